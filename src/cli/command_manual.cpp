#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <string_view>

#include "cli/app.hpp"
#include "cli/commands.hpp"
#include "cli/manual.hpp"
#include "cli/options.hpp"
#include "core/output_file.hpp"

namespace piblocks::cli {
namespace {

struct Kind {
  std::string_view name;
  std::string (*text)(const CLI::App& app);
};
constexpr auto kKinds = std::to_array<Kind>({{"man", man_page},
                                             {"bash", bash_completion},
                                             {"zsh", zsh_completion},
                                             {"fish", fish_completion}});

void run_manual(const std::string& name) {
  const auto kind = std::ranges::find(kKinds, std::string_view(name), &Kind::name);
  if (kind == kKinds.end()) {
    throw UsageError(fmt::format("manual: '{}' must be one of: man, bash, zsh, fish", name));
  }
  OutputFile out("-", OutputFile::Contents::text);
  out.write(kind->text(*make_app()));
  out.finish();
}

}  // namespace

void add_manual(CLI::App& app) {
  CLI::App* const command = app.add_subcommand(
      "manual", "Print the manual page, or what a shell needs to complete options");
  const CLI::Option* const kind =
      add_value_option(*command, "KIND", "", "man, bash, zsh or fish").required();
  command->callback([=] { run_manual(*text_of(*kind)); });
}

}  // namespace piblocks::cli
