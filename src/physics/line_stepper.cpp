#include <piblocks/system.hpp>

#include <memory>
#include <optional>

#include "physics/certified_line.hpp"
#include "physics/exact_line.hpp"
#include "physics/stepper.hpp"

namespace piblocks {
namespace {

/// Exact as long as its numbers are short and its steps not too many.
class LineStepper final : public Stepper {
 public:
  explicit LineStepper(const System& system)
      : is_at_once_(are_at_once(system)), exact_(std::in_place, system) {}

  std::optional<SteppedCollision> step() override {
    if (certified_) return certified_->step();
    std::optional<SteppedCollision> step = exact_->step();
    const bool is_long = ++steps_ >= kMaxExactCollisions || exact_->bits() > kMaxExactBits;
    if (is_long && !exact_->is_within_stage()) {
      certified_.emplace(exact_->elements(), exact_->time(), is_at_once_);
      exact_.reset();
    }
    return step;
  }

  double certain_until() const override {
    return certified_ ? certified_->certain_until() : kForEver;
  }

 private:
  bool is_at_once_;
  std::optional<ExactLine> exact_;  // one of the two
  std::optional<CertifiedLine> certified_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_line_stepper(const System& system) {
  return std::make_unique<LineStepper>(system);
}

}  // namespace piblocks
