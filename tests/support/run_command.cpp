#include "support/run_command.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <thread>

namespace piblocks::testing_support {
namespace {

/// @param ok  the return value of a POSIX call, told by errno.
void check(bool ok, const char* call) {
  if (!ok) throw std::system_error(errno, std::generic_category(), call);
}

struct Stream {
  int ours = -1;
  int theirs = -1;
};

Stream make_pipe() {
  std::array<int, 2> ends{};
  check(::pipe2(ends.data(), O_CLOEXEC) == 0, "pipe2");
  return {ends[0], ends[1]};
}

Stream make_terminal(unsigned short columns) {
  Stream stream;
  const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
  check(::openpty(&stream.ours, &stream.theirs, nullptr, nullptr, &size) == 0, "openpty");
  check(::fcntl(stream.ours, F_SETFD, FD_CLOEXEC) == 0, "fcntl");
  check(::fcntl(stream.theirs, F_SETFD, FD_CLOEXEC) == 0, "fcntl");
  return stream;
}

/// posix_spawn() returns its error; so do the calls that prepare it.
void check_spawn(int error, const char* call) {
  if (error != 0) throw std::system_error(error, std::generic_category(), call);
}

/// Ends with a null pointer, as exec() wants it.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

pid_t spawn(const std::vector<std::string>& arguments, const CommandOptions& options, int out,
            int err) {
  posix_spawn_file_actions_t actions;
  check_spawn(posix_spawn_file_actions_init(&actions), "posix_spawn_file_actions_init");
  if (!options.folder.empty()) {
    posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());
  }
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, options.in_file.c_str(), O_RDONLY, 0);
  if (options.out_file.empty()) {
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, options.out_file.c_str(),
                                     options.out_flags, 0666);
  }
  posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
  for (const int descriptor : options.closed) {
    posix_spawn_file_actions_addclose(&actions, descriptor);
  }

  const std::string program = options.program.empty() ? PIBLOCKS_PROGRAM : options.program;
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = options.environment;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    environment.emplace_back(*variable);
  }
  pid_t pid = -1;
  const int error = posix_spawn(&pid, program.c_str(), &actions, nullptr, pointers(words).data(),
                                pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  check_spawn(error, "posix_spawn");
  return pid;
}

void close_once(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

/// Appends what is there; closes the descriptor at the end of the stream. A terminal's end is EIO.
void read_some(int& descriptor, std::string& text) {
  std::array<char, 65536> buffer;
  const ssize_t length = ::read(descriptor, buffer.data(), buffer.size());
  if (length > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(length));
  } else if (length == 0 || errno != EINTR) {
    close_once(descriptor);
  }
}

}  // namespace

RunningCommand::RunningCommand(const std::vector<std::string>& arguments,
                               const CommandOptions& options) {
  Stream out = options.out_is_terminal ? make_terminal(options.columns) : make_pipe();
  Stream err = options.err_is_terminal ? make_terminal(options.columns) : make_pipe();
  out_ = out.ours;
  err_ = err.ours;
  pid_ = spawn(arguments, options, out.theirs, err.theirs);
  close_once(out.theirs);
  close_once(err.theirs);
}

RunningCommand::~RunningCommand() {
  close_once(out_);
  close_once(err_);
  if (pid_ < 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void RunningCommand::send(int signal) const { check(::kill(pid_, signal) == 0, "kill"); }

bool RunningCommand::has_ended() const { return is_in_state(WEXITED); }

bool RunningCommand::has_stopped() const { return is_in_state(WSTOPPED); }

bool RunningCommand::is_in_state(int state) const {
  siginfo_t info{};
  const auto id = static_cast<id_t>(pid_);
  check(::waitid(P_PID, id, &info, state | WNOHANG | WNOWAIT) == 0, "waitid");
  return info.si_pid == pid_;
}

void RunningCommand::close_output_after_one_byte() {
  char byte = 0;
  check(::read(out_, &byte, 1) == 1, "read");
  close_once(out_);
}

void RunningCommand::close_errors() { close_once(err_); }

void RunningCommand::read_streams(CommandResult& result,
                                  std::chrono::steady_clock::time_point deadline) {
  while (out_ >= 0 || err_ >= 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (left.count() <= 0) throw std::runtime_error("piblocks: timed out; it said: " + result.err);
    // poll() passes over descriptors below zero.
    std::array<pollfd, 2> streams{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
    ::poll(streams.data(), streams.size(), static_cast<int>(left.count()));
    if (streams[0].revents != 0) read_some(out_, result.out);
    if (streams[1].revents != 0) read_some(err_, result.err);
  }
}

CommandResult RunningCommand::wait(std::chrono::seconds timeout) {
  CommandResult result;
  read_streams(result, std::chrono::steady_clock::now() + timeout);
  int status = 0;
  rusage usage{};
  check(::wait4(pid_, &status, 0, &usage) == pid_, "wait4");
  pid_ = -1;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  result.max_memory_KiB = usage.ru_maxrss;
  return result;
}

CommandResult run_command(const std::vector<std::string>& arguments,
                          const CommandOptions& options) {
  return RunningCommand(arguments, options).wait();
}

bool has_pseudo_terminals() {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (terminal >= 0) ::close(terminal);
  return terminal >= 0;
}

bool wait_until(const std::function<bool()>& condition, std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace piblocks::testing_support
