// Values that options of several commands have, and their limits.
// In: the text of an option. Out: its value, or a UsageError that says what is expected.
#pragma once

#include <piblocks/error.hpp>
#include <piblocks/exact.hpp>
#include <piblocks/instant.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace piblocks::cli {

/// Rows of a log that are written unless --limit asks for more.
inline constexpr long kMaxRows = 100'000'000;
/// Threads of --jobs.
inline constexpr int kMaxJobs = 256;
/// Shards of --part.
inline constexpr int kMaxShards = 100'000;
/// Flashes of --max-flashes: as many as there can be at 60 frames a second.
inline constexpr int kMaxFlashes = 30;

/// @throws UsageError unless the text is a whole number >= low and, if there is a high, <= high.
Integer parse_whole_number(const std::string& text, const Integer& low,
                           const std::optional<Integer>& high = std::nullopt);

/// The same for a number that fits into an int.
int parse_int(const std::string& text, int low, int high);

/// "0,3.5,#10,last"
std::vector<Instant> parse_instants(const std::string& text);

/// The value whose name the text is.
/// @throws UsageError with all the names otherwise.
template <typename Value>
Value parse_choice(const std::string& text,
                   const std::vector<std::pair<std::string, Value>>& choices) {
  std::string names;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    if (!names.empty()) names += " or ";
    names += name;
  }
  throw UsageError("must be " + names);
}

}  // namespace piblocks::cli
