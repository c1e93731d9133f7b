// One side of a comparison: samples, a PNG file in memory, or the name of a file.
// In: what Python has. Out: a frame to compare; a PNG file.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <variant>

#include "core/output_file.hpp"
#include "golden/frame_pair.hpp"
#include "media/output/bytes.hpp"
#include "media/pixels/frame_reader.hpp"

namespace piblocks::python {

/// Immutable, so that threads may share it.
class Picture {
 public:
  /// A buffer of height x width, or height x width x 3 or 4: red, green, blue, straight alpha.
  /// @throws std::invalid_argument unless it is contiguous, of std::uint8_t or std::uint16_t;
  ///         UsageError if it is too large
  static Picture of_samples(const pybind11::buffer& buffer);
  /// A PNG file. It is decoded when it is needed.
  static Picture of_png(const std::string& bytes);
  /// Of a file, folder, pattern or video.
  static Picture of_path(const std::string& path);

  bool has_path() const noexcept { return path() != nullptr; }
  /// Nothing but of a path.
  const std::string* path() const noexcept { return std::get_if<std::string>(&content_); }
  /// As what the side has, with a name for people; empty for one in memory.
  /// @param role  "the reference", for messages about a PNG file in memory
  Fetched fetch(const std::string& role) const;
  /// A PNG file: that which was given, or the samples as one.
  /// @throws IoError if the file that was given cannot be read, or is no PNG file
  Bytes png() const;
  void write(const std::string& output) const { write_file(output, png()); }

 private:
  using Content = std::variant<std::string, Bytes, AnyImage>;

  explicit Picture(Content content) : content_(std::move(content)) {}

  Content content_;
};

}  // namespace piblocks::python
