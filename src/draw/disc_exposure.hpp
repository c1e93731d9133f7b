// Discs that move while a picture is exposed, row by row.
// In: exposed discs and an area. Out: the mean light of its pixels.
#pragma once

#include <piblocks/image.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "draw/disc_look.hpp"
#include "draw/exposed_items.hpp"

namespace piblocks {

/// Paints row by row. A pixel's light is its mean over the time of the exposure. A disc that is in
/// a pixel while no other one is adds its light by itself. Those that are there at the same time
/// are painted one over the other, as Cairo does, from each change to the next.
class DiscExposure {
 public:
  /// Keeps what reaches into an area.
  void begin(const ExposedDiscsItem& item, const PixelRect& area);
  /// Rows of the area from its top to its bottom. @param pixels  of this row
  void paint_row(int y, std::uint32_t* pixels, const Light& light);

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  /// So many pixels are painted at once: there may be thousands of visits to each.
  static constexpr int kColumns = 128;

  /// A part of the exposure's time, 0 … 1.
  struct Moments {
    double begin = 0;
    double end = 0;
  };

  /// A disc goes one of its paths.
  struct Pass {
    std::uint32_t look = 0;
    Point from;
    Point step;  ///< to the end of the path
    double begin = 0;
    double share = 0;
    /// So many places stand for a short path; 0 if rings are looked for.
    int places = 0;
    PixelRect pixels = {};

    /// When the centre is within a distance of a place.
    std::optional<Moments> within(const Point& place, double distance) const;
    /// Whether both ends of the path, so all of it, are within a distance of a place.
    bool is_all_within(const Point& place, double distance) const;
    /// How far the centre is from a place, in the middle of a part of a short path.
    double distance_to(const Point& place, int part) const;
    /// Columns, outside of which the centre is farther than that from any place of this height.
    Extent beside(double y, double distance) const;
  };

  /// A disc is in a pixel.
  struct Visit {
    std::uint32_t pass = 0;
    std::uint32_t next = 0;  ///< another visit of the pixel
    bool is_inside = false;  ///< all of the pixel is in the innermost ring all the time
    Moments moments;
  };

  /// In a pixel a disc comes to its next ring, or part of a short path.
  struct Crossing {
    double time = 0;
    std::uint32_t visit = 0;
    bool leaves = false;   ///< a ring that is farther inside
    std::int32_t to = 0;   ///< the ring or part from then on; -1 outside
    DiscCover cover = {};  ///< from then on
  };

  void add(const ExposedDisc& disc, std::size_t place);
  void paint_columns(const PixelRect& columns, std::uint32_t* pixels);
  void visit(std::uint32_t number, const PixelRect& columns);
  std::uint32_t mean_of(std::uint32_t first, const Point& at, std::uint32_t pixel);
  void add_light(double share, const Rgb& light);
  void add_alone(const Visit& visit, const Point& at, std::uint32_t background);
  void add_together(std::span<const Visit> visits, const Point& at, const Rgb& background);
  void add_crossings(std::uint32_t number, const Visit& visit, const Point& at);
  void move(std::span<const Visit> visits, const Crossing& crossing);
  void add_present(double share, std::span<const Visit> visits, const Rgb& background);

  PixelRect area_ = {};
  const Light* light_ = nullptr;
  std::vector<DiscLook> looks_;        // of the discs that reach into the area
  std::vector<Pass> passes_;           // by disc, and by time
  std::vector<std::uint32_t> starts_;  // passes by their highest row
  std::size_t next_start_ = 0;
  std::vector<std::uint32_t> active_;            // passes in this row
  std::array<std::uint32_t, kColumns> first_{};  // visit of each pixel of some columns
  std::vector<Visit> visits_;                    // of these pixels
  // Of one pixel.
  std::vector<Visit> together_;
  std::vector<Crossing> crossings_;
  std::vector<Crossing> present_;
  Rgb plain_{};
  Rgb sum_{};
};

}  // namespace piblocks
