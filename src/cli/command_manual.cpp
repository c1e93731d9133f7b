#include "cli/commands.hpp"
#include "cli/manual.hpp"
#include "cli/options.hpp"
#include "core/output_file.hpp"

namespace piblocks::cli {
namespace {

using MakeText = std::string (*)();

MakeText parse_kind(const std::string& text) {
  return parse_choice<MakeText>(text, {{"man", man_page},
                                       {"bash", bash_completion},
                                       {"zsh", zsh_completion},
                                       {"fish", fish_completion}});
}

void run_manual(const Command& command) {
  const MakeText make_text = *command.value("KIND", parse_kind);
  OutputFile out("-", OutputFile::Contents::text);
  out.write(make_text());
  out.finish();
}

}  // namespace

void add_manual(Command& app) {
  Command command =
      app.add_command("manual", "Print the manual page, or what a shell needs to complete options");
  command.add_argument("KIND", "man, bash, zsh or fish");
  command.on_run([=] { run_manual(command); });
}

}  // namespace piblocks::cli
