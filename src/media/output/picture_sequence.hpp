// Numbered pictures, each a file.
// In: a name with a number field; the pictures, encoded. Out: files that take their names together.
#pragma once

#include <filesystem>
#include <string_view>

#include "media/output/output_kinds.hpp"

namespace piblocks {

/// How piblocks knows its own pictures.
struct PictureKind {
  Bytes (*with_mark)(ByteSpan picture);
  bool (*has_mark)(const std::filesystem::path& path);
  std::string_view ending;  ///< the last bytes of every file
};

/// The sinks of an output. @throws UsageError if its name is no FramePattern.
decltype(Output::open) sequence_of(const OutputRequest& request, const PictureKind& kind);

}  // namespace piblocks
