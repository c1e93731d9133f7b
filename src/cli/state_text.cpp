#include "cli/state_text.hpp"

#include <fmt/format.h>

namespace piblocks::cli {
namespace {

std::string described(const Motion& motion, const std::optional<double>& position_bound) {
  const std::string bound =
      position_bound ? fmt::format(R"(,"position_bound":{})", shown(*position_bound)) : "";
  return fmt::format(R"({{"position":{}{},"velocity":{}}})", shown(motion.position), bound,
                     shown(motion.velocity));
}

}  // namespace

std::string vector_text(const BodySystem& system, const std::array<double, 2>& vector) {
  if (system.dimensions == 1) return fmt::format("{}", shown(vector[0]));
  return fmt::format("[{},{}]", shown(vector[0]), shown(vector[1]));
}

std::string state_text(const Rational& time, const BlockState& state,
                       const std::optional<Integer>& infinite,
                       const std::optional<PositionBounds>& bounds) {
  const auto blue_bound = bounds ? std::optional(bounds->blue) : std::nullopt;
  const auto red_bound = bounds ? std::optional(bounds->red) : std::nullopt;
  return fmt::format(R"({{"time":{},"collisions":"{}","blue":{},"red":{}}})",
                     shown(to_double(time)),
                     state.count == infinite ? "infinite" : state.count.get_str(),
                     described(state.blue, blue_bound), described(state.red, red_bound));
}

std::string state_text(const BodySystem& system, const Rational& time, const BodiesState& state) {
  std::string bodies;
  for (const BodyMotion& body : state.bodies) {
    if (!bodies.empty()) bodies += ',';
    bodies += fmt::format(R"({{"position":{},"velocity":{}}})", vector_text(system, body.position),
                          vector_text(system, body.velocity));
  }
  return fmt::format(R"({{"time":{},"collisions":"{}","bodies":[{}]}})", shown(to_double(time)),
                     state.count.get_str(), bodies);
}

}  // namespace piblocks::cli
