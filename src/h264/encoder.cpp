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

std::string number_of(const Level& level) { return text(level.idc / 10, ".", level.idc % 10); }

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

/// @throws Error if it cannot hold the stream
const Level& level_of(const Config& config) {
  check(config);
  const Level& lowest = *lowest_level(config.width_px, config.height_px, rate_of(config));
  if (config.level_idc == 0) return lowest;
  const auto asked = std::ranges::find(levels(), config.level_idc, &Level::idc);
  if (asked == levels().end()) {
    throw Error(text("h264: level_idc is ", config.level_idc, ", which is no level from 20 to 62"));
  }
  if (!can_hold(*asked, config.width_px, config.height_px, rate_of(config))) {
    throw Error(text("h264: level_idc is ", config.level_idc, ", but ", config.width_px, "x",
                     config.height_px, " at this rate needs level ", number_of(lowest),
                     " or more"));
  }
  return *asked;
}

/// The next quantiser to try for a picture that has `size_bytes`, more than `room_bytes`. Each step
/// takes about a ninth of the bits, so that six halve them.
int next_qp(int qp, std::int64_t size_bytes, std::int64_t room_bytes) {
  while (size_bytes > room_bytes && qp < kMaxQp) {
    size_bytes -= size_bytes / 9;
    ++qp;
  }
  return qp;
}

}  // namespace

class Encoder::Impl {
 public:
  explicit Impl(const Config& config)
      : level_(level_of(config)),
        config_(config),
        sets_(parameter_sets(config)),
        headers_(write_parameter_sets(config, level_.idc)),
        coder_(sets_, config.width_px, config.height_px, config.qp),
        changed_(sets_.width_mb, sets_.height_mb),
        watch_(make_watch()) {
    add({0, 0, config.width_px, config.height_px});
  }

  const std::vector<std::uint8_t>& headers() const { return headers_; }
  const Level& level() const { return level_; }
  void restart() {
    is_begun_ = false;
    coder_.restart();
    watch_ = make_watch();
  }
  CodedPicture encode(const Planes& source, std::span<const Rect> changed, PictureType type,
                      Bytes& unit) {
    for (const Plane& plane : {source.y, source.cb, source.cr}) {
      if (plane.samples == nullptr) throw Error("h264: a plane has no samples");
    }
    for (const Rect& rect : changed) add(rect);
    if (!is_begun_) type = PictureType::idr;
    is_begun_ = true;
    if (type == PictureType::idr) {
      coder_.encode_idr(source, changed_, unit);
    } else {
      coder_.encode_p(source, changed_, unit);
    }
    changed_.clear();
    const int qp = keep_rate(type, unit);
    return {.type = type,
            .qp = qp,
            .is_within_level = watch_.take(std::ssize(unit)),
            .coarse_macroblocks = coder_.coarse_macroblocks(),
            .transformed_macroblocks = coder_.transformed_macroblocks()};
  }

 private:
  RateWatch make_watch() const {
    return {level_, sets_.width_mb * sets_.height_mb, rate_of(config_)};
  }
  void add(const Rect& rect) {
    const auto clamp = [](std::int64_t value, int most) {
      return static_cast<int>(std::clamp<std::int64_t>(value, 0, most));
    };
    const int left = clamp(rect.x_px, config_.width_px);
    const int above = clamp(rect.y_px, config_.height_px);
    const int right = clamp(std::int64_t{rect.x_px} + rect.width_px, config_.width_px);
    const int below = clamp(std::int64_t{rect.y_px} + rect.height_px, config_.height_px);
    changed_.add(left, above, right - left, below - above);
  }
  /// Leaves macroblocks as coarse as they are, or quantises the picture more coarsely, until the
  /// level's rate suffices. @returns the quantiser of what changes
  int keep_rate(PictureType type, Bytes& unit) {
    int qp = config_.qp;
    const std::int64_t room_bytes = watch_.room_bytes();
    if (std::ssize(unit) <= room_bytes) return qp;
    const int waiting = type == PictureType::p ? coder_.waiting() : 0;
    if (waiting > 0) {
      const std::int64_t corrected_bytes = std::ssize(unit);
      coder_.encode_again(qp, 0, unit);
      const std::int64_t spare_bytes = room_bytes - std::ssize(unit);
      if (spare_bytes >= 0) {
        correct(waiting, corrected_bytes - std::ssize(unit), spare_bytes, unit);
        return qp;
      }
    }
    while (std::ssize(unit) > room_bytes && qp < kMaxQp) {
      qp = next_qp(qp, std::ssize(unit), room_bytes);
      coder_.encode_again(qp, 0, unit);
    }
    return qp;
  }
  /// Corrects as many coarse macroblocks as half of the spare bytes is likely to suffice for: the
  /// other half is left to what changes next.
  /// @param all_bytes  for all that wait
  void correct(int waiting, std::int64_t all_bytes, std::int64_t spare_bytes, Bytes& unit) {
    const std::int64_t most_bytes = std::ssize(unit) + spare_bytes;
    const auto affordable = static_cast<int>(waiting * (spare_bytes / 2) / all_bytes);
    int corrections = std::min(std::max(affordable, 1), waiting - 1);
    while (corrections > 0) {
      coder_.encode_again(config_.qp, corrections, unit);
      if (std::ssize(unit) <= most_bytes) return;
      corrections /= 2;
    }
    coder_.encode_again(config_.qp, 0, unit);
  }

  const Level& level_;
  Config config_;
  ParameterSets sets_;
  Bytes headers_;
  PictureEncoder coder_;
  MacroblockSet changed_;
  RateWatch watch_;
  bool is_begun_ = false;
};

Encoder::Encoder(const Config& config) : impl_(std::make_unique<Impl>(config)) {}
Encoder::~Encoder() = default;
Encoder::Encoder(Encoder&&) noexcept = default;
Encoder& Encoder::operator=(Encoder&&) noexcept = default;

std::span<const std::uint8_t> Encoder::headers() const { return impl_->headers(); }
int Encoder::level_idc() const { return impl_->level().idc; }
void Encoder::restart() { impl_->restart(); }

CodedPicture Encoder::encode(const Planes& source, std::span<const Rect> changed, PictureType type,
                             std::vector<std::uint8_t>& unit) {
  return impl_->encode(source, changed, type, unit);
}

std::size_t Encoder::max_unit_bytes(const Config& config) {
  constexpr std::size_t kHeader_bytes = 64;
  constexpr std::size_t kMacroblock_bytes = 400;  // 3200 bits, by A.3.1
  level_of(config);                               // refuses what no encoder takes
  const ParameterSets sets = parameter_sets(config);
  const std::size_t macroblocks = static_cast<std::size_t>(sets.width_mb) * sets.height_mb;
  // In the worst case every third byte is an emulation_prevention_three_byte.
  return (kHeader_bytes + macroblocks * kMacroblock_bytes) * 3 / 2;
}

}  // namespace piblocks::h264
