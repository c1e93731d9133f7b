#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/say.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {
namespace {

void run_join(const Command& options) {
  const StopOnSignals signals;
  refuse_terminal(options);
  const std::vector<std::string> parts = options.texts("PART");
  const std::string output = output_of(options);
  const std::int64_t frames = join(parts, output, signals.token());
  if (options.is_given("--quiet")) return;
  say("{}: {} {} from {} {}\n", output == "-" ? "standard output" : output, frames,
      frames == 1 ? "frame" : "frames", parts.size(), parts.size() == 1 ? "part" : "parts");
}

}  // namespace

void add_join(Command& app) {
  Command command = app.add_command("join", "Join the parts of a rendering");
  command.add_arguments("PART", "Every file of 'render --part', in any order");
  command.add_required_value("-o,--output", "OUT", "The name that the parts were rendered for");
  command.add_flag("--quiet", "Print nothing but errors");
  command.set_footer(
      "Examples:\n"
      "  piblocks render --part 1/2 -o pi.mp4    # on one machine: pi.mp4.part-1-of-2\n"
      "  piblocks render --part 2/2 -o pi.mp4    # on another: pi.mp4.part-2-of-2\n"
      "  piblocks join pi.mp4.part-* -o pi.mp4   # the bytes of 'piblocks render -o pi.mp4'");
  command.on_run([=] { run_join(command); });
}

}  // namespace piblocks::cli
