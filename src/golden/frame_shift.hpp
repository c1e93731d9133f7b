// Whether one side of a comparison shows what the other one shows, some frames earlier or later.
// In: the frames of both sides, in their order. Out: a sentence, if so.
#pragma once

#include <piblocks/compare.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace piblocks {

/// Looks at the frames from the first that is different, since those before are equal.
class FrameShift {
 public:
  void add(std::int64_t number, const FrameComparison& frame);
  /// "from frame 12 on, frames look like those of the reference 2 frames before them"; empty if
  /// they do not.
  std::string text() const;

 private:
  static constexpr int kAcross = 32;
  static constexpr int kDown = 18;
  /// The mean red, green and blue of its parts.
  using Thumbnail = std::array<float, std::size_t{3} * kAcross * kDown>;

  static Thumbnail thumbnail_of(const Image& image);
  /// The mean square difference of the frames that both sides have if the actual ones come later.
  double distance(int frames_later) const;

  std::int64_t first_ = 0;
  std::vector<Thumbnail> reference_;
  std::vector<Thumbnail> actual_;
};

}  // namespace piblocks
