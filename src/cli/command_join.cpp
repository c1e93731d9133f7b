#include <piblocks/render.hpp>

#include "cli/commands.hpp"
#include "cli/options.hpp"
#include "cli/refuse_terminal.hpp"
#include "cli/say.hpp"
#include "cli/stop_on_signals.hpp"

namespace piblocks::cli {
namespace {

struct JoinOptions {
  const CLI::Option* parts;
  const CLI::Option* output;
  const CLI::Option* quiet;
};

void run(const JoinOptions& options) {
  const StopOnSignals signals;
  refuse_terminal(*options.output);
  const std::vector<std::string> parts = options.parts->results();
  const std::string output = *text_of(*options.output);
  const std::int64_t frames = join(parts, output, signals.token());
  if (options.quiet->count() > 0) return;
  say("{}: {} {} from {} {}\n", output == "-" ? "standard output" : output, frames,
      frames == 1 ? "frame" : "frames", parts.size(), parts.size() == 1 ? "part" : "parts");
}

}  // namespace

void add_join(CLI::App& app) {
  CLI::App* command = app.add_subcommand("join", "Join the parts of a rendering");
  const CLI::Option* parts = command->add_option("PART")
                                 ->description("Every file of 'render --part', in any order")
                                 ->required()
                                 ->expected(1, -1)
                                 ->allow_extra_args()
                                 ->option_text("...");
  const CLI::Option& output =
      *add_value_option(*command, "-o,--output", "OUT", "The name that the parts were rendered for")
           .required();
  const CLI::Option& quiet = *command->add_flag("--quiet")->description("Print nothing but errors");
  command->footer(
      "Examples:\n"
      "  piblocks render --part 1/2 -o pi.mp4    # on one machine: pi.mp4.part-1-of-2\n"
      "  piblocks render --part 2/2 -o pi.mp4    # on another: pi.mp4.part-2-of-2\n"
      "  piblocks join pi.mp4.part-* -o pi.mp4   # the bytes of 'piblocks render -o pi.mp4'");
  const JoinOptions options{parts, &output, &quiet};
  command->callback([options] { run(options); });
}

}  // namespace piblocks::cli
