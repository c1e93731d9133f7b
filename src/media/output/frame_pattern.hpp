// The name of one image of a sequence.
// In: a pattern such as "frames/%06d.png". Out: the file name of frame n.
// The pattern is the user's text, so it is parsed here and never handed to printf.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace piblocks {

/// One integer field, %d or %0Nd with N from 1 to 9, between literal texts; %% is a percent sign.
class FramePattern {
 public:
  /// @throws UsageError saying what to write, if the text has no field, more than one, a field in
  ///         a folder's name, or another percent sign.
  explicit FramePattern(std::string_view text);

  /// File name of frame `number` >= 0, without its folder. Longer numbers are written in full.
  std::string name(std::int64_t number) const;
  /// The number of the image with this file name; nothing if no image has it.
  std::optional<std::int64_t> number_of(std::string_view name) const;
  /// The same for a name whose number may have other leading zeros.
  std::optional<std::int64_t> number_in(std::string_view name) const;
  /// The same for all patterns of a folder that differ only in the width of the field.
  std::string label() const { return before_ + "%d" + after_; }
  /// The folder the files go to; empty if the pattern names none.
  const std::string& folder() const noexcept { return folder_; }

 private:
  std::string folder_;
  std::string before_;
  std::string after_;
  int digits_ = 1;
};

/// Whether a file name is that of an image of this pattern, whatever its number.
std::function<bool(const std::string& name)> names_of_pattern(const std::string& pattern);

}  // namespace piblocks
