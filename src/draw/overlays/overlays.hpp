// The overlays there are, one file each.
// In: a setting. Out: a part of the picture.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "draw/part.hpp"
#include "draw/text_widths.hpp"

namespace piblocks {

/// Each block's mass on it, as large as fits.
std::unique_ptr<PicturePart> mass_labels(const Setting& setting);

/// Arrows above the blocks. Velocities of one run differ by the square root of the mass ratio, so
/// lengths grow less and less, up to a longest one; the figure says the value.
/// @throws UsageError if the view has no room above the blocks.
std::unique_ptr<PicturePart> velocity_arrows(const Setting& setting);

/// A scale of positions below the blocks.
/// @throws UsageError if the view has no room there.
std::unique_ptr<PicturePart> ruler(const Setting& setting);

/// A short text that changes with what is shown, beside others in a row.
struct ReadOut {
  const char* name;                                    ///< in messages
  std::string widest;                                  ///< what takes most room
  std::function<std::string(const FrameState&)> text;  ///< empty where there is nothing to say
  Color color;
};

ReadOut time_read_out(const Setting& setting);
ReadOut energy_read_out(const Setting& setting);
ReadOut momentum_read_out(const Setting& setting);
/// Whether slower_read_out() has anything to say.
bool has_slow_motion(const Pacing& pacing);
/// "10× slower".
ReadOut slower_read_out(const Setting& setting);

/// Read-outs in rows.
class ReadOutRows : public PicturePart {
 public:
  /// @param area  as wide as the rows may be; they are centred in it from its top on.
  /// @throws UsageError if one has to be too small to be read.
  ReadOutRows(std::vector<ReadOut> read_outs, const Rectangle& area, double text_px,
              const Font& font);

  double height() const noexcept { return height_; }
  /// Moves all rows down.
  void move(double y);
  void add(const FrameState& shown, std::vector<DrawItem>& items) const override;

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
