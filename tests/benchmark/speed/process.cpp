#include "speed/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <utility>

#include "support/temporary_folder.hpp"

namespace piblocks::benchmark {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void note_end(int status, const rusage& used, Finished& finished) {
  finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  finished.usage.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  finished.usage.peak_MB = static_cast<double>(used.ru_maxrss) * 1024 / 1e6;
}

std::vector<char*> pointers_to(const Command& command) {
  std::vector<char*> words;
  for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  return words;
}

}  // namespace

ProcessRunner::ProcessRunner(std::filesystem::path folder)
    : out_(folder / "stdout"), err_(folder / "stderr") {
  sigemptyset(&signals_);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals_, signal);
  sigprocmask(SIG_BLOCK, &signals_, &old_signals_);
}

Finished ProcessRunner::try_run(const Command& command) const {
  Finished finished;
  const auto begin = Clock::now();
  pid_t child = -1;
  if (start(command, child) != 0) {
    finished.exit_code = 127;
    finished.err = fmt::format("cannot start {}", command.front());
    return finished;
  }
  wait_for(child, finished);
  finished.usage.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  finished.out = testing_support::file_contents(out_);
  finished.err = testing_support::file_contents(err_);
  return finished;
}

Finished ProcessRunner::run(const Command& command) const {
  Finished finished = try_run(command);
  if (finished.exit_code != 0) {
    throw Error(fmt::format("{} failed with {}: {}", fmt::join(command, " "), finished.exit_code,
                            last_line(finished.err)));
  }
  return finished;
}

/// In a process group of its own, so that a signal can end it with all that it has started.
int ProcessRunner::start(const Command& command, pid_t& child) const {
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out_.c_str(), kWrite, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err_.c_str(), kWrite, 0600);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &old_signals_);
  const int error = posix_spawnp(&child, command.front().c_str(), &files, &attributes,
                                 pointers_to(command).data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

/// The signals are blocked and taken one by one here: none can come between a look and a wait.
void ProcessRunner::wait_for(pid_t child, Finished& finished) const {
  int status = 0;
  rusage used{};
  for (;;) {
    const int signal = sigwaitinfo(&signals_, nullptr);
    if (signal == SIGCHLD && wait4(child, &status, WNOHANG, &used) == child) break;
    if (signal <= 0 || signal == SIGCHLD) continue;
    kill(-child, SIGTERM);
    wait4(child, &status, 0, &used);
    throw Interrupted();
  }
  note_end(status, used, finished);
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return {};
  const std::size_t before = text.rfind('\n', end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

}  // namespace piblocks::benchmark
