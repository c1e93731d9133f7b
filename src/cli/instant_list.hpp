// Several instants in one option.
// In: "0,3.5,#10,last". Out: the instants, in this order.
#pragma once

#include <piblocks/instant.hpp>

#include <string>
#include <vector>

namespace piblocks::cli {

/// @throws UsageError if one of them is no instant.
std::vector<Instant> parse_instants(const std::string& text);

}  // namespace piblocks::cli
