#include <utility>

#include "h264/encoder.hpp"
#include "screen/contenders.hpp"

namespace piblocks::benchmark {
namespace {

h264::Config config(int qp) {
  return {.width_px = kScreenWidth_px,
          .height_px = kScreenHeight_px,
          .rate_numerator = kPicturesPerSecond,
          .qp = qp};
}

class PiblocksEncoder : public PictureEncoder {
 public:
  PiblocksEncoder(int qp, bool is_told) : qp_(qp), is_told_(is_told), encoder_(config(qp)) {}

  std::span<const std::uint8_t> encode(const Picture& picture) override {
    rects_.clear();
    const std::span<const PixelRect> told = picture.changed;
    for (const PixelRect& rect : is_told_ ? told : std::span(&kWholeScreen, 1)) {
      rects_.push_back({rect.x_px, rect.y_px, rect.width_px, rect.height_px});
    }
    const h264::Planes planes = {.y = {picture.y(), kScreenWidth_px},
                                 .cb = {picture.cb(), kScreenWidth_px / 2},
                                 .cr = {picture.cr(), kScreenWidth_px / 2}};
    const auto coded = encoder_.encode(planes, rects_, h264::PictureType::p, unit_);
    if (coded.qp > qp_) ++coarser_pictures_;
    if (!std::exchange(is_first_, false)) return unit_;
    const auto headers = encoder_.headers();
    unit_.insert(unit_.begin(), headers.begin(), headers.end());
    return unit_;
  }

  int coarser_pictures() const override { return coarser_pictures_; }

 private:
  int qp_;
  bool is_told_;
  int coarser_pictures_ = 0;
  h264::Encoder encoder_;
  std::vector<h264::Rect> rects_;
  std::vector<std::uint8_t> unit_;
  bool is_first_ = true;
};

}  // namespace

std::vector<Contender> piblocks_contenders() {
  const Contender told = {
      .name = "piblocks::h264",
      .version = "piblocks",
      .settings = "default",
      .has_qp = true,
      .make = [](int qp) { return std::make_unique<PiblocksEncoder>(qp, true); }};
  Contender untold = told;
  untold.name = "piblocks::h264 without rectangles";
  untold.make = [](int qp) { return std::make_unique<PiblocksEncoder>(qp, false); };
  return {told, untold};
}

}  // namespace piblocks::benchmark
