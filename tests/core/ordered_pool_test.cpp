#include "core/ordered_pool.hpp"

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <atomic>
#include <chrono>

namespace piblocks {
namespace {

using Pool = OrderedPool<std::int64_t>;

std::size_t nothing(std::int64_t /*result*/) { return 0; }
std::size_t much(std::int64_t /*result*/) { return Pool::kLittle + 1; }

Pool::Task square(std::atomic<std::int64_t>* begun = nullptr) {
  return [begun](std::int64_t n, const std::stop_token&) {
    if (begun != nullptr) ++*begun;
    std::this_thread::sleep_for(std::chrono::microseconds((n * 37) % 200));
    return n * n;
  };
}

TEST(OrderedPool, HandsOnEveryResultInOrder) {
  for (const int workers : {1, 2, 3, 7, 50}) {
    Pool pool(
        40, workers, [] { return square(); }, nothing);
    for (std::int64_t n = 0; n < 40; ++n) EXPECT_EQ(pool.take({}), n * n);
    EXPECT_EQ(pool.take({}), std::nullopt);
  }
}

TEST(OrderedPool, HasNothingToDoForNothing) {
  Pool pool(
      0, 2, [] { return square(); }, nothing);
  EXPECT_EQ(pool.take({}), std::nullopt);
}

TEST(OrderedPool, BoundsWhatWaits) {
  // One result that holds much may be there when six tasks have begun, and more when sixteen.
  for (const auto& [weigh, most] : {std::pair{&much, 2 * 3}, std::pair{&nothing, 16 * 3}}) {
    std::atomic<std::int64_t> begun = 0;
    Pool pool(
        1000, 3, [&] { return square(&begun); }, weigh);
    for (int n = 0; n < 50; ++n) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      EXPECT_LE(begun, n + most);
      pool.take({});
    }
  }
}

TEST(OrderedPool, GoesOnWhileOneTaskTakesLong) {
  std::atomic<std::int64_t> done = 0;
  const auto make_task = [&] {
    return [&](std::int64_t n, const std::stop_token& halt) {
      while (n == 0 && done < 31 && !halt.stop_requested()) std::this_thread::yield();
      ++done;
      return n;
    };
  };
  Pool pool(100, 2, make_task, nothing);
  EXPECT_EQ(pool.take({}), 0);
}

TEST(OrderedPool, CallsWhileItWaits) {
  std::atomic<int> calls = 0;
  Pool pool(
      1, 1,
      [&] {
        return [&](std::int64_t n, const std::stop_token& halt) {
          while (calls < 3 && !halt.stop_requested()) std::this_thread::yield();
          return n;
        };
      },
      nothing);
  EXPECT_EQ(pool.take({}, [&] { ++calls; }), 0);
  EXPECT_GE(calls, 3);
}

TEST(OrderedPool, RethrowsTheFirstFailureAndStops) {
  Pool pool(
      1000, 2,
      [] {
        return [](std::int64_t n, const std::stop_token&) -> std::int64_t {
          if (n == 5) throw MediaError("five");
          return n;
        };
      },
      nothing);
  EXPECT_THROW(
      {
        while (pool.take({})) {
        }
      },
      MediaError);
}

/// Whichever comes first in time: results before it are handed on.
TEST(OrderedPool, RethrowsTheFailureThatIsFirstInOrder) {
  std::atomic<bool> has_failed = false;
  const auto make_task = [&] {
    return [&](std::int64_t n, const std::stop_token&) -> std::int64_t {
      if (n == 3) {
        has_failed = true;
        throw DrawError("three");
      }
      while (n == 2 && !has_failed) std::this_thread::yield();
      if (n == 2) throw MediaError("two");
      return n;
    };
  };
  for (int i = 0; i < 20; ++i) {
    has_failed = false;
    Pool pool(1000, 2, make_task, nothing);
    EXPECT_EQ(pool.take({}), 0);
    EXPECT_EQ(pool.take({}), 1);
    EXPECT_THROW(pool.take({}), MediaError);
  }
}

TEST(OrderedPool, RethrowsWhatMakingAWorkerThrows) {
  Pool pool(
      10, 2, []() -> Pool::Task { throw DrawError("no canvas"); }, nothing);
  EXPECT_THROW(pool.take({}), DrawError);
}

/// As while a slow disk takes what is ready.
TEST(OrderedPool, StopsThoughResultsAreReady) {
  std::stop_source stop;
  std::atomic<int> done = 0;
  const auto make_task = [&] {
    return [&](std::int64_t n, const std::stop_token& /*halt*/) {
      ++done;
      return n;
    };
  };
  Pool pool(10, 1, make_task, nothing);
  EXPECT_EQ(pool.take(stop.get_token()), 0);
  while (done < 10) std::this_thread::yield();
  stop.request_stop();
  EXPECT_EQ(pool.take(stop.get_token()), std::nullopt);
}

TEST(OrderedPool, StopsWhenAsked) {
  std::stop_source stop;
  Pool pool(
      10, 1,
      [] {
        return [](std::int64_t n, const std::stop_token& halt) {
          while (!halt.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          return n;
        };
      },
      nothing);
  stop.request_stop();
  EXPECT_EQ(pool.take(stop.get_token()), std::nullopt);
}

}  // namespace
}  // namespace piblocks
