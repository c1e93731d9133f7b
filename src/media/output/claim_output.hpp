// The files that an output consists of.
// In: the name of an output, as set_up_output() takes it. Out: an entry in the check that no input
// is overwritten.
#pragma once

#include <string>

#include "core/overwrite_check.hpp"

namespace piblocks {

/// @param what  the output's part in the command, for messages.
void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name);

/// The files of a pattern such as "frames/%06d.png", whatever their numbers.
OverwriteCheck::Names names_of_pattern(const std::string& pattern);

}  // namespace piblocks
