// All overlays.
// In: a setting. Out: a drawable, or a read-out for a row of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "draw/drawable.hpp"

namespace piblocks {

/// Each block's mass on it, as large as fits.
Drawable mass_labels(const Setting& setting);

/// Arrows above the blocks, with figures. Velocities of one run differ by the square root of the
/// mass ratio, so lengths grow less and less with the velocity, up to a longest one.
/// @throws UsageError if the view has no room above the blocks.
Drawable velocity_arrows(const Setting& setting);

/// A scale of positions below the blocks.
/// @throws UsageError if the view has no room there.
Drawable ruler(const Setting& setting);

/// A short text that changes with what is shown, beside others in a row.
struct ReadOut {
  const char* name;                                    ///< in messages
  std::string widest;                                  ///< the text that takes most room
  std::function<std::string(const FrameState&)> text;  ///< empty where there is nothing to say
  Color color;
};

ReadOut time_read_out(const Setting& setting);
ReadOut energy_read_out(const Setting& setting);
ReadOut momentum_read_out(const Setting& setting);
bool has_slow_motion(const Pacing& pacing);
/// "10× slower".
ReadOut slower_read_out(const Setting& setting);

/// Read-outs in centred rows, from the frame's top on. A Drawable.
class ReadOutRows {
 public:
  /// @throws UsageError if one is too long to be read.
  ReadOutRows(std::vector<ReadOut> read_outs, const Setting& setting);

  double height() const noexcept { return height_; }
  /// Moves all rows down.
  void move(double y);
  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const;

 private:
  struct Placed {
    ReadOut read_out;
    Point origin;
    double room_px = 0;
  };
  std::vector<Placed> placed_;
  TextWidths widths_;
  double text_px_;
  double height_ = 0;
};

}  // namespace piblocks
