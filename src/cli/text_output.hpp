// Text for people and for programs.
// In: text and values; what a terminal cannot show in them is escaped. Out: messages on standard
// error, if it can be written: work does not fail because a terminal was closed. Lines to standard
// output, in large writes: a failed write is an exception, but nothing is said to a reader that has
// gone away.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/output_file.hpp"
#include "core/text.hpp"

namespace piblocks::cli {

/// The value itself, or a text that a terminal can show.
template <typename Value>
decltype(auto) printable_value(const Value& value) {
  if constexpr (std::is_convertible_v<const Value&, std::string_view>) {
    return printable(value);
  } else {
    return (value);
  }
}

/// Calls `use` with the values as arguments for fmt, which takes no temporaries from version 10 on.
template <typename Use, typename... Values>
void with_printable(Use use, const Values&... values) {
  const auto call = [&](const auto&... shown) { use(fmt::make_format_args(shown...)); };
  call(printable_value(values)...);
}

template <typename... Values>
void say(fmt::format_string<const Values&...> format, const Values&... values) noexcept {
  try {
    with_printable(
        [&](fmt::format_args arguments) {
          fmt::vprint(stderr, fmt::string_view(format), arguments);
        },
        values...);
  } catch (const std::exception&) {
    return;
  }
}

/// Writes a text to standard output as it is. @throws IoError, ReaderGone
inline void print_text(std::string_view text) {
  OutputFile out("-", OutputFile::Contents::text);
  out.write(text);
  out.finish();
}

class TextOutput {
 public:
  void line(std::string_view text) {
    buffer_.append(text.data(), text.data() + text.size());
    end_line();
  }
  template <typename... Values>
  void format_line(fmt::format_string<const Values&...> format, const Values&... values) {
    with_printable(
        [&](fmt::format_args arguments) {
          fmt::vformat_to(fmt::appender(buffer_), fmt::string_view(format), arguments);
        },
        values...);
    end_line();
  }
  /// Hands on what a reader may wait for. @throws IoError
  void flush() {
    try {
      if (has_reader_) file_.write(std::string_view(buffer_.data(), buffer_.size()));
    } catch (const ReaderGone&) {  // the work goes on: it may be more than text
      has_reader_ = false;
    }
    buffer_.clear();
  }
  /// @throws IoError
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

  OutputFile file_{"-", OutputFile::Contents::text};
  fmt::memory_buffer buffer_;
  bool has_reader_ = true;
};

}  // namespace piblocks::cli
