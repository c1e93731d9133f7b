// Automatic slow motion of bodies: its middle is where their collisions are densest.
#include <algorithm>

#include "scene/file_fixture.hpp"
#include "scene/pacing_fixture.hpp"
#include "scene/run_log.hpp"

namespace piblocks {
namespace {

constexpr const char* kAutomatic = "slow-motion = 'auto'\nease = 0\n";

/// A wall, a light block, one of 30 and one of 1,000: the light one is hit over and over.
const std::string kSqueezed =
    "[[body]]\nposition = 1\n[[body]]\nposition = 3\nmass = 30\n"
    "[[body]]\nposition = 5\nmass = 1000\nvelocity = -1\n[box]\nx = [0, 'inf']\n";

class BodiesPacing : public FileFixture {
 protected:
  /// The slowest stretch and where it ends.
  struct Slowest {
    Rational from;
    Rational to;
    Rational slowdown;
  };

  /// Eleven collisions in a row that take the shortest time.
  static Span densest_of(const Log& log) {
    Span found{0, 1'000'000};
    for (Integer last = 11; last <= log.last(); ++last) {
      const Rational from = to_rational(log.collision_time(last - 10));
      const Rational to = to_rational(log.collision_time(last));
      if (to - from < found.to - found.from) found = {from, to};
    }
    return found;
  }

  static Slowest slowest_of(const Schedule& schedule) {
    expect_no_gaps(schedule);
    const auto stretches = schedule.stretches();
    const auto found = std::ranges::max_element(stretches, {}, &Stretch::slowdown);
    const auto next = std::next(found);
    return {found->time, next == stretches.end() ? found->time : next->time, found->slowdown};
  }

  Schedule schedule(const std::string& text) {
    const Scene scene = load(text);
    return make_schedule(scene, *log_of(scene));
  }
};

TEST_F(BodiesPacing, SlowsDownTheDensestCollisionsUntilTheyCanBeToldApart) {
  const Scene scene = load(kSqueezed + "[time]\n" + kAutomatic);
  const auto log = log_of(scene);
  ASSERT_GT(log->last(), 100);
  const Span densest = densest_of(*log);
  const Slowest slowest = slowest_of(make_schedule(scene, *log));
  EXPECT_LT(slowest.from, densest.from);
  EXPECT_GT(slowest.to, densest.to);
  const double in_a_second = to_double(10 / (densest.to - densest.from) / slowest.slowdown);
  EXPECT_LE(in_a_second, 10);
  EXPECT_GT(in_a_second, 1);
}

TEST_F(BodiesPacing, LooksOnlyAtWhatIsShown) {
  const std::string window = "from = 6\nto = 8\n";
  const Schedule whole = schedule(kSqueezed + "[time]\n" + kAutomatic);
  const Schedule late = schedule(kSqueezed + "[time]\n" + window + kAutomatic);
  EXPECT_LT(slowest_of(whole).to, 6);
  for (const Stretch& stretch : late.stretches()) EXPECT_GE(stretch.time, 6);
}

TEST_F(BodiesPacing, TheArticlesBlocksAreAsSlowAsByTheirOwnKeys) {
  for (const auto& [digits, mass] : {std::pair{3, "1e4"}, {10, "1e18"}, {20, "1e38"}}) {
    const Slowest bodies = slowest_of(
        schedule("[[body]]\nposition = 2\n[[body]]\nposition = 5\nvelocity = -1\nmass = '" +
                 std::string(mass) + "'\n[box]\nx = [0, 'inf']\n[time]\n" + kAutomatic));
    const Scene scene = paced_scene({{"time.slow-motion", "auto"}, {"time.ease", "0"}}, digits);
    const Slowest blocks = slowest_of(schedule_of(scene));
    EXPECT_EQ(bodies.slowdown, blocks.slowdown) << digits;
    EXPECT_LT(bodies.from, blocks.to) << digits;
    EXPECT_LT(blocks.from, bodies.to) << digits;
  }
}

TEST_F(BodiesPacing, CollisionsAtOneInstantAreAsSlowAsCanBe) {
  const Schedule tied = schedule(
      "[[body]]\nposition = -2\nvelocity = 1\n[[body]]\nposition = 0\n"
      "[[body]]\nposition = 2\nvelocity = -1\n[time]\n" +
      std::string(kAutomatic));
  const Slowest slowest = slowest_of(tied);
  EXPECT_EQ(slowest.slowdown, kMaxAutomaticFactor);
  EXPECT_EQ((slowest.from + slowest.to) / 2, 1);
}

TEST_F(BodiesPacing, FewCollisionsAreShownAtFullSpeed) {
  const std::string apart = "[[body]]\nposition = -2\nvelocity = 1\n[[body]]\nposition = 0\n";
  EXPECT_EQ(schedule(apart + "[time]\n" + kAutomatic).stretches().size(), 1 + kStand);
  EXPECT_EQ(schedule(apart + "[[body]]\nposition = 4\n[time]\n" + kAutomatic).stretches().size(),
            1 + kStand);
}

/// To and fro in a gap of 0.05: 20 collisions a second.
TEST_F(BodiesPacing, DiscsAreSlowedDownToo) {
  const Slowest slowest =
      slowest_of(schedule("[[body]]\nposition = [1, 1]\nvelocity = [1, 0]\nradius = 0.2\n"
                          "[[body]]\nposition = [1.43, 1]\nradius = 0.2\nmass = 'inf'\n"
                          "[box]\nx = [0.78, 3]\ny = [0, 2]\n[time]\nto = 3\n" +
                          std::string(kAutomatic)));
  EXPECT_EQ(slowest.slowdown, 10);
}

}  // namespace
}  // namespace piblocks
