#include "draw/disc_exposure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "draw/extent.hpp"

namespace piblocks {

std::optional<DiscExposure::Moments> DiscExposure::Pass::within(const Point& place,
                                                                double distance) const {
  const Point at{place.x - from.x, place.y - from.y};
  const double length2 = step.x * step.x + step.y * step.y;
  const double out2 = at.x * at.x + at.y * at.y - distance * distance;
  if (length2 == 0) {
    if (out2 >= 0) return std::nullopt;
    return Moments{begin, begin + share};
  }
  // |at - t step|² = distance²
  const double middle = at.x * step.x + at.y * step.y;
  const double discriminant = middle * middle - length2 * out2;
  if (discriminant <= 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double enters = std::clamp((middle - root) / length2, 0.0, 1.0);
  const double leaves = std::clamp((middle + root) / length2, 0.0, 1.0);
  if (enters >= leaves) return std::nullopt;
  return Moments{begin + enters * share, begin + leaves * share};
}

bool DiscExposure::Pass::is_all_within(const Point& place, double distance) const {
  const Point at{place.x - from.x, place.y - from.y};
  const Point end{at.x - step.x, at.y - step.y};
  return std::max(at.x * at.x + at.y * at.y, end.x * end.x + end.y * end.y) < distance * distance;
}

double DiscExposure::Pass::distance_to(const Point& place, int part) const {
  const double at = (part + 0.5) / places;
  const Point to{place.x - from.x - at * step.x, place.y - from.y - at * step.y};
  return std::sqrt(to.x * to.x + to.y * to.y);
}

Extent DiscExposure::Pass::beside(double y, double distance) const {
  double enters = 0;
  double leaves = 1;
  if (step.y != 0) {
    const double below = (y - distance - from.y) / step.y;
    const double above = (y + distance - from.y) / step.y;
    enters = std::clamp(std::min(below, above), 0.0, 1.0);
    leaves = std::clamp(std::max(below, above), 0.0, 1.0);
  }
  const double one = from.x + enters * step.x;
  const double other = from.x + leaves * step.x;
  return {std::min(one, other) - distance, y, std::max(one, other) + distance, y};
}

void DiscExposure::begin(const ExposedDiscsItem& item, const PixelRect& area) {
  area_ = area;
  looks_.clear();
  passes_.clear();
  for (std::size_t i = 0; i < item.discs.size(); ++i) add(item.discs[i], i);
  starts_.resize(passes_.size());
  std::iota(starts_.begin(), starts_.end(), 0U);
  std::ranges::stable_sort(starts_, {}, [&](std::uint32_t i) { return passes_[i].pixels.y_px; });
  next_start_ = 0;
  active_.clear();
}

void DiscExposure::paint_row(int y, std::uint32_t* pixels, const Light& light) {
  light_ = &light;
  std::erase_if(active_, [&](std::uint32_t i) {
    return y >= passes_[i].pixels.y_px + passes_[i].pixels.height_px;
  });
  for (; next_start_ < starts_.size(); ++next_start_) {
    const std::uint32_t i = starts_[next_start_];
    if (passes_[i].pixels.y_px > y) break;
    active_.push_back(i);
  }
  const int end = area_.x_px + area_.width_px;
  for (int x = area_.x_px; x < end; x += kColumns) {
    paint_columns({x, y, std::min(kColumns, end - x), 1}, pixels + (x - area_.x_px));
  }
}

void DiscExposure::paint_columns(const PixelRect& columns, std::uint32_t* pixels) {
  visits_.clear();
  first_.fill(kNone);
  for (const std::uint32_t pass : active_) visit(pass, columns);
  if (visits_.empty()) return;
  for (int x = 0; x < columns.width_px; ++x) {
    const std::uint32_t first = first_.at(static_cast<std::size_t>(x));
    if (first == kNone) continue;
    const Point at{columns.x_px + x + 0.5, columns.y_px + 0.5};
    pixels[x] = (pixels[x] & 0xFF000000U) | mean_of(first, at, pixels[x]);
  }
}

void DiscExposure::add(const ExposedDisc& disc, std::size_t place) {
  // Steps of an edge are seen in a disc that hardly moves. Places on a short path have none.
  constexpr double kShort_px = 1;
  constexpr double kPlacesPerPixel = 8;
  const Extent extent = extent_of(disc);
  if (extent.left >= area_.x_px + area_.width_px || extent.right <= area_.x_px ||
      extent.top >= area_.y_px + area_.height_px || extent.bottom <= area_.y_px) {
    return;
  }
  const auto look = static_cast<std::uint32_t>(looks_.size());
  looks_.emplace_back(disc, place);
  const double reach = looks_.back().rings().front().radius + kSoftEdge_px;
  double begin = 0;
  for (const DiscPath& path : disc.paths) {
    const Point step{path.to.x - path.from.x, path.to.y - path.from.y};
    const auto [left, right] = std::minmax(path.from.x, path.to.x);
    const auto [top, bottom] = std::minmax(path.from.y, path.to.y);
    const PixelRect pixels = pixels_of(Extent{left, top, right, bottom}.grown(reach), area_);
    if (pixels.width_px > 0 && pixels.height_px > 0 && path.share > 0) {
      const double way_px = std::sqrt(step.x * step.x + step.y * step.y);
      const bool is_short = way_px <= kShort_px;
      const int places =
          is_short ? std::max(1, static_cast<int>(std::ceil(kPlacesPerPixel * way_px))) : 0;
      passes_.push_back({look, path.from, step, begin, path.share, places, pixels});
    }
    begin += path.share;
  }
}

void DiscExposure::visit(std::uint32_t number, const PixelRect& columns) {
  const Pass& pass = passes_[number];
  if (pass.pixels.x_px >= columns.x_px + columns.width_px ||
      pass.pixels.x_px + pass.pixels.width_px <= columns.x_px) {
    return;
  }
  const int y = columns.y_px;
  const std::span<const Ring> rings = looks_[pass.look].rings();
  // A short path is looked at without steps: its edge reaches half a step farther, on both sides.
  const double step = pass.places > 0 ? kSoftEdge_px / kEdgeSteps : 0;
  const double outside = rings.front().radius + step;
  const double inside = rings.back().radius - step;
  Extent beside = pass.beside(y + 0.5, outside);
  beside.bottom = y + 1;
  const PixelRect row = pixels_of(beside.grown(kRounding_px), columns);
  for (int x = row.x_px; x < row.x_px + row.width_px; ++x) {
    const Point pixel{x + 0.5, y + 0.5};
    Visit visit{number,
                kNone,
                inside > 0 && pass.is_all_within(pixel, inside),
                {pass.begin, pass.begin + pass.share}};
    if (!visit.is_inside) {
      const std::optional<Moments> moments = pass.within(pixel, outside);
      if (!moments) continue;
      if (pass.places == 0) visit.moments = *moments;
    }
    std::uint32_t& first = first_.at(static_cast<std::size_t>(x - columns.x_px));
    visit.next = first;
    first = static_cast<std::uint32_t>(visits_.size());
    visits_.push_back(visit);
  }
}

std::uint32_t DiscExposure::mean_of(std::uint32_t first, const Point& at, std::uint32_t pixel) {
  const std::uint32_t background = pixel & 0xFFFFFFU;
  const Rgb samples = samples_of(background);
  sum_ = plain_ = light_of(samples, *light_);
  together_.clear();
  for (std::uint32_t i = first; i != kNone; i = visits_[i].next) together_.push_back(visits_[i]);
  // By time, and by disc where the time is the same: whatever the area is.
  std::ranges::sort(together_, [&](const Visit& a, const Visit& b) {
    if (a.moments.begin != b.moments.begin) return a.moments.begin < b.moments.begin;
    return a.pass < b.pass;
  });
  for (std::size_t begin = 0; begin < together_.size();) {
    double until = together_[begin].moments.end;
    std::size_t end = begin + 1;
    for (; end < together_.size() && together_[end].moments.begin < until; ++end) {
      until = std::max(until, together_[end].moments.end);
    }
    const std::span<const Visit> visits(together_.data() + begin, end - begin);
    if (visits.size() == 1) {
      add_alone(visits.front(), at, background);
    } else {
      add_together(visits, at, samples);
    }
    begin = end;
  }
  return std::uint32_t{light_->sample(sum_[0])} << 16 |
         std::uint32_t{light_->sample(sum_[1])} << 8 | light_->sample(sum_[2]);
}

void DiscExposure::add_light(double share, const Rgb& light) {
  for (std::size_t i = 0; i < 3; ++i) sum_[i] += share * (light[i] - plain_[i]);
}

void DiscExposure::add_alone(const Visit& visit, const Point& at, std::uint32_t background) {
  const Pass& pass = passes_[visit.pass];
  DiscLook& look = looks_[pass.look];
  const std::span<const Ring> rings = look.rings();
  const std::span<const Rgb> lights = look.lights(background, *light_);
  if (visit.is_inside) return add_light(pass.share, lights.back());
  for (int part = 0; part < pass.places; ++part) {
    const DiscCover cover = look.cover_at(pass.distance_to(at, part));
    add_light(pass.share / pass.places,
              light_of(look.over(samples_of(background), cover), *light_));
  }
  if (pass.places > 0) return;
  double share = visit.moments.end - visit.moments.begin;
  for (std::size_t ring = 0; ring < rings.size() && share > 0; ++ring) {
    const std::optional<Moments> inner =
        ring + 1 < rings.size() ? pass.within(at, rings[ring + 1].radius) : std::nullopt;
    const double next = inner ? inner->end - inner->begin : 0;
    add_light(share - next, lights[ring]);
    share = next;
  }
}

void DiscExposure::add_crossings(std::uint32_t number, const Visit& visit, const Point& at) {
  const Pass& pass = passes_[visit.pass];
  const DiscLook& look = looks_[pass.look];
  const std::span<const Ring> rings = look.rings();
  if (visit.is_inside || pass.places > 0) {
    const double length = visit.moments.end - visit.moments.begin;
    const int parts = visit.is_inside ? 1 : pass.places;
    for (int part = 0; part < parts; ++part) {
      const DiscCover cover =
          visit.is_inside ? rings.back().cover : look.cover_at(pass.distance_to(at, part));
      const double time = visit.moments.begin + length * part / parts;
      crossings_.push_back({time, number, false, part, cover});
    }
    crossings_.push_back({visit.moments.end, number, true, -1, {}});
    return;
  }
  DiscCover outside;
  for (std::int32_t ring = 0; ring < static_cast<std::int32_t>(rings.size()); ++ring) {
    const auto& [radius, cover] = rings[static_cast<std::size_t>(ring)];
    const std::optional<Moments> within = pass.within(at, radius);
    if (!within) break;
    crossings_.push_back({within->begin, number, false, ring, cover});
    crossings_.push_back({within->end, number, true, ring - 1, outside});
    outside = cover;
  }
}

void DiscExposure::add_together(std::span<const Visit> visits, const Point& at,
                                const Rgb& background) {
  crossings_.clear();
  for (std::size_t i = 0; i < visits.size(); ++i) {
    add_crossings(static_cast<std::uint32_t>(i), visits[i], at);
  }
  // At one time a disc first enters from ring to ring, then leaves the other way.
  std::ranges::sort(crossings_, [](const Crossing& a, const Crossing& b) {
    if (a.time != b.time) return a.time < b.time;
    if (a.visit != b.visit) return a.visit < b.visit;
    if (a.leaves != b.leaves) return b.leaves;
    return a.leaves ? a.to > b.to : a.to < b.to;
  });
  present_.clear();
  for (std::size_t i = 0; i < crossings_.size(); ++i) {
    const Crossing& crossing = crossings_[i];
    move(visits, crossing);
    const double until = i + 1 < crossings_.size() ? crossings_[i + 1].time : crossing.time;
    if (until > crossing.time) add_present(until - crossing.time, visits, background);
  }
}

void DiscExposure::move(std::span<const Visit> visits, const Crossing& crossing) {
  const auto place = [&](const Crossing& of) {
    return looks_[passes_[visits[of.visit].pass].look].place();
  };
  const auto found = std::ranges::find(present_, crossing.visit, &Crossing::visit);
  if (found != present_.end()) {
    if (crossing.to < 0) {
      present_.erase(found);
    } else {
      *found = crossing;
    }
  } else if (crossing.to >= 0) {
    present_.insert(std::ranges::upper_bound(present_, place(crossing), {}, place), crossing);
  }
}

void DiscExposure::add_present(double share, std::span<const Visit> visits, const Rgb& background) {
  Rgb samples = background;
  for (const Crossing& present : present_) {
    const DiscLook& look = looks_[passes_[visits[present.visit].pass].look];
    samples = look.over(samples, present.cover);
  }
  add_light(share, light_of(samples, *light_));
}

}  // namespace piblocks
