// The command line: options in, exit code out. 0 done, 1 failed, 2 wrong usage.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <csignal>
#include <cstdio>
#include <new>

#include "cli/commands.hpp"
#include "cli/stop_on_signals.hpp"
#include "cli/version.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int fail(const char* message, int exit_code) {
  fmt::print(stderr, "piblocks: {}\n", message);
  return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace piblocks;
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is a failed write, with a message
  const cli::StopOnSignals signals;

  CLI::App app("Renders two sliding blocks and a wall whose collisions count the digits of pi.",
               "piblocks");
  app.set_version_flag("--version", cli::kVersion);
  app.require_subcommand(1);
  cli::add_render(app, signals.token());
  cli::add_still(app);
  cli::add_log(app, signals.token());
  cli::add_state(app);
  cli::add_count(app);
  cli::add_info(app);

  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return fail(error.what(), kWrongUsage);
  } catch (const UsageError& error) {
    return fail(error.what(), kWrongUsage);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}
