#include "speed/profile.hpp"

#include <optional>
#include <sstream>

namespace piblocks::benchmark {
namespace {

std::optional<StageTime> parse_line(const std::string& line) {
  StageTime time;
  double ms_per_frame = 0;
  double percentage = 0;
  std::string s;
  std::string ms;
  std::string percent;
  std::istringstream words(line);
  words >> time.stage >> time.cpu_seconds >> s >> ms_per_frame >> ms >> percentage >> percent;
  if (!words || !line.starts_with("  ")) return std::nullopt;
  if (s != "s" || ms != "ms/frame" || percent != "%") return std::nullopt;
  return time;
}

}  // namespace

std::vector<StageTime> parse_profile(std::string_view text) {
  std::vector<StageTime> stages;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (const auto time = parse_line(line)) stages.push_back(*time);
  }
  return stages;
}

}  // namespace piblocks::benchmark
