#include "render/shutter.hpp"

#include "physics/exposure.hpp"

namespace piblocks {

std::vector<WeightedExposure> expose(const CollisionLog& log, std::span<const TimeSlice> slices) {
  std::vector<WeightedExposure> parts;
  parts.reserve(slices.size());
  for (const TimeSlice& slice : slices) {
    parts.push_back({to_double(slice.share), expose(log, slice.from, slice.to)});
  }
  return parts;
}

}  // namespace piblocks
