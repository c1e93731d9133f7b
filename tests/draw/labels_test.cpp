// What is written and drawn beside the blocks keeps clear of them, of the wall and of each other.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "draw/composition.hpp"
#include "draw/font.hpp"
#include "draw/look.hpp"
#include "support/state_after.hpp"

namespace piblocks {
namespace {

using Settings = std::vector<std::pair<const char*, std::string>>;

class Labels {
 public:
  Labels(int digits, const Settings& settings)
      : scene_(scene_with(digits, settings)),
        log_(make_pair_log(scene_.system)),
        composition_(scene_, *log_) {}

  DrawList at(const Rational& time) const {
    return composition_.frame({log_->state_at(time), time});
  }
  DrawList after(int count) const { return composition_.frame({bodies_after(*log_, count)}); }

 private:
  static Scene scene_with(int digits, const Settings& settings) {
    ScriptBuilder builder;
    builder.set("test", "digits", std::to_string(digits));
    for (const auto& [key, text] : settings) builder.set("test", key, text);
    return builder.build_scene();
  }

  Scene scene_;
  std::unique_ptr<PairLog> log_;
  Composition composition_;
};

bool shows(ItemId item, ItemId thing) {
  return static_cast<std::uint32_t>(item) >> 16 == static_cast<std::uint32_t>(thing) >> 16;
}

std::vector<TextItem> texts_of(const DrawList& list, ItemId thing) {
  std::vector<TextItem> texts;
  for (const DrawItem& item : list.items) {
    const auto* text = std::get_if<TextItem>(&item);
    if (text != nullptr && shows(text->id, thing)) texts.push_back(*text);
  }
  return texts;
}

double right_of_wall(const DrawList& list) {
  const Rect& wall = std::get<RectangleItem>(list.items.front()).bounds;
  return wall.right();
}

/// From the leftmost to the rightmost point of an arrow; the wrong way round if none is drawn.
std::pair<double, double> reach_of_arrow(const DrawList& list, std::size_t n) {
  std::pair<double, double> reach{1e9, -1e9};
  for (const DrawItem& item : list.items) {
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr ||
        (path->id != nth(ItemId::velocities, n) && path->id != nth(ItemId::velocities, n + 1))) {
      continue;
    }
    const Rect& bounds = path->points.bounds();
    reach = {std::min(reach.first, bounds.x), std::max(reach.second, bounds.right())};
  }
  return reach;
}

TEST(Labels, ArrowsOfVelocitiesNeverMeet) {
  for (const char* width : {"1/2", "1", "3/2"}) {
    const Labels labels(3, {{"show.overlays", "velocities"}, {"red.width", width}});
    int pairs = 0;
    for (int count = 1; count <= 314; ++count) {
      const DrawList list = labels.after(count);
      const auto red = reach_of_arrow(list, 0);
      const auto blue = reach_of_arrow(list, 4);
      EXPECT_LT(blue.second, red.first) << count;
      pairs += blue.second > 0 && red.second > 0 ? 1 : 0;
    }
    EXPECT_GT(pairs, 200);
  }
}

TEST(Labels, FiguresOfVelocitiesMeetNeitherEachOtherNorTheWall) {
  const Font font;
  for (const int digits : {3, 9, 20}) {
    for (const char* size : {"1920x1080", "640x360", "450x800"}) {
      const Labels labels(digits, {{"show.overlays", "velocities"}, {"view.size", size}});
      const DrawList list = labels.at(Rational(7, 2));
      const std::vector<TextItem> figures = texts_of(list, ItemId::velocities);
      ASSERT_EQ(figures.size(), 2U);
      const TextItem& blue = figures[1];
      EXPECT_GT(blue.origin.x, right_of_wall(list));
      EXPECT_LT(blue.origin.x + font.width_em(blue.text) * blue.size_px, figures[0].origin.x);
    }
  }
}

/// From the left of the first to the right of the last figure, and around the line.
Rect bounds_of(const TextItem& text, const Fonts& fonts) {
  return {text.origin.x, text.origin.y - text.size_px,
          fonts.of(text.face).width_em(text.text) * text.size_px, 1.2 * text.size_px};
}

/// A mass is whole in the frame: on its block, or clear of it.
void expect_mass_of(const DrawList& list, ItemId thing, std::size_t n, const Fonts& fonts) {
  std::optional<Rect> block;
  for (const DrawItem& item : list.items) {
    const auto* rectangle = std::get_if<RectangleItem>(&item);
    if (rectangle != nullptr && rectangle->id == thing) block = rectangle->bounds;
  }
  ASSERT_TRUE(block);
  const double seen =
      std::min(double(list.width_px), block->x + block->width) - std::max(0.0, block->x);
  if (seen < 1) return;
  std::optional<TextItem> mass;
  for (const TextItem& text : texts_of(list, ItemId::masses)) {
    if (text.id == nth(ItemId::masses, n)) mass = text;
  }
  ASSERT_TRUE(mass) << "the mass is gone, and " << seen << " pixels of its block are seen";
  const Rect text = bounds_of(*mass, fonts);
  EXPECT_GE(text.x, 0);
  EXPECT_LE(text.right(), list.width_px);
  const bool is_on =
      text.x >= block->x && text.right() <= block->x + block->width && text.y > block->y - 1;
  const bool is_above = mass->origin.y < block->y;
  const bool is_beside = text.right() <= block->x || text.x >= block->x + block->width;
  EXPECT_TRUE(is_on || is_above || is_beside) << text.x << " on " << block->x;
}

TEST(Labels, AMassStaysWhileItsBlockIsInSight) {
  const Fonts fonts;
  int pictures = 0;
  for (const char* theme : {"lecture", "lecture-light", "article"}) {
    for (const char* size : {"1280x720", "1080x1920", "720x720"}) {
      for (const Settings& more : std::vector<Settings>{
               {},
               {{"red.width", "by-mass"}, {"show.panels", "velocity"}},
               {{"view.x", "1.7:8"}, {"blue.position", "3"}, {"red.position", "6"}},
               {{"red.mass", "1/100"}, {"blue.velocity", "1"}, {"red.position", "9"}},
               {{"red.mass", "1"}, {"blue.velocity", "2"}}}) {
        SCOPED_TRACE(std::string(theme) + " " + size + (more.empty() ? "" : more.front().second));
        Settings all = {{"show.overlays", "masses"}, {"view.theme", theme}, {"view.size", size}};
        all.insert(all.end(), more.begin(), more.end());
        std::optional<Labels> labels;
        try {
          labels.emplace(2, all);
        } catch (const UsageError&) {  // no room
          continue;
        }
        for (Rational time = 0; time < 20; time += Rational(1, 8)) {
          SCOPED_TRACE(time.get_str());
          const DrawList list = labels->at(time);
          expect_mass_of(list, ItemId::red_block, 0, fonts);
          expect_mass_of(list, ItemId::blue_block, 1, fonts);
          if (HasFailure()) return;
          ++pictures;
        }
      }
    }
  }
  EXPECT_GT(pictures, 3000);
}

/// Half a figure, at the frame's edge, is another number.
TEST(Labels, FiguresOfVelocitiesAreWholeAndOfBlocksInTheFrame) {
  const Font font;
  const auto expect_whole = [&](const Range& view, const char* red_position, std::size_t count) {
    ScriptBuilder builder;
    builder.set("test", "show.overlays", "velocities");
    builder.set("test", "view.size", "640x360");
    builder.set("test", "blue.velocity", "-7654321");
    builder.set("test", "red.velocity", "-1234567");
    builder.set("test", "red.position", red_position);
    Scene scene = builder.build_scene();
    scene.view.x = view;
    const auto log = make_pair_log(scene.system);
    const std::vector<TextItem> figures =
        texts_of(Composition(scene, *log).frame({log->state_at(0)}), ItemId::velocities);
    EXPECT_EQ(figures.size(), count) << red_position;
    for (const TextItem& figure : figures) {
      EXPECT_GE(figure.origin.x, 0) << red_position;
      EXPECT_LE(figure.origin.x + font.width_em(figure.text) * figure.size_px, 640) << red_position;
    }
    if (count == 2) {
      EXPECT_LT(figures[1].origin.x + font.width_em(figures[1].text) * figures[1].size_px,
                figures[0].origin.x)
          << red_position;
    }
  };
  for (const char* position : {"5", "5.6", "5.9", "6.2", "6.45", "6.6"}) {
    expect_whole({-1, 6}, position, 2);
  }
  expect_whole({-1, 6}, "100", 1);
  expect_whole({-1, Rational(34, 10)}, "3.1", 2);
  expect_whole({2, 9}, "5", 2);
  expect_whole({4, 9}, "5", 1);
  expect_whole({1000, 1010}, "5", 0);
}

/// Straight lines of two points, also those of diagrams.
void add_lines(const std::vector<DrawItem>& items, std::vector<std::pair<Point, Point>>& lines) {
  for (const DrawItem& item : items) {
    if (const auto* plate = std::get_if<PlateItem>(&item)) add_lines(plate->plate->items, lines);
    const auto* path = std::get_if<PathItem>(&item);
    if (path == nullptr || path->points.view().size() != 2) continue;
    lines.emplace_back(path->points.view()[0], path->points.view()[1]);
  }
}

std::vector<std::pair<Point, Point>> lines_of(const DrawList& list) {
  std::vector<std::pair<Point, Point>> lines;
  add_lines(list.items, lines);
  return lines;
}

bool has_upright_line_at(const DrawList& list, double x) {
  return std::ranges::any_of(lines_of(list), [x](const auto& line) {
    return line.first.x == line.second.x && std::abs(line.first.x - x) < 1e-6;
  });
}

bool has_level_line_at(const DrawList& list, double y) {
  return std::ranges::any_of(lines_of(list), [y](const auto& line) {
    return line.first.y == line.second.y && std::abs(line.first.y - y) < 1e-6;
  });
}

TEST(Labels, FiguresOfTheRulerStandBelowTheirMarks) {
  const Font font;
  for (const char* size : {"640x360", "480x360", "1080x1920", "3840x2160", "1600x300"}) {
    const Labels labels(3, {{"show.overlays", "ruler"}, {"view.size", size}});
    const DrawList list = labels.at(0);
    const Rect& wall = std::get<RectangleItem>(list.items.front()).bounds;
    const std::vector<TextItem> figures = texts_of(list, ItemId::ruler);
    EXPECT_GT(figures.size(), 3U);
    for (const TextItem& figure : figures) {
      const double width_px = font.width_em(figure.text) * figure.size_px;
      EXPECT_TRUE(has_upright_line_at(list, figure.origin.x + width_px / 2))
          << figure.text << " in " << size;
      EXPECT_TRUE(figure.origin.x > wall.right() ||
                  figure.origin.y - 0.73 * figure.size_px > wall.bottom())
          << figure.text << " meets the wall in " << size;
      EXPECT_LT(figure.origin.x + width_px, list.width_px) << figure.text;
      EXPECT_LT(figure.origin.y, list.height_px) << figure.text;
    }
  }
}

/// Texts of a diagram that are numbers, without their exponents.
std::vector<TextItem> figures_of_diagram(const DrawList& list) {
  std::vector<TextItem> figures;
  for (const DrawItem& item : list.items) {
    const auto* plate = std::get_if<PlateItem>(&item);
    if (plate == nullptr) continue;
    for (const DrawItem& inner : plate->plate->items) {
      const auto* text = std::get_if<TextItem>(&inner);
      if (text == nullptr) continue;
      const bool is_number = text->text.find_first_of("0123456789") < 4;
      const bool is_raised = !figures.empty() && text->size_px < 0.9 * figures.front().size_px;
      if (is_number && !is_raised) figures.push_back(*text);
    }
  }
  return figures;
}

TEST(Labels, FiguresOfDiagramsAreCentredOnTheirMarks) {
  const Font font;
  int across = 0;
  int upright = 0;
  for (const char* panel : {"time", "count"}) {
    for (const int digits : {1, 3, 9, 60}) {
      for (const char* end : {"3", "4", "9.99", "10", "20000", "1e9", "1e-7"}) {
        const Labels labels(digits, {{"show.panels", panel},
                                     {"view.size", "640x360"},
                                     {"time.from", "0"},
                                     {"time.to", end}});
        const DrawList list = labels.at(0);
        for (const TextItem& figure : figures_of_diagram(list)) {
          const double width_px = font.width_em(figure.text) * figure.size_px;
          const bool is_below = has_upright_line_at(list, figure.origin.x + width_px / 2);
          const bool is_beside = has_level_line_at(list, figure.origin.y - 0.365 * figure.size_px);
          EXPECT_TRUE(is_below || is_beside) << figure.text << " to " << end;
          EXPECT_GE(figure.origin.x, 0);
          EXPECT_LE(figure.origin.x + width_px, 640);
          (is_below ? across : upright) += 1;
        }
      }
    }
  }
  EXPECT_GT(across, 100);
  EXPECT_GT(upright, 50);
}

TEST(Labels, TitlesOfNarrowDiagramsAreBriefRatherThanSmall) {
  const Fonts fonts;
  std::vector<double> lengths_em;
  for (const char* size : {"1920x1080", "1440x1080", "1080x1080", "480x360"}) {
    const Labels labels(6, {{"view.size", size}, {"show.panels", "velocity,position"}});
    const DrawList list = labels.at(4);
    double& length_em = lengths_em.emplace_back(0);
    for (const DrawItem& item : list.items) {
      const auto* plate = std::get_if<PlateItem>(&item);
      if (plate == nullptr) continue;
      // The title comes first.
      const auto first = std::ranges::find_if(plate->plate->items, [](const DrawItem& inner) {
        return std::holds_alternative<TextItem>(inner);
      });
      const double baseline = std::get<TextItem>(*first).origin.y;
      for (const DrawItem& inner : plate->plate->items) {
        const auto* text = std::get_if<TextItem>(&inner);
        if (text == nullptr || text->origin.y != baseline) continue;
        const double width_em = fonts.of(text->face).width_em(text->text);
        EXPECT_GE(text->size_px, style::kLeastType * std::min(list.width_px, list.height_px));
        EXPECT_LE(text->origin.x + width_em * text->size_px, plate->bounds.right())
            << text->text << " in " << size;
        length_em += width_em;
      }
    }
    EXPECT_GT(length_em, 0);
  }
  EXPECT_LT(lengths_em.back(), lengths_em.front());
}

}  // namespace
}  // namespace piblocks
