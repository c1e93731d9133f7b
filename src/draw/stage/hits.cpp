#include "draw/stage/hits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

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
constexpr int kDirections = 13;
/// An arc flashes in so many frames.
constexpr double kFlash_frames = 2;
constexpr double kNegligible_frames = 1e-6;
/// Ids of a hit: of its arc, and of an edge on either side.
constexpr std::size_t kIdsOfHit = 3;
/// The greatest opacity of a glow, and its radius in parts of an arc's final radius.
constexpr double kGlowAlpha = 0.85;
constexpr double kGlowReach = 1;
/// The strength of a glow goes from the least one at kMaxHitsPerSecond towards 1. It is half-way
/// when the rate has doubled so many times.
constexpr double kLeastGlow = 0.55;
constexpr double kHalfGlow = 6;
/// Strengths that are told apart, from kLeastGlow to 1. While the rate hardly changes, a glow keeps
/// its pixels.
constexpr int kGlows = 38;

/// Which of the kGlows strengths the rate has, from 0, the weakest.
int glow_of(double hits_per_s) {
  const double doublings = straight_log2(hits_per_s / kMaxHitsPerSecond);
  return static_cast<int>(std::lround((kGlows - 1) * doublings / (doublings + kHalfGlow)));
}

double opacity_of_glow(int glow) {
  return kGlowAlpha * (kLeastGlow + (1 - kLeastGlow) * glow / (kGlows - 1));
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
  return colors[is_immovable(system, second) ? first : second].line;
}

HitMarks::HitMarks(const DrawingContext& context, double most_reach_px, double most_glow_px)
    : reach_px_(std::min(most_reach_px, style::kHitReach * context.sizes.short_side)),
      glow_px_(std::ceil(std::min(kGlowReach * reach_px_, most_glow_px))),
      line_px_(context.sizes.wall_line),
      corner_px_(context.layout.corner_px),
      frames_per_s_(to_double(context.scene.view.frame_rate)),
      flash_(context.palette.text) {}

bool HitMarks::is_flash(double age_s) const {
  return age_s * frames_per_s_ < kFlash_frames - kNegligible_frames;
}

void HitMarks::add_arc(std::size_t n, double age_s, const Contact& contact,
                       std::vector<DrawItem>& items) const {
  const bool is_ring = !contact.is_left_free && !contact.is_right_free;
  const double left = 1 - age_s / kHitLife_s;  // of its life
  const double radius = (is_ring ? kRing : 1) * reach_px_ * (1 - (1 - kFirstRadius) * left * left);
  constexpr double kUp = std::numbers::pi / 2;
  const double from = is_ring || contact.is_right_free ? 0 : kUp;
  const double to = is_ring ? 4 * kUp : contact.is_left_free ? 2 * kUp : kUp;
  std::vector<Point> arc = Circle{contact.at, radius}.arc(from, to, kDirections - 1);
  arc.pop_back();
  if (!is_ring) arc.erase(arc.begin());
  const Color color = is_flash(age_s) ? flash_ : faded(contact.color, left);
  items.emplace_back(PathItem{nth(ItemId::hits, kIdsOfHit * n), std::move(arc), is_ring,
                              std::nullopt, Stroke{color, line_px_}});
}

void HitMarks::add_edges(std::size_t n, double age_s, const std::optional<Rect>& left,
                         const std::optional<Rect>& right, std::vector<DrawItem>& items) const {
  if (!is_flash(age_s)) return;
  const auto add = [&](std::size_t side, double x, const Rect& block) {
    items.emplace_back(RectangleItem{
        nth(ItemId::hits, kIdsOfHit * n + side),
        {x, block.y + corner_px_, line_px_, std::max(0.0, block.height - 2 * corner_px_)},
        flash_});
  };
  if (left) add(1, left->right() - line_px_, *left);
  if (right) add(2, right->x, *right);
}

void HitMarks::add_glow(double hits_per_s, std::span<const Contact> contacts,
                        std::vector<DrawItem>& items) const {
  if (hits_per_s <= kMaxHitsPerSecond) return;
  const double opacity = opacity_of_glow(glow_of(hits_per_s));
  std::size_t n = 0;
  for (const Contact& contact : contacts) {
    const double left = contact.is_left_free ? glow_px_ : 0;
    const double right = contact.is_right_free ? glow_px_ : 0;
    const GlowItem glow{ItemId::hits,
                        {-left, -glow_px_, left + right, glow_px_},
                        {},
                        glow_px_,
                        faded(contact.color, opacity)};
    const Point at{std::round(contact.at.x), std::round(contact.at.y)};
    // Its pixels are kept.
    items.emplace_back(PlateItem{nth(ItemId::hits, n++), glow.bounds + at,
                                 std::make_shared<const Plate>(Plate{{glow}}), at});
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
      const auto [left, right] = from_left(hit.pair, shown);
      const Contact contact = contact_at(hit.pair, layout_.at(hit.contact).x, shown);
      marks_.add_arc(n, hit.age_s, contact, items);
      marks_.add_edges(n, hit.age_s, block_at(left, shown), block_at(right, shown), items);
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

  MetPair from_left(const MetPair& pair, const FrameState& shown) const {
    const auto [first, second] = pair;
    if (position(first, shown) < position(second, shown)) return pair;
    return {second, first};
  }

  std::optional<Rect> block_at(std::size_t id, const FrameState& shown) const {
    return is_wall(id) ? std::nullopt : std::optional(layout_.at(id, shown));
  }

  Contact contact_at(const MetPair& pair, double x_px, const FrameState& shown) const {
    const auto [left, right] = from_left(pair, shown);
    return contact_of(x_px, layout_.floor_px, height_px(left), height_px(right),
                      color_of_hit(pair, system_, colors_));
  }

  double present_x_px(const MetPair& pair, const FrameState& shown) const {
    const std::size_t second = pair[1];
    if (is_wall(second)) {
      const Wall& wall = system_.walls[second - colors_.size()];
      return layout_.at(to_double(Rational(wall.point[0] + wall.velocity[0] * shown.time)), 0).x;
    }
    return layout_.at(from_left(pair, shown)[1], shown).x;
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
      marks.add_arc(n, hit.age_s, ring, items);
    }
  };
  return {add, needs};
}

}  // namespace piblocks
