// Which frames a person is shown: one choice for console, page and pictures.
// In: frames in any number, with what would be shown of them. Out: the most severe ones; of equally
// severe ones, the first.
#pragma once

#include <fmt/format.h>
#include <piblocks/compare.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "golden/difference.hpp"

namespace piblocks {

inline constexpr std::size_t kMaxShown = 40;

template <typename Item>
class ShownFrames {
 public:
  struct Left {
    Outcome outcome;
    Item item;
  };

  /// Whether add() would keep an item of this outcome.
  bool takes(Outcome outcome) const { return count_ < kMaxShown || least() < rank(outcome); }

  /// @returns the item for which there is no room: this one, or a less severe one.
  std::optional<Left> add(Outcome outcome, Item item) {
    if (!takes(outcome)) return Left{outcome, std::move(item)};
    std::optional<Left> left;
    if (count_ == kMaxShown) {
      auto& items = items_.at(least());
      left = Left{static_cast<Outcome>(least()), std::move(items.back())};
      items.pop_back();
      --count_;
    }
    items_.at(rank(outcome)).push_back(std::move(item));
    ++count_;
    return left;
  }

  /// Calls use(outcome, item), the most severe ones first.
  template <typename Use>
  void for_each(const Use& use) const {
    for (std::size_t i = kOutcomes; i-- > 0;) {
      for (const Item& item : items_.at(i)) use(static_cast<Outcome>(i), item);
    }
  }

 private:
  static std::size_t rank(Outcome outcome) { return static_cast<std::size_t>(outcome); }
  /// The rank of the least severe item.
  std::size_t least() const {
    std::size_t i = 0;
    while (i < kOutcomes && items_.at(i).empty()) ++i;
    return i;
  }

  std::array<std::vector<Item>, kOutcomes> items_;
  std::size_t count_ = 0;
};

/// The lines of the frames that are shown.
class ShownLines {
 public:
  void add(const FrameComparison& frame) {
    if (frame.outcome == Outcome::equal) return;
    add(frame.outcome, lines_.takes(frame.outcome) ? printable(row_text(frame)) : "");
  }
  void add(Outcome outcome, std::string line) {
    if (lines_.add(outcome, std::move(line))) ++left_;
  }
  template <typename Use>
  void for_each(const Use& use) const {
    lines_.for_each(use);
  }
  /// How many others there are; empty if there are none.
  std::string rest() const { return left_ > 0 ? fmt::format("… and {} more", left_) : ""; }
  /// The lines, and how many others there are.
  std::vector<std::string> all() const {
    std::vector<std::string> lines;
    for_each([&](Outcome, const std::string& line) { lines.push_back(line); });
    if (left_ > 0) lines.push_back(rest());
    return lines;
  }

 private:
  ShownFrames<std::string> lines_;
  std::int64_t left_ = 0;
};

}  // namespace piblocks
