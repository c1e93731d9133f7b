// Access units for MP4 files that no encoder has made.
// In: numbers. Out: headers, units of sizes of their own, tracks of them.
#pragma once

#include "h264/encoder.hpp"
#include "h264/mp4_file.hpp"
#include "support/message_of.hpp"

namespace piblocks::h264 {

/// A sequence parameter set of level 2.0, and a picture parameter set.
inline const ByteVector kHeaders = {0,    0, 0, 1, 0x67, 66,   0xc0, 20,
                                    0xda, 0, 0, 0, 1,    0x68, 0xce, 0x3c};
inline constexpr PictureRate kRate = {60, 1};

inline Mp4Track track_of(std::int64_t max_pictures, PictureRate rate = kRate) {
  return {.width_px = 320,
          .height_px = 180,
          .rate = rate,
          .headers = kHeaders,
          .max_pictures = max_pictures};
}

/// The NAL unit of picture n: of a size of its own.
inline ByteVector unit_of(std::int64_t number, bool is_idr) {
  ByteVector unit(std::size_t(3 + number % 97), std::uint8_t(1 + number % 255));
  unit[0] = is_idr ? 0x65 : 0x41;
  return unit;
}

/// With bytes before it.
inline ByteVector after(ByteVector start, const ByteVector& unit) {
  start.insert(start.end(), unit.begin(), unit.end());
  return start;
}

inline const ByteVector kStartCode = {0, 0, 0, 1};

inline bool is_idr(std::int64_t number) { return number % 60 == 0; }

inline void append_pictures(Mp4Writer& writer, std::int64_t pictures) {
  for (std::int64_t i = 0; i < pictures; ++i) {
    writer.append(after(kStartCode, unit_of(i, is_idr(i))), is_idr(i));
  }
}

inline std::string problem_of(const Mp4Track& track) {
  return testing_support::message_of<Error>([&] { Mp4Writer(track, [](auto, auto) {}); });
}

/// Everything but the content of free boxes was written.
inline void expect_only_free_holes(const Mp4Memory& file, const Mp4Boxes& boxes) {
  std::uint64_t end = 0;
  std::map<std::uint64_t, std::uint64_t> holes;
  for (const auto& [begin, next] : file.written) {
    if (begin != end) holes[end] = begin;
    end = next;
  }
  for (const auto& [begin, hole_end] : holes) {
    const bool is_free =
        (boxes.starts.at("free") == begin && begin + boxes.sizes.at("free") == hole_end) ||
        (boxes.starts.at("free'") == begin && begin + boxes.sizes.at("free'") == hole_end);
    EXPECT_TRUE(is_free) << begin << " to " << hole_end;
  }
}

}  // namespace piblocks::h264
