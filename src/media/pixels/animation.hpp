// How the images of animated PNG (PNG specification, 13) and GIF (89a, 23) make frames.
// In: images, each with its place and what becomes of it. Out: pictures with straight alpha, and
// the number of frames that show each.
#pragma once

#include <piblocks/exact.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace piblocks {

/// How our own files say their frame rate, such as "30000/1001": under this keyword of a tEXt chunk
/// of PNG, or in an application extension of GIF. In no other way can a standstill, which is one
/// image, be told from a long frame.
inline constexpr std::string_view kFrameRateKeyword = "Frames per second";
inline constexpr std::string_view kFrameRateExtension = "PIBLOCKSfps";

/// Counts the frames that images stand for: one each, unless the file says its frame rate.
class ImageFrames {
 public:
  /// Ignores what is no rate.
  void set_rate(const std::string& text) {
    Rational rate;
    constexpr std::size_t kMaxText_bytes = 32;
    if (text.size() > kMaxText_bytes || rate.set_str(text, 10) != 0 || rate.get_den() == 0) return;
    rate.canonicalize();
    if (rate > 0) rate_ = rate;
  }
  /// @param duration_s  of the next image
  std::int64_t of_next(const Rational& duration_s) {
    if (!rate_) return 1;
    end_s_ += duration_s;
    const Integer end = floor(end_s_ * *rate_ + Rational(1, 2));
    const Integer count = end - std::exchange(end_, end);
    constexpr int kMostFrames = 1'000'000;  // more than any film of ours has
    return end_ <= kMostFrames ? std::max(1L, count.get_si()) : 1;
  }

 private:
  std::optional<Rational> rate_;
  Rational end_s_;
  Integer end_;  // the number of frames up to there
};

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
