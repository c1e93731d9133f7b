#include "draw/finite.hpp"

#include <algorithm>
#include <cmath>

namespace piblocks {
namespace {

bool is_finite(const Point& point) { return std::isfinite(point.x) && std::isfinite(point.y); }
bool is_finite(const Rectangle& r) {
  return std::isfinite(r.x) && std::isfinite(r.y) && std::isfinite(r.width) &&
         std::isfinite(r.height);
}

struct IsFinite {
  bool operator()(const RectangleItem& item) const { return is_finite(item.bounds); }
  bool operator()(const TextItem& item) const {
    return is_finite(item.origin) && std::isfinite(item.size_px);
  }
  bool operator()(const PathItem& item) const {
    return std::ranges::all_of(item.points.view(),
                               [](const Point& point) { return is_finite(point); });
  }
  bool operator()(const DiskItem& item) const {
    return is_finite(item.centre) && std::isfinite(item.radius);
  }
  bool operator()(const ImageItem& item) const { return is_finite(item.bounds); }
  bool operator()(const PlateItem& item) const { return is_finite(item.bounds); }
  bool operator()(const GroupItem& item) const { return std::isfinite(item.opacity); }
  bool operator()(const ExposedItem& item) const {
    return is_finite(item.behind.bounds) && is_finite(item.front.bounds);
  }
};

}  // namespace

bool is_finite(const DrawItem& item) { return std::visit(IsFinite{}, item); }

bool are_finite(std::span<const DrawItem> items) {
  return std::ranges::all_of(items, [](const DrawItem& item) { return is_finite(item); });
}

}  // namespace piblocks
