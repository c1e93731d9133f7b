// The command line: options in, exit code out. 0 done, 1 failed, 2 wrong usage.
#include <fcntl.h>
#include <piblocks/error.hpp>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/app.hpp"
#include "cli/exit_code.hpp"
#include "cli/say.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/usage_message.hpp"
#include "core/gmp_memory.hpp"
#include "core/output_file.hpp"

namespace {

using piblocks::cli::kFailed;
using piblocks::cli::kWrongUsage;

int fail(std::string_view message, int exit_code) {
  piblocks::cli::say("piblocks: {}\n", message);
  return exit_code;
}

int fail_by_interruption() { return fail("interrupted", kFailed); }

int fail(const piblocks::UsageError& error) {
  if (piblocks::cli::stop_was_requested()) return fail_by_interruption();
  for (const std::string& problem : error.problems()) fail(problem, kWrongUsage);
  return kWrongUsage;
}

int fail(const std::exception& error, int exit_code) {
  // A call that was broken off fails for a reason that nobody needs to know.
  const bool is_broken_off = piblocks::cli::stop_was_requested() &&
                             dynamic_cast<const piblocks::Interrupted*>(&error) == nullptr;
  return is_broken_off ? fail_by_interruption() : fail(error.what(), exit_code);
}

/// Where nothing can be passed on: below GMP.
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

/// What CLI11 throws when it stops early: --help and --version, or an error.
int finish(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() != 0) {
    return fail(piblocks::cli::usage_message(app, error), kWrongUsage);
  }
  std::ostringstream text;
  app.exit(error, text, text);
  piblocks::OutputFile out("-", piblocks::OutputFile::Contents::text);
  out.write(text.str());
  out.finish();
  return 0;
}

/// "piblocks help COMMAND" is "piblocks COMMAND --help". CLI11 takes arguments from the back.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (!arguments.empty() && arguments.front() == "help") {
    arguments.erase(arguments.begin());
    arguments.emplace_back("--help");
  }
  std::ranges::reverse(arguments);
  return arguments;
}

int run(int argc, char** argv) {
  const std::unique_ptr<CLI::App> app = piblocks::cli::make_app();
  if (argc <= 1) {
    std::fputs(app->help().c_str(), stderr);
    return kWrongUsage;
  }
  try {
    app->parse(arguments_of(argc, argv));
    return 0;
  } catch (const CLI::ParseError& error) {
    return finish(*app, error);
  }
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
    return run(argc, argv);
  } catch (const piblocks::UsageError& error) {
    return fail(error);
  } catch (const piblocks::ReaderGone&) {
    return 0;
  } catch (const piblocks::cli::ExitCode& exit) {
    return *exit.what() == '\0' ? exit.code() : fail(exit, exit.code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error, kFailed);
  }
}
