#include "draw/bodies/body_painter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "draw/number_text.hpp"

namespace piblocks {
namespace {

/// Length of the arrow of the usual speed, and of an arrow's head, in fractions of the frame's
/// shorter side.
constexpr double kArrow = 0.08;
constexpr double kArrowHead = 0.014;
/// Above the ids of labels, two for each body.
constexpr std::size_t kArrows = 32768;
/// Above the ids of walls.
constexpr std::size_t kTrails = 2000;
/// Above the ids of discs.
constexpr std::size_t kExposed = 65535;
constexpr double kTrailOpacity = 0.45;
/// A disc whose radius is less than so many widths of its rim has none.
constexpr double kLeastRim = 4;

/// How velocities are drawn.
struct ArrowLook {
  bool are_shown = false;
  Color color;
  double px_per_speed = 0;
  double line_px = 1;
  double head_px = 1;
  double above_px = 0;  ///< from a block to its arrow
};

ArrowLook arrow_look(const DrawingContext& context) {
  double energy = 0;
  double mass = 0;
  for (const Body& body : context.bodies.system.bodies) {
    if (!body.mass) continue;
    const auto& [x, y] = body.velocity;
    energy += to_double(*body.mass * (x * x + y * y));
    mass += to_double(*body.mass);
  }
  const double usual_speed = std::sqrt(energy / mass);
  const double short_side = context.sizes.short_side;
  return {.are_shown = context.scene.show.has(Overlay::velocities) && usual_speed > 0,
          .color = context.palette.text,
          .px_per_speed = kArrow * short_side / usual_speed,
          .line_px = context.sizes.data_line,
          .head_px = kArrowHead * short_side,
          .above_px = kArrowAbove * short_side};
}

/// A line and a triangle; nothing where the arrow would be shorter than its head.
void add_arrow(const ArrowLook& look, ItemId id, const Point& from,
               const std::array<double, 2>& velocity, std::vector<DrawItem>& items) {
  const Point way{velocity[0] * look.px_per_speed, -velocity[1] * look.px_per_speed};
  const double length = std::sqrt(way.x * way.x + way.y * way.y);
  if (length < look.head_px) return;
  const Point along{way.x / length, way.y / length};
  const Point tip{from.x + way.x, from.y + way.y};
  const Point neck{tip.x - look.head_px * along.x, tip.y - look.head_px * along.y};
  const double half = look.head_px / 2;
  items.emplace_back(PathItem{id, std::vector<Point>{from, neck}, false, std::nullopt,
                              Stroke{look.color, look.line_px}});
  items.emplace_back(
      PathItem{nth(id, 1),
               std::vector<Point>{tip,
                                  {neck.x - half * along.y, neck.y + half * along.x},
                                  {neck.x + half * along.y, neck.y - half * along.x}},
               true, look.color, std::nullopt});
}

struct LabelLook {
  double type_px = 16;
  double above_px = 0;  ///< from a body to the label above it
  Color above;          ///< of labels that are above
  Face face = Face::text;
};

class BodyPainter {
 public:
  BodyPainter(const DrawingContext& context, BodyShapes bodies)
      : bodies_(std::move(bodies)),
        line_px_(std::max(1.0, std::round(context.sizes.data_line))),
        width_px_(context.scene.view.width_px),
        labels_{.type_px = context.sizes.mass,
                .above_px = kLabelAbove * context.sizes.short_side,
                .above = context.palette.text,
                .face = context.font.face()},
        arrows_(arrow_look(context)) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    add_trails(shown.trails, items);
    if (bodies_.are_blocks) {
      add_blocks(shown, items);
    } else {
      add_discs(shown, items);
    }
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      if (!bodies_.shapes[i].label.empty()) items.emplace_back(label_of(i, centre_of(shown, i)));
    }
    if (arrows_.are_shown) add_arrows(shown, items);
  }

 private:
  Point centre_of(const FrameState& shown, std::size_t body) const {
    return bodies_.map.at(shown.state.bodies[body].position);
  }

  /// Lines behind discs. They end where the disc is.
  void add_trails(const std::vector<std::vector<PathPoint>>& trails,
                  std::vector<DrawItem>& items) const {
    for (std::size_t i = 0; i < trails.size(); ++i) {
      const BodyShape& shape = bodies_.shapes[i];
      std::vector<Point> points;
      for (const PathPoint& point : trails[i]) points.push_back(bodies_.map.at(point.position));
      const double width_px = std::clamp(shape.half_width_px / 2, 1.0, 6.0);
      items.emplace_back(PathItem{nth(ItemId::wall, kTrails + i), std::move(points), false,
                                  std::nullopt,
                                  Stroke{faded(shape.colors.fill, kTrailOpacity), width_px}});
    }
  }

