// A program run to its end, and what that took.
// In: words of a command. Out: wall time, processor time, memory, what it printed.
#pragma once

#include <sys/types.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace piblocks::benchmark {

using Command = std::vector<std::string>;

/// Of a process and of all processes that it has waited for.
struct Usage {
  double seconds = 0;      ///< from before it is started until it has ended
  double cpu_seconds = 0;  ///< user and system
  double peak_MB = 0;      ///< resident set of the largest single process
};

struct Finished {
  int exit_code = 0;  ///< 127 if it could not be started, 128 + number for a signal
  Usage usage;
  std::string out;
  std::string err;
};

/// Make one before any other thread: it takes SIGINT, SIGTERM and SIGHUP, and ends what it runs.
class ProcessRunner {
 public:
  /// @param folder  holds what a process prints.
  explicit ProcessRunner(std::filesystem::path folder);

  /// @throws Interrupted if a signal asks to stop.
  Finished try_run(const Command& command) const;
  /// @throws Error unless it succeeds.
  Finished run(const Command& command) const;

 private:
  int start(const Command& command, pid_t& child) const;
  void wait_for(pid_t child, Finished& finished) const;

  std::filesystem::path out_;
  std::filesystem::path err_;
  sigset_t signals_{};
  sigset_t old_signals_{};
};

/// The last line that is not empty.
std::string last_line(const std::string& text);

}  // namespace piblocks::benchmark
