// Signals at random moments, also those that no program can answer.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <thread>

#include "core/output_file.hpp"
#include "faults/fault_fixture.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

namespace fs = std::filesystem;

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Each file that has a final name is as before, or complete.
testing::AssertionResult is_before_or_complete(const Files& now, const Files& before,
                                               const Files& complete) {
  const auto is_in = [](const Files& files, const auto& file) {
    const auto found = files.find(file.first);
    return found != files.end() && found->second == file.second;
  };
  for (const auto& file : now) {
    if (is_in(before, file) || is_in(complete, file)) continue;
    return testing::AssertionFailure() << file.first << " is neither as before nor complete";
  }
  return testing::AssertionSuccess();
}

class KilledTest : public EveryKindTest {
 protected:
  /// A run that gets the signal after a while.
  CommandResult interrupt(int signal, double after_s) const {
    RunningCommand command(GetParam().arguments, {.folder = out()});
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    command.send(signal);
    return command.wait();
  }

  /// Whether a run was killed while its files took their names: the next one goes on with that.
  bool is_within_commit() const {
    const std::set<std::string> all = names(files());
    return std::ranges::any_of(all, [](const auto& name) { return name.ends_with("/old/"); });
  }

  void judge(const CommandResult& result, int signal, const Files& before, const Files& complete,
             bool committed_before) const {
    const Files now = finished();
    EXPECT_TRUE(is_before_or_complete(now, before, complete));
    EXPECT_LE(std::distance(fs::directory_iterator(out()), fs::directory_iterator()),
              std::ptrdiff_t(now.size()) + 1)
        << "what an earlier run left is still there";
    if (result.exit_code == 0) {
      EXPECT_TRUE(files() == complete);
    }
    if (result.exit_code == 0) return;
    EXPECT_EQ(result.exit_code, -signal);
    if (signal == SIGKILL) return;
    // At its start it has no handler yet, nothing to say, and nothing to remove.
    EXPECT_TRUE(result.err.empty() || result.err.ends_with(": interrupted\n")) << result.err;
    const bool has_begun = !result.err.empty() && result.err != "piblocks: interrupted\n";
    EXPECT_TRUE((has_begun ? files() : now) == before || committed_before)
        << testing::PrintToString(names(files()));
  }
};

/// A round leaves to the next what it left: that has to remove it.
TEST_P(KilledTest, AtRandomMomentsLeavesNoHalfFile) {
  constexpr int kRounds = 40;
  TracedRandom random(20261121);
  const Files complete = undisturbed(GetParam());
  const auto run_once = [&] { run(GetParam().arguments); };
  const double whole_s = std::min(seconds(run_once), seconds(run_once));

  int interrupted = 0;
  for (int round = 0; round < kRounds; ++round) {
    for (const auto& [name, contents] : finished()) fs::remove(out() / name);
    const bool has_old = random.integer(0, 1) == 1;
    if (has_old) put_old_files(complete);
    const Files before = finished();
    const bool committed_before = is_within_commit();
    const int signal = std::array{SIGINT, SIGTERM, SIGKILL}[std::size_t(random.integer(0, 2))];
    const double after_s = random.uniform(0, whole_s);
    SCOPED_TRACE(fmt::format("round {}: signal {} after {} s", round, signal, after_s));
    const CommandResult result = interrupt(signal, after_s);
    judge(result, signal, before, complete, committed_before);
    if (result.exit_code != 0) ++interrupted;
  }
  fmt::print("{} of {} runs interrupted; {}\n", interrupted, kRounds, random.trace());
  EXPECT_GE(interrupted, kRounds / 8) << "the signals come too late";
  put_old_files(complete);
  EXPECT_EQ(run(GetParam().arguments).exit_code, 0);
  EXPECT_TRUE(files() == complete) << testing::PrintToString(names(files()));
}
INSTANTIATE_TEST_SUITE_P(Every, KilledTest, testing::ValuesIn(every_kind()), name_of);

/// The path that a process killed just now would have left.
fs::path dead_path(const fs::path& name) { return Unfinished(name, Unfinished::Kind::file).path(); }

class AbandonedTest : public EveryKindTest {
 protected:
  /// What the temporary file or folder is called after.
  fs::path name_of(const Files& complete) const {
    return out() / (is_sequence(complete) ? "%d.png" : complete.begin()->first);
  }
  static bool is_sequence(const Files& complete) { return complete.size() > 1; }
};

TEST_P(AbandonedTest, IsRemovedByTheNextRunAndNothingElse) {
  const Files complete = undisturbed(GetParam());
  const fs::path name = name_of(complete);
  const fs::path dead_file = dead_path(name);
  const fs::path dead_folder = dead_path(name);
  const fs::path other = dead_path(out() / "other.mp4");
  const fs::path copy = dead_file.string() + "x";
  const fs::path backup = name.string() + ".unfinished-backup";
  const fs::path keep = name.string() + ".unfinished-abcdefghij234567";
  const fs::path part = name.string() + ".part-1-of-200000";
  for (const fs::path& file : {dead_file, other, copy, backup, part}) std::ofstream{file};
  for (const fs::path& folder : {dead_folder, keep}) {
    fs::create_directory(folder);
    std::ofstream(folder / "a") << "a";
  }

  EXPECT_EQ(run(GetParam().arguments).exit_code, 0);
  EXPECT_FALSE(fs::exists(dead_file));
  EXPECT_FALSE(fs::exists(dead_folder));
  for (const fs::path& path : {other, copy, backup, part, keep / "a"}) {
    EXPECT_TRUE(fs::exists(path)) << path;
  }
}

/// Files of one name appear whole, and the last wins; those of a sequence would mix.
TEST_P(AbandonedTest, IsKeptWhileItsOwnerLives) {
  const Files complete = undisturbed(GetParam());
  const auto kind = is_sequence(complete) ? Unfinished::Kind::folder : Unfinished::Kind::file;
  const Unfinished of_a_living_process(name_of(complete), kind);
  const CommandResult result = run(GetParam().arguments);
  EXPECT_TRUE(fs::exists(of_a_living_process.path()));
  EXPECT_EQ(result.exit_code, is_sequence(complete) ? 2 : 0);
  if (!is_sequence(complete)) return;
  EXPECT_TRUE(contains(result.err, "another run is writing it"));
  EXPECT_TRUE(finished().empty());
}
INSTANTIATE_TEST_SUITE_P(Every, AbandonedTest, testing::ValuesIn(every_kind()), name_of);

}  // namespace
}  // namespace piblocks
