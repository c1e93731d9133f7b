#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "core/processors.hpp"

namespace piblocks {
namespace {

/// The processors that the process's affinity mask (taskset) and its cpuset allow.
int allowed_processors() {
  constexpr std::size_t kMost_words = std::size_t{1} << 12;  // for 65,536 processors
  for (std::size_t words = 1; words <= kMost_words; words *= 2) {
    std::vector<cpu_set_t> sets(words);
    const std::size_t size_bytes = words * sizeof(cpu_set_t);
    if (::sched_getaffinity(0, size_bytes, sets.data()) == 0) {
      return CPU_COUNT_S(size_bytes, sets.data());
    }
    if (errno != EINVAL) break;  // EINVAL: the set is too small
  }
  return static_cast<int>(std::thread::hardware_concurrency());
}

std::optional<std::string> read_text(const std::string& path) {
  std::ifstream file(path);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace

int processor_count() {
  const int allowed = std::max(1, allowed_processors());
  const auto granted =
      granted_processors(read_text("/proc/self/cgroup").value_or(""),
                         read_text("/proc/self/mountinfo").value_or(""), read_text);
  if (!granted || *granted >= allowed) return allowed;
  return std::max(1, static_cast<int>(std::ceil(*granted)));
}

}  // namespace piblocks
