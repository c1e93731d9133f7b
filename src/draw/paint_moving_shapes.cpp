#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "core/stop.hpp"
#include "draw/block_cover.hpp"
#include "draw/extent.hpp"
#include "draw/painter.hpp"

namespace piblocks {
namespace {

/// Sums of light in whole numbers do not depend on their order, so that a part of the picture has
/// the pixels of the whole.
using LightSum = std::array<std::int64_t, 3>;
constexpr double kWeightUnit = 1 << 24;

Rgb samples_of(const Color& color) {
  return {double(color.red), double(color.green), double(color.blue)};
}

/// The part of a pixel that a half-plane covers. Its edge is `inside` beyond the pixel's centre,
/// and at right angles to (x, y), whose length is given.
double half_plane(double inside, double x, double y, double length) {
  const double most = std::max(std::fabs(x), std::fabs(y));
  const double least = std::min(std::fabs(x), std::fabs(y));
  const double away = std::fabs(inside) * length;
  double outside = 0;  // of the smaller part
  if (away <= (most - least) / 2) {
    outside = 0.5 - away / most;
  } else if (away < (most + least) / 2) {
    const double corner = (most + least) / 2 - away;
    outside = corner * corner / (2 * most * least);
  }
  return inside > 0 ? 1 - outside : outside;
}

PixelRun cut(const PixelRun& run, const PixelRun& to) {
  return {std::clamp(run.begin, to.begin, to.end), std::clamp(run.end, to.begin, to.end)};
}

int whole(double px) { return static_cast<int>(std::clamp(px, -1e9, 1e9)); }

/// A disc as the painter sees it, at any place.
class MovingDisc {
 public:
  explicit MovingDisc(const DiscItem& disc)
      : fill_(samples_of(disc.fill.value_or(Color{}))),
        rim_(samples_of(disc.stroke ? disc.stroke->color : Color{})) {
    const double rim_px = disc.stroke ? disc.stroke->width_px : 0;
    const double radius = disc.radius + rim_px / 2;
    const double seen = std::max(radius, kLeast_px);
    // A disc thinner than a pixel is as wide as one, and fainter.
    opacity_ = std::min(1.0, radius * radius / (seen * seen));
    outer_ = radius_of_edge(seen);
    inner_ = rim_px > 0 ? radius_of_edge(seen - rim_px) : outer_;
  }

  /// Whether it looks the same in a row and in the one above, wherever it is.
  static bool repeats(int /*y*/) { return false; }
  PixelRun rows(const Point& at) const {
    return {whole(std::floor(at.y - outer_ - kEdge_px)),
            whole(std::ceil(at.y + outer_ + kEdge_px))};
  }

  /// Calls solid(run, samples) and edge(x, over), which is what it makes of the samples behind it.
  template <typename Solid, typename Edge>
  void visit_row(const Point& at, int y, const PixelRun& columns, const Solid& solid,
                 const Edge& edge) const {
    const double down = y + 0.5 - at.y;
    const PixelRun run = cut(within(outer_ + kEdge_px, down, at.x), columns);
    PixelRun inside = within(inner_ - kEdge_px, down, at.x);
    if (opacity_ < 1 || inside.begin >= inside.end) inside = {run.end, run.end};
    inside = cut(inside, run);
    const auto paint = [&](int x) {
      edge(x, [&](const Rgb& behind) { return over(behind, x + 0.5 - at.x, down); });
    };
    for (int x = run.begin; x < inside.begin; ++x) paint(x);
    if (inside.begin < inside.end) solid(inside, fill_);
    for (int x = inside.end; x < run.end; ++x) paint(x);
  }

 private:
  static constexpr double kLeast_px = 0.5;
  /// A pixel's centre is at most so far from a circle that touches it.
  static constexpr double kEdge_px = 0.7072;

