// Everything that is wrong with a scene file and options, as it is found.
// In: where a value comes from, and what is wrong with it. Out: a line for each problem.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstddef>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// In the order in which they are found. A problem of every part is there once.
class ProblemLines {
 public:
  /// @param origin  such as "--size" or "story.toml:12"
  void add(const std::string& origin, const std::string& text) {
    add_line(fmt::format("{}: {}", origin, text));
  }
  /// @param line  of the file
  void add(const std::string& path, std::size_t line, const std::string& text) {
    add(fmt::format("{}:{}", path, line), text);
  }
  void add(const ProblemLines& more) {
    for (const std::string& line : more.lines_) add_line(line);
  }

  bool empty() const noexcept { return lines_.empty(); }
  /// @throws SceneError with all of them, if there are any.
  void require_none() const {
    if (!lines_.empty()) throw SceneError(lines_);
  }

 private:
  void add_line(const std::string& line) {
    if (known_.insert(line).second) lines_.push_back(line);
  }

  std::vector<std::string> lines_;
  std::set<std::string> known_;
};

}  // namespace piblocks
