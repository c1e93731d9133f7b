#include "draw/stage/hits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/rounded.hpp"
#include "draw/overlays/zoom.hpp"
#include "draw/stage/stage.hpp"

namespace piblocks {
namespace {

/// Radius of an arc when it appears, in parts of its final radius.
constexpr double kFirstRadius = 0.3;
/// Radius of a ring in a plane, in radii of an arc.
constexpr double kRing = 0.4;
/// Directions in which an arc is drawn: without the first and the last, it keeps clear of the
/// bodies.
constexpr std::size_t kDirections = 13;
/// Width of an arc's line, in widths of the wall's line.
constexpr double kMarkLine = 1.2;
/// Of concentric discs that make a glow: their number, the greatest opacity of each, and the radius
/// of the largest in parts of an arc's final radius.
constexpr int kGlowDiscs = 7;
constexpr double kGlowAlpha = 0.24;
constexpr double kGlowReach = 0.8;
/// The strength of a glow goes from the least one at kMaxHitsPerSecond towards 1. It is half-way
/// when the rate has doubled so many times.
constexpr double kLeastGlow = 0.4;
constexpr double kHalfGlow = 6;
/// Glows have at most so many colours. Where there are more, some are in the colour of text.
constexpr std::size_t kMostColors = 16;
/// Kinds of free corners.
constexpr std::size_t kCorners = 3;
/// Strengths that are told apart, from kLeastGlow to 1: one for each of its opacities.
constexpr int kGlows = 38;

/// Which of the kGlows strengths the rate has, from 0, the weakest.
int glow_of(double hits_per_s) {
  const double doublings = straight_log2(hits_per_s / kMaxHitsPerSecond);
  return static_cast<int>(std::lround((kGlows - 1) * doublings / (doublings + kHalfGlow)));
}

double opacity_of_glow(int glow) {
  return kGlowAlpha * (kLeastGlow + (1 - kLeastGlow) * glow / (kGlows - 1));
}

/// From one angle to another, counter-clockwise from the right.
std::vector<Point> directions_of(double from, double to) {
  std::vector<Point> directions;
  for (std::size_t i = 0; i < kDirections; ++i) {
    const double angle = from + (to - from) * double(i) / double(kDirections - 1);
    const auto [sine, cosine] = rounded::sin_cos(angle);
    directions.push_back({cosine, -sine});
  }
  return directions;
}

/// Directions of the free corner at a contact, of length 1, counter-clockwise.
std::vector<Point> directions_of(const Contact& contact) {
  constexpr double kUp = std::numbers::pi / 2;
  if (!contact.is_right_free && !contact.is_left_free) return directions_of(0, 4 * kUp);
  return directions_of(contact.is_right_free ? 0 : kUp, contact.is_left_free ? 2 * kUp : kUp);
}

std::uint32_t number_of(const Color& color) {
  return std::uint32_t(color.red) << 16U | std::uint32_t(color.green) << 8U | color.blue;
}

}  // namespace

Contact contact_of(double x_px, double floor_px, double left_px, double right_px,
                   const Color& color) {
  return {{x_px, floor_px - std::min(left_px, right_px)},
          left_px <= right_px,
          right_px <= left_px,
          color};
}

Color color_of_hit(const MetPair& pair, const System& system,
                   const std::vector<BlockColors>& colors) {
  const auto [first, second] = pair;
  const bool is_fixed = second >= system.bodies.size() || !system.bodies[second].mass;
  return colors[is_fixed ? first : second].line;
}

HitMarks::HitMarks(const DrawingContext& context, double most_reach_px, double most_glow_px)
    : reach_px_(std::min(most_reach_px, style::kHitReach * context.sizes.short_side)),
      glow_px_(std::min(kGlowReach * reach_px_, most_glow_px)),
      line_px_(kMarkLine * context.sizes.wall_line),
      other_color_(context.palette.text) {
  if (context.is_plane()) return;
  add_glows(other_color_);
  for (const BlockColors& colors : context.colors) {
    if (glows_.size() < kCorners * kMostColors) add_glows(colors.line);
  }
}

/// Glows of one colour, in each free corner.
void HitMarks::add_glows(const Color& color) {
  for (const auto& [left, right] : {std::pair(false, true), {true, false}, {true, true}}) {
    const Contact contact{{}, left, right, color};
    Glows& glows = glows_[kind_of(contact)];
    if (glows.empty()) glows = glows_of(contact);
  }
}

std::tuple<bool, bool, std::uint32_t> HitMarks::kind_of(const Contact& contact) {
  return {contact.is_left_free, contact.is_right_free, number_of(contact.color)};
}

void HitMarks::add_arc(ItemId id, double age_s, const Contact& contact,
                       std::vector<DrawItem>& items) const {
  const bool is_ring = !contact.is_left_free && !contact.is_right_free;
  const double left = 1 - age_s / kHitLife_s;  // of its life
  const double radius = (is_ring ? kRing : 1) * reach_px_ * (1 - (1 - kFirstRadius) * left * left);
  std::vector<Point> arc;
  for (const Point& direction : directions_of(contact)) {
    arc.push_back(contact.at + radius * direction);
  }
  arc.pop_back();
  if (!is_ring) arc.erase(arc.begin());
  items.emplace_back(PathItem{id, std::move(arc), is_ring, std::nullopt,
                              Stroke{faded(contact.color, left), line_px_}});
}

HitMarks::Glows HitMarks::glows_of(const Contact& contact) const {
  const std::vector<Point> directions = directions_of(contact);
  std::vector<Points> outlines;
  for (int disc = 1; disc <= kGlowDiscs; ++disc) {
    const double radius_px = glow_px_ * disc / kGlowDiscs;
    std::vector<Point> outline = {{0, 0}};
    for (const Point& direction : directions) outline.push_back(radius_px * direction);
    outlines.emplace_back(std::move(outline));
  }
  Glows glows;
  for (int glow = 0; glow < kGlows; ++glow) {
    const Color color = faded(contact.color, opacity_of_glow(glow));
    Plate plate;
    for (const Points& outline : outlines) {
      plate.items.emplace_back(PathItem{ItemId::hits, outline, true, color, std::nullopt});
    }
    glows.push_back(std::make_shared<const Plate>(std::move(plate)));
  }
  return glows;
}

void HitMarks::add_glow(double hits_per_s, std::span<const Contact> contacts,
                        std::vector<DrawItem>& items) const {
  if (hits_per_s <= kMaxHitsPerSecond) return;
  const auto glow = static_cast<std::size_t>(glow_of(hits_per_s));
  const double reach_px = std::ceil(glow_px_) + 1;
  std::size_t n = 0;
  for (const Contact& contact : contacts) {
    auto glows = glows_.find(kind_of(contact));
    if (glows == glows_.end()) {
      Contact other = contact;
      other.color = other_color_;
      glows = glows_.find(kind_of(other));
    }
    const Point at{std::round(contact.at.x), std::round(contact.at.y)};
    items.emplace_back(PlateItem{nth(ItemId::hits, n++),
                                 {at.x - reach_px, at.y - reach_px, 2 * reach_px, reach_px + 1},
                                 glows->second[glow],
                                 at});
  }
}

namespace {

/// Marks of blocks on a line.
class LineMarks {
 public:
  explicit LineMarks(const DrawingContext& context)
      : layout_(context.layout),
        colors_(context.colors),
        system_(context.scene.system),
        order_(from_left_to_right(system_)),
        marks_(context, most_reach_px(labelled_above(context, layout_)),
               narrowest_px(line_walls(system_)) / 2) {}

