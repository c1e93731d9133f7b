// A program of another project that uses the event simulator alone.
// In: nothing. Out: the count on standard output.
#include <piblocks/event_simulator.hpp>

#include <iostream>

int main() {
  using Body = piblocks::Particle<double, 1>;
  const auto at = [](double x) { return Body::Vector::Constant(x); };
  piblocks::EventSimulator<double, 1> simulator({
      {1, 0.5, at(2), at(0)},
      {10000, 0.5, at(5), at(-1)},
      {piblocks::kInfiniteMass<double>, 0.5, at(-0.5), at(0)},
  });
  std::cout << simulator.run(1000).size() << '\n';
}
