// The program as a user runs it: a process with arguments, streams and signals.
// In: arguments, a working folder. Out: exit code, what it printed, the memory it took.
#pragma once

#include <fcntl.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace piblocks::testing_support {

struct CommandOptions {
  std::filesystem::path folder = {};  ///< working folder; the caller's if empty
  std::string in_file = "/dev/null";  ///< what standard input reads
  std::string out_file = {};          ///< where standard output goes instead, such as /dev/full
  int out_flags = O_WRONLY | O_CREAT | O_TRUNC;  ///< how out_file is opened
  std::vector<std::string> environment = {};     ///< "NAME=VALUE" each, beside the caller's
  std::vector<int> closed = {};                  ///< descriptors that the program starts without
  bool out_is_terminal = false;                  ///< standard output is a terminal of its own
  bool err_is_terminal = false;                  ///< standard error is a terminal of its own
  unsigned short columns = 80;                   ///< of that terminal
  std::string program = {};                      ///< a copy of the program to run instead
};

/// A sanitizer keeps freed memory, and needs some of its own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kTellsMemory = false;
#else
inline constexpr bool kTellsMemory = true;
#endif

struct CommandResult {
  int exit_code = 0;  ///< minus the signal's number if one ended it
  std::string out;
  std::string err;
  long max_memory_KiB = 0;  ///< largest resident set; means nothing unless kTellsMemory
};

/// A running piblocks; killed if it is still running when this object goes.
class RunningCommand {
 public:
  explicit RunningCommand(const std::vector<std::string>& arguments,
                          const CommandOptions& options = {});
  ~RunningCommand();
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  void send(int signal) const;
  bool has_ended() const;
  /// By SIGSTOP.
  bool has_stopped() const;
  /// Reads one byte of standard output, then closes the pipe, as `head -c 1` does.
  void close_output_after_one_byte();
  /// As a terminal that is closed.
  void close_errors();
  /// Reads what is printed until the process ends. Before, nothing but the pipes' buffers takes
  /// its output.
  /// @throws std::runtime_error, having killed it, if that takes longer than `timeout`.
  CommandResult wait(std::chrono::seconds timeout = std::chrono::seconds(120));

 private:
  void read_streams(CommandResult& result, std::chrono::steady_clock::time_point deadline);

  bool is_in_state(int state) const;

  pid_t pid_ = -1;  // -1 when it has been waited for
  int out_ = -1;
  int err_ = -1;
};

CommandResult run_command(const std::vector<std::string>& arguments,
                          const CommandOptions& options = {});

/// Whether terminals can be had: a container may have no /dev/pts.
bool has_pseudo_terminals();

/// Polls until `condition` holds. False if it does not within `timeout`.
bool wait_until(const std::function<bool()>& condition,
                std::chrono::milliseconds timeout = std::chrono::seconds(30));

}  // namespace piblocks::testing_support
