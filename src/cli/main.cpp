// The command line: options in, exit code out (command.hpp).
#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "cli/command.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/text_output.hpp"
#include "core/gmp_memory.hpp"
#include "core/output_file.hpp"
#include "core/text.hpp"

namespace {

using piblocks::cli::kFailed;
using piblocks::cli::kWrongUsage;

int fail(std::string_view message, int exit_code) {
  piblocks::cli::say("piblocks: {}\n", piblocks::with_short_words(message));
  return exit_code;
}

[[noreturn]] void end_interrupted(std::string_view message) {
  fail(message, kFailed);
  piblocks::cli::end_by_signal();
}

int fail(const piblocks::UsageError& error) {
  if (piblocks::cli::stop_was_requested()) end_interrupted("interrupted");
  for (const std::string& problem : error.lines()) fail(problem, kWrongUsage);
  return kWrongUsage;
}

int fail(const std::exception& error, std::string_view command) {
  if (!piblocks::cli::stop_was_requested()) return fail(error.what(), kFailed);
  // A call that was broken off fails for a reason that nobody needs to know.
  const bool says_so = dynamic_cast<const piblocks::Interrupted*>(&error) != nullptr;
  end_interrupted(says_so ? fmt::format("{}: {}", command, error.what()) : "interrupted");
}

/// GMP cannot pass an exception on: the process ends here.
[[noreturn]] void end_without_memory() { _exit(fail("out of memory", kFailed)); }

/// Reports out-of-memory. Any other exception that reaches this place is a bug.
[[noreturn]] void end_of_exception() {
  try {
    if (const auto exception = std::current_exception()) std::rethrow_exception(exception);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
    std::abort();
  }
  std::abort();
}

/// A file that is opened takes the lowest free number: were a standard stream closed, it could take
/// the stream's, and messages would end up in a video. Reading only, so that writing still fails.
void fill_closed_streams() {
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::close(opened);
}

/// A failed write is an error with a message, and does not end the process. A cluster announces the
/// end of a job's time by SIGUSR1 or SIGUSR2, and SIGTERM follows.
void ignore_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ, SIGUSR1, SIGUSR2}) std::signal(signal, SIG_IGN);
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_streams();
  ignore_signals();
  piblocks::cli::end_at_once_on_signals();
  piblocks::end_when_gmp_has_no_memory(end_without_memory);
  std::set_terminate(end_of_exception);
  try {
    return piblocks::cli::run_command_line(argc, argv);
  } catch (const piblocks::UsageError& error) {
    return fail(error);
  } catch (const piblocks::ReaderGone&) {
    return 0;
  } catch (const piblocks::cli::ExitError& exit) {
    if (piblocks::cli::stop_was_requested()) end_interrupted("interrupted");
    return *exit.what() == '\0' ? exit.code() : fail(exit.what(), exit.code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error, argc > 1 ? argv[1] : "");
  }
}
