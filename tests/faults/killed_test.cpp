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

/// A sequence whose runs are killed until one of them ends.
class ResumedTest : public FaultFixture {
 protected:
  static Arguments resume(const Arguments& more = {}) {
    return Arguments{"render", "--size", "160x90", "--fps", "12",       "--to",
                     "120",    "--jobs", "2",      "-o",    "f/%d.png", "--resume"} +
           more;
  }
  /// The folder of an unfinished run; empty if there is none.
  fs::path unfinished() const {
    if (!fs::exists(out() / "f")) return {};
    for (const auto& entry : fs::directory_iterator(out() / "f")) {
      if (is_unfinished(entry.path().string())) return entry.path();
    }
    return {};
  }
  /// What is there when a run is killed: each picture, and when it was written.
  std::map<std::string, fs::file_time_type> pictures() const {
    std::map<std::string, fs::file_time_type> found;
    const fs::path folder = unfinished();
    if (folder.empty() || !fs::exists(folder / "new")) return found;
    for (const auto& entry : fs::directory_iterator(folder / "new")) {
      if (!file_contents(entry.path()).ends_with("IEND\xae\x42\x60\x82")) continue;
      found[entry.path().filename()] = entry.last_write_time();
    }
    return found;
  }
  /// Waits for whole pictures: each job may be at one more.
  void kill_after_pictures(std::size_t count, int signal, const Arguments& arguments) const {
    RunningCommand command(arguments, {.folder = out()});
    ASSERT_TRUE(wait_until([&] { return pictures().size() >= count; }));
    command.send(signal);
    command.wait();
  }
};

TEST_F(ResumedTest, AtRandomMomentsEndsAsIfNothingHadBeen) {
  TracedRandom random(20261128);
  EXPECT_EQ(run(resume()).exit_code, 0);
  const Files complete = files();
  ASSERT_EQ(complete.size(), 1441U) << "frames in a folder";
  for (int round = 0; round < 5; ++round) {
    clear();
    std::size_t before = 0;
    for (int kill = 0; kill < 3; ++kill) {
      const int signal = std::array{SIGINT, SIGTERM, SIGKILL}[std::size_t(random.integer(0, 2))];
      kill_after_pictures(before + std::size_t(random.integer(0, 99)), signal, resume());
      const auto kept = pictures();
      EXPECT_GE(kept.size(), before);
      before = kept.size();
    }
    const auto kept = pictures();
    const CommandResult result = run(resume());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(files() == complete);
    EXPECT_EQ(contains(result.err, fmt::format("; kept {} picture", kept.size())), !kept.empty())
        << result.err;
    for (const auto& [name, time] : kept) {
      EXPECT_EQ(fs::last_write_time(out() / "f" / name), time) << name << " was written again";
    }
  }
}

TEST_F(ResumedTest, OnlyByTheSameRun) {
  kill_after_pictures(20, SIGKILL, resume());
  const auto kept = pictures();
  ASSERT_GE(kept.size(), 20U);
  Arguments larger = resume();
  std::ranges::replace(larger, "160x90", "160x92");
  const std::vector<std::pair<Arguments, std::string>> others = {
      {resume({"--digits", "2"}), "red.mass;"},
      {resume({"--theme", "dark"}), "view."},
      {resume({"--transparent"}), "view."},
      {resume({"--start-number", "2"}), "start-number;"},
      {resume({"--frames", "1-1439"}), "frames;"},
      {larger, "view.size;"}};
  for (const auto& [arguments, name] : others) {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, "'f/%d.png' are of another run: they differ in " + name))
        << result.err;
    EXPECT_TRUE(pictures() == kept);
  }
  std::string job = file_contents(unfinished() / "job");
  ASSERT_TRUE(job.starts_with("piblocks: "));
  std::ofstream(unfinished() / "job") << job.replace(10, 1, "9");
  EXPECT_TRUE(contains(run(resume()).err, "they differ in piblocks;"));
  Arguments anew = resume();
  anew.pop_back();
  EXPECT_FALSE(contains(run(anew).err, "kept"));
  EXPECT_TRUE(unfinished().empty());
}

/// Who has not thought of it before may still resume what was killed.
TEST_F(ResumedTest, ARunThatWasNotMeantTo) {
  Arguments plain = resume();
  plain.pop_back();
  kill_after_pictures(10, SIGKILL, plain);
  const auto kept = pictures();
  EXPECT_TRUE(contains(run(resume()).err, fmt::format("; kept {} pictures", kept.size())));
  clear();
  kill_after_pictures(10, SIGINT, plain);
  EXPECT_TRUE(files().empty()) << "without --resume an interrupted run cleans up";
}

TEST_F(ResumedTest, IsASequenceOfPictures) {
  for (const char* film : {"a.mp4", "-", "null", "a.html", "a.wav"}) {
    EXPECT_TRUE(
        contains(run(small_render({"-o", film, "--resume"})).err, "only pictures of a sequence"));
  }
  EXPECT_TRUE(files().empty());
}

/// The path that a process killed just now would have left.
fs::path dead_path(const fs::path& name) { return Unfinished(name, Unfinished::Kind::file).path(); }

class AbandonedTest : public EveryKindTest {
 protected:
  /// What the temporary file or folder is called after.
  fs::path name_of(const Files& complete) const {
    const fs::path first = complete.begin()->first;
    return out() / (is_sequence(complete) ? "%d" + first.extension().string() : first.string());
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
