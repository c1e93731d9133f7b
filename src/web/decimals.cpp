#include "web/decimals.hpp"

#include <algorithm>
#include <cstddef>

namespace piblocks::web {
namespace {

constexpr std::size_t kMostPlaces = 20;
constexpr std::string_view kDigits = "0123456789";

}  // namespace

std::string decimal_text(const Rational& value) {
  Integer rest = value.get_den();
  std::size_t places = 0;
  for (const unsigned long prime : {2UL, 5UL}) {
    const Integer factor = prime;
    places = std::max<std::size_t>(
        places, mpz_remove(rest.get_mpz_t(), rest.get_mpz_t(), factor.get_mpz_t()));
  }
  if (places == 0 || rest != 1 || places > kMostPlaces) return value.get_str();
  const Rational scaled = abs(value) * power(10, places);
  std::string digits = scaled.get_num().get_str();
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  digits.insert(digits.size() - places, ".");
  return (value < 0 ? "-" : "") + digits;
}

std::string with_decimals(std::string_view text) {
  std::string result;
  for (;;) {
    const std::size_t begin = text.find_first_of(kDigits);
    if (begin == std::string_view::npos) return result.append(text);
    result.append(text.substr(0, begin));
    text.remove_prefix(begin);
    const std::size_t slash = std::min(text.find_first_not_of(kDigits), text.size());
    std::size_t end = slash;
    if (slash < text.size() && text[slash] == '/') {
      end = std::min(text.find_first_not_of(kDigits, slash + 1), text.size());
    }
    const std::string number(text.substr(0, end));
    const bool is_fraction = end > slash + 1 && number.find_first_not_of('0', slash + 1) < end;
    result += is_fraction ? decimal_text(parse_rational(number, kMaxMassBits)) : number;
    text.remove_prefix(end);
  }
}

}  // namespace piblocks::web
