#include "circumstances.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>

namespace piblocks::benchmark {

std::string Circumstances::fields() const {
  return fmt::format("{},{},{},GCC {}", date, csv_text(commit), csv_text(cpu), __VERSION__);
}

std::string Circumstances::today() {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

std::string Circumstances::cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string csv_text(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace piblocks::benchmark
