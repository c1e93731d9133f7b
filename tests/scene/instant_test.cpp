// Instants: their texts, and the times that they stand for.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/two_blocks.hpp>

#include <string>

#include "support/message_of.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

TEST(Instant, ReadsItsForms) {
  EXPECT_EQ(parse_instant("-2.5"), Instant(Rational(-5, 2)));
  EXPECT_EQ(parse_instant("turn"), Instant::turn());
  EXPECT_EQ(parse_instant(" turn\n"), Instant::turn());
  EXPECT_EQ(parse_instant("turn-0.3"), Instant::turn(Rational(-3, 10)));
  EXPECT_EQ(parse_instant("last+1/3"), Instant::last(Rational(1, 3)));
  EXPECT_EQ(parse_instant("#314"), Instant::collision(314));
  EXPECT_EQ(parse_instant("#314+1/1000"), Instant::collision(314, Rational(1, 1000)));
  EXPECT_EQ(parse_instant("#-3-.5"), Instant::collision(-3, Rational(-1, 2)));
  EXPECT_EQ(parse_instant("#31415926535897932384"),
            Instant::collision(Integer("31415926535897932384")));
}

TEST(Instant, GivesTheSignToTheWholeOffset) {
  EXPECT_EQ(parse_instant("turn-2^2"), Instant::turn(-4));
  EXPECT_EQ(parse_instant("turn+2^2"), Instant::turn(4));
  EXPECT_EQ(parse_instant("-2^2"), Instant(Rational(-4)));
}

TEST(Instant, RefusesOtherTexts) {
  for (const char* text :
       {"",      "#",       "#1.5",   "##1",    "# 1",     "#+1",      "#--1",
        "end",   "turning", "turn*2", "turn+",  "turn--1", "turn+-1",  "turn - 1",
        "last1", "last-",   "last+-", "middle", "1:2",     "last+1+1", "turn+1e400"}) {
    EXPECT_THROW(parse_instant(text), UsageError) << text;
  }
}

TEST(Instant, TextsReadBackAsTheSame) {
  for (const char* text :
       {"0", "-7/3", "turn", "turn-1/3", "last+5", "last-5/2", "#7", "#-7", "#7+1/3", "#0-2"}) {
    EXPECT_EQ(exact_text(parse_instant(text)), text);
  }
}

/// Count at the instant, and a hair before it.
struct Counts {
  Integer before;
  Integer at;
};

Counts counts_at(const PairLog& log, const std::string& text, const char* hair = "1e-12") {
  const Rational time = time_of(parse_instant(text), log);
  return {log.blocks_at(time - parse_rational(hair)).count, log.blocks_at(time).count};
}

TEST(Instant, OfACollisionCountsExactlyThoseUntilIt) {
  for (int digits = 1; digits <= 40; ++digits) {
    const auto log = make_pair_log(article_blocks(digits));
    const Integer total = log->last();
    for (const Integer& index : {Integer(1), Integer(2), Integer(total / 3 + 1),
                                 Integer((total + 1) / 2), Integer(total - 1), total}) {
      const std::string text = "#" + index.get_str();
      EXPECT_EQ(counts_at(*log, text).at, index) << digits << " digits, " << text;
      EXPECT_EQ(counts_at(*log, text + "-0").at, index);
    }
    EXPECT_EQ(counts_at(*log, "last").before, total - 1) << digits;
  }
}

// Of every mass ratio, also where a double of the time would stand just before the collision.
TEST(Instant, OfTheLastCollisionCountsAllOfThem) {
  TracedRandom random(314);
  for (int i = 0; i < 2000; ++i) {
    TwoBlocks system;
    system.red.mass = random.integer(0, 3) == 0
                          ? Rational(power(10, static_cast<unsigned long>(random.integer(0, 24))))
                          : Rational(random.rational(0, 1000000, 997) + Rational(1, 100));
    system.red.position = 4 + random.rational(0, 5, 7);
    const auto log = make_pair_log(system);
    const Rational last = time_of(Instant::last(), *log);
    ASSERT_EQ(log->blocks_at(last).count, log->last()) << system.red.mass;
    const Integer index = 1 + (log->last() * random.integer(0, 1000)) / 1001;
    const Rational middle = time_of(Instant::collision(index), *log);
    ASSERT_EQ(log->blocks_at(middle).count, index) << system.red.mass;
    // It is no later than a picture could show: the log's time is as good as a double can be.
    EXPECT_NEAR(to_double(middle), log->blocks_collision(index).time.hi, 1e-13 * to_double(middle));
  }
}

