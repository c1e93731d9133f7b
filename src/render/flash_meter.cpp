#include "render/flash_meter.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <optional>

#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "draw/light.hpp"

namespace piblocks {
namespace {

/// Cells along the picture's longer side, about.
constexpr int kCells = 160;
// WCAG: the picture fills a screen of 1024 x 768, of which one can see this much at once.
constexpr double kScreenWidth_px = 1024;
constexpr double kScreenHeight_px = 768;
constexpr double kSightWidth_px = 341;
constexpr double kSightHeight_px = 256;

constexpr float kLeastChange = 0.1F;
constexpr float kBright = 0.8F;
constexpr float kLeastRedChange = 20.0F / 320;
constexpr float kSaturated = 0.8F;

/// Cells that a length covers, rounded to the smaller field of sight.
int cells_in(double length_px, int cell_px, int most) {
  return std::clamp(static_cast<int>(length_px / cell_px), 1, most);
}

}  // namespace

FlashMeter::FlashMeter(int width_px, int height_px, double frames_per_s, int most)
    : width_px_(width_px),
      height_px_(height_px),
      frames_per_s_(frames_per_s),
      too_many_(2 * static_cast<std::size_t>(most) + 1),
      cell_px_(std::max(1, std::max(width_px, height_px) / kCells)),
      columns_((width_px + cell_px_ - 1) / cell_px_),
      rows_((height_px + cell_px_ - 1) / cell_px_) {
  const double scale = std::max(width_px / kScreenWidth_px, height_px / kScreenHeight_px);
  sight_columns_ = cells_in(scale * kSightWidth_px, cell_px_, columns_);
  sight_rows_ = cells_in(scale * kSightHeight_px, cell_px_, rows_);
  const Light light;
  for (std::size_t i = 0; i < light_.size(); ++i) light_[i] = float(light.of(double(i)));
  const auto cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  touched_.resize(cells);
  swings_.resize(cells * kMeasures);
  changed_at_.resize(cells * kMeasures * too_many_);
}

std::optional<Flashing> FlashMeter::take(const ImageView& frame,
                                         std::span<const PixelRect> changed) {
  const bool is_first = ++frame_ == 0;
  has_changed_ = false;
  std::fill(touched_.begin(), touched_.end(), is_first);
  for (const PixelRect& rect : changed) touch(rect);
  for (std::size_t cell = 0; cell < touched_.size(); ++cell) {
    if (!touched_[cell]) continue;
    const int at = static_cast<int>(cell);
    const Measured measured = measure(frame, at % columns_, at / columns_);
    for (const Measure each : {luminance, red}) {
      Swing& swing = swings_[cell * kMeasures + each];
      if (is_first) swing.low = swing.high = measured[each];
      follow(cell * kMeasures + each, each, measured[each]);
    }
  }
  // More can only be flashing than before where something has changed.
  return has_changed_ ? most_flashing() : std::nullopt;
}

void FlashMeter::touch(const PixelRect& rect) {
  for (int y = rect.y_px / cell_px_; y * cell_px_ < rect.bottom_px(); ++y) {
    for (int x = rect.x_px / cell_px_; x * cell_px_ < rect.right_px(); ++x) {
      touched_[cell_at(x, y)] = true;
    }
  }
}

FlashMeter::Measured FlashMeter::measure(const ImageView& frame, int column, int row) const {
  const int left = column * cell_px_;
  const int top = row * cell_px_;
  const int right = std::min(left + cell_px_, width_px_);
  const int bottom = std::min(top + cell_px_, height_px_);
  Measured sum{};
  for (int y = top; y < bottom; ++y) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(frame.row(y));
    for (int x = left; x < right; ++x) {
      const float r = light_[words[x] >> 16 & 0xff];
      const float g = light_[words[x] >> 8 & 0xff];
      const float b = light_[words[x] & 0xff];
      sum[luminance] += 0.2126F * r + 0.7152F * g + 0.0722F * b;
      if (r >= kSaturated * (r + g + b)) sum[red] += std::max(0.0F, r - g - b);
    }
  }
  const auto pixels = static_cast<float>((right - left) * (bottom - top));
  for (float& value : sum) value /= pixels;
  return sum;
}

