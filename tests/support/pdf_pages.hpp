// How many pages a PDF file says it has.
// In: its bytes. Out: the number. Cairo 1.18 and later compress the object that has it.
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace piblocks::testing_support {

/// What a stream begins with that zlib has compressed; "" if it is something else.
inline std::string inflated(std::string_view bytes) {
  std::string text(1 << 20, '\0');
  z_stream stream{};
  // zlib does not change it.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  if (inflateInit(&stream) != Z_OK) throw std::runtime_error("no memory to inflate");
  inflate(&stream, Z_SYNC_FLUSH);
  text.resize(stream.total_out);
  inflateEnd(&stream);
  return text;
}

/// @throws std::runtime_error if it does not say
inline long long pages_of_pdf(std::string_view pdf) {
  constexpr std::string_view kStream = "stream\n";
  constexpr std::string_view kCount = "/Count ";
  std::string text(pdf);
  for (std::size_t at = pdf.find(kStream); at != pdf.npos; at = pdf.find(kStream, at)) {
    at += kStream.size();
    text += inflated(pdf.substr(at));
  }
  const std::size_t count = text.find(kCount);
  if (count == text.npos) throw std::runtime_error("a PDF file without a count of pages");
  return std::atoll(text.c_str() + count + kCount.size());
}

}  // namespace piblocks::testing_support
