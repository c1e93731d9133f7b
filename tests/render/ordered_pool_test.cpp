#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <atomic>
#include <chrono>

#include "render/chunks.hpp"

namespace piblocks {
namespace {

using Pool = OrderedPool<std::int64_t>;

Pool::Task square(std::atomic<std::int64_t>* begun = nullptr) {
  return [begun](std::int64_t n, const std::stop_token&) {
    if (begun != nullptr) ++*begun;
    std::this_thread::sleep_for(std::chrono::microseconds((n * 37) % 200));
    return n * n;
  };
}

TEST(OrderedPool, HandsOnEveryResultInOrder) {
  for (const int workers : {1, 2, 3, 7, 50}) {
    Pool pool(40, workers, [] { return square(); });
    for (std::int64_t n = 0; n < 40; ++n) EXPECT_EQ(pool.take({}), n * n);
    EXPECT_EQ(pool.take({}), std::nullopt);
  }
}

TEST(OrderedPool, HasNothingToDoForNothing) {
  Pool pool(0, 2, [] { return square(); });
  EXPECT_EQ(pool.take({}), std::nullopt);
}

TEST(OrderedPool, BoundsWhatWaits) {
  std::atomic<std::int64_t> begun = 0;
  Pool pool(1000, 3, [&] { return square(&begun); });
  for (int n = 0; n < 50; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_LE(begun, n + 2 * 3);
    pool.take({});
  }
}

TEST(OrderedPool, CallsWhileItWaits) {
  std::atomic<int> calls = 0;
  Pool pool(1, 1, [&] {
    return [&](std::int64_t n, const std::stop_token& halt) {
      while (calls < 3 && !halt.stop_requested()) std::this_thread::yield();
      return n;
    };
  });
  EXPECT_EQ(pool.take({}, [&] { ++calls; }), 0);
  EXPECT_GE(calls, 3);
}

TEST(OrderedPool, RethrowsTheFirstFailureAndStops) {
  Pool pool(1000, 2, [] {
    return [](std::int64_t n, const std::stop_token&) -> std::int64_t {
      if (n == 5) throw MediaError("five");
      return n;
    };
  });
  EXPECT_THROW(
      {
        while (pool.take({})) {
        }
      },
      MediaError);
}

TEST(OrderedPool, RethrowsWhatMakingAWorkerThrows) {
  Pool pool(10, 2, []() -> Pool::Task { throw DrawError("no canvas"); });
  EXPECT_THROW(pool.take({}), DrawError);
}

TEST(OrderedPool, StopsWhenAsked) {
  std::stop_source stop;
  Pool pool(10, 1, [] {
    return [](std::int64_t n, const std::stop_token& halt) {
      while (!halt.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return n;
    };
  });
  stop.request_stop();
  EXPECT_EQ(pool.take(stop.get_token()), std::nullopt);
}

}  // namespace
}  // namespace piblocks
