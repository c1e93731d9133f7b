#include "accuracy/methods.hpp"
#include "support/oracle.hpp"

namespace piblocks::benchmark {
namespace {

/// The oracle of the tests: nothing is kept from one state to the next.
class Multiprecision final : public Method {
 public:
  Multiprecision() : Method({"closed form, oracle", "MPFR 512 bits and more", ""}) {}

  bool answers(Question question) const override { return question != Question::whole_log; }

  Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                  const Deadline& deadline) const override {
    std::vector<Reference> blue;
    blue.reserve(instants.exact.size());
    for (const Rational& time : instants.exact) {
      deadline.check();
      const oracle::ExactState state = oracle::high_precision_state(system, time);
      blue.push_back(to_reference(state.blue.position));
    }
    return blue;
  }

  Integer count(const TwoBlocks& system, const Deadline&) const override {
    return oracle::high_precision_total(system);
  }
};

}  // namespace

MethodPtr multiprecision() { return std::make_unique<Multiprecision>(); }

}  // namespace piblocks::benchmark
