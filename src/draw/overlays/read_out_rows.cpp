#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "draw/number_text.hpp"
#include "draw/overlays/overlays.hpp"
#include "draw/style.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kGap = 2.0;
constexpr double kRowHeight = 1.6;
constexpr double kRowBaseline = 1.1;

/// The characters that the read-outs may have at any instant.
std::string characters_of(const std::vector<ReadOut>& read_outs) {
  std::string characters(kNumberCharacters);
  for (const ReadOut& read_out : read_outs) characters += read_out.widest;
  return characters;
}

}  // namespace

ReadOutRows::ReadOutRows(std::vector<ReadOut> read_outs, const Setting& setting)
    : widths_(setting.font, characters_of(read_outs)), text_px_(setting.text_px) {
  const View& view = setting.scene.view;
  const double margin = style::kMargin * short_measure(view);
  const double room_px = view.width_px - 2 * margin;
  if (read_outs.empty()) return;
  const auto width_em = [&](const ReadOut& read_out) {
    return setting.font.width_em(read_out.widest);
  };
  const ReadOut& widest = *std::ranges::max_element(read_outs, {}, width_em);
  text_px_ = setting.font.fitted_px(widest.widest, setting.text_px, room_px);
  if (text_px_ < style::kLeastText_px) {
    throw UsageError(
        fmt::format("show.overlays: '{}' cannot be read in {:.0f} pixels; leave it out, or make "
                    "the frame wider",
                    widest.name, room_px));
  }
  std::vector<double> widths;
  for (const ReadOut& read_out : read_outs) widths.push_back(width_em(read_out) * text_px_);
  const double gap = kGap * text_px_;
  std::size_t first = 0;
  while (first < read_outs.size()) {
    double width = widths[first];
    std::size_t end = first + 1;
    for (; end < read_outs.size() && width + gap + widths[end] <= room_px; ++end) {
      width += gap + widths[end];
    }
    double x = margin + (room_px - width) / 2;
    for (; first < end; ++first) {
      placed_.push_back(
          {std::move(read_outs[first]), {x, height_ + kRowBaseline * text_px_}, widths[first]});
      x += widths[first] + gap;
    }
    height_ += kRowHeight * text_px_;
  }
}

void ReadOutRows::move(double y) {
  for (Placed& placed : placed_) placed.origin.y += y;
}

void ReadOutRows::operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
  // An instant outside of the scene's span may need more room than any in it.
  double shift = 0;
  for (std::size_t n = 0; n < placed_.size(); ++n) {
    const Placed& placed = placed_[n];
    if (n > 0 && placed.origin.y != placed_[n - 1].origin.y) shift = 0;
    std::string text = placed.read_out.text(shown);
    if (text.empty()) continue;
    const Point origin{placed.origin.x + shift, placed.origin.y};
    if (text.size() > placed.read_out.widest.size()) {
      shift += std::max(0.0, widths_.width_em(text) * text_px_ - placed.room_px);
    }
    items.emplace_back(TextItem{nth(ItemId::read_outs, n), origin, std::move(text), text_px_,
                                placed.read_out.color});
  }
}

}  // namespace piblocks