  ExposedBlock block_of(std::size_t body, const Point& centre) const {
    const BodyShape& shape = bodies_.shapes[body];
    return {{centre.x - shape.half_width_px, centre.y - shape.height_px, 2 * shape.half_width_px,
             shape.height_px},
            shape.colors.fill,
            {shape.colors.edge, line_px_},
            {},
            {}};
  }

  void add_blocks(const FrameState& shown, std::vector<DrawItem>& items) const {
    std::vector<ExposedBlock> blocks;
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      blocks.push_back(block_of(i, centre_of(shown, i)));
    }
    if (shown.body_exposure.empty()) {
      for (std::size_t i = 0; i < blocks.size(); ++i) {
        add_rectangles(nth(ItemId::red_block, i), blocks[i], items);
      }
      return;
    }
    const AxisPlace axis{bodies_.map.origin.x, bodies_.map.scale, double(width_px_)};
    items.emplace_back(exposed_blocks(std::move(blocks), axis, shown.body_exposure));
  }

  void add_discs(const FrameState& shown, std::vector<DrawItem>& items) const {
    ExposedDiscsItem exposed{nth(ItemId::red_block, kExposed), {}};
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      std::vector<DiscPath> paths = paths_of(i, shown.body_exposure);
      if (paths.empty()) {
        items.emplace_back(disc_of(i, centre_of(shown, i)));
      } else {
        exposed.discs.push_back(exposed_disc(i, std::move(paths)));
      }
    }
    if (!exposed.discs.empty()) items.emplace_back(std::move(exposed));
  }

  bool has_rim(const BodyShape& shape) const {
    return shape.half_width_px - line_px_ / 2 > kLeastRim * line_px_;
  }

  DiscItem disc_of(std::size_t body, const Point& centre) const {
    const BodyShape& shape = bodies_.shapes[body];
    const ItemId id = nth(ItemId::red_block, body);
    if (!has_rim(shape)) {
      return {id, centre, shape.half_width_px, shape.colors.fill, std::nullopt};
    }
    return {id, centre, shape.half_width_px - line_px_ / 2, shape.colors.fill,
            Stroke{shape.colors.edge, line_px_}};
  }

  ExposedDisc exposed_disc(std::size_t body, std::vector<DiscPath> paths) const {
    const BodyShape& shape = bodies_.shapes[body];
    return {shape.half_width_px, has_rim(shape) ? line_px_ : 0, shape.colors.fill,
            shape.colors.edge, std::move(paths)};
  }

  /// Nothing if the disc stays where it is.
  std::vector<DiscPath> paths_of(std::size_t body,
                                 const std::vector<WeightedBodyExposure>& exposures) const {
    std::vector<DiscPath> paths;
    for (const auto& [share, exposure] : exposures) {
      for (const BodyPiece& piece : exposure.pieces[body]) {
        paths.push_back(
            {bodies_.map.at(piece.from), bodies_.map.at(piece.to), share * piece.share()});
      }
    }
    const auto is_near = [](const Point& a, const Point& b) {
      return std::fabs(a.x - b.x) <= kStill_px && std::fabs(a.y - b.y) <= kStill_px;
    };
    const bool is_still = std::ranges::all_of(paths, [&](const DiscPath& way) {
      return is_near(way.from, paths.front().from) && is_near(way.to, paths.front().from);
    });
    if (is_still) paths.clear();
    return paths;
  }

  TextItem label_of(std::size_t body, const Point& centre) const {
    const BodyShape& shape = bodies_.shapes[body];
    const double middle = bodies_.are_blocks ? centre.y - shape.height_px / 2 : centre.y;
    const double top = centre.y - (bodies_.are_blocks ? shape.height_px : shape.half_width_px);
    const double baseline =
        shape.is_label_on ? middle + kHalfFigure_em * labels_.type_px : top - labels_.above_px;
    return {nth(ItemId::blue_block, body),
            {std::round(centre.x - shape.label_px / 2), std::round(baseline)},
            shape.label,
            labels_.type_px,
            shape.is_label_on ? shape.colors.text : labels_.above,
            labels_.face};
  }

  void add_arrows(const FrameState& shown, std::vector<DrawItem>& items) const {
    for (std::size_t i = 0; i < shown.state.bodies.size(); ++i) {
      Point from = centre_of(shown, i);
      if (bodies_.are_blocks) from.y -= bodies_.shapes[i].height_px + arrows_.above_px;
      add_arrow(arrows_, nth(ItemId::blue_block, kArrows + 2 * i), from,
                shown.state.bodies[i].velocity, items);
    }
  }

  BodyShapes bodies_;
  double line_px_;
  int width_px_;
  LabelLook labels_;
  ArrowLook arrows_;
};

}  // namespace

Drawable body_painter(const DrawingContext& context, BodyShapes bodies) {
  return BodyPainter(context, std::move(bodies));
}

}  // namespace piblocks
