#include "render/chunks.hpp"

#include <gtest/gtest.h>

namespace piblocks {
namespace {

TEST(Chunks, HoldEveryFrameOnce) {
  for (const std::int64_t length : {1, 2, 3, 16, 60}) {
    for (std::int64_t frames = 1; frames < 5 * length; ++frames) {
      const Chunks chunks{frames, length};
      EXPECT_EQ(chunks.begin(0), 0);
      for (std::int64_t i = 0; i + 1 < chunks.count(); ++i) {
        EXPECT_EQ(chunks.end(i), (i + 1) * length);
      }
      EXPECT_EQ(chunks.end(chunks.count() - 1), frames);
    }
  }
}

TEST(Chunks, LeaveNoWorkerWithAFewFrames) {
  for (std::int64_t frames = 30; frames < 1000; ++frames) {
    const Chunks chunks{frames, 60};
    const std::int64_t last = chunks.count() - 1;
    EXPECT_GE(chunks.end(last) - chunks.begin(last), 30) << frames;
    EXPECT_LT(chunks.end(last) - chunks.begin(last), 90) << frames;
  }
}

TEST(Chunks, AreNoneForNoFrames) { EXPECT_EQ((Chunks{0, 60}.count()), 0); }

}  // namespace
}  // namespace piblocks
