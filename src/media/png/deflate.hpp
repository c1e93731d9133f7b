// zlib's compressor, set up for pictures.
// In: the form of its streams. Out: a stream that can be used again and again.
#pragma once

#include <zlib.h>

#include <memory>

namespace piblocks {

struct DeflateDeleter {
  void operator()(z_stream* stream) const noexcept;
};
using DeflatePtr = std::unique_ptr<z_stream, DeflateDeleter>;

/// What deflateInit2() takes for the form: with header and checksum, or without.
enum class DeflateForm { zlib = 15, raw = -15 };

/// Fast, and for runs of equal bytes: all that filter Up leaves of flat shapes. Chosen from the
/// table in README.md.
/// @throws MediaError if memory runs out.
DeflatePtr open_deflate(DeflateForm form);

}  // namespace piblocks
