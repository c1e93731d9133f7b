#include "media/png/deflate.hpp"

#include <piblocks/error.hpp>

namespace piblocks {

void DeflateDeleter::operator()(z_stream* stream) const noexcept {
  deflateEnd(stream);
  delete stream;  // NOLINT(cppcoreguidelines-owning-memory): the owner is the pointer it belongs to
}

DeflatePtr open_deflate(DeflateForm form) {
  constexpr int kLevel = 1;
  constexpr int kStrategy = Z_RLE;
  constexpr int kMemoryLevel = 8;
  DeflatePtr stream(new z_stream{});
  const int code = deflateInit2(stream.get(), kLevel, Z_DEFLATED, static_cast<int>(form),
                                kMemoryLevel, kStrategy);
  if (code != Z_OK) throw MediaError("png: cannot compress images: out of memory");
  return stream;
}

}  // namespace piblocks