TEST(Instant, OfTheFirstCollisionsIsExact) {
  const auto log = make_pair_log(article_blocks(3));
  EXPECT_EQ(time_of(Instant::collision(1), *log), 2);
  EXPECT_EQ(time_of(Instant::collision(2), *log), parse_rational("2.750075"));
  EXPECT_EQ(time_of(Instant::turn(), *log), Rational(7, 2));
}

TEST(Instant, OfAnEndlesslyLateCollisionIsFound) {
  TwoBlocks system = article_blocks(1);
  system.red.mass = 1 + 1 / power(2, 300);
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_at(time_of(Instant::last(), *log)).count, 4);
  const Rational just_before = time_of(Instant::last(), *log) * (1 - parse_rational("1e-20"));
  EXPECT_EQ(log->blocks_at(just_before).count, 3);
}

TEST(Instant, KnowsCollisionsBeforeTimeZero) {
  for (const char* ratio : {"10000", "1/2", "1"}) {
    TwoBlocks system;
    system.red.mass = parse_rational(ratio);
    system.red.velocity = 1;
    const auto log = make_pair_log(system);
    EXPECT_EQ(log->last(), 0);
    EXPECT_LT(log->first_index(), 0);
    for (Integer index = log->first_index(); index <= 0; ++index) {
      EXPECT_EQ(log->blocks_at(time_of(Instant::collision(index), *log)).count, index) << ratio;
    }
    EXPECT_EQ(log->blocks_at(-1000).count, log->first_index() - 1);
    EXPECT_FALSE(exists(Instant::collision(log->first_index() - 1), *log));
    EXPECT_FALSE(exists(Instant::last(), *log));
    EXPECT_THROW(time_of(Instant::collision(1), *log), UsageError);
  }
}

TEST(Instant, OfACollisionAtTimeZeroIsTimeZero) {
  TwoBlocks system;
  system.blue = {1, parse_rational("2.3"), Rational(1, 10), 1};
  system.red = {1000, parse_rational("3.3"), parse_rational("-0.7"), 1};
  const auto log = make_pair_log(system);
  EXPECT_EQ(log->blocks_collision(1).time, Time{});
  EXPECT_EQ(time_of(Instant::collision(1), *log), 0);
  EXPECT_EQ(log->blocks_at(0).count, 1);
  const auto batch = std::make_unique<PairBatch>();
  log->stream(1, log->last())->read(*batch);
  EXPECT_EQ(batch->time_hi[0], 0);
  EXPECT_EQ(batch->time_lo[0], 0);
}

TEST(Instant, OfOneOfManyCollisionsAtOnceIsRefused) {
  for (const char* mass : {"100", "1/2"}) {
    TwoBlocks system;
    system.blue.position = Rational(1, 2);  // at rest on the wall: all collisions happen at once
    system.red.mass = parse_rational(mass);
    const auto log = make_pair_log(system);
    ASSERT_GT(log->last(), 1);
    EXPECT_EQ(log->blocks_at(time_of(Instant::last(), *log)).count, log->last());
    EXPECT_THROW(time_of(Instant::collision(1), *log), UsageError);
  }
}

TEST(Instant, SaysWhatTheSceneHas) {
  const auto problem = [](const TwoBlocks& system, const char* text) {
    return testing_support::message_of<UsageError>(
        [&] { time_of(parse_instant(text), *make_pair_log(system)); });
  };
  TwoBlocks resting;
  resting.red.velocity = 0;
  EXPECT_EQ(problem(resting, "turn"),
            "'turn': there is no turn; only two blocks beside a wall have one, if they move; give "
            "a time");
  EXPECT_EQ(problem(resting, "last"), "'last': no collision happens from time 0 on; give a time");
  TwoBlocks receding = article_blocks(2);
  receding.red.velocity = 1;
  EXPECT_EQ(problem(receding, "last"), "'last': no collision happens from time 0 on; give a time");
  EXPECT_EQ(problem(receding, "#1"), "collision #1: the scene has collisions #-30 to #0");
  EXPECT_EQ(problem(resting, "#1"), "collision #1: the scene has no collisions");
  EXPECT_EQ(problem(article_blocks(2), "#32"), "collision #32: the scene has collisions #1 to #31");
  EXPECT_EQ(problem(article_blocks(2), "#0"), "collision #0: the scene has collisions #1 to #31");
}

}  // namespace
}  // namespace piblocks
