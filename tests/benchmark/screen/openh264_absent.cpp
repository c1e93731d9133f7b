#include "screen/contenders.hpp"

namespace piblocks::benchmark {

std::optional<Contender> openh264_contender() { return std::nullopt; }

}  // namespace piblocks::benchmark
