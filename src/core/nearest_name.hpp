// The name that a misspelt word was meant to be, for messages.
// In: a word that somebody typed, and the names there are. Out: the nearest name; "did you mean"
// for it; what the word must be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace piblocks {

/// The name that begins with the word if it is the only one; otherwise the one that differs in the
/// fewest letters. Capitals and small letters are the same.
/// @returns an empty text if more than about a third of the word's letters would have to change.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// "; did you mean 'lecture'?", or an empty text if no name is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// "must be csv or npy; did you mean 'npy'?", "must be one of: csv, jsonl, npy".
std::string must_be_one_of(std::string_view word, const std::vector<std::string>& names);

}  // namespace piblocks