  /// The straight edge that covers as much as the circle.
  static double radius_of_edge(double radius) {
    return radius > 0 ? std::sqrt(std::max(0.0, radius * radius - 1.0 / 12)) : -2 * kEdge_px;
  }
  /// Pixels of a row so far below the centre that have theirs within a distance of it.
  static PixelRun within(double distance, double down, double at) {
    const double left = distance * distance - down * down;
    if (distance <= 0 || left <= 0) return {};
    const double half = std::sqrt(left);
    return {whole(std::ceil(at - half - 0.5)), whole(std::floor(at + half - 0.5)) + 1};
  }
  Rgb over(const Rgb& behind, double x, double y) const {
    const double distance = std::sqrt(x * x + y * y);
    const auto covered = [&](double radius) {
      const double inside = radius - distance;
      if (std::fabs(inside) >= kEdge_px || distance == 0) return inside > 0 ? 1.0 : 0.0;
      return half_plane(inside, x, y, distance);
    };
    const double outer = opacity_ * covered(outer_);
    const double inner = inner_ < outer_ ? opacity_ * covered(inner_) : outer;
    Rgb samples = behind;
    for (std::size_t i = 0; i < 3; ++i) {
      samples[i] += inner * (fill_[i] - behind[i]) + (outer - inner) * (rim_[i] - behind[i]);
    }
    return samples;
  }

  Rgb fill_;
  Rgb rim_;
  double opacity_ = 1;
  double outer_ = 0;
  double inner_ = 0;  ///< of the rim
};

/// The same of a block.
class MovingBlock {
 public:
  explicit MovingBlock(const ExposedBlock& block) : block_(block), cover_(block) {}

  bool repeats(int y) const { return cover_.of_row(y) == cover_.of_row(y - 1); }
  PixelRun rows(const Point& /*at*/) const {
    return {whole(std::floor(block_.bounds.y)), whole(std::ceil(block_.bounds.bottom()))};
  }

  template <typename Solid, typename Edge>
  void visit_row(const Point& at, int y, const PixelRun& columns, const Solid& solid,
                 const Edge& edge) const {
    const Cover row = cover_.of_row(y);
    const double right = at.x + block_.bounds.width;
    const double end = std::max(cover_.line_px(), row.inset);
    const PixelRun run = cut({whole(std::floor(at.x)), whole(std::ceil(right))}, columns);
    PixelRun inside{whole(std::ceil(at.x + end)), whole(std::floor(right - end))};
    if (row.outer < 1 || inside.begin >= inside.end) inside = {run.end, run.end};
    inside = cut(inside, run);
    const auto paint = [&](int x) {
      const Cover column = cover_.of_column(x, at.x, row.inset);
      edge(x, [&](const Rgb& behind) { return over(behind, column, row); });
    };
    for (int x = run.begin; x < inside.begin; ++x) paint(x);
    if (inside.begin < inside.end) solid(inside, over({}, {1, 1, 0}, row));
    for (int x = inside.end; x < run.end; ++x) paint(x);
  }

 private:
  Rgb over(const Rgb& behind, const Cover& column, const Cover& row) const {
    const PixelCover pixel(block_, column, row);
    return {pixel.over(behind[0], &Color::red), pixel.over(behind[1], &Color::green),
            pixel.over(behind[2], &Color::blue)};
  }

  const ExposedBlock& block_;
  BlockCover cover_;
};

/// A shape that comes into an area, and its places.
struct Mover {
  std::variant<MovingBlock, MovingDisc> shape;
  std::span<const Point> places;
  Rect extent;  ///< over all places

