#include "h264/encoder.hpp"

#include <limits>
#include <string_view>
#include <utility>

#include "h264/levels.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture.hpp"
#include "h264/picture_encoder.hpp"

namespace piblocks::h264 {
namespace {

void require(std::string_view field, std::int64_t value, std::int64_t least, std::int64_t most) {
  if (least <= value && value <= most) return;
  throw Error("h264: " + std::string(field) + " is " + std::to_string(value) + ", not in [" +
              std::to_string(least) + ", " + std::to_string(most) + "]");
}

void require_side(std::string_view field, int value) {
  require(field, value, 2, std::int64_t{kLumaSide} * kMaxSide_mb);
  if (value % 2 == 0) return;
  throw Error("h264: " + std::string(field) + " is " + std::to_string(value) + ", which is odd");
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

/// level_idc of the lowest that holds the stream. @throws Error if none does
int level_of(const Config& config) {
  check(config);
  return lowest_level(config.width_px, config.height_px, rate_of(config))->idc;
}

}  // namespace

Encoder::Encoder(const Config& config)
    : level_idc_(level_of(config)),
      headers_(write_parameter_sets(config, level_idc_)),
      pictures_(std::make_unique<PictureEncoder>(config)) {}
Encoder::~Encoder() = default;

void Encoder::take(const Planes& part, const Rect& rect) {
  for (const Plane& plane : {part.y, part.cb, part.cr}) {
    if (plane.samples == nullptr) throw Error("h264: a plane has no samples");
  }
  for (const int number : {rect.x_px, rect.y_px, rect.width_px, rect.height_px}) {
    if (number >= 0 && number % 2 == 0) continue;
    throw Error("h264: a rectangle has the number " + std::to_string(number) +
                ", which is odd or below 0");
  }
  pictures_->take(part, rect);
}

CodedPicture Encoder::encode(PictureType type, std::vector<std::uint8_t>& unit) {
  if (!std::exchange(is_begun_, true)) type = PictureType::idr;
  if (type == PictureType::idr) {
    pictures_->encode_idr(unit);
  } else {
    pictures_->encode_p(unit);
  }
  return {type, pictures_->transformed_macroblocks()};
}

}  // namespace piblocks::h264
