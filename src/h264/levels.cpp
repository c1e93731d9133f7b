#include "h264/levels.hpp"

#include <algorithm>
#include <array>

namespace piblocks::h264 {
namespace {

/// Table A-1. MaxBR and MaxCPB are those of the VCL, times 1000 (the whole NAL stream may have a
/// fifth more).
constexpr std::array kLevels = {Level{20, 11'880, 396, 2'000'000, 2'000'000, 2},
                                Level{21, 19'800, 792, 4'000'000, 4'000'000, 2},
                                Level{22, 20'250, 1'620, 4'000'000, 4'000'000, 2},
                                Level{30, 40'500, 1'620, 10'000'000, 10'000'000, 2},
                                Level{31, 108'000, 3'600, 14'000'000, 14'000'000, 4},
                                Level{32, 216'000, 5'120, 20'000'000, 20'000'000, 4},
                                Level{40, 245'760, 8'192, 20'000'000, 25'000'000, 4},
                                Level{41, 245'760, 8'192, 50'000'000, 62'500'000, 2},
                                Level{42, 522'240, 8'704, 50'000'000, 62'500'000, 2},
                                Level{50, 589'824, 22'080, 135'000'000, 135'000'000, 2},
                                Level{51, 983'040, 36'864, 240'000'000, 240'000'000, 2},
                                Level{52, 2'073'600, 36'864, 240'000'000, 240'000'000, 2},
                                Level{60, 4'177'920, 139'264, 240'000'000, 240'000'000, 2},
                                Level{61, 8'355'840, 139'264, 480'000'000, 480'000'000, 2},
                                Level{62, 16'711'680, 139'264, 800'000'000, 800'000'000, 2}};

constexpr const Level& kHighest = kLevels.back();
static_assert(kMaxSide_mb * kMaxSide_mb <= 8 * kHighest.max_macroblocks &&
              (kMaxSide_mb + 1) * (kMaxSide_mb + 1) > 8 * kHighest.max_macroblocks);

/// Bytes of a macroblock's samples: what MinCR counts from.
constexpr std::int64_t kMacroblock_bytes = 384;

struct Size {
  std::int64_t width_mb;
  std::int64_t height_mb;

  std::int64_t area_mb() const { return width_mb * height_mb; }
};

Size size_of(int width_px, int height_px) {
  return {(std::int64_t{width_px} + 15) / 16, (std::int64_t{height_px} + 15) / 16};
}

/// A.3.1, items a, e, f and g. One frame always fits into the buffer of decoded pictures.
bool holds(const Level& level, const Size& size, PictureRate rate) {
  const std::int64_t side = std::max(size.width_mb, size.height_mb);
  return side * side <= 8 * level.max_macroblocks && size.area_mb() <= level.max_macroblocks &&
         size.area_mb() * rate.numerator <= level.max_macroblocks_per_s * rate.denominator;
}

}  // namespace

std::span<const Level> levels() { return kLevels; }

const Level* lowest_level(int width_px, int height_px, PictureRate rate) {
  const Size size = size_of(width_px, height_px);
  for (const Level& level : kLevels) {
    if (holds(level, size, rate)) return &level;
  }
  return nullptr;
}

std::string level_problem(int width_px, int height_px, PictureRate rate) {
  const Size size = size_of(width_px, height_px);
  if (std::max(size.width_mb, size.height_mb) > kMaxSide_mb) {
    return "a side of " + std::to_string(std::max(width_px, height_px)) +
           " px is longer than the " + std::to_string(16 * kMaxSide_mb) +
           " px of level 6.2, the highest";
  }
  const std::string macroblocks = std::to_string(size.area_mb()) + " macroblocks of 16x16 pixels";
  if (size.area_mb() > kHighest.max_macroblocks) {
    return std::to_string(width_px) + "x" + std::to_string(height_px) + " are " + macroblocks +
           ", more than the " + std::to_string(kHighest.max_macroblocks) +
           " of level 6.2, the highest";
  }
  if (!holds(kHighest, size, rate)) {
    const std::string divisor = rate.denominator == 1 ? "" : "/" + std::to_string(rate.denominator);
    return macroblocks + " in each of " + std::to_string(rate.numerator) + divisor +
           " frames a second are more than the " + std::to_string(kHighest.max_macroblocks_per_s) +
           " a second of level 6.2, the highest";
  }
  return {};
}

RateWatch::RateWatch(const Level& level, int size_mb, PictureRate rate)
    : byte_(8 * rate.numerator),
      capacity_(level.max_buffer_bits * rate.numerator),
      filled_(capacity_) {
  // The products are below 2^63: rates have terms of 31 bits.
  refill_ = std::min(level.max_rate_bps * rate.denominator, capacity_);
  // A.3.1, items c and d; fR is 1/172 s below level 6, and 1/300 s from there on.
  const int most_pictures_per_s = level.idc < 60 ? 172 : 300;
  const std::int64_t limit_bytes = kMacroblock_bytes / level.min_compression;
  picture_limit_bytes_ =
      limit_bytes * level.max_macroblocks_per_s * rate.denominator / rate.numerator;
  first_picture_limit_bytes_ = std::max(
      limit_bytes * size_mb, limit_bytes * level.max_macroblocks_per_s / most_pictures_per_s);
}

std::int64_t RateWatch::room_bytes() const {
  return std::min(filled_ / byte_, is_first_ ? first_picture_limit_bytes_ : picture_limit_bytes_);
}

bool RateWatch::take(std::int64_t size_bytes) {
  const bool is_kept = size_bytes <= room_bytes();
  is_first_ = false;
  filled_ = size_bytes > filled_ / byte_ ? 0 : filled_ - size_bytes * byte_;
  filled_ = std::min(filled_ + refill_, capacity_);
  return is_kept;
}

LevelWatch::LevelWatch(int width_px, int height_px, PictureRate rate, int profile_idc) {
  constexpr int kHigh = 100;
  const Size size = size_of(width_px, height_px);
  for (const Level& level : kLevels) {
    if (!holds(level, size, rate)) continue;
    Level limits = level;
    if (profile_idc == kHigh) {
      limits.max_rate_bps += level.max_rate_bps / 4;
      limits.max_buffer_bits += level.max_buffer_bits / 4;
    }
    candidates_.push_back({&level, RateWatch(limits, static_cast<int>(size.area_mb()), rate)});
  }
}

void LevelWatch::take(std::int64_t size_bytes) {
  std::erase_if(candidates_,
                [&](Candidate& candidate) { return !candidate.watch.take(size_bytes); });
}

const Level* LevelWatch::level() const {
  return candidates_.empty() ? nullptr : candidates_.front().level;
}

}  // namespace piblocks::h264
