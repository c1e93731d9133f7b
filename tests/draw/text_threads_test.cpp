// Text that several threads paint at once, each with fonts of its own.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "draw/canvas.hpp"
#include "support/property.hpp"

namespace piblocks {
namespace {

/// Cairo's cache of fonts is shared by all threads. It aborted the program, after some million
/// texts.
TEST(TextThreads, NeverTakeEachOthersFontsAway) {
  constexpr int kThreads = 4;
  const std::int64_t texts = many(100'000);
  std::vector<std::thread> threads;
  for (int number = 0; number < kThreads; ++number) {
    threads.emplace_back([=] {
      Canvas canvas(64, 32);
      for (std::int64_t i = 0; i < texts; ++i) {
        const auto size_px = double(8 + (i + number) % 2);
        const TextItem text{ItemId::label, {4, 20}, "1", size_px, Color{0, 0, 0}, Face::text};
        canvas.paint({64, 32, Color{255, 255, 255}, {text}});
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace piblocks
