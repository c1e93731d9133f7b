// An H.264 encoder for pictures of which little changes: drawings, diagrams, screens.
// In: the rectangles of each picture, in 4:2:0, that may have changed. Out: a stream of access
// units, Constrained Baseline, in the byte stream format of annex B.
//
// Users of the library need this header, and mp4_writer.hpp for MP4 files. The
// library needs the standard library alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace piblocks::h264 {

/// What the library throws: a config or a picture that cannot be, or a limit that is passed.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What all pictures of a stream have in common.
struct Config {
  int width_px = 0;   ///< even, from 2
  int height_px = 0;  ///< even, from 2
  /// Pictures a second: numerator / denominator, each from 1 to 2^31 - 1.
  std::int64_t rate_numerator = 60;
  std::int64_t rate_denominator = 1;
  /// The quantiser, QP: 0 (nearly lossless) to 41. Above 41, decoders would disagree (8.5.12.2).
  int qp = 14;
};

/// One plane of samples of 8 bits, row by row.
struct Plane {
  const std::uint8_t* samples = nullptr;
  std::ptrdiff_t stride_bytes = 0;  ///< from row to row
};

/// A picture in 4:2:0, or a part of one: chroma planes have half the width and half the height.
/// BT.709, limited range.
struct Planes {
  Plane y;
  Plane cb;
  Plane cr;
};

/// Pixels from (x_px, y_px), the upper left, to before (x_px + width_px, y_px + height_px).
struct Rect {
  int x_px = 0;
  int y_px = 0;
  int width_px = 0;
  int height_px = 0;
};

enum class PictureType : std::uint8_t {
  idr,  ///< depends on no other: where a player can begin
  p     ///< what has changed since the picture before
};

/// How a picture was coded.
struct CodedPicture {
  PictureType type;
  int transformed_macroblocks;  ///< of a P picture: with coefficients, or I_PCM
};

class PictureEncoder;

/// Encodes one stream. An object may be used by one thread at a time.
class Encoder {
 public:
  /// @throws Error naming the field and its limits, before anything large is allocated.
  explicit Encoder(const Config& config);
  ~Encoder();
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  /// Sequence and picture parameter set, with start codes: the beginning of a byte stream, or what
  /// avcC of an MP4 file is made of.
  std::span<const std::uint8_t> headers() const { return headers_; }
  /// level_idc of the headers, ten times the level's number: the lowest that holds the size and the
  /// rate of the pictures, whatever their bytes.
  int level_idc() const { return level_idc_; }

  /// Takes a part of the next picture, whose other pixels are those of the picture before. All that
  /// differs has to be taken, of the very first picture everything; more does no harm.
  /// @param part  the samples of the rectangle alone; only read, and not kept
  /// @param rect  of even numbers, from 0; what reaches out of the picture is cut off
  /// @throws Error if a plane has no samples, or a number of the rectangle is odd or below 0
  void take(const Planes& part, const Rect& rect);
  /// Encodes the picture. The first of a stream is an IDR picture, whatever is asked for.
  /// @param unit  the caller's; its bytes are replaced by the access unit's, which begins with a
  ///              start code of four bytes. Kept from picture to picture, it is allocated once.
  CodedPicture encode(PictureType type, std::vector<std::uint8_t>& unit);

  /// Makes the stream begin anew: the next picture is an IDR picture, whose bytes depend on its
  /// samples, and on whether the one before was an IDR picture, too (7.4.3), alone. Nothing has to
  /// be passed whole again.
  void restart() { is_begun_ = false; }

 private:
  int level_idc_;
  std::vector<std::uint8_t> headers_;
  std::unique_ptr<PictureEncoder> pictures_;
  bool is_begun_ = false;
};

}  // namespace piblocks::h264
