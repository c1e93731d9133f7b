// The engine for discs, with what its tests ask for.
// In: a System without problems. Out: see stepper.hpp.
#pragma once

#include <cstdint>
#include <memory>

#include "physics/discs/cells.hpp"
#include "physics/discs/disc_system.hpp"
#include "physics/stepper.hpp"

namespace piblocks {

class DiscStepper : public Stepper {
 public:
  /// While all is certain: how far the true flight of a body since its last collision may be from
  /// the computed one, in the units of the system.
  virtual discs::Bound bound_of(std::uint32_t body) const = 0;
};

/// Both searches give the same numbers.
std::unique_ptr<DiscStepper> make_disc_stepper(const System& system, discs::Search search);

}  // namespace piblocks
