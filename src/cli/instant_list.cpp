#include "cli/instant_list.hpp"

#include <algorithm>

namespace piblocks::cli {

std::vector<Instant> parse_instants(const std::string& text) {
  std::vector<Instant> instants;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    instants.push_back(parse_instant(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return instants;
}

}  // namespace piblocks::cli
