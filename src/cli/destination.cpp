#include "cli/destination.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <algorithm>

#include "core/nearest_name.hpp"
#include "core/text.hpp"

namespace piblocks::cli {
namespace {

/// src/media/README.md has the reasons.
const std::vector<Destination>& destinations() {
  static const std::vector<Destination> all = {
      {"powerpoint", {{"view.size", "1920x1080"}, {"view.fps", "60"}}, {".mp4"}},
      {"keynote", {{"view.size", "1920x1080"}, {"view.fps", "60"}}, {".mp4", ".mov"}},
      {"web",
       {{"view.size", "1280x720"}, {"view.fps", "30"}},
       {".mp4", ".webm", ".gif", ".apng", ".webp", ".html"}},
      {"editor",
       {{"view.size", "1920x1080"}, {"view.fps", "60"}, {"view.background", "transparent"}},
       {".mov", ".png"},
       "prores_ks"},
      {"shorts", {{"view.size", "1080x1920"}, {"view.fps", "60"}}, {".mp4"}},
      {"beamer", {{"view.size", "1280x720"}, {"view.fps", "25"}}, {".mp4", ".pdf", ".png"}}};
  return all;
}

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const Destination& destination : destinations()) names.emplace_back(destination.name);
  return names;
}

}  // namespace

std::string destination_names() { return fmt::format("{}", fmt::join(names(), ", ")); }

const Destination& parse_destination(const std::string& name) {
  const auto found = std::ranges::find(destinations(), name, &Destination::name);
  if (found != destinations().end()) return *found;
  throw UsageError(must_be_one_of(name, names()));
}

void check_ending(const Destination& destination, const std::string& output) {
  const auto is_ending = [&](std::string_view ending) { return has_ending(output, ending); };
  if (std::ranges::any_of(destination.endings, is_ending)) return;
  throw UsageError(fmt::format("--for {}: cannot use '{}' there; write one of: *{}",
                               destination.name, output, fmt::join(destination.endings, ", *")));
}

}  // namespace piblocks::cli
