// What is written and drawn beside the blocks keeps clear of them, of the wall and of each other.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "draw/composed_pictures.hpp"
#include "draw/lecture_frames.hpp"
#include "draw/look.hpp"

namespace piblocks {
namespace {

/// From the leftmost to the rightmost point of an arrow; the wrong way round if none is drawn.
std::pair<double, double> reach_of_arrow(const DrawList& list, std::size_t n) {
  std::pair<double, double> reach{1e9, -1e9};
  for (const std::size_t part : {n, n + 1}) {
    const auto* const path = find_item<PathItem>(list, nth(ItemId::velocities, part));
    if (path == nullptr) continue;
    const Rect& bounds = path->points.bounds();
    reach = {std::min(reach.first, bounds.x), std::max(reach.second, bounds.right())};
  }
  return reach;
}

TEST(Labels, ArrowsOfVelocitiesNeverMeet) {
  for (const char* width : {"1/2", "1", "3/2"}) {
    const Pictures pictures(3, {{"show.overlays", "velocities"}, {"red.width", width}});
    int pairs = 0;
    for (int count = 1; count <= 314; ++count) {
      const DrawList list = pictures.after(count);
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
      const Pictures pictures(digits, {{"show.overlays", "velocities"}, {"view.size", size}});
      const DrawList list = pictures.at(Rational(7, 2));
      const std::vector<TextItem> figures = items_of<TextItem>(list.items, ItemId::velocities);
      ASSERT_EQ(figures.size(), 2U);
      const TextItem& blue = figures[1];
      EXPECT_GT(blue.origin.x, wall_of(list).right());
      EXPECT_LT(blue.origin.x + font.width_em(blue.text) * blue.size_px, figures[0].origin.x);
    }
  }
}

/// A mass is whole in the frame: on its block, or clear of it.
void expect_mass_of(const DrawList& list, ItemId thing, std::size_t n, const Fonts& fonts) {
  const auto* const block = find_item<RectangleItem>(list, thing);
  ASSERT_TRUE(block);
  const Rect& place = block->bounds;
  const double seen = std::min(double(list.width_px), place.right()) - std::max(0.0, place.x);
  if (seen < 1) return;
  const auto* const mass = find_item<TextItem>(list, nth(ItemId::masses, n));
  ASSERT_TRUE(mass) << "the mass is gone, and " << seen << " pixels of its block are seen";
  const Box text = box_of(*mass, fonts);
  EXPECT_GE(text.x, 0);
  EXPECT_LE(text.right(), list.width_px);
  const bool is_on = text.x >= place.x && text.right() <= place.right() && text.y > place.y - 1;
  const bool is_above = mass->origin.y < place.y;
  const bool is_beside = text.right() <= place.x || text.x >= place.right();
  const bool is_below = text.y > place.bottom();
  EXPECT_TRUE(is_on || is_above || is_beside || is_below) << text.x << " on " << place.x;
}

/// What runs fast is at even pixels, where encoders find its colours again; else at whole ones.
TEST(Labels, FastOnesAreAtEvenPixels) {
  const auto odd_places = [](const char* speed, const char* velocity) {
    const Frames frames({{"digits", "2"},
                         {"show.overlays", "masses"},
                         {"view.theme", "lecture"},
                         {"view.size", "1280x720"},
                         {"time.speed", speed},
                         {"red.velocity", velocity}});
    int odd = 0;
    for (int i = 0; i < 40; ++i) {
      const DrawList frame = frames.at(Rational(i) / 60);
      const double x = items_of<TextItem>(frame.items, ItemId::masses).front().origin.x;
      EXPECT_EQ(x, std::round(x));
      odd += std::fmod(x, 2) != 0 ? 1 : 0;
    }
    return odd;
  };
  // Some 130 pixels a unit and 60 frames a second.
  EXPECT_EQ(odd_places("1", "-1"), 0);
  EXPECT_GT(odd_places("1/4", "-1"), 10);
  EXPECT_EQ(odd_places("1/4", "-4"), 0);
}

TEST(Labels, AMassStaysWhileItsBlockIsInSight) {
  const Fonts fonts;
  int instants = 0;
  for (const char* theme : {"lecture", "lecture-light", "article"}) {
    for (const char* size : {"1280x720", "1080x1920", "720x720"}) {
      for (const Settings& more : std::vector<Settings>{
               {},
               {{"red.width", "by-mass"}, {"show.panels", "velocity"}},
               {{"view.x", "1.7:8"}, {"blue.position", "3"}, {"red.position", "6"}},
               {{"red.mass", "1/100"}, {"blue.velocity", "1"}, {"red.position", "9"}},
               {{"red.mass", "1"}, {"blue.velocity", "2"}}}) {
        SCOPED_TRACE(std::string(theme) + " " + size + (more.empty() ? "" : more.front().second));
        const Settings all =
            Settings{{"show.overlays", "masses"}, {"view.theme", theme}, {"view.size", size}} +
            more;
        std::optional<Pictures> pictures;
        try {
          pictures.emplace(2, all);
        } catch (const UsageError&) {  // no room
          continue;
        }
        for (Rational time = 0; time < 20; time += Rational(1, 8)) {
          SCOPED_TRACE(time.get_str());
          const DrawList list = pictures->at(time);
          expect_mass_of(list, ItemId::red_block, 0, fonts);
          expect_mass_of(list, ItemId::blue_block, 1, fonts);
          if (HasFailure()) return;
          ++instants;
        }
      }
    }
  }
  EXPECT_GT(instants, 3000);
}

TEST(Labels, MassesOfTheThemeAreThereUnlessOneHasNoPlace) {
  const auto masses = [](const Settings& settings) {
    const Pictures pictures(3, Settings{{"view.theme", "lecture-light"}} + settings);
    std::vector<std::string> texts;
    for (const std::size_t n : {0U, 1U}) {
      const std::string text = text_of(pictures.at(0), nth(ItemId::masses, n));
      if (!text.empty()) texts.push_back(text);
    }
    return texts;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(masses({}), (Texts{"10,000 kg", "1 kg"}));
  EXPECT_EQ(masses({{"view.size", "1080x1920"}}), (Texts{"10,000", "1"})) << "no room for a unit";
  EXPECT_TRUE(masses({{"view.theme", "article"}}).empty());
  EXPECT_TRUE(masses({{"view.theme", "dark"}}).empty());
  EXPECT_TRUE(masses({{"show.overlays", "none"}}).empty());
  EXPECT_TRUE(masses({{"show.overlays", "time"}}).empty());
  // Blue is too narrow, and red would run into a label above it.
  const Setting narrow{"blue.width", "1/10"};
  EXPECT_TRUE(masses({narrow}).empty());
  EXPECT_EQ(masses({narrow, {"show.overlays", "masses"}}).size(), 2U) << "below the floor";
}

/// A mass that does not fit on the lighter block is below the floor, and stays below its block.
TEST(Labels, AMassIsBelowTheFloorWhereItsBlockIsSmall) {
  Scene scene = scene_with(
      3, {{"show.overlays", "masses"}, {"view.theme", "lecture"}, {"view.size", "1280x720"}});
  scene.view.x = {0, 50};
  const Pictures pictures(scene);
  const auto blue_at_wall = items_of<RectangleItem>(pictures.after(2).items, ItemId::blue_block);
  const double wall_px = blue_at_wall.front().bounds.x + 0.25 * 0.036 * 720;
  for (const int count : {10, 150, 300}) {
    const DrawList list = pictures.after(count);
    const Rect blue = items_of<RectangleItem>(list.items, ItemId::blue_block).front().bounds;
    ASSERT_LT(blue.height, 0.042 * 720 * 1.2) << "else the test shows nothing";
    const auto masses = items_of<TextItem>(list.items, ItemId::masses);
    ASSERT_EQ(masses.size(), 2U);
    const Box box = box_of(masses.back(), Fonts());
    EXPECT_EQ(box.what, "1 kg");
    EXPECT_GT(box.y, blue.bottom());
    EXPECT_LE(box.bottom(), 720);
    EXPECT_NEAR(box.centre().x, std::max(blue.centre().x, wall_px + box.width / 2), 1);
    EXPECT_GE(box_of(masses.front(), Fonts()).x, wall_px - 1) << "nor is red's on the wall";
    EXPECT_LT(masses.front().origin.y, blue.y) << "red's is above red";
  }
  // Where a scale is, there is no room.
  scene.show.overlays->push_back(Overlay::ruler);
  EXPECT_THROW(Pictures{scene}, UsageError);
}

/// Half a figure, at the frame's edge, is another number.
TEST(Labels, FiguresOfVelocitiesAreWholeAndOfBlocksInTheFrame) {
  const Font font;
  const auto expect_whole = [&](const Range& view, const char* red_position, std::size_t count) {
    Scene scene = scene_with({{"show.overlays", "velocities"},
                              {"view.size", "640x360"},
                              {"blue.velocity", "-7654321"},
                              {"red.velocity", "-1234567"},
                              {"red.position", red_position}});
    scene.view.x = view;
    const std::vector<TextItem> figures =
        items_of<TextItem>(Pictures(scene).at(0).items, ItemId::velocities);
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
    const Pictures pictures(3, {{"show.overlays", "ruler"}, {"view.size", size}});
    const DrawList list = pictures.at(0);
    const Rect wall = wall_of(list);
    const std::vector<TextItem> figures = items_of<TextItem>(list.items, ItemId::ruler);
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
  for (const TextItem& text : Shown(list).texts) {
    const bool is_number = text.text.find_first_of("0123456789") < 4;
    const bool is_raised = !figures.empty() && text.size_px < 0.9 * figures.front().size_px;
    if (is_number && !is_raised) figures.push_back(text);
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
        const Pictures pictures(digits, {{"show.panels", panel},
                                         {"view.size", "640x360"},
                                         {"time.from", "0"},
                                         {"time.to", end}});
        const DrawList list = pictures.at(0);
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
    const Pictures pictures(6, {{"view.size", size}, {"show.panels", "velocity,position"}});
    const DrawList list = pictures.at(4);
    double& length_em = lengths_em.emplace_back(0);
    for (const PlateItem& plate : Shown(list).plates) {
      const auto texts = items_of<TextItem>(plate.plate->items);
      for (const TextItem& text : texts) {
        // The title comes first.
        if (text.origin.y != texts.front().origin.y) continue;
        const double width_em = fonts.of(text.face).width_em(text.text);
        EXPECT_GE(text.size_px, style::kLeastType * std::min(list.width_px, list.height_px));
        EXPECT_LE(text.origin.x + width_em * text.size_px, plate.bounds.right())
            << text.text << " in " << size;
        length_em += width_em;
      }
    }
    EXPECT_GT(length_em, 0);
  }
  EXPECT_LT(lengths_em.back(), lengths_em.front());
}

}  // namespace
}  // namespace piblocks
