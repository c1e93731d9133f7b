// The kinds of output, told by the names of their files.
// In: a name, a format and settings. Out: the output, set up but not opened.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/overwrite_check.hpp"
#include "media/output/frame_sink.hpp"

namespace piblocks {

/// Sets up the output whose kind `name` tells:
/// `*.mp4`, `*.mov`, `*.webm`, `*.gif`, `*.apng`, `*.png` with one integer field such as `%06d`,
/// `*.y4m`, `-` (y4m on standard output), `*.framehash`, `null`, or `*.wav`, which is sound alone.
/// PNG files are numbered from 1, as FFmpeg numbers them.
/// @throws UsageError if the name has no known kind, the format or the settings do not suit the
///         kind, or there is no encoder.
std::unique_ptr<Output> set_up_output(const std::string& name, const VideoFormat& format,
                                      const EncoderSettings& settings,
                                      const std::optional<SoundFormat>& sound = {});

/// Whether an output of this name is sound without pictures: `*.wav`.
bool is_sound_alone(const std::string& name);

/// Enters the files of an output into the check that no input is overwritten.
/// @param what  the output's part in the command, for messages.
void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name);

/// Name and version of each codec library, such as "libavcodec 59.37.100".
std::vector<std::string> media_library_versions();

}  // namespace piblocks
