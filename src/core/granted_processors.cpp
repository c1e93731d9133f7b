#include <algorithm>
#include <charconv>
#include <vector>

#include "core/processors.hpp"
#include "core/text.hpp"

namespace piblocks {
namespace {

bool holds(std::string_view list, std::string_view wanted) {
  const std::vector<std::string> pieces = split(list, ',');
  return std::find(pieces.begin(), pieces.end(), wanted) != pieces.end();
}

/// The first number of a text; nothing for "max" and -1, which mean that there is no limit.
std::optional<double> positive(std::string_view text) {
  long value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc() || value <= 0) return std::nullopt;
  return double(value);
}

/// The limit of one group. Version 2 keeps "QUOTA PERIOD" in cpu.max, version 1 a file for each.
std::optional<double> limit_of(const std::string& folder, bool is_version_2, const ReadText& read) {
  const auto text = [&](const char* file) { return read(folder + file).value_or(""); };
  const std::vector<std::string> parts =
      is_version_2 ? split(text("/cpu.max"), ' ')
                   : std::vector{text("/cpu.cfs_quota_us"), text("/cpu.cfs_period_us")};
  const auto quota = positive(parts.front());
  const auto period = parts.size() > 1 ? positive(parts[1]) : std::nullopt;
  if (!quota || !period) return std::nullopt;
  return *quota / *period;
}

/// The path of the process's group in the hierarchy; nothing if the text has none.
std::optional<std::string> group_in(std::string_view groups, bool is_version_2) {
  constexpr std::size_t kNone = std::string_view::npos;
  for (const std::string& line : split(groups, '\n')) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == kNone ? kNone : line.find(':', first + 1);
    if (second == kNone) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool is_it =
        is_version_2 ? line.starts_with("0:") && controllers.empty() : holds(controllers, "cpu");
    if (is_it) return line.substr(second + 1);
  }
  return std::nullopt;
}

struct Mount {
  std::string root;  // the group that is mounted there
  std::string place;
};

/// A line of mountinfo: ID PARENT DEVICE ROOT PLACE OPTIONS … - TYPE SOURCE OPTIONS (proc(5)).
std::optional<Mount> mount_of(std::string_view mounts, bool is_version_2) {
  for (const std::string& line : split(mounts, '\n')) {
    const std::vector<std::string> fields = split(line, ' ');
    const auto dash = std::find(fields.begin(), fields.end(), "-");
    if (dash - fields.begin() < 6 || fields.end() - dash < 4) continue;
    const bool is_it =
        is_version_2 ? dash[1] == "cgroup2" : dash[1] == "cgroup" && holds(dash[3], "cpu");
    if (is_it) return Mount{fields[3], fields[4]};
  }
  return std::nullopt;
}

/// The folders of the group and of the groups around it, as far as they are mounted.
std::vector<std::string> folders_of(const std::string& group, const Mount& mount) {
  const std::string root = mount.root == "/" ? "" : mount.root;
  std::string below = group;
  const bool is_below = below == root || below.starts_with(root + '/');
  below = is_below ? below.substr(root.size()) : "";  // elsewhere: the whole mount is the group's
  std::vector<std::string> folders;
  for (; below.size() > 1; below.erase(below.rfind('/'))) folders.push_back(mount.place + below);
  folders.push_back(mount.place);
  return folders;
}

}  // namespace

std::optional<double> granted_processors(std::string_view groups, std::string_view mounts,
                                         const ReadText& read) {
  std::optional<double> least;
  for (const bool is_version_2 : {false, true}) {
    const auto group = group_in(groups, is_version_2);
    const auto mount = mount_of(mounts, is_version_2);
    if (!group || !mount) continue;
    for (const std::string& folder : folders_of(*group, *mount)) {
      const auto limit = limit_of(folder, is_version_2, read);
      if (limit && (!least || *limit < *least)) least = limit;
    }
  }
  return least;
}

}  // namespace piblocks
