// How the frames of animated PNG (PNG specification, 13) and GIF (89a, 23) make pictures.
// In: frames, each with its place and what becomes of it. Out: pictures with straight alpha.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace piblocks {

/// What becomes of a frame before the next one.
enum class Disposal {
  none,        ///< it stays
  background,  ///< its area becomes transparent
  previous     ///< its area becomes what it was
};

/// The place of a frame, which lies wholly on the screen, and what happens to it afterwards.
struct FrameControl {
  std::uint32_t width, height, x, y;
  Disposal disposal;
  bool is_blended;  ///< else it replaces what is there, with its alpha
};

/// The channels of a word, alpha last.
template <typename Word>
int shift_of(int channel) {
  return channel * int(sizeof(Word)) * 2;
}

/// A colour over another one, neither multiplied by its alpha (PNG specification, 13.9).
template <typename Word>
Word over(Word front, Word back) {
  constexpr std::uint64_t kMax = (std::uint64_t{1} << (sizeof(Word) * 2)) - 1;
  const auto level = [](Word word, int channel) { return word >> shift_of<Word>(channel) & kMax; };
  const std::uint64_t front_weight = level(front, 3) * kMax;
  const std::uint64_t back_weight = (kMax - level(front, 3)) * level(back, 3);
  const std::uint64_t sum = front_weight + back_weight;
  if (sum == 0) return 0;
  Word result = Word((2 * sum + kMax) / (2 * kMax)) << shift_of<Word>(3);
  for (int channel = 0; channel < 3; ++channel) {
    const std::uint64_t colour =
        level(front, channel) * front_weight + level(back, channel) * back_weight;
    result |= Word((2 * colour + sum) / (2 * sum)) << shift_of<Word>(channel);
  }
  return result;
}

/// What is shown, frame after frame. @tparam Picture  Image or DeepImage
template <typename Picture>
class Screen {
 public:
  Screen(int width_px, int height_px, Picture blank) : picture_(std::move(blank)) {
    picture_.width_px = width_px;
    picture_.height_px = height_px;
    picture_.words.resize(std::size_t(width_px) * std::size_t(height_px));  // transparent black
  }

  const Picture& show(const FrameControl& control, const Picture& frame) {
    dispose();
    if (control.disposal == Disposal::previous) saved_ = picture_.words;
    shown_ = control;
    auto from = frame.words.begin();
    for_each_row([&](auto row) {
      for (auto& word : row) {
        word = control.is_blended ? over(*from, word) : *from;
        ++from;
      }
    });
    return picture_;
  }

 private:
  template <typename Use>
  void for_each_row(const Use& use) {
    for (std::uint32_t y = shown_->y; y < shown_->y + shown_->height; ++y) {
      const std::size_t at = std::size_t{y} * std::size_t(picture_.width_px) + shown_->x;
      use(std::span(picture_.words).subspan(at, shown_->width));
    }
  }
  void dispose() {
    if (!shown_ || shown_->disposal == Disposal::none) return;
    if (shown_->disposal == Disposal::previous) {
      picture_.words = saved_;
    } else {
      for_each_row([](auto row) { std::ranges::fill(row, 0); });
    }
  }

  Picture picture_;
  std::optional<FrameControl> shown_;
  decltype(Picture::words) saved_;
};

}  // namespace piblocks
