#include "accuracy/methods.hpp"

#include <fmt/format.h>

#include <utility>

#include "accuracy/article_loop.hpp"
#include "accuracy/closed_form.hpp"
#include "accuracy/euler_loop.hpp"
#include "accuracy/event_loop.hpp"
#include "accuracy/gap_loop.hpp"
#include "accuracy/instants.hpp"
#include "accuracy/simulator_loop.hpp"
#include "accuracy/velocity_loop.hpp"

namespace piblocks::benchmark {
namespace {

MethodPtr euler(double step_s) {
  return std::make_unique<EventLoop<EulerLoop>>(
      Label{"fixed-step Euler", kScalarName<double>, fmt::format("h={:.0e}", step_s)},
      [step_s](const TwoBlocks& system) { return EulerLoop(system, step_s, kLastInstant_s); });
}

}  // namespace

std::vector<MethodPtr> all_methods() {
  std::vector<MethodPtr> methods;
  methods.push_back(product());
  methods.push_back(closed_form<TwoSided<double>>("closed form, two-sided"));
  methods.push_back(closed_form<TwoSided<long double>>("closed form, two-sided"));
  methods.push_back(closed_form<TwoSided<Quad>>("closed form, two-sided"));
  methods.push_back(closed_form<OneSided<double>>("closed form, one-sided"));
  methods.push_back(closed_form<OneSided<long double>>("closed form, one-sided"));
  methods.push_back(closed_form<OneSided<Quad>>("closed form, one-sided"));
  methods.push_back(closed_form<OneSided<Decimal50>>("closed form, one-sided"));
  methods.push_back(multiprecision());
  methods.push_back(event_loop<VelocityLoop<double>>("velocity-only loop"));
  methods.push_back(event_loop<VelocityLoop<long double>>("velocity-only loop"));
  methods.push_back(event_loop<GapLoop<double>>("gap loop"));
  methods.push_back(event_loop<GapLoop<long double>>("gap loop"));
  methods.push_back(event_loop<ArticleLoop<double>>("article's loop"));
  methods.push_back(event_loop<ArticleLoop<long double>>("article's loop"));
  methods.push_back(event_loop<ArticleLoop<Quad>>("article's loop"));
  methods.push_back(event_loop<ArticleLoop<Decimal50>>("article's loop"));
  methods.push_back(event_loop<SimulatorLoop<double>>("piblocks::EventSimulator"));
  for (const double step_s : {1e-3, 1e-4, 1e-5, 1e-6}) methods.push_back(euler(step_s));
#ifdef PIBLOCKS_HAS_CVODE
  for (MethodPtr& method : cvode_methods()) methods.push_back(std::move(method));
#else
  fmt::print(stderr, "accuracy_benchmark: built without SUNDIALS; CVODE is left out\n");
#endif
  return methods;
}

}  // namespace piblocks::benchmark
