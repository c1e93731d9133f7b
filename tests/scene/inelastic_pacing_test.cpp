// Automatic slow motion of blocks that lose energy, held to collisions that are stepped exactly.
#include <piblocks/two_blocks.hpp>

#include <algorithm>
#include <cmath>

#include "physics/inelastic_motion.hpp"
#include "scene/pacing_fixture.hpp"
#include "support/inelastic_checks.hpp"
#include "support/inelastic_run.hpp"
#include "support/random_system.hpp"

namespace piblocks {
namespace {

constexpr const char* kHardlyLess = "0.9999999999999999999999999999999999999999";

/// Where three collisions in a row take the shortest time, and how many a second that is.
struct Densest {
  Rational from;
  Rational to;
  Rational rate = 0;
};

Densest densest_of(const std::vector<oracle::InelasticEvent>& events) {
  Densest found;
  for (std::size_t i = 2; i < events.size(); ++i) {
    const Rational length = events[i].time - events[i - 2].time;
    if (length * found.rate < 2) found = {events[i - 2].time, events[i].time, 2 / length};
  }
  return found;
}

Scene lossy_scene(int digits, const char* blocks, const char* wall) {
  return paced_scene({{"time.slow-motion", "auto"},
                      {"time.ease", "0"},
                      {"blocks.restitution", blocks},
                      {"wall.restitution", wall}},
                     digits);
}

struct LossyRun {
  int digits;
  const char* blocks;
  const char* wall;
};

const std::vector<LossyRun> kCases = {
    {2, "0.999", "0.999"}, {2, "0.9", "0.95"}, {2, "0.85", "0.85"}, {3, "0.999", "0.999"},
    {3, "0.99", "0.99"},   {3, "1", "0.98"},   {3, "0.98", "1"},    {3, "0.985", "0.984"}};

TEST(InelasticPacing, FindsTheDensestCollisions) {
  for (const auto& [digits, blocks, wall] : kCases) {
    SCOPED_TRACE(std::string(blocks) + " " + wall);
    const Scene scene = lossy_scene(digits, blocks, wall);
    const auto run = oracle::inelastic_run(*two_blocks_of(scene.system), 2000);
    ASSERT_TRUE(run.ended);
    const Densest expected = densest_of(run.events);
    const auto found = InelasticMotion(*two_blocks_of(scene.system)).densest();
    ASSERT_TRUE(found && found->rate);
    const double rate = to_double(expected.rate);
    EXPECT_NEAR(to_double(*found->rate), rate, 0.05 * rate);
    // Within some collisions of it; beside the middle they are nearly as dense.
    const Rational room = 12 / expected.rate;
    EXPECT_GE(found->time, expected.from - room);
    EXPECT_LE(found->time, expected.to + room);
  }
}

/// Any masses, gaps, velocities and losses. The middle is found to one collision, beside which
/// others may be denser if there are only a few.
TEST(InelasticPacing, FindsTheDensestCollisionsOfAnySystem) {
  constexpr std::size_t kMost = 120;
  int compared = 0;
  for (int i = 0; i < many(100); ++i) {
    Random random(std::uint64_t(77'000 + i));
    TwoBlocks system = random_system(random, 0, 6);
    const auto least = 1 - 2 * std::sqrt(to_double(Rational(system.blue.mass / system.red.mass)));
    const auto share = [&]() -> Rational {
      return Rational(std::round(random.uniform(std::max(0.01, least), 1) * 1000)) / 1000;
    };
    system.blocks_restitution = share();
    system.wall_restitution = share();
    SCOPED_TRACE(describe_inelastic(system));
    const auto run = oracle::inelastic_run(system, kMost);
    if (!run.ended || run.events.size() < 3) continue;
    const auto found = InelasticMotion(system).densest();
    ASSERT_TRUE(found && found->rate);
    const double expected = to_double(densest_of(run.events).rate);
    EXPECT_LE(to_double(*found->rate), expected * (1 + 1e-12));
    EXPECT_GE(to_double(*found->rate), 0.3 * expected);
    ++compared;
  }
  EXPECT_GT(compared, 20 * many(1));
}

TEST(InelasticPacing, SlowsDownAsFarAsTheTrueRateAsksFor) {
  for (const auto& [digits, blocks, wall] : kCases) {
    SCOPED_TRACE(std::string(blocks) + " " + wall);
    const Scene scene = lossy_scene(digits, blocks, wall);
    const auto run = oracle::inelastic_run(*two_blocks_of(scene.system), 2000);
    const Schedule schedule = schedule_of(scene);
    expect_no_gaps(schedule);
    const Densest densest = densest_of(run.events);
    const auto stretches = schedule.stretches();
    const auto slowest = std::ranges::max_element(stretches, {}, &Stretch::slowdown);
    const double in_a_second = to_double(Rational(densest.rate / slowest->slowdown));
    EXPECT_TRUE(in_a_second <= 10.5 || slowest->slowdown == kMaxAutomaticFactor);
    EXPECT_GE(in_a_second, 0.95);
    EXPECT_LT(slowest->time, densest.to);
    EXPECT_GT(std::next(slowest)->time, densest.from);
  }
}

/// The limit of no loss: the windows are those of elastic blocks, whose middle is the turn.
TEST(InelasticPacing, WithHardlyAnyLossItIsThatOfElasticBlocks) {
  for (const int digits : {2, 3, 9, 15}) {
    const Scene scene = lossy_scene(digits, kHardlyLess, "1");
    const auto found = InelasticMotion(*two_blocks_of(scene.system)).densest();
    ASSERT_TRUE(found);
    const Scene elastic = lossy_scene(digits, "1", "1");
    const Rational turn = *turn_of(*two_blocks_of(elastic.system));
    const auto slowest = [](const Scene& any) {
      const Schedule schedule = schedule_of(any);
      return std::ranges::max_element(schedule.stretches(), {}, &Stretch::slowdown)->slowdown;
    };
    EXPECT_EQ(slowest(scene), slowest(elastic));
    EXPECT_LE(abs(Rational(found->time - turn)), 2 / *found->rate);
  }
}

TEST(InelasticPacing, TheEndOfInfinitelyManyIsAsSlowAsCanBe) {
  const Scene scene = lossy_scene(2, "0.5", "0.5");
  const auto collapse = collapse_of(*two_blocks_of(scene.system));
  ASSERT_TRUE(collapse && collapse->time);
  const Schedule schedule = schedule_of(scene);
  const auto stretches = schedule.stretches();
  const auto slowest = std::ranges::max_element(stretches, {}, &Stretch::slowdown);
  EXPECT_EQ(slowest->slowdown, kMaxAutomaticFactor);
  EXPECT_LT(slowest->time, to_rational(*collapse->time));
  EXPECT_GT(std::next(slowest)->time, to_rational(*collapse->time));
}

TEST(InelasticPacing, NothingIsDenseWhereNothingHappensTwice) {
  Scene scene = lossy_scene(1, "0.5", "0.5");
  scene.system.bodies[1].velocity[0] = 1;
  EXPECT_FALSE(InelasticMotion(*two_blocks_of(scene.system)).densest());
  scene.time.to = Rational(3);
  EXPECT_EQ(schedule_of(scene).stretches().size(), 1 + kStand);
}

}  // namespace
}  // namespace piblocks
