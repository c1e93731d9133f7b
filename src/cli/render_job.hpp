// What 'piblocks render' is asked for.
// In: options as texts, a script. Out: a job, and the files that it writes.
#pragma once

#include <piblocks/render.hpp>

#include <functional>
#include <string>

#include "cli/destination.hpp"
#include "cli/option_texts.hpp"
#include "core/overwrite_check.hpp"

namespace piblocks::cli {

/// What --for names; null if it is not given. @throws UsageError if it does not suit the output.
const Destination* destination_of(const OptionTexts& options, const std::string& output);

/// The job, with the settings that suit its destination.
/// @param make_script  called once, when the options before it have been read.
/// @throws UsageError, or what make_script() throws
RenderJob job_of(const OptionTexts& options, const std::string& output,
                 const std::function<Script()>& make_script);

/// What is written, for messages.
std::string name_of(const RenderJob& job);

/// Enters the files that the job writes.
void claim_outputs(OverwriteCheck& check, const RenderJob& job);

}  // namespace piblocks::cli
