// The colours of one frame of a GIF.
// In: the colours of its pixels. Out: at most 256 of them, and for each other one the nearest.
#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace piblocks {

/// Counts colours, then numbers them. A colour is a word 0x00RRGGBB.
class ColorTable {
 public:
  void clear();
  void count(std::uint32_t color) { ++entry(color); }
  /// Keeps all colours if there is room. Otherwise the most frequent ones, those of flat shapes,
  /// take an eighth of the room. Each further one is the colour that is farthest from all that are
  /// kept already, so that a colour of few pixels keeps its look. The choice depends on the counts
  /// alone.
  void choose(std::size_t room);

  const std::vector<std::uint32_t>& colors() const noexcept { return colors_; }
  /// The place in colors() of a counted colour, or of the nearest colour that is kept.
  std::uint8_t index_of(std::uint32_t color) { return std::uint8_t(entry(color)); }

 private:
  /// A colour that was counted, and the nearest that is kept.
  struct Candidate {
    std::uint32_t color = 0;
    std::int64_t count = 0;
    std::int64_t place = 0;  ///< in colors_
    int distance = std::numeric_limits<int>::max();
  };

  void choose_some(std::size_t room, std::vector<Candidate>& candidates);
  void keep(std::uint32_t color, std::vector<Candidate>& candidates);
  std::int64_t& entry(std::uint32_t color);

  std::unordered_map<std::uint32_t, std::int64_t> counts_;  // then places
  std::vector<std::uint32_t> colors_;
  // The last colour that was looked up: most pixels have the colour of their neighbour.
  std::uint32_t last_color_ = 0;
  std::int64_t* last_ = nullptr;
};

}  // namespace piblocks
