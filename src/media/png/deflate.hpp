// zlib's compressor, set up for pictures.
// In: bytes. Out: the same bytes as a deflate stream (RFC 1951), whole or in pieces.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace piblocks {

/// Fast, and for runs of equal bytes, which filter Up leaves of flat shapes: chosen from the table
/// in tests/benchmark/encoders.md. Used by one thread at a time.
class Deflater {
 public:
  enum class Form {
    whole,  ///< a zlib stream (RFC 1950)
    piece   ///< blocks up to a whole byte, which other pieces may follow
  };

  /// @throws MediaError if memory runs out.
  explicit Deflater(Form form);

  /// The result stays until the next call. It depends on `bytes` alone.
  /// @throws MediaError
  std::span<const std::uint8_t> compress(std::span<const std::uint8_t> bytes);

 private:
  struct Deleter {
    void operator()(z_stream* stream) const noexcept;
  };

  Form form_;
  std::unique_ptr<z_stream, Deleter> stream_;
  std::vector<std::uint8_t> compressed_;
};

}  // namespace piblocks
