// The command line: options in, exit code out. 0 done, 1 failed, 2 wrong usage.
#include <fcntl.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <new>

#include "cli/commands.hpp"
#include "cli/exit_code.hpp"
#include "cli/help_formatter.hpp"
#include "cli/say.hpp"
#include "cli/usage_message.hpp"
#include "core/gmp_memory.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int fail(const char* message, int exit_code) {
  piblocks::cli::say("piblocks: {}\n", message);
  return exit_code;
}

int fail(const piblocks::UsageError& error) {
  for (const std::string& problem : error.problems()) fail(problem.c_str(), kWrongUsage);
  return kWrongUsage;
}

/// Where nothing can be passed on: below GMP.
[[noreturn]] void end_without_memory() { _exit(fail("out of memory", kFailed)); }

/// An exception in a destructor, for one. Of memory the user is to be told; all else is a fault of
/// the program.
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
    return fail(piblocks::cli::usage_message(app, error).c_str(), kWrongUsage);
  }
  app.exit(error);
  std::cout.flush();
  return std::cout ? 0 : fail("cannot write to standard output", kFailed);
}

void add_commands(CLI::App& app) {
  using namespace piblocks;
  const std::string version = fmt::format("piblocks {}", kVersion);
  app.formatter(std::make_shared<cli::HelpFormatter>());
  app.set_help_flag("-h,--help", "Print this text and exit");
  app.require_subcommand(1);
  cli::add_render(app);
  cli::add_join(app);
  cli::add_still(app);
  cli::add_sheet(app);
  cli::add_log(app);
  cli::add_state(app);
  cli::add_count(app);
  cli::add_compare(app);
  cli::add_golden(app);
  cli::add_info(app);
  app.set_version_flag("--version", version, "Print the version and exit");
  for (CLI::App* command : app.get_subcommands({})) {
    command->group("Commands");
    command->set_version_flag("--version", version, "Print the version and exit");
  }
  app.get_formatter()->label("Positionals", "Arguments");
  app.footer(
      "'piblocks COMMAND --help' explains a command.\n"
      "Exit codes: 0 done, 1 failed, 2 wrong usage.");
}

int run(int argc, char** argv) {
  CLI::App app("Renders two sliding blocks and a wall whose collisions count the digits of pi.",
               "piblocks");
  add_commands(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return finish(app, error);
  }
}

/// A file that is opened takes the lowest free number: were a standard stream closed, it could take
/// the stream's, and messages would end up in a video. Reading only, so that writing still fails.
void fill_closed_streams() {
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  ::close(opened);
}

/// So that a failed write is an error with a message, and does not end the process.
void ignore_signals_of_writing() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file longer than ulimit -f allows
}

}  // namespace

int main(int argc, char** argv) {
  fill_closed_streams();
  ignore_signals_of_writing();
  piblocks::end_when_gmp_has_no_memory(end_without_memory);
  std::set_terminate(end_of_exception);
  try {
    return run(argc, argv);
  } catch (const piblocks::UsageError& error) {
    return fail(error);
  } catch (const piblocks::cli::ExitCode& exit) {
    return *exit.what() == '\0' ? exit.code() : fail(exit.what(), exit.code());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}
