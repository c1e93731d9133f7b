#include "circumstances.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>

namespace piblocks::benchmark {

namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

std::string circumstances(const std::string& commit) {
  return fmt::format("{:%Y-%m-%d},{},{},GCC {}", fmt::gmtime(std::time(nullptr)), csv_text(commit),
                     csv_text(cpu_name()), __VERSION__);
}

std::string csv_text(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace piblocks::benchmark