  bool repeats(int y) const {
    return std::visit([&](const auto& any) { return any.repeats(y); }, shape);
  }
};

struct PixelSum {
  LightSum edges{};               ///< what edges add to the light, which may be negative
  LightSum solid{};               ///< light of the runs that begin here, less of those that end
  std::int64_t solid_weight = 0;  ///< of these runs
  std::int64_t moment = 0;        ///< the last in which an edge was here
  Rgb samples{};                  ///< of that moment
  LightSum light{};               ///< of these
};

/// Pixels to which pictures of moments are added.
class MomentSums {
 public:
  MomentSums(const PixelRect& area, const Light& light, const SurfacePixels& pixels,
             std::span<const Mover* const> movers, std::vector<PixelSum>& memory)
      : area_(area),
        light_(light),
        pixels_(pixels),
        stride_(static_cast<std::size_t>(area.width_px) + 1),
        sums_(memory) {
    sums_.resize(std::max(sums_.size(), stride_ * static_cast<std::size_t>(area.height_px)));
    for (int y = area.y_px; y < area.bottom_px(); ++y) {
      const auto row = [&](int of) { return std::span(pixels.at(area.x_px, of), stride_ - 1); };
      const bool repeats =
          y > area.y_px &&
          std::ranges::all_of(movers, [&](const Mover* m) { return m->repeats(y); }) &&
          std::ranges::equal(row(y), row(y - 1));
      if (repeats) continue;
      rows_.push_back(y);
      std::fill_n(&at(area.x_px, y), stride_, PixelSum{});
    }
  }

  /// What is added from now on is seen for a share of the exposure.
  void next_moment(double share) {
    ++moment_;
    weight_ = std::llround(share * kWeightUnit);
    weights_ += weight_;
  }

  template <typename Shape>
  void add(const Shape& shape, const Point& place) {
    const PixelRun rows = cut(shape.rows(place), {area_.y_px, area_.bottom_px()});
    for (const int y : rows_) {
      if (y < rows.begin || y >= rows.end) continue;
      shape.visit_row(
          place, y, {area_.x_px, area_.right_px()},
          [&](const PixelRun& run, const Rgb& samples) { add_solid(y, run, samples); },
          [&](int x, const auto& over) { add_edge(x, y, over); });
    }
  }

  /// Makes each pixel the mean of all moments.
  void finish() {
    auto next = rows_.begin();
    for (int y = area_.y_px; y < area_.bottom_px(); ++y) {
      if (next != rows_.end() && *next == y) {
        finish_row(*next++);
      } else {
        std::copy_n(pixels_.at(area_.x_px, y - 1), area_.width_px, pixels_.at(area_.x_px, y));
      }
    }
  }

 private:
  void finish_row(int y) {
    LightSum solid{};
    std::int64_t covered = 0;
    for (int x = area_.x_px; x < area_.right_px(); ++x) {
      const PixelSum& pixel = at(x, y);
      covered += pixel.solid_weight;
      for (std::size_t i = 0; i < 3; ++i) solid[i] += pixel.solid[i];
      if (covered > 0 || pixel.moment > 0) set_mean(pixel, solid, covered, *pixels_.at(x, y));
    }
  }

  PixelSum& at(int x, int y) {
    return sums_[static_cast<std::size_t>(y - area_.y_px) * stride_ +
                 static_cast<std::size_t>(x - area_.x_px)];
  }
  static Rgb samples_of(std::uint32_t pixel) {
    return {double(pixel >> 16 & 0xFF), double(pixel >> 8 & 0xFF), double(pixel & 0xFF)};
  }
  LightSum lights_of(const Rgb& samples) const {
    return {light_.units_of(samples[0]), light_.units_of(samples[1]), light_.units_of(samples[2])};
  }

  void add_solid(int y, const PixelRun& run, const Rgb& samples) {
    PixelSum& begin = at(run.begin, y);
    PixelSum& end = at(run.end, y);
    begin.solid_weight += weight_;
    end.solid_weight -= weight_;
    const LightSum lights = lights_of(samples);
    for (std::size_t i = 0; i < 3; ++i) {
      begin.solid[i] += weight_ * lights[i];
      end.solid[i] -= weight_ * lights[i];
    }
  }

