#include <algorithm>
#include <utility>

#include "draw/overlays/overlays.hpp"

namespace piblocks {
namespace {

// In ems.
constexpr double kGap = 2.0;
constexpr double kRowHeight = 1.6;
constexpr double kBaseline = 1.1;

}  // namespace

ReadOutRows::ReadOutRows(std::vector<ReadOut> read_outs, const Rectangle& area, double text_px,
                         const Font& font)
    : text_px_(text_px) {
  std::vector<double> widths;
  for (const ReadOut& read_out : read_outs) {
    widths.push_back(font.width_em(read_out.widest) * text_px);
    text_px_ = std::min(text_px_, text_px * area.width / widths.back());
  }
  for (double& width : widths) width *= text_px_ / text_px;
  const double gap = kGap * text_px_;
  std::size_t first = 0;
  while (first < read_outs.size()) {
    double width = widths[first];
    std::size_t end = first + 1;
    for (; end < read_outs.size() && width + gap + widths[end] <= area.width; ++end) {
      width += gap + widths[end];
    }
    double x = area.x + (area.width - width) / 2;
    for (; first < end; ++first) {
      placed_.push_back(
          {std::move(read_outs[first]), {x, area.y + height_ + kBaseline * text_px_}});
      x += widths[first] + gap;
    }
    height_ += kRowHeight * text_px_;
  }
}

void ReadOutRows::move(double y) {
  for (Placed& placed : placed_) placed.origin.y += y;
}

void ReadOutRows::add(const Shown& shown, std::vector<DrawItem>& items) const {
  for (std::size_t n = 0; n < placed_.size(); ++n) {
    const Placed& placed = placed_[n];
    std::string text = placed.read_out.text(shown);
    if (text.empty()) continue;
    items.emplace_back(TextItem{nth(ItemId::read_outs, n), placed.origin, std::move(text), text_px_,
                                placed.read_out.color});
  }
}

}  // namespace piblocks
