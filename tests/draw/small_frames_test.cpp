// Frames of every size and shape: what a scene shows is either drawn inside the frame or refused by
// its name.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "draw/composed_pictures.hpp"

namespace piblocks {
namespace {

struct Feature {
  const char* key;
  const char* text;
  const char* named;  ///< in a refusal
};

constexpr std::array kFeatures{Feature{"view.theme", "print", "count"},
                               Feature{"show.overlays", "digits", "-"},
                               Feature{"show.overlays", "masses", "mass"},
                               Feature{"show.overlays", "velocities", "velocities"},
                               Feature{"show.overlays", "ruler", "ruler"},
                               Feature{"show.overlays", "time", "'time'"},
                               Feature{"show.overlays", "energy", "'energy'"},
                               Feature{"show.overlays", "momentum", "'momentum'"},
                               Feature{"time.slow-motion", "3:4:10", "slow motion"},
                               Feature{"show.title", "fi", "title"},
                               Feature{"show.caption", "fi", "caption"},
                               Feature{"show.panels", "velocity", "show.panels"},
                               Feature{"show.panels", "position", "show.panels"},
                               Feature{"show.panels", "unfolded", "show.panels"},
                               Feature{"show.panels", "time", "show.panels"},
                               Feature{"show.panels", "count", "show.panels"},
                               Feature{"show.panels", "conservation", "show.panels"},
                               Feature{"show.panels", "certainty", "show.panels"},
                               Feature{"show.logo", "logo.png", "logo"}};

/// Rounding of sums of lengths.
constexpr double kSlack_px = 1e-6;

class Checker {
 public:
  explicit Checker(const DrawList& list) : list_(list) {}

  void check(const std::vector<DrawItem>& items) {
    for (const DrawItem& item : items) {
      std::visit([&](const auto& any) { check_item(any); }, item);
    }
  }

  std::string problem;

 private:
  void check_inside(const Rect& r, const std::string& what) {
    if (!whole_of(list_).grown(kSlack_px).holds(r)) problem += what + " leaves the frame; ";
  }
  void check_item(const RectangleItem& item) {
    const Rect& r = item.bounds;
    if (!(r.width >= 0 && r.height >= 0)) problem += "a rectangle of negative size; ";
    if (item.id == ItemId::wall) check_inside(r, "the wall");
    if (item.stroke && !(item.stroke->width_px > 0)) problem += "a line without width; ";
  }
  void check_item(const TextItem& item) {
    if (!(item.size_px > 0) || !std::isfinite(item.size_px))
      problem += item.text + " has no size; ";
    const double width_px = fonts_.of(item.face).width_em(item.text) * item.size_px;
    const double height_px = 0.73 * item.size_px;
    check_inside({item.origin.x, item.origin.y - height_px, width_px, height_px}, item.text);
  }
  void check_item(const PathItem& item) {
    if (item.id == ItemId::wall) check_inside(item.points.bounds(), "the wall");
    if (item.stroke && !(item.stroke->width_px > 0)) problem += "a line without width; ";
    check_inside(item.points.bounds(), "a path");
  }
  void check_item(const DiscItem& item) {
    if (!(item.radius > 0)) problem += "a dot without a radius; ";
    check_inside({item.centre.x, item.centre.y, 0, 0}, "a dot");
  }
  void check_item(const GlowItem& item) {
    if (!(item.radius > 0)) problem += "a glow without a radius; ";
  }
  void check_item(const ImageItem& item) {
    const Rect& r = item.bounds;
    if (!(r.width > 0 && r.height > 0)) problem += "a picture without size; ";
    check_inside(r, "a picture");
  }
  void check_item(const PlateItem& item) { check(item.plate->items); }
  void check_item(const GroupItem& /*item*/) {}
  void check_item(const ExposedBlocksItem& /*item*/) {}
  void check_item(const MovingShapesItem& /*item*/) {}

  const DrawList& list_;
  Fonts fonts_;
};

/// Nothing if the feature is drawn or refused as it should be.
std::string problem_with(const Feature& feature, int width_px, int height_px, bool& is_drawn) {
  const std::string size = std::to_string(width_px) + "x" + std::to_string(height_px);
  const Scene scene = scene_with(2, {{"view.size", size}, {feature.key, feature.text}});
  const auto log = make_pair_log(scene.system);
  const auto logo = std::make_shared<const Image>(Image{3, 2, std::vector<std::uint32_t>(6)});
  try {
    const Composition composition(scene, *log, scene.show.logo.empty() ? nullptr : logo);
    const Rational time(7, 2);
    const DrawList list = composition.frame({log->state_at(time), time, 10});
    Checker checker(list);
    checker.check(list.items);
    is_drawn = true;
    return checker.problem;
  } catch (const UsageError& error) {
    const std::string what = error.what();
    if (what.find('\n') != what.npos) return "more than one line: " + what;
    return what.find(feature.named) == what.npos ? "nameless refusal: " + what : "";
  }
}

void expect_all(const std::vector<int>& widths, const std::vector<int>& heights) {
  for (const Feature& feature : kFeatures) {
    for (const int width : widths) {
      for (const int height : heights) {
        bool is_drawn = false;
        EXPECT_EQ(problem_with(feature, width, height, is_drawn), "")
            << feature.text << " in " << width << 'x' << height;
      }
    }
  }
}

TEST(SmallFrames, ShowOrRefuse) {
  const std::vector<int> sides{1, 2, 3, 4, 7, 8, 11, 12, 13, 16, 21, 27, 32, 41, 53, 64};
  expect_all(sides, sides);
}

TEST(SmallFrames, ThinFramesShowOrRefuse) {
  const std::vector<int> thin{1, 2, 8, 12, 30, 90, 120, 150};
  const std::vector<int> longest{1000, 4000, 16000};
  expect_all(thin, longest);
  expect_all(longest, thin);
}

TEST(SmallFrames, EverythingIsDrawnWhereThereIsRoom) {
  for (const Feature& feature : kFeatures) {
    for (const auto& [width, height] : {std::pair{640, 360}, {360, 640}, {1600, 400}}) {
      bool is_drawn = false;
      EXPECT_EQ(problem_with(feature, width, height, is_drawn), "");
      EXPECT_TRUE(is_drawn) << feature.text << " in " << width << 'x' << height;
    }
  }
}

}  // namespace
}  // namespace piblocks
