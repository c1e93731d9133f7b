// An exception that carries an exit code.
// In: thrown by a command whose exit codes say more than done, failed or wrong usage. Out: the
// code.
#pragma once

#include <piblocks/error.hpp>

#include <string>

namespace piblocks::cli {

inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;

// Those of comparisons.
inline constexpr int kDifferent = 1;
inline constexpr int kMissingReference = 3;
inline constexpr int kMismatch = 4;
inline constexpr int kUnreadable = 5;

class ExitError : public Error {
 public:
  /// @param message  for standard error; empty if all has been said.
  explicit ExitError(int code, const std::string& message = {}) : Error(message), code_(code) {}
  int code() const noexcept { return code_; }

 private:
  int code_;
};

}  // namespace piblocks::cli
