#include "cli/values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace piblocks::cli {

std::vector<Instant> parse_instants(const std::string& text) {
  std::vector<Instant> instants;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string instant = text.substr(begin, end - begin);
    try {
      instants.push_back(parse_instant(instant));
    } catch (const UsageError& error) {
      if (instant == text) throw;
      throw UsageError(fmt::format("'{}': {}", instant, error.what()));
    }
    begin = end + 1;
  }
  return instants;
}

}  // namespace piblocks::cli
