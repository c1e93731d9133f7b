// How much a film flashes, by the general and the red flash thresholds of WCAG 2.3.1.
// In: every frame, in order, and where it differs from the one before; or a film. Out: where there
// are more flashes within a second than are allowed.
#pragma once

#include <piblocks/image.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "render/film.hpp"

namespace piblocks {

/// More flashes than are allowed, within the second up to a frame.
struct Flashing {
  std::int64_t frame = 0;
  double share = 0;  ///< of the field of sight that is covered most; more than kMostFlashing
};

/// The harmless share of ten degrees of sight.
inline constexpr double kMostFlashing = 0.25;

/// A flash is a pair of opposing changes: of relative luminance by a tenth of that of white, the
/// darker state being below 0.8; or of saturated red by 20 of 320 (R - G - B), which is red where
/// R / (R + G + B) >= 0.8 (all of them linear; definition of general and red flash thresholds in
/// WCAG 2.1). It matters if it covers more than a quarter of ten degrees of sight: of 341 x 256
/// pixels on a screen of 1024 x 768 that the picture fills. The meter averages over the cells of a
/// grid: a flash that covers a part of a cell counts as a weaker flash of the whole cell. Changes
/// count whether or not they are simultaneous, and half a flash too many is too many: this errs on
/// the safe side.
class FlashMeter {
 public:
  /// @param most  flashes within a second that are allowed, >= 1.
  FlashMeter(int width_px, int height_px, double frames_per_s, int most);

  /// @param changed  where the frame differs from the last one; the first one is read as a whole.
  /// @returns the flashing within the second up to this frame, if it is too much. Transparent is
  ///          black.
  std::optional<Flashing> take(const ImageView& frame, std::span<const PixelRect> changed);

 private:
  enum Measure : std::size_t { luminance, red };
  static constexpr std::size_t kMeasures = 2;
  using Measured = std::array<float, kMeasures>;

  /// One measure of a cell, from one change to the next.
  struct Swing {
    float low = 0;
    float high = 0;
    int direction = 0;       ///< of the last change
    std::int64_t count = 0;  ///< changes so far
  };

  std::size_t cell_at(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  void touch(const PixelRect& rect);
  Measured measure(const ImageView& frame, int column, int row) const;
  void follow(std::size_t at, Measure measure, float value);
  bool flashes(std::size_t swing) const;
  std::optional<Flashing> most_flashing() const;

  int width_px_;
  int height_px_;
  double frames_per_s_;
  std::size_t too_many_;  ///< changes
  int cell_px_;
  int columns_;
  int rows_;
  int sight_columns_;
  int sight_rows_;
  std::array<float, 256> light_{};
  std::int64_t frame_ = -1;
  bool has_changed_ = false;
  std::vector<bool> touched_;             ///< by cell
  std::vector<Swing> swings_;             ///< by cell and measure
  std::vector<std::int64_t> changed_at_;  ///< the last too_many_ frames of each swing, as a ring
};

/// Paints every frame once, without encoding any.
/// @param most    flashes within a second that are allowed (WCAG 2.3.1: 3), >= 1.
/// @param frames  that are rendered; all without it
/// @throws UsageError as FlashMeter finds; SimulationError, DrawError, Interrupted
void check_flashes(const Film& film, int most, const std::stop_token& stop,
                   const std::optional<FrameRange>& frames = {});

}  // namespace piblocks
