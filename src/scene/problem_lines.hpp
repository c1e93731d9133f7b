// Everything that is wrong with a scene file and options, as it is found.
// In: where a value comes from, and what is wrong with it. Out: the problems, each once.
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
  void add(Problem problem) {
    if (known_.insert(problem.line()).second) list_.push_back(std::move(problem));
  }
  /// @param origin  such as "--size" or "story.toml:12"
  void add(const std::string& origin, Problem problem) {
    problem.origin = origin;
    add(std::move(problem));
  }
  /// @param line  of the file
  void add(const std::string& path, std::size_t line, Problem problem) {
    add(fmt::format("{}:{}", path, line), std::move(problem));
  }
  void add(const ProblemLines& more) {
    for (const Problem& problem : more.list_) add(problem);
  }

  bool empty() const noexcept { return list_.empty(); }
  /// @throws SceneError with all of them, if there are any.
  void require_none() const {
    if (!list_.empty()) throw SceneError(list_);
  }

 private:
  std::vector<Problem> list_;
  std::set<std::string> known_;  ///< lines
};

}  // namespace piblocks
