// The live page: one file with the program in it, as scripts/web builds it.
// In: where this program lies; the text of a scene file. Out: the page, with that scene opened.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/output_file.hpp"

namespace piblocks::cli {

struct LivePage {
  std::string file;
  std::string html;
  std::size_t scene_begin = 0;  ///< bytes before the JSON of the scene that it opens
  std::size_t scene_end = 0;    ///< bytes before what follows that JSON
};

/// The live page of this version: beside the folder of the program, in the source tree if the
/// program lies where it was built, or where the build was to install it.
/// @throws IoError that lists these places and what is wrong in each
LivePage find_live_page();

/// Writes the page so that it opens this scene. @param toml  in UTF-8
/// @throws IoError, ReaderGone as OutputFile::write()
void write_page(const LivePage& page, std::string_view toml, OutputFile& out);

}  // namespace piblocks::cli
