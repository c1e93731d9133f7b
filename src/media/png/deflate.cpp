#include "media/png/deflate.hpp"

#include <piblocks/error.hpp>

namespace piblocks {

void Deflater::Deleter::operator()(z_stream* stream) const noexcept {
  deflateEnd(stream);
  delete stream;  // NOLINT(cppcoreguidelines-owning-memory): the owner is the pointer it belongs to
}

Deflater::Deflater(Form form) : form_(form), stream_(new z_stream{}) {
  constexpr int kLevel = 1;
  constexpr int kMemoryLevel = 8;
  const int window_bits = form == Form::whole ? 15 : -15;  // negative: without header and checksum
  if (deflateInit2(stream_.get(), kLevel, Z_DEFLATED, window_bits, kMemoryLevel, Z_RLE) != Z_OK) {
    throw MediaError("png: cannot compress images: out of memory");
  }
}

std::span<const std::uint8_t> Deflater::compress(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kFlush_bytes = 16;  // which the bound leaves out
  z_stream& stream = *stream_;
  deflateReset(&stream);
  compressed_.resize(deflateBound(&stream, bytes.size()) + kFlush_bytes);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast): zlib does not write to it
  stream.next_in = const_cast<std::uint8_t*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = compressed_.data();
  stream.avail_out = static_cast<uInt>(compressed_.size());
  const int code = deflate(&stream, form_ == Form::whole ? Z_FINISH : Z_SYNC_FLUSH);
  if (code != (form_ == Form::whole ? Z_STREAM_END : Z_OK) || stream.avail_in != 0) {
    throw MediaError("png: cannot compress an image");
  }
  return {compressed_.data(), stream.next_out};
}

}  // namespace piblocks