  void operator()(const FrameState& shown, std::vector<DrawItem>& items) const {
    for (std::size_t n = 0; n < shown.hits.size(); ++n) {
      const Hit& hit = shown.hits[n];
      const Contact contact = contact_at(hit.pair, layout_.at(hit.contact).x, shown);
      marks_.add_arc(nth(ItemId::hits, n), hit.age_s, contact, items);
    }
    if (shown.hits_per_s <= kMaxHitsPerSecond) return;
    std::vector<Contact> contacts;
    for (const MetPair& pair : shown.met_pairs) {
      contacts.push_back(contact_at(pair, present_x_px(pair, shown), shown));
    }
    std::ranges::sort(contacts, {}, [](const Contact& contact) { return contact.at.x; });
    marks_.add_glow(shown.hits_per_s, contacts, items);
  }

 private:
  /// A label above a block may be wider than this.
  double most_reach_px(const std::vector<std::size_t>& labelled) const {
    double most = HUGE_VAL;
    const auto is_labelled = [&](std::size_t i) { return std::ranges::binary_search(labelled, i); };
    for (std::size_t i = 1; i < order_.size(); ++i) {
      const std::size_t left = order_[i - 1];
      const std::size_t right = order_[i];
      if (!is_labelled(left) && !is_labelled(right)) continue;
      most = std::min(most, std::abs(layout_.height_px(left) - layout_.height_px(right)));
    }
    return most;
  }

