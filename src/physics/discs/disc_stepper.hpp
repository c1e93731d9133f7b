// The engine for discs, with a choice that tests make.
// In: a BodySystem without problems. Out: see body_stepper.hpp.
#pragma once

#include <memory>

#include "physics/body_stepper.hpp"
#include "physics/discs/cells.hpp"

namespace piblocks {

/// Both searches give the same numbers.
std::unique_ptr<BodyStepper> make_disc_stepper(const BodySystem& system, discs::Search search);

}  // namespace piblocks
