#include "h264/encoder.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include "h264/levels.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"
#include "h264/text.hpp"

namespace piblocks::h264 {
namespace {

void require(std::string_view field, std::int64_t value, std::int64_t least, std::int64_t most) {
  if (least <= value && value <= most) return;
  throw Error(text("h264: ", field, " is ", value, ", not in [", least, ", ", most, "]"));
}

void require_side(std::string_view field, int value) {
  require(field, value, 2, std::int64_t{kLumaSide} * kMaxSide_mb);
  if (value % 2 != 0) throw Error(text("h264: ", field, " is ", value, ", which is odd"));
}

PictureRate rate_of(const Config& config) {
  return {config.rate_numerator, config.rate_denominator};
}

void check(const Config& config) {
  constexpr std::int64_t kMaxTerm = std::numeric_limits<std::int32_t>::max();
  require_side("width_px", config.width_px);
  require_side("height_px", config.height_px);
  require("rate_numerator", config.rate_numerator, 1, kMaxTerm);
  require("rate_denominator", config.rate_denominator, 1, kMaxTerm);
  require("qp", config.qp, 0, kMaxQp);
  const std::string problem = level_problem(config.width_px, config.height_px, rate_of(config));
  if (!problem.empty()) throw Error("h264: " + problem);
}

/// @throws Error if none holds the stream
const Level& level_of(const Config& config) {
  check(config);
  return *lowest_level(config.width_px, config.height_px, rate_of(config));
}

}  // namespace

class Encoder::Impl {
 public:
  explicit Impl(const Config& config)
      : level_(level_of(config)),
        headers_(write_parameter_sets(config, level_.idc)),
        coder_(config) {}

  const std::vector<std::uint8_t>& headers() const { return headers_; }
  const Level& level() const { return level_; }
  void restart() { is_begun_ = false; }
  void take(const Planes& part, const Rect& rect) {
    for (const Plane& plane : {part.y, part.cb, part.cr}) {
      if (plane.samples == nullptr) throw Error("h264: a plane has no samples");
    }
    for (const int number : {rect.x_px, rect.y_px, rect.width_px, rect.height_px}) {
      if (number >= 0 && number % 2 == 0) continue;
      throw Error(text("h264: a rectangle has the number ", number, ", which is odd or below 0"));
    }
    coder_.take(part, rect);
  }
  CodedPicture encode(PictureType type, Bytes& unit) {
    if (!is_begun_) type = PictureType::idr;
    is_begun_ = true;
    if (type == PictureType::idr) {
      coder_.encode_idr(unit);
    } else {
      coder_.encode_p(unit);
    }
    return {type, coder_.transformed_macroblocks()};
  }

 private:
  const Level& level_;
  Bytes headers_;
  PictureEncoder coder_;
  bool is_begun_ = false;
};

Encoder::Encoder(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Encoder::~Encoder() = default;

std::span<const std::uint8_t> Encoder::headers() const { return impl_->headers(); }
int Encoder::level_idc() const { return impl_->level().idc; }
void Encoder::restart() { impl_->restart(); }

void Encoder::take(const Planes& part, const Rect& rect) { impl_->take(part, rect); }
CodedPicture Encoder::encode(PictureType type, std::vector<std::uint8_t>& unit) {
  return impl_->encode(type, unit);
}

}  // namespace piblocks::h264