void FlashMeter::follow(std::size_t at, Measure measure, float value) {
  Swing& swing = swings_[at];
  const float least = measure == luminance ? kLeastChange : kLeastRedChange;
  const auto counts = [&](float darker, float brighter) {
    return brighter - darker >= least && (measure == red || darker < kBright);
  };
  int direction = 0;
  if (swing.direction <= 0 && counts(swing.low, value)) direction = 1;
  if (swing.direction >= 0 && counts(value, swing.high)) direction = -1;
  if (direction == 0) {
    swing.low = std::min(swing.low, value);
    swing.high = std::max(swing.high, value);
    return;
  }
  // The next change is measured from the extreme that follows this one.
  swing.low = swing.high = value;
  swing.direction = direction;
  changed_at_[at * too_many_ + static_cast<std::size_t>(swing.count) % too_many_] = frame_;
  ++swing.count;
  has_changed_ = true;
}

bool FlashMeter::flashes(std::size_t swing) const {
  const auto count = static_cast<std::size_t>(swings_[swing].count);
  if (count < too_many_) return false;
  const std::int64_t oldest = changed_at_[swing * too_many_ + count % too_many_];
  return double(frame_ - oldest) <= frames_per_s_;
}

std::optional<Flashing> FlashMeter::most_flashing() const {
  // Sums over all cells above and to the left, to have that of any rectangle at once.
  const auto stride = static_cast<std::size_t>(columns_) + 1;
  std::vector<int> sums(stride * (static_cast<std::size_t>(rows_) + 1));
  const auto sum = [&](int x, int y) -> int& {
    return sums[static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      const std::size_t at = cell_at(x, y) * kMeasures;
      const int own = flashes(at + luminance) || flashes(at + red) ? 1 : 0;
      sum(x + 1, y + 1) = own + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    }
  }
  int most = 0;
  for (int y = sight_rows_; y <= rows_; ++y) {
    for (int x = sight_columns_; x <= columns_; ++x) {
      const int left = x - sight_columns_;
      const int top = y - sight_rows_;
      most = std::max(most, sum(x, y) - sum(left, y) - sum(x, top) + sum(left, top));
    }
  }
  const double share = double(most) / (double(sight_columns_) * sight_rows_);
  if (share <= kMostFlashing) return std::nullopt;
  return Flashing{frame_, share};
}

void check_flashes(const Film& film, int most, const std::stop_token& stop,
                   const std::optional<FrameRange>& frames) {
  const View& view = film.view();
  const double frames_per_s = to_double(view.frame_rate);
  FlashMeter meter(view.width_px, view.height_px, frames_per_s, most);
  Canvas canvas(view.width_px, view.height_px, view.background);
  canvas.listen(stop);
  std::optional<Flashing> first;
  Flashing worst;
  const auto [begin, last] = frames.value_or(film.frames());
  for (std::int64_t frame = begin; frame <= last; ++frame) {
    check_stop(stop);
    const std::span<const PixelRect> changed = canvas.update(film.frame(frame));
    const std::optional<Flashing> found = meter.take(canvas.view(), changed);
    if (!found) continue;
    if (!first) first = found;
    worst = std::max(worst, *found, [](const auto& a, const auto& b) { return a.share < b.share; });
  }
  if (!first) return;
  throw UsageError(fmt::format(
      "render: the film would flash more than {} times within a second, first at {:.3f} s, and at "
      "{:.3f} s on {:.0f} % of a field of view ({:.0f} % are harmless, WCAG 2.3.1); expose frames "
      "for longer (--shutter 1), slow the film down (--slow-motion auto, --speed), or show it "
      "smaller in the frame",
      most, double(first->frame) / frames_per_s, double(worst.frame) / frames_per_s,
      100 * worst.share, 100 * kMostFlashing));
}

}  // namespace piblocks
