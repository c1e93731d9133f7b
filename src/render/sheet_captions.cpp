#include "render/sheet_captions.hpp"

#include <fmt/format.h>
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>

#include "draw/number_text.hpp"

namespace piblocks {
namespace {

/// Significant digits of a time.
constexpr int kUsualDigits = 6;
constexpr int kMostDigits = 40;
/// A number whose first digit is at this decimal place or further right is written with a power of
/// ten.
constexpr int kFirstDecimalOfPowers = 5;
/// A time that looks like another is written from the turn if it is so many times nearer to it than
/// to 0.
constexpr int kNearTurn = 1000;

void drop_last_zeros(std::string& decimal) {
  if (decimal.find('.') == std::string::npos) return;
  decimal.erase(decimal.find_last_not_of('0') + 1);
  if (decimal.back() == '.') decimal.pop_back();
}

/// With so many significant digits, but no zeros behind the last one; a time that is beyond that is
/// written with a power of ten.
std::string time_text(const Rational& time, int digits) {
  // What is rounded to ten times as much keeps a digit more than was asked for.
  const long exponent = time == 0 ? 0 : magnitude_of(abs(time)).exponent;
  const bool is_short = exponent > -kFirstDecimalOfPowers && exponent < kMostDigits;
  const long unit = is_short ? 0 : exponent;
  const Rational scaled = time / power_of_ten(unit);
  const int decimals = static_cast<int>(std::max(0L, digits - 1 - (exponent - unit)));
  std::string text = fixed_text(scaled, decimals);
  drop_last_zeros(text);
  return is_short ? text : fmt::format("{}×{}", text, power_text(unit));
}

/// "turn − 0.3"
std::string text_from_turn(const Rational& after_turn, int digits) {
  if (after_turn == 0) return "turn";
  return fmt::format("turn {} {}", after_turn < 0 ? "−" : "+", time_text(abs(after_turn), digits));
}

/// A time, and how it is written.
struct WrittenTime {
  Rational time;
  std::optional<Rational> turn;  ///< of the run
  bool is_from_turn = false;
  int digits = kUsualDigits;

  std::string text() const {
    return is_from_turn ? text_from_turn(time - *turn, digits) : time_text(time, digits);
  }
  bool is_near_turn() const { return turn && abs(Rational(time - *turn)) * kNearTurn < abs(time); }
};

/// Writes it more exactly; false if it is exact enough.
bool refine(WrittenTime& written) {
  if (written.digits == kMostDigits) return false;
  if (!written.is_from_turn && written.is_near_turn()) {
    written.is_from_turn = true;
  } else {
    ++written.digits;
  }
  return true;
}

/// Writes times that differ but look alike more exactly; false if there are none.
bool refine_clashes(std::vector<WrittenTime>& all, std::vector<std::string>& texts) {
  using Extremes = std::pair<Rational, Rational>;
  std::map<std::string, Extremes> times_by_text;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rational& time = all[i].time;
    Extremes& seen = times_by_text.try_emplace(texts[i], time, time).first->second;
    seen = {std::min(seen.first, time), std::max(seen.second, time)};
  }
  bool is_refined = false;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [least, greatest] = times_by_text.at(texts[i]);
    if (least == greatest || !refine(all[i])) continue;
    is_refined = true;
    texts[i] = all[i].text();
  }
  return is_refined;
}

}  // namespace

std::vector<std::string> sheet_captions(const Scene& scene, const Log& log,
                                        const std::vector<Instant>& instants,
                                        const std::vector<Rational>& times) {
  const std::optional<Rational> turn = turn_of(log);
  const bool picture_has_time = scene.show.has(Overlay::time);
  if (picture_has_time && !turn) return std::vector<std::string>(times.size());
  std::vector<WrittenTime> all;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const bool is_from_turn = picture_has_time || instants[i].anchor == Instant::Anchor::turn;
    all.push_back({times[i], turn, is_from_turn});
    texts.push_back(all.back().text());
  }
  while (refine_clashes(all, texts)) {
  }
  for (std::string& text : texts) text.insert(0, "t = ");
  return texts;
}

}  // namespace piblocks
