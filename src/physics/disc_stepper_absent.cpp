#include <piblocks/error.hpp>

#include "physics/body_stepper.hpp"

namespace piblocks {
std::unique_ptr<BodyStepper> make_disc_stepper(const BodySystem& /*system*/) {
  throw SimulationError("discs: not there yet");
}
}  // namespace piblocks
