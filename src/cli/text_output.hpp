// Lines of text to a file or to standard output.
// In: lines. Out: the same bytes, in large writes; a failed write is an exception.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/output_file.hpp"

namespace piblocks::cli {

/// A number as it is printed: zero without a sign, which nobody asked about.
/// @throws SimulationError if it is not finite; JSON could not tell.
inline double shown(double value) {
  if (!std::isfinite(value)) {
    throw SimulationError("output: a number is beyond the range of a double (about 1.8e308)");
  }
  return value == 0 ? 0 : value;
}

class TextOutput {
 public:
  /// @param name  a file, which appears when it is finished, or "-".
  explicit TextOutput(const std::string& name) : file_(name) {}

  void line(std::string_view text) {
    buffer_.append(text.data(), text.data() + text.size());
    end_line();
  }
  template <typename... Values>
  void format_line(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(fmt::appender(buffer_), format, std::forward<Values>(values)...);
    end_line();
  }
  void finish() {
    flush();
    file_.finish();
  }

 private:
  void end_line() {
    constexpr std::size_t kFlush_bytes = 1 << 16;
    buffer_.push_back('\n');
    if (buffer_.size() >= kFlush_bytes) flush();
  }
  void flush() {
    file_.write(std::string_view(buffer_.data(), buffer_.size()));
    buffer_.clear();
  }

  OutputFile file_;
  fmt::memory_buffer buffer_;
};

}  // namespace piblocks::cli
