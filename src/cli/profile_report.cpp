#include "cli/profile_report.hpp"

#include <algorithm>
#include <numeric>
#include <string_view>

#include "cli/say.hpp"

namespace piblocks::cli {

namespace {

/// Chunks in a row that were encoded alike share a line.
void print_methods(const std::vector<std::string>& methods) {
  for (auto begin = methods.begin(); begin != methods.end();) {
    const auto end = std::find_if(begin, methods.end(), [&](const auto& m) { return m != *begin; });
    if (!begin->empty()) {
      say("  chunks {} to {} by {}\n", begin - methods.begin() + 1, end - methods.begin(), *begin);
    }
    begin = end;
  }
}

}  // namespace

void print_profile(const Rendered& rendered) {
  const Profile& profile = rendered.profile;
  const double frames = double(std::max<std::int64_t>(1, rendered.frame_count));
  const auto print = [&](std::string_view name, double spent_s) {
    say("  {:<8} {:8.3f} s {:8.4f} ms/frame {:5.1f} %\n", name, spent_s, 1000 * spent_s / frames,
        100 * spent_s / profile.total_s);
  };
  say("processor time of {} frames:\n", rendered.frame_count);
  for (std::size_t i = 0; i < profile.stages.size(); ++i) print(kStageNames[i], profile.stages[i]);
  const double staged_s = std::accumulate(profile.stages.begin(), profile.stages.end(), 0.0);
  print("other", profile.total_s - staged_s);  // start-up and set-up
  print("total", profile.total_s);
  print_methods(profile.chunk_methods);
}

}  // namespace piblocks::cli