  /// Where several shapes have their edges in one pixel, each is painted over those before.
  template <typename Over>
  void add_edge(int x, int y, const Over& over) {
    PixelSum& pixel = at(x, y);
    if (pixel.moment < moment_) {
      pixel.moment = moment_;
      pixel.samples = samples_of(*pixels_.at(x, y));
      pixel.light = lights_of(pixel.samples);
    }
    pixel.samples = over(pixel.samples);
    const LightSum lights = lights_of(pixel.samples);
    for (std::size_t i = 0; i < 3; ++i) pixel.edges[i] += weight_ * (lights[i] - pixel.light[i]);
    pixel.light = lights;
  }

  void set_mean(const PixelSum& pixel, const LightSum& solid, std::int64_t covered,
                std::uint32_t& word) const {
    const LightSum background = lights_of(samples_of(word));
    std::uint32_t mean = word & 0xFF000000U;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t sum = pixel.edges[i] + solid[i] + (weights_ - covered) * background[i];
      const double light = double(sum) / (double(weights_) * Light::kLightUnit);
      mean |= std::uint32_t{light_.sample(light)} << (16 - 8 * i);
    }
    word = mean;
  }

  PixelRect area_;
  const Light& light_;
  const SurfacePixels& pixels_;
  std::size_t stride_;
  std::vector<PixelSum>& sums_;  // one more a row, where runs may end
  std::vector<int> rows_;        // others are as the one above
  std::int64_t moment_ = 0;      // from 1 on
  std::int64_t weight_ = 0;      // of this moment
  std::int64_t weights_ = 0;     // of all until now
};

std::vector<Mover> movers_in(const MovingShapesItem& item, const Rect& area) {
  std::vector<Mover> movers;
  for (const MovingShape& moving : item.shapes) {
    const Rect extent = extent_of(moving);
    if (!extent.meets(area)) continue;
    if (const auto* disc = std::get_if<DiscItem>(&moving.shape)) {
      movers.push_back({MovingDisc(*disc), moving.places.view(), extent});
    } else {
      movers.push_back(
          {MovingBlock(std::get<ExposedBlock>(moving.shape)), moving.places.view(), extent});
    }
  }
  return movers;
}

Rect extent_of(std::span<const Mover> movers) {
  Rect extent = movers.front().extent;
  for (const Mover& mover : movers) extent = extent | mover.extent;
  return extent;
}

}  // namespace

/// In tiles, which bounds the memory and keeps it in the cache.
void Painter::paint(cairo_t& cr, const MovingShapesItem& item, const PixelRect& area) {
  constexpr int kTile_px = 64;
  if (!has_pixels_of_picture(cr)) return paint_still(cr, item);
  const std::vector<Mover> movers = movers_in(item, to_rect(area));
  if (movers.empty()) return;
  const PixelRect moving = piblocks::pixels_of(extent_of(movers), area);
  const SurfacePixels pixels(cr, area);
  std::vector<PixelSum> memory;
  std::vector<const Mover*> here;
  const auto paint_tile = [&](const PixelRect& tile) {
    here.clear();
    for (const Mover& mover : movers) {
      if (mover.extent.meets(to_rect(tile))) here.push_back(&mover);
    }
    if (here.empty()) return;
    MomentSums sums(tile, light(), pixels, here, memory);
    for (std::size_t moment = 0; moment < item.shares.size(); ++moment) {
      check_stop(stop_);
      sums.next_moment(item.shares[moment]);
      for (const Mover* mover : here) {
        std::visit([&](const auto& any) { sums.add(any, mover->places[moment]); }, mover->shape);
      }
    }
    sums.finish();
  };
  for (int y = moving.y_px; y < moving.bottom_px(); y += kTile_px) {
    const int height = std::min(kTile_px, moving.bottom_px() - y);
    for (int x = moving.x_px; x < moving.right_px(); x += kTile_px) {
      paint_tile({x, y, std::min(kTile_px, moving.right_px() - x), height});
    }
  }
}

}  // namespace piblocks