  /// Of the blocks that are met from both sides; infinite if none is.
  double narrowest_px(const LineWalls& walls) const {
    double narrowest = HUGE_VAL;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const bool has_left = i > 0 || walls.left;
      const bool has_right = i + 1 < order_.size() || walls.right;
      if (has_left && has_right) narrowest = std::min(narrowest, layout_.width_px(order_[i]));
    }
    return narrowest;
  }

  bool is_wall(std::size_t id) const { return id >= colors_.size(); }
  double height_px(std::size_t id) const { return is_wall(id) ? HUGE_VAL : layout_.height_px(id); }
  double position(std::size_t id, const FrameState& shown) const {
    if (!is_wall(id)) return shown.state.bodies[id].position[0];
    return system_.walls[id - colors_.size()].normal[0] > 0 ? -HUGE_VAL : HUGE_VAL;
  }

  Contact contact_at(const MetPair& pair, double x_px, const FrameState& shown) const {
    const auto [first, second] = pair;
    const bool is_first_left = position(first, shown) < position(second, shown);
    return contact_of(x_px, layout_.floor_px, height_px(is_first_left ? first : second),
                      height_px(is_first_left ? second : first),
                      color_of_hit(pair, system_, colors_));
  }

  double present_x_px(const MetPair& pair, const FrameState& shown) const {
    const auto [first, second] = pair;
    if (is_wall(second))
      return layout_.at(to_double(system_.walls[second - colors_.size()].point[0]), 0).x;
    const bool is_first_left = position(first, shown) < position(second, shown);
    return layout_.at(is_first_left ? second : first, shown).x;
  }

  Layout layout_;
  std::vector<BlockColors> colors_;
  System system_;
  std::vector<std::size_t> order_;  ///< of bodies, from left to right
  HitMarks marks_;
};

}  // namespace

Drawable hit_marks(const DrawingContext& context) {
  const FrameNeeds needs{.hits = true};
  if (!context.is_plane()) return {LineMarks(context), needs};
  const auto add = [marks = HitMarks(context, HUGE_VAL, HUGE_VAL), layout = context.layout,
                    color = context.palette.text](const FrameState& shown,
                                                  std::vector<DrawItem>& items) {
    for (std::size_t n = 0; n < shown.hits.size(); ++n) {
      const Hit& hit = shown.hits[n];
      const Contact ring{layout.at(hit.contact), false, false, color};
      marks.add_arc(nth(ItemId::hits, n), hit.age_s, ring, items);
    }
  };
  return {add, needs};
}

}  // namespace piblocks
