#include <fmt/format.h>
#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>

#include <algorithm>

#include "physics/blocks.hpp"

namespace piblocks {
}
