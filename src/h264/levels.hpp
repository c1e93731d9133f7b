// Levels: how large, how fast and how heavy a stream may be (ITU-T H.264 (08/2021), Annex A).
// In: the size of the pictures, their rate, and the bytes of each. Out: the lowest level that
// holds.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace piblocks::h264 {

/// Pictures a second, as a fraction.
struct PictureRate {
  std::int64_t numerator;    ///< 1 … 2^31 - 1
  std::int64_t denominator;  ///< 1 … 2^31 - 1
};

/// A row of table A-1.
struct Level {
  int idc;                             ///< level_idc: ten times the level's number
  std::int64_t max_macroblocks_per_s;  ///< MaxMBPS
  std::int64_t max_macroblocks;        ///< MaxFS: of a picture
  std::int64_t max_rate_bps;           ///< MaxBR of the VCL: bits a second
  std::int64_t max_buffer_bits;        ///< MaxCPB of the VCL: bits
  int min_compression;                 ///< MinCR
};

/// Levels 2 to 6.2, the lowest first. Those below 2 have so small a buffer that a single key frame
/// of a tiny picture overruns it.
std::span<const Level> levels();

/// The longest side that the highest level allows: floor(Sqrt(8 MaxFS)), by A.3.1, items f and g.
inline constexpr int kMaxSide_mb = 1055;

/// Empty if some level holds such pictures at such a rate; else the limit of level 6.2, the
/// highest, that they exceed.
std::string level_problem(int width_px, int height_px, PictureRate rate);

/// The lowest of levels() that holds such pictures at such a rate, whatever their bytes; null if
/// none does.
const Level* lowest_level(int width_px, int height_px, PictureRate rate);

/// The buffer of a decoder of one level (the hypothetical reference decoder, C.1): it is full
/// before the first picture, each picture empties its bits at once, and MaxBR fills it. And MinCR,
/// the least compression of each picture.
class RateWatch {
 public:
  RateWatch(const Level& level, int size_mb, PictureRate rate);

  /// The most bytes that the next picture may have.
  std::int64_t room_bytes() const;
  /// The next picture has this many bytes.
  /// @return whether it keeps the limits; if the buffer has less, it is empty then.
  bool take(std::int64_t size_bytes);

 private:
  std::int64_t picture_limit_bytes_;        // by MinCR, of all pictures but the first
  std::int64_t first_picture_limit_bytes_;  // by MinCR
  // In parts of a bit, as many as the rate's numerator: so all of them are whole numbers.
  std::int64_t byte_;      // how many a byte has
  std::int64_t capacity_;  // of the buffer
  std::int64_t refill_;    // what comes in from picture to picture
  std::int64_t filled_;    // what is in the buffer
  bool is_first_ = true;
};

/// The lowest level that holds a stream whose pictures are known one by one.
class LevelWatch {
 public:
  /// @param profile_idc  of High, 100, a level allows a quarter more bits (A.3.3, table A-2)
  LevelWatch(int width_px, int height_px, PictureRate rate, int profile_idc);

  void take(std::int64_t size_bytes);
  /// Null if no level holds what was taken.
  const Level* level() const;

 private:
  struct Candidate {
    const Level* level = nullptr;
    RateWatch watch;
  };
  std::vector<Candidate> candidates_;  // that still hold, the lowest first
};

}  // namespace piblocks::h264
