// Random systems of discs: what the engine calls certain, against 400 bits.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "support/disc_certainty.hpp"
#include "support/random_discs.hpp"
#include "support/traced_random.hpp"

namespace piblocks::stress {
namespace {

void check_systems(const std::function<System(Random&)>& draw, double expected,
                   std::int64_t number = 800) {
  TracedRandom random(71);
  const std::int64_t systems = many(number);
  std::size_t certain = 0;
  std::int64_t complete = 0;
  double widest = 0;
  for (std::int64_t k = 0; k < systems; ++k) {
    const System system = draw(random);
    const CertaintyCheck check = check_certainty(system, 500);
    for (const std::string& wrong : check.wrong) ADD_FAILURE() << "system " << k << ": " << wrong;
    certain += check.certain;
    if (check.is_complete) ++complete;
    widest = std::max(widest, check.widest);
  }
  fmt::print(
      "{} systems, {} of them certain to the end: {} certain collisions, {:.1f} on average; "
      "errors up to {:.2f} of their bounds\n",
      systems, complete, certain, static_cast<double>(certain) / static_cast<double>(systems),
      widest);
  EXPECT_GT(static_cast<double>(certain), expected * static_cast<double>(systems));
}

TEST(DiscCertaintyStress, OfRandomDiscs) { check_systems(random_discs, 30); }

TEST(DiscCertaintyStress, OfDiscsThatMeetByCoincidence) { check_systems(random_coincidences, 3); }

TEST(DiscCertaintyStress, OfDiscsThatLoseEnergyBetweenMovingWalls) {
  check_systems([](Random& random) { return with_loss_and_motion(random, random_discs(random)); },
                20);
}

TEST(DiscCertaintyStress, OfRacksThatAreStruck) { check_systems(random_rack, 3); }

TEST(DiscCertaintyStress, OfCoincidencesThatLoseEnergy) {
  check_systems(
      [](Random& random) { return with_loss_and_motion(random, random_coincidences(random)); }, 2);
}

/// Rational numbers: again and again it meets two walls at once, or nearly.
TEST(DiscCertaintyStress, OfADiscInABox) {
  const auto draw = [](Random& random) {
    System system{.dimensions = 2,
                  .bodies = {{1, {2, 2}, {random.rational(-2, 2, 3), random.rational(-2, 2, 3)}}},
                  .walls = box(random.rational(4, 8, 3), random.rational(4, 8, 3))};
    return random.integer(0, 1) == 0 ? with_loss_and_motion(random, system) : system;
  };
  check_systems(draw, 100, 100);
}

TEST(DiscCertaintyStress, OfDiscsInCells) {
  const auto draw = [](Random& random) {
    System system = random_gas(random, static_cast<std::uint32_t>(random.integer(20, 30)), 3);
    if (random.integer(0, 1) == 0) system.walls.clear();
    system.bodies.push_back({Rational(50), {-9, 5}, {Rational(1), 0}, 8});
    for (Wall& wall : system.walls) {
      if (wall.name == "left") wall.point[0] = -18;
      if (wall.name == "bottom") wall.point[1] = -4;
    }
    return system;
  };
  check_systems(draw, 30, 10);
}

/// In cells, with a disc so large that it has a zone, and an immovable disc.
TEST(DiscCertaintyStress, OfDiscsBesideOneThatStays) {
  const auto draw = [](Random& random) {
    System system = random_gas(random, 25);
    system.walls = box(46, 16);
    system.bodies.push_back({Rational(100), {20, 7}, {Rational(-1, 9), 0}, 6});
    system.bodies.push_back({std::nullopt, {40, 5}, {0, 0}, 2});
    return system;
  };
  check_systems(draw, 60, 1);
}

}  // namespace
}  // namespace piblocks::stress
