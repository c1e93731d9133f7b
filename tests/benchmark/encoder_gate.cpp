// From how much change on libx264 is the better encoder: time and size of both ways to an MP4 for
// pictures of which a part is new in every frame.
// In: nothing. Out: CSV on standard output; encoders.md holds the table.
#include <fmt/format.h>

#include <filesystem>
#include <random>

#include "accuracy/deadline.hpp"
#include "circumstances.hpp"
#include "media/output/output.hpp"
#include "support/article_frames.hpp"

namespace piblocks {
namespace {
using benchmark::thread_seconds;

constexpr int kWidth_px = 1280;
constexpr int kHeight_px = 720;
constexpr int kSide_px = 16;
constexpr int kFrames = 60;

/// Grey macroblocks with noise, of which some are renewed.
class Texture {
 public:
  explicit Texture(int noise) : noise_(noise), picture_{kWidth_px, kHeight_px, {}} {
    picture_.words.resize(std::size_t{kWidth_px} * kHeight_px);
    renew(1);
  }

  Image& picture() { return picture_; }
  /// @return the macroblocks that are new.
  std::vector<PixelRect> renew(double share) {
    std::vector<PixelRect> rects;
    for (int y = 0; y < kHeight_px; y += kSide_px) {
      for (int x = 0; x < kWidth_px; x += kSide_px) {
        if (static_cast<double>(random_()) < share * 0x1p32) {
          fill(rects.emplace_back(PixelRect{x, y, kSide_px, kSide_px}));
        }
      }
    }
    return rects;
  }

 private:
  void fill(const PixelRect& rect) {
    const auto pick = [&](int count) {
      return static_cast<std::uint32_t>(random_() % static_cast<unsigned>(count));
    };
    const std::uint32_t base = 64 + pick(128);
    for (int y = rect.y_px; y < rect.y_px + kSide_px; ++y) {
      for (int x = rect.x_px; x < rect.x_px + kSide_px; ++x) {
        const std::uint32_t grey = base + pick(noise_ + 1);
        picture_.words[static_cast<std::size_t>(y * kWidth_px + x)] = 0xff000000 | grey * 0x010101;
      }
    }
  }

  int noise_;
  Image picture_;
  std::mt19937 random_{1};
};

/// One line: processor time and size of a frame.
void measure(int noise, double share, const char* name) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path();
  const auto output =
      set_up_output(folder / "unused.mp4", {kWidth_px, kHeight_px, 60}, {.encoder = name});
  const auto encoder = output.make_encoder();
  Texture texture(noise);
  std::vector<PixelRect> changed = {{0, 0, kWidth_px, kHeight_px}};
  double spent_s = -thread_seconds();
  encoder->begin(0);
  for (int frame = 0; frame < kFrames; ++frame) {
    encoder->take(texture.picture().view(), changed);
    encoder->encode();
    spent_s += thread_seconds();
    changed = texture.renew(share);
    spent_s -= thread_seconds();
  }
  const EncodedChunk chunk = encoder->finish();
  spent_s += thread_seconds();
  std::size_t bytes = 0;
  for (const Packet& packet : chunk) bytes += packet.bytes.size();
  fmt::print("{},{},{},{},{:.3f},{:.1f}\n", benchmark::circumstances(), noise, share, name,
             1000 * spent_s / kFrames, static_cast<double>(bytes) / kFrames / 1000);
}

}  // namespace
}  // namespace piblocks

int main() {
  fmt::print("date,commit,cpu,compiler,noise,share,encoder,ms_a_frame,kB_a_frame\n");
  for (const int noise : {0, 8, 64}) {
    for (const double share : {0.01, 0.02, 0.05, 0.1, 0.2, 1.0}) {
      for (const char* encoder : {"builtin", "libx264"}) piblocks::measure(noise, share, encoder);
    }
  }
}
