// Every failure of the library is one of these exceptions.
// In: the operation that failed, its object and the cause. Out: one line that names all three.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace piblocks {

/// Base of every exception that the library throws on purpose.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One thing that is wrong.
struct Problem {
  /// The key that is wrong, as a scene file names it: "red.mass"; may be empty.
  std::string key = {};
  std::string reason = {};  ///< with the value: "= -1: must be greater than 0"; or ": is too long"
  std::string item = {};    ///< of the key's list, if it is about one: "unfolded"
  std::string origin = {};  ///< of the value, as "--size" or "story.toml:12"; empty if not known
  bool means_nothing = false;  ///< there is no such key, or the text is no value of it

  /// As it is told: "story.toml:12: red.mass = -1: must be greater than 0".
  std::string line() const {
    const bool is_one_word = key.empty() || reason.starts_with(':');
    return (origin.empty() ? "" : origin + ": ") + key + (is_one_word ? "" : " ") + reason;
  }
};

/// What was asked for cannot be done as asked: a value out of range, a scene that contradicts
/// itself, an output that cannot be opened. Nothing has been written.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& line) : UsageError(Problem{.reason = line}) {}
  /// "KEY: REASON". @param item  as of Problem
  UsageError(const std::string& key, const std::string& reason, const std::string& item = {})
      : UsageError(Problem{key, ": " + reason, item}) {}
  explicit UsageError(Problem problem) : UsageError(std::vector{std::move(problem)}) {}
  /// @param problems at least one; each is a line of its own in what(). Of more than kMostProblems
  ///                 the last line says how many there are.
  explicit UsageError(std::vector<Problem> problems)
      : UsageError(Bounded{}, bounded(std::move(problems))) {}
  explicit UsageError(std::vector<std::string> lines) : UsageError(problems_of(std::move(lines))) {}

  const std::vector<Problem>& problems() const noexcept { return problems_; }
  /// line() of each problem, in order.
  std::vector<std::string> lines() const {
    std::vector<std::string> lines;
    for (const Problem& problem : problems_) lines.push_back(problem.line());
    return lines;
  }

  static constexpr std::size_t kMostProblems = 100;

 private:
  struct Bounded {};
  UsageError(Bounded /*tag*/, std::vector<Problem> problems)
      : Error(join(problems)), problems_(std::move(problems)) {}

  static std::vector<Problem> problems_of(std::vector<std::string> lines) {
    std::vector<Problem> problems;
    problems.reserve(lines.size());
    for (std::string& line : lines) problems.push_back({.reason = std::move(line)});
    return problems;
  }
  static std::vector<Problem> bounded(std::vector<Problem> problems) {
    if (problems.size() <= kMostProblems) return problems;
    const std::size_t more = problems.size() - kMostProblems;
    problems.resize(kMostProblems);
    problems.push_back({.reason = "and " + std::to_string(more) + " more problems"});
    return problems;
  }
  static std::string join(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
      if (!text.empty()) text += '\n';
      text += problem.line();
    }
    return text;
  }

  std::vector<Problem> problems_;
};

/// A scene file or scene value is invalid; problems() lists everything that is wrong with it.
struct SceneError : UsageError {
  using UsageError::UsageError;
};

/// The physics has no answer: a step limit was reached or a number left its range.
struct SimulationError : Error {
  using Error::Error;
};

/// Painting failed: Cairo or FreeType reported an error.
struct DrawError : Error {
  using Error::Error;
};

/// Encoding or muxing failed: a codec library reported an error.
struct MediaError : Error {
  using Error::Error;
};

/// Reading or writing a file failed after it had been opened.
struct IoError : Error {
  using Error::Error;
};

/// The work was stopped on request, by a signal for example.
struct Interrupted : Error {
  Interrupted() : Error("interrupted") {}
};

}  // namespace piblocks
