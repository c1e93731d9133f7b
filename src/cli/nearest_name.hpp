// The name that a misspelt word was meant to be, for messages.
// In: a word of the command line, and the names there are. Out: the nearest name, and
// "did you mean" for it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace piblocks::cli {

/// @returns an empty text if more than about a third of the word's letters would have to change.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean 'lecture'?", or an empty text if `near` is empty.
std::string did_you_mean(const std::string& near);

}  // namespace piblocks::cli
