#include "draw/panels/certainty_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "draw/number_text.hpp"

namespace piblocks {
namespace {

/// Up to so many places numbers are written out.
constexpr unsigned long kFewPlaces = 5;
constexpr unsigned long kFewZeros = 3;  ///< of a power of ten
constexpr std::size_t kFewNines = 5;
constexpr std::size_t kDigitsOfMany = 6;  ///< of pi, beside a number of nines
/// Digits after the point, or behind those that two numbers share.
constexpr std::size_t kLeastDigits = 3;
constexpr std::size_t kAfterNines = 3;

/// The last characters of a whole number: "…932,384".
std::string end_of(const Integer& value, int base, std::size_t length) {
  const std::string text = count_text(value, base);
  return text.size() <= length ? text : "…" + text.substr(text.size() - length);
}

std::string ordinal(const Integer& value) {
  const unsigned long tens = Integer(value % 100).get_ui();
  const unsigned long ones = tens % 10;
  const bool is_teen = tens / 10 == 1;
  const char* ending = "th";
  if (!is_teen && ones == 1) ending = "st";
  if (!is_teen && ones == 2) ending = "nd";
  if (!is_teen && ones == 3) ending = "rd";
  return with_thousands_separators(value) + ending;
}

std::size_t shared_length(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace

CertaintyWords::CertaintyWords(const FormulaSetter& setter, const Certainty& certainty)
    : set_(setter), numbers_(certainty), nines_(certainty.nines()) {}

std::vector<Formula> CertaintyWords::titles() const {
  if (numbers_.is_wrong()) {
    return {set_.text("Could a digit be wrong? Here the last one is"),
            set_.text("The last digit is wrong")};
  }
  if (nines_ == 0) {
    return {set_.text("Could a digit be wrong? Not here"), set_.text("No digit is wrong")};
  }
  return {set_.text(fmt::format("Could a digit be wrong? Only if {} followed", largest_digits())),
          set_.text(fmt::format("Only {} could mislead it", largest_digits()))};
}

std::vector<CertaintyWords::Pair> CertaintyWords::ends() const {
  const Integer& whole = numbers_.whole();
  const int base = numbers_.base();
  const Integer right = whole + (numbers_.is_wrong() ? 2 : 1);
  constexpr std::array<std::size_t, 3> kLengths{std::string::npos, 7, 3};
  std::vector<Pair> ends;
  ends.reserve(kLengths.size());
  for (const std::size_t length : kLengths) {
    ends.push_back(
        {set_.text(end_of(whole, base, length)), set_.text(end_of(right, base, length))});
  }
  return ends;
}

std::vector<CertaintyWords::Pair> CertaintyWords::marks() const {
  const Formula pi = pi_over_s() + set_.text(" = ");
  const Formula ray = pi_over_theta() + set_.text(" = ");
  std::vector<Pair> pairs;
  if (numbers_.places() == 0) {
    pairs.push_back({pi + set_.text(numbers_.scaled_pi(kLeastDigits) + "…"),
                     ray + set_.text(numbers_.pi_over_theta(0))});
  } else {
    const std::size_t many = 2 * numbers_.places() + kLeastDigits;
    const std::string a = numbers_.scaled_pi(many);
    const std::string b = numbers_.pi_over_theta(many);
    const std::size_t shared = shared_length(a, b);
    const std::size_t length = std::max(shared + 1, a.find('.') + 1 + kLeastDigits);
    pairs.push_back(
        {pi + set_.text(a.substr(0, length) + "…"), ray + set_.text(b.substr(0, length) + "…")});
    constexpr std::size_t kBefore = 3;
    if (shared > a.find('.') + kBefore) {
      const std::size_t from = shared - kBefore;
      pairs.push_back({pi + set_.text("…" + a.substr(from, length - from) + "…"),
                       ray + set_.text("…" + b.substr(from, length - from) + "…")});
    }
  }
  pairs.push_back({pi_over_s(), pi_over_theta()});
  return pairs;
}

std::vector<Formula> CertaintyWords::next_whole_meaning() const {
  if (numbers_.is_wrong()) return {};
  const Formula who = set_.text(one_more() + " would need ") + pi_over_theta();
  if (!is_small()) {
    return {who + set_.text(" past this end"), set_.text("one more: past this end")};
  }
  const Formula than = set_.text(" > " + next_whole_text());
  return {who + than, pi_over_theta() + than + set_.text(": one more")};
}

std::vector<std::vector<Words>> CertaintyWords::notes(bool is_defined) const {
  const Words needs = needed();
  const Words far = distance();
  std::vector<std::vector<Words>> notes;
  const bool has_reason = !is_defined || numbers_.places() > 0;
  if (has_reason && !far.empty()) notes.push_back({reason(is_defined), far, needs});
  if (!far.empty()) notes.push_back({far, needs});
  if (has_reason && far.empty()) notes.push_back({reason(is_defined), needs});
  notes.push_back({needs});
  notes.push_back({needed_briefly()});
  return notes;
}

Formula CertaintyWords::mark_names() const {
  return pi_over_s() + set_.text(" and ") + pi_over_theta();
}

Formula CertaintyWords::excess_label() const {
  const Formula product = set_.text("π") + set_.italic("s") + set_.text("/3");
  if (numbers_.places() == 0) return set_.text(short_text(numbers_.excess()));
  if (numbers_.base() != kUsualBase) return set_.text("about ") + product;
  return set_.text(short_text(numbers_.excess()) + " ≈ ") + product;
}

Formula CertaintyWords::magnification(long exponent) const {
  return set_.text("× " + (exponent == 1 ? "10" : power_text(exponent)));
}

Words CertaintyWords::words(const std::string& text) const {
  std::istringstream stream(text);
  Words all;
  for (std::string word; stream >> word;) all.push_back(set_.text(word));
  return all;
}

Formula CertaintyWords::theta() const { return set_.italic("θ"); }

Formula CertaintyWords::pi_over_theta() const { return set_.text("π/") + theta(); }

Formula CertaintyWords::pi_over_s() const {
  const unsigned long places = numbers_.places();
  if (places == 0) return set_.text("π");
  const int base = numbers_.base();
  if (places == 1 || (base == kUsualBase && places <= kFewZeros)) {
    return set_.text(with_thousands_separators(power(base, places).get_num()) + " π");
  }
  return set_.raised(set_.text(std::to_string(base)), set_.text(std::to_string(places))) +
         set_.text(" π");
}

std::string CertaintyWords::largest_digits() const {
  const int base = numbers_.base();
  if (base == kUsualBase) return "nines";
  if (base == 2) return "ones";
  return "digits " + Integer(base - 1).get_str(base);
}

std::string CertaintyWords::next_whole_text() const {
  return count_text(numbers_.whole() + 1, numbers_.base());
}

bool CertaintyWords::is_small() const { return numbers_.places() <= kFewPlaces; }

std::string CertaintyWords::one_more() const {
  const bool has_name = is_small() && numbers_.base() == kUsualBase;
  return has_name ? "a " + ordinal(numbers_.whole() + 1) + " collision" : "one more collision";
}

/// s, up to an equals sign and its value.
Words CertaintyWords::ratio() const {
  const Formula masses = set_.lowered(set_.italic("m"), set_.text("1")) + set_.text("/") +
                         set_.lowered(set_.italic("m"), set_.text("2"));
  return {set_.italic("s"), set_.text("="), set_.root(masses)};
}

Formula CertaintyWords::definition() const {
  Formula line = theta() + set_.text(" = arctan ") + set_.italic("s") + set_.text(", ");
  for (const Formula& word : ratio()) line += word + space();
  const unsigned long places = numbers_.places();
  if (places == 0) return line + set_.text("= 1");
  if (places == 1 || (numbers_.base() == kUsualBase && places <= kFewZeros)) {
    const Integer scale = power(numbers_.base(), places).get_num();
    return line + set_.text("= 1/" + with_thousands_separators(scale));
  }
  return line + set_.text("= ") +
         set_.raised(set_.text(std::to_string(numbers_.base())),
                     set_.text("−" + std::to_string(places)));
}

Words CertaintyWords::reason(bool is_defined) const {
  const Words result = words("so") + Words{pi_over_theta()} + words("is a little more than") +
                       Words{pi_over_s() + set_.text(".")};
  if (is_defined) {
    return Words{theta()} + words("is a little less than") +
           Words{set_.italic("s") + set_.text(",")} + result;
  }
  const Formula angle = theta() + set_.text(" = arctan ") + set_.italic("s");
  Words least = ratio();
  least.back() += set_.text(numbers_.places() == 0 ? "." : ",");
  if (numbers_.places() == 0) return Words{angle} + words("with") + least;
  return Words{angle} + words("is a little less than") + least + result;
}

Words CertaintyWords::distance() const {
  if (numbers_.base() != kUsualBase || numbers_.distance_to_next() < 2 * numbers_.excess()) {
    return {};
  }
  const Rational times = numbers_.distance_to_next() / numbers_.excess();
  constexpr int kMostWritten = 100'000;
  const std::string many = times < kMostWritten
                               ? with_thousands_separators(floor(times))
                               : "More than " + power_text(magnitude_of(times).exponent);
  const std::string after = is_small() ? next_whole_text() : "the next whole number";
  return words(many + " such gaps would fit between") + Words{pi_over_theta()} +
         words("and " + after + ".");
}

Words CertaintyWords::needed() const {
  if (numbers_.places() == 0) {
    return words("For " + one_more() + ",") + Words{pi_over_theta()} +
           words("would have to be more than " + next_whole_text() + "; it is " +
                 next_whole_text() + " exactly.");
  }
  const std::size_t counted = numbers_.whole().get_str(numbers_.base()).size();
  if (nines_ > kFewNines) {
    return words(
        fmt::format("One more collision would need {} {} after these {} digits of π; it "
                    "goes on with {}…",
                    nines_, largest_digits(), counted, numbers_.following(kDigitsOfMany)));
  }
  const std::size_t many = nines_ + kAfterNines;
  const std::string begun = pi_digits(numbers_.base(), counted);
  if (numbers_.is_wrong()) {
    return words(
        fmt::format("The digits {} would have to be followed by {}… or more for {}, and "
                    "they are: {}…",
                    begun, numbers_.needed(many), one_more(), numbers_.following(many)));
  }
  return words(fmt::format("For {}, {} would have to go on with {}… or more; π goes on with {}…",
                           one_more(), begun, numbers_.needed(many), numbers_.following(many)));
}

Words CertaintyWords::needed_briefly() const {
  if (numbers_.places() == 0) {
    return words("Equal masses:") + Words{pi_over_theta() + set_.text(" = " + next_whole_text())};
  }
  if (nines_ > kFewNines) {
    return words(fmt::format("Needed next in π: {} {}. Found: {}…", nines_, largest_digits(),
                             numbers_.following(kDigitsOfMany)));
  }
  const std::size_t many = nines_ + kAfterNines;
  return words(fmt::format("Needed next in π: {}… Found: {}…", numbers_.needed(many),
                           numbers_.following(many)));
}

}  // namespace piblocks
