#include "draw/panels/corner_path.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/rounded.hpp"
#include "draw/number_text.hpp"

namespace piblocks {
namespace {

/// The picture is enlarged so that red's gap is at most this share of its width.
constexpr double kGapShare = 0.8;
/// The share of the way to the next power of ten, on a logarithmic scale, in which the zoom stays.
/// A picture whose zoom stays costs next to nothing.
constexpr double kPlateau = 0.95;
/// Larger powers of ten are beyond the range of a double.
constexpr long kMostPower = 300;

Gaps clipped(const Gaps& outside, const Gaps& inside, double limit) {
  const double share = (limit - inside.y2) / (outside.y2 - inside.y2);
  return {inside.y1 + share * (outside.y1 - inside.y1), limit};
}

/// The part of a line, from far away to the corner, that is in the window.
std::vector<Gaps> inside_of(const GapWindow& window, const std::vector<Gaps>& corners) {
  const auto is_inside = [&](const Gaps& gaps) { return gaps.y2 <= window.to; };
  const auto first = std::ranges::find_if(corners, is_inside);
  std::vector<Gaps> line(first, corners.end());
  if (first != corners.end() && first != corners.begin()) {
    line.insert(line.begin(), clipped(*std::prev(first), *first, window.to));
  }
  return line;
}

}  // namespace

CornerPath::CornerPath(const PairLog& log, const Span& span, int most_corners) {
  const Integer before = log.blocks_at(span.from).count;
  const Integer last = log.blocks_at(span.to).count;
  const std::optional<Rational> turn = turn_of(log.blocks());
  const Rational middle = std::clamp(turn.value_or(span.from), span.from, span.to);
  const Integer at_turn = log.blocks_at(middle).count;
  in_.push_back(log.gaps_at(span.from));
  out_.push_back(log.gaps_at(span.to));
  const Integer in_end = std::min(at_turn, Integer(before + most_corners));
  const Integer out_end = std::max(Integer(at_turn + 1), Integer(last + 1 - most_corners));
  for (Integer k = before + 1; k <= in_end; k += 1) in_.push_back(log.gaps_at_collision(k));
  for (Integer k = last; k >= out_end; k -= 1) out_.push_back(log.gaps_at_collision(k));
  is_complete_ = in_end == at_turn && out_end == at_turn + 1;
  least_y2_ = std::min({log.gaps_at(middle).y2, in_.back().y2, out_.back().y2});
  if (at_turn > before) least_y2_ = std::min(least_y2_, log.gaps_at_collision(at_turn).y2);
  if (at_turn < last) least_y2_ = std::min(least_y2_, log.gaps_at_collision(at_turn + 1).y2);
  for (const auto* side : {&in_, &out_}) {
    for (const Gaps& gaps : *side) greatest_y2_ = std::max(greatest_y2_, gaps.y2);
  }
}

CornerPath::Side CornerPath::side_of(const std::vector<Gaps>& corners,
                                     const GapWindow& window) const {
  std::vector<Gaps> line = inside_of(window, corners);
  // From one visit of the wall to the next.
  for (std::size_t i = 0; i + 2 < line.size(); ++i) {
    if (line[i].y2 - line[i + 2].y2 >= window.least_apart) continue;
    line.resize(i + 1);
    const double from = line.back().y2;
    return {std::move(line), from};
  }
  double dense_from = 0;
  if (!is_complete_) dense_from = line.empty() ? window.to : line.back().y2;
  return {std::move(line), dense_from};
}

ShownPath CornerPath::shown(const GapWindow& window) const {
  Side in = side_of(in_, window);
  Side out = side_of(out_, window);
  ShownPath path;
  path.filled_low = path.filled_high = least_y2_;
  if (in.dense_from == 0 && out.dense_from == 0) {
    std::ranges::reverse(out.line);
    std::ranges::move(out.line, std::back_inserter(in.line));
    path.lines.push_back(std::move(in.line));
    return path;
  }
  if (least_y2_ < window.to) {
    path.filled_high = std::max({least_y2_, in.dense_from, out.dense_from});
  }
  for (Side* side : {&in, &out}) {
    if (side->line.size() > 1) path.lines.push_back(std::move(side->line));
  }
  return path;
}

CornerZoom::CornerZoom(double least_share, const FormulaSetter& set)
    // One power more than is shown: Zoom has no plateau at 1.
    : zoom_(std::clamp(std::lround(std::ceil(2 - rounded::log10(least_share))),
                       static_cast<long>(kPlain), kMostPower),
            kPlateau) {
  for (std::size_t exponent = 0; exponent < kPlain; ++exponent) {
    // Of two digits.
    for (int tenths = 0; tenths <= 100; ++tenths) {
      const double value = power(exponent) * tenths / 10;
      plain_.at(exponent).push_back(set.text("×" + fixed_text(value, exponent == 0 ? 1 : 0)));
    }
  }
  for (long exponent = 0; exponent <= zoom_.most_exponent(); ++exponent) {
    const bool is_plain = exponent < static_cast<long>(kPlain);
    powers_.push_back(
        set.text("×" + (is_plain ? fixed_text(power_of_ten(exponent), 0) : power_text(exponent))));
  }
}

double CornerZoom::factor_for(double share) const {
  const double room = kGapShare / share;
  if (room < 1) return 1;
  const double zoom = zoom_.factor_for(10 * room);
  const long exponent = zoom_.exponent_of(zoom);
  return zoom == zoom_.power(exponent) ? zoom_.power(exponent - 1) : zoom / 10;
}

std::optional<std::size_t> CornerZoom::exponent_of(double zoom) const {
  const long exponent = zoom_.exponent_of(zoom);
  if (zoom != zoom_.power(exponent)) return std::nullopt;
  return static_cast<std::size_t>(exponent);
}

Formula CornerZoom::text(double zoom) const {
  const auto exponent = static_cast<std::size_t>(zoom_.exponent_of(zoom));
  const auto tenths = static_cast<std::size_t>(std::lround(10 * zoom / power(exponent)));
  if (tenths <= 10) return powers_.at(exponent);
  if (exponent < kPlain) return plain_.at(exponent).at(tenths);
  if (tenths >= 100) return powers_.at(exponent + 1);
  return plain_.at(0).at(tenths) + powers_.at(exponent);
}

}  // namespace piblocks
