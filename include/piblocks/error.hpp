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

/// What was asked for cannot be done as asked: a value out of range, a scene that contradicts
/// itself, an output that cannot be opened. Nothing has been written.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& problem) : UsageError(std::vector{problem}) {}
  /// @param problems at least one; each is a line of its own in what(). Of more than kMostProblems
  ///                 the last line says how many there are.
  explicit UsageError(std::vector<std::string> problems)
      : UsageError(Bounded{}, bounded(std::move(problems))) {}

  const std::vector<std::string>& problems() const noexcept { return problems_; }

  static constexpr std::size_t kMostProblems = 100;

 private:
  struct Bounded {};
  UsageError(Bounded /*tag*/, std::vector<std::string> problems)
      : Error(join(problems)), problems_(std::move(problems)) {}

  static std::vector<std::string> bounded(std::vector<std::string> problems) {
    if (problems.size() <= kMostProblems) return problems;
    const std::size_t more = problems.size() - kMostProblems;
    problems.resize(kMostProblems);
    problems.push_back("and " + std::to_string(more) + " more problems");
    return problems;
  }
  static std::string join(const std::vector<std::string>& problems) {
    std::string text;
    for (const std::string& problem : problems) text += (text.empty() ? "" : "\n") + problem;
    return text;
  }

  std::vector<std::string> problems_;
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
