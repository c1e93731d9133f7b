// What 'piblocks render' is asked for.
// In: options as texts, a script. Out: a job, and the files that it writes.
#pragma once

#include <piblocks/render.hpp>

#include <functional>
#include <string>
#include <vector>

#include "cli/option_texts.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// The value of a key of the scene file.
struct SceneDefault {
  std::string key;
  std::string text;
};

/// Makes a script. @param defaults  replace values of its file, but not options.
/// @param origin  says in messages where the defaults come from, as "--for NAME".
using MakeScript =
    std::function<Script(const std::vector<SceneDefault>& defaults, const std::string& origin)>;

/// The job, with the settings that suit the destination that --for names.
/// @param make_script  called once, when the options before it have been read.
/// @throws UsageError, or what make_script() throws
RenderJob job_of(const OptionTexts& options, const std::string& output,
                 const MakeScript& make_script);

/// The destinations of --for, as a message lists them.
std::string destination_names();

/// What is written, for messages.
std::string name_of(const RenderJob& job);

/// Enters the files that the job writes.
void claim_outputs(OverwriteCheck& check, const RenderJob& job);

}  // namespace piblocks::cli
