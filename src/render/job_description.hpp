// What the bytes of a rendering depend on, written into its parts.
// In: a job, and what came of it so far. Out: names and values that are equal for all parts of one
// job, and from them what is needed to set up its output again.
#pragma once

#include <piblocks/render.hpp>

#include <cstdint>
#include <string>

#include "media/output/shard_file.hpp"

namespace piblocks {

/// Everything but the number of the part.
ShardHeader describe(const RenderJob& job, const Output& output, std::int64_t frame_count);

/// What joining needs of a description.
struct JobDescription {
  VideoFormat format;
  EncoderSettings encoder;
  std::string signature;
  std::int64_t frame_count = 0;
  bool has_sound = false;
};

/// The header of a part file, and the file's name for messages.
struct ShardInfo {
  std::string path;
  ShardHeader header;
};

/// @throws UsageError if a value is missing or cannot be read.
JobDescription read_description(const ShardInfo& part);

/// The value of that name in the part's header.
/// @throws UsageError if there is none.
const std::string& value_of(const ShardInfo& part, const std::string& name);

}  // namespace piblocks
