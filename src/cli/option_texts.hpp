// Options as texts, from a command line or from another program; limits of their values.
// In: the name of an option, such as "--output". Out: its text, or the value that a parser makes of
// it, or a UsageError that says what is expected.
#pragma once

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/nearest_name.hpp"
#include "core/text.hpp"
#include "core/whole_number.hpp"

namespace piblocks::cli {

/// Rows of a log that are written unless --limit asks for more.
inline constexpr long kMaxRows = 100'000'000;
/// Threads of --jobs.
inline constexpr int kMaxJobs = 256;
/// Shards of --part.
inline constexpr int kMaxShards = 100'000;
/// Flashes of --max-flashes: as many as there can be at 60 frames a second.
inline constexpr int kMaxFlashes = 30;

/// The value whose name the text is.
/// @throws UsageError with all the names otherwise.
template <typename Value>
Value parse_choice(const std::string& text,
                   const std::vector<std::pair<std::string, Value>>& choices) {
  std::vector<std::string> names;
  for (const auto& [name, value] : choices) {
    if (text == name) return value;
    names.push_back(name);
  }
  throw UsageError(must_be_one_of(text, names));
}

class OptionTexts {
 public:
  OptionTexts() = default;
  OptionTexts(const OptionTexts&) = default;
  OptionTexts& operator=(const OptionTexts&) = default;
  virtual ~OptionTexts() = default;

  /// False also if there is no such option.
  virtual bool is_given(const std::string& option) const = 0;
  /// Nothing if the option was not given.
  virtual std::optional<std::string> text(const std::string& option) const = 0;
  /// Of an option that may be given several times.
  virtual std::vector<std::string> texts(const std::string& option) const {
    const std::optional<std::string> given = text(option);
    return given ? std::vector{*given} : std::vector<std::string>();
  }
  /// The option's value as `parse` makes it of the text; nothing if it was not given.
  /// @throws UsageError that names option and text if `parse` throws one
  template <typename Parse>
  auto value(const std::string& option, const Parse& parse) const
      -> std::optional<decltype(parse(std::string()))> {
    const std::optional<std::string> given = text(option);
    if (!given) return std::nullopt;
    try {
      return parse(*given);
    } catch (const UsageError& error) {
      const std::string shown = given->empty() ? "''" : shortened(*given);
      throw UsageError(fmt::format("{} {}: {}", option, shown, error.what()));
    }
  }
  /// The same of a whole number within limits.
  std::optional<int> whole(const std::string& option, int low, int high) const {
    return value(option, [&](const std::string& text) { return parse_int(text, low, high); });
  }
};

/// Options that no command line has given.
class OptionMap final : public OptionTexts {
 public:
  OptionMap() = default;
  explicit OptionMap(const std::map<std::string, std::string>& texts)
      : texts_(texts.begin(), texts.end()) {}

  void add(const std::string& option, const std::string& text) { texts_.emplace(option, text); }
  bool is_given(const std::string& option) const override { return texts_.contains(option); }
  std::optional<std::string> text(const std::string& option) const override {
    const auto found = texts_.find(option);
    return found == texts_.end() ? std::nullopt : std::optional(found->second);
  }
  std::vector<std::string> texts(const std::string& option) const override {
    std::vector<std::string> all;
    const auto [begin, end] = texts_.equal_range(option);
    for (auto at = begin; at != end; ++at) all.push_back(at->second);
    return all;
  }

 private:
  std::multimap<std::string, std::string> texts_;
};

}  // namespace piblocks::cli
