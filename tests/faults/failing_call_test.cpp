// Calls of the system that fail, one at a time.
#include <fmt/format.h>

#include <cmath>

#include "faults/fault_fixture.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

class FailingCallTest : public EveryKindTest {
 protected:
  void SetUp() override {
    if (!kHasFaults) GTEST_SKIP() << "a sanitizer replaces malloc() itself";
  }
  CommandResult run_with(const std::string& fault) const {
    return run(GetParam().arguments, with_fault(fault));
  }
  /// Whether a player finds all frames of a video, right or not. Anything else passes.
  bool is_playable(const Files& complete) const {
    const auto& [name, contents] = *complete.begin();
    if (!name.ends_with(".mp4")) return true;
    std::ofstream(in() / "complete.mp4") << contents;
    return run({"compare", "--quiet", "../in/complete.mp4", name}).exit_code <= kDifferent;
  }
  static constexpr int kDifferent = 1;
};

/// Each write, sync and renaming in turn, until there is none left to fail.
TEST_P(FailingCallTest, OfAnyNumberLeavesTheOldFilesOrAllNewOnes) {
  const Files complete = undisturbed(GetParam());
  const Files old = put_old_files(complete);
  int failures = 0;
  for (const std::string call :
       {"write", "read", "fsync", "syncfs", "mkdir", "rename", "renameat"}) {
    for (int number = 1;; ++number, ++failures) {
      SCOPED_TRACE(fmt::format("{} {}", call, number));
      put_old_files(complete);
      const CommandResult result = run_with(fmt::format("{} {}", call, number));
      if (result.exit_code == 0) break;
      ASSERT_EQ(result.exit_code, 1);
      EXPECT_TRUE(contains(result.err, "Input/output error"));
      EXPECT_EQ(lines(result.err).size(), 1u) << result.err;
      // A page's video is a file of a folder of its own before.
      const bool is_in_place = result.err.find("sync folder") != std::string::npos &&
                               result.err.find(".unfinished-") == std::string::npos;
      EXPECT_TRUE(files() == (is_in_place ? complete : old))
          << testing::PrintToString(names(files()));
    }
    EXPECT_TRUE(files() == complete);
  }
  fmt::print("{} calls failed\n", failures);
  EXPECT_GE(failures, 4);
}

/// Libraries may crash or leave something out without a word: tests/README.md. What has a final
/// name is never half a file all the same.
TEST_P(FailingCallTest, OfMallocEndsWithAMessage) {
  constexpr int kRounds = 40;
  TracedRandom random(31415);
  const Files complete = undisturbed(GetParam());
  int failures = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto number = static_cast<long>(std::exp(random.uniform(0, std::log(2000))));
    SCOPED_TRACE(fmt::format("malloc {}", number));
    put_old_files(complete);
    const Files old = finished();
    const CommandResult result = run_with(fmt::format("malloc {}", number));
    failures += result.exit_code != 0 ? 1 : 0;
    if (result.exit_code == 0 && GetParam().through_libraries) {
      EXPECT_TRUE(is_playable(complete));
      continue;
    }
    EXPECT_TRUE(finished() == complete || (result.exit_code != 0 && finished() == old));
    if (result.exit_code == 0 || GetParam().through_libraries) continue;
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err, "piblocks: out of memory\n");
  }
  fmt::print("{} of {} runs failed; {}\n", failures, kRounds, random.trace());
  EXPECT_GT(failures, 0);
}
INSTANTIATE_TEST_SUITE_P(Every, FailingCallTest, testing::ValuesIn(every_kind()), name_of);

}  // namespace
}  // namespace piblocks
