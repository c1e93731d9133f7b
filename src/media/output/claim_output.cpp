#include "media/output/claim_output.hpp"

#include <piblocks/error.hpp>

#include <optional>

#include "core/ending.hpp"
#include "media/output/frame_pattern.hpp"

namespace piblocks {
namespace {

/// Nothing if it is none that can be used.
std::optional<FramePattern> pattern_of(const std::string& name) {
  if (!has_ending(name, ".png")) return std::nullopt;
  try {
    return FramePattern(name);
  } catch (const UsageError&) {  // opening it says what is wrong
    return std::nullopt;
  }
}

}  // namespace

OverwriteCheck::Names names_of_pattern(const std::string& pattern) {
  return [pattern = FramePattern(pattern)](const std::string& name) {
    return pattern.number_of(name).has_value();
  };
}

void claim_output(OverwriteCheck& check, const std::string& what, const std::string& name) {
  if (name == "null") return;
  if (name == "-") return check.writes_standard_output();
  if (const auto pattern = pattern_of(name)) {
    return check.writes_some_of(what, name, pattern->folder(), names_of_pattern(name));
  }
  check.writes(what, name);
}

}  // namespace piblocks
