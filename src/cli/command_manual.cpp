#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include "cli/commands.hpp"
#include "cli/manual.hpp"
#include "cli/options.hpp"
#include "core/output_file.hpp"

namespace piblocks::cli {
namespace {

struct Kind {
  std::string_view name;
  std::string (*text)();
};
constexpr auto kKinds = std::to_array<Kind>({{"man", man_page},
                                             {"bash", bash_completion},
                                             {"zsh", zsh_completion},
                                             {"fish", fish_completion}});

void run_manual(const std::string& name) {
  const auto* const kind = std::ranges::find(kKinds, std::string_view(name), &Kind::name);
  if (kind == kKinds.end()) {
    throw UsageError(fmt::format("manual: '{}' must be one of: man, bash, zsh, fish", name));
  }
  OutputFile out("-", OutputFile::Contents::text);
  out.write(kind->text());
  out.finish();
}

}  // namespace

void add_manual(Command& app) {
  Command command =
      app.add_command("manual", "Print the manual page, or what a shell needs to complete options");
  const Option kind = command.add_argument("KIND", "man, bash, zsh or fish");
  command.on_run([=] { run_manual(*kind.text()); });
}

}  // namespace piblocks::cli
