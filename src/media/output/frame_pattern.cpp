#include "media/output/frame_pattern.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <charconv>

namespace piblocks {
namespace {

[[noreturn]] void fail(std::string_view text, std::string_view why) {
  throw UsageError(fmt::format(
      "output: cannot use '{}': {}; write one number field, as in frames/%06d.png", text, why));
}

struct Escape {
  std::size_t length = 0;     // of %%, %d or %0Nd; 0 if it is none of these
  std::optional<int> digits;  // of a field
};

/// @param rest  starts with a percent sign.
Escape parse_escape(std::string_view rest) {
  if (rest.starts_with("%%")) return {2, std::nullopt};
  if (rest.starts_with("%d")) return {2, 1};
  const bool padded =
      rest.size() >= 4 && rest[1] == '0' && rest[2] >= '1' && rest[2] <= '9' && rest[3] == 'd';
  if (padded) return {4, rest[2] - '0'};
  return {};
}

}  // namespace

FramePattern::FramePattern(std::string_view text) {
  bool has_field = false;
  for (std::size_t at = 0; at < text.size();) {
    std::string& literal = has_field ? after_ : before_;
    if (text[at] != '%') {
      literal += text[at++];
      continue;
    }
    const Escape escape = parse_escape(text.substr(at));
    if (escape.length == 0)
      fail(text, fmt::format("'{}' starts none of %d, %0Nd and %%", text.substr(at, 2)));
    at += escape.length;
    if (!escape.digits) {
      literal += '%';
      continue;
    }
    if (has_field) fail(text, "it has two number fields");
    has_field = true;
    digits_ = *escape.digits;
  }
  if (!has_field) fail(text, "an image sequence needs a number in its name");
  if (after_.find('/') != std::string::npos) fail(text, "the number is in the name of a folder");
  const std::size_t slash = before_.rfind('/');
  if (slash == std::string::npos) return;
  folder_ = before_.substr(0, slash + 1);
  before_.erase(0, slash + 1);
}

std::string FramePattern::name(std::int64_t number) const {
  return fmt::format("{}{:0{}}{}", before_, number, digits_, after_);
}

std::optional<std::int64_t> FramePattern::number_of(std::string_view name) const {
  const auto number = number_in(name);
  return number && this->name(*number) == name ? number : std::nullopt;
}

std::optional<std::int64_t> FramePattern::number_in(std::string_view name) const {
  const bool fits = name.size() > before_.size() + after_.size() && name.starts_with(before_) &&
                    name.ends_with(after_);
  if (!fits) return std::nullopt;
  const char* const begin = name.data() + before_.size();
  const char* const end = name.data() + name.size() - after_.size();
  std::int64_t number = 0;
  const auto read = std::from_chars(begin, end, number);
  if (read.ec != std::errc() || read.ptr != end || *begin == '-') return std::nullopt;
  return number;
}

std::function<bool(const std::string& name)> names_of_pattern(const std::string& pattern) {
  return [pattern = FramePattern(pattern)](const std::string& name) {
    return pattern.number_of(name).has_value();
  };
}

}  // namespace piblocks
