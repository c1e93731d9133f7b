// Values that options of several commands have, and their limits.
// In: the text of an option. Out: its value, or a UsageError that says what is expected.
#pragma once

#include <piblocks/error.hpp>

#include <string>
#include <utility>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/whole_number.hpp"

namespace piblocks::cli {

/// Rows of a log that are written unless --limit asks for more.
inline constexpr long kMaxRows = 100'000'000;
/// Threads of --jobs.
inline constexpr int kMaxJobs = 256;
/// Shards of --part.
inline constexpr int kMaxShards = 100'000;
/// Flashes of --max-flashes: as many as there can be at 60 frames a second.
inline constexpr int kMaxFlashes = 30;

/// The value whose name the text is.
/// @throws UsageError with all the names otherwise.
template <typename Value>
Value parse_choice(const std::string& text,
                   const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    names.push_back(name);
  }
  throw UsageError(must_be_one_of(text, names));
}

}  // namespace piblocks::cli
