#include "draw/text_lines.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <iterator>
#include <sstream>

namespace piblocks {
namespace {

/// In a smaller frame no text can be read.
constexpr int kLeastFrame_px = 120;
constexpr std::size_t kMostLines = 2;  ///< of a title or a caption

}  // namespace

std::vector<std::string> break_lines(const Font& font, const std::string& text,
                                     const LineRoom& room) {
  const auto fits = [&](const std::string& line) {
    return font.width_em(line) * room.size_px <= room.width_px;
  };
  std::istringstream stream(text);
  const std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  std::vector<std::string> lines = filled_lines(words, std::string(" "), fits);
  if (lines.size() <= kMostLines && std::ranges::all_of(lines, fits)) return lines;
  throw_too_long(room.key, text, room.width_px);
}

void throw_too_long(const char* key, const std::string& text, double room_px) {
  throw UsageError(
      key, fmt::format(
               "'{}' is too long to be read in {:.0f} pixels; shorten it, or make the frame wider",
               text, room_px));
}

void check_readable(const LayoutContext& context, const char* key, const std::string& text) {
  context.font.check(text, key);
  if (context.sizes.short_side >= kLeastFrame_px) return;
  const View& view = context.scene.view;
  throw UsageError(
      key, fmt::format("'{}' cannot be read in a frame of {}x{}; leave it out, or make the frame "
                       "{} pixels {} or more",
                       text, view.width_px, view.height_px, kLeastFrame_px,
                       view.height_px < view.width_px ? "high" : "wide"));
}

}  // namespace piblocks
