// Stills and sheets as SVG and PDF show what they show as PNG: turned into pixels by librsvg and by
// poppler, they are compared with it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cli/cli_fixture.hpp"
#include "golden/picture_likeness.hpp"

namespace piblocks {
namespace {

using testing_support::read_samples;
using testing_support::Unlikeness;
using testing_support::unlikeness;

struct Bounds {
  int beside_nothing;
  double of_window;
};
// Measured 2026-11-22 over all pictures below: 5 and 25 by librsvg, 34 and 32 by poppler, which
// sets type at other places. A stray line in the palest colour of any theme is 55 beside nothing.
constexpr Bounds kSvgBounds{8, 32};
constexpr Bounds kPdfBounds{45, 40};

constexpr const char* kOnePixelAPoint = "-r 72";
constexpr const char* kAllOverlays = "digits,masses,velocities,energy,momentum,time,ruler";
constexpr const char* kAllPanels =
    "velocity,position,unfolded,time,count,ellipse,mirrors,conservation,certainty";
constexpr const char* kTwoPanels = "velocity,unfolded";

struct VectorCase {
  std::string name;
  Arguments options;
};

void PrintTo(const VectorCase& one, std::ostream* out) { *out << one.name; }

/// Turns NAME.svg and NAME.pdf into NAME-svg.png and NAME-pdf.png.
bool rasterise(const TemporaryFolder& folder, const std::string& name, const std::string& svg_size,
               const std::string& pdf_size) {
  const std::string base = folder / name;
  const std::string svg = "rsvg-convert " + svg_size + " " + base + ".svg -o " + base + "-svg.png";
  const std::string pdf =
      "pdftoppm -png -singlefile " + pdf_size + " " + base + ".pdf " + base + "-pdf";
  return std::system(svg.c_str()) == 0 && std::system(pdf.c_str()) == 0;
}

bool has_tools() { return std::system("command -v rsvg-convert pdftoppm > /dev/null") == 0; }

class VectorStills : public CliFixture, public testing::WithParamInterface<VectorCase> {
 protected:
  void SetUp() override {
    if (!has_tools()) GTEST_SKIP() << "rsvg-convert or pdftoppm is not here";
    // Of even colours: programs enlarge and reduce pictures in ways of their own.
    output_of({"still", "--at", "3", "--size", "240x160", "--theme", "dark", "-o", "logo.png"});
  }

  void draw(const Arguments& command) const {
    for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
      output_of(command + Arguments{"-o", name});
    }
  }
  void expect_alike(const char* kind, std::uint8_t grey) const {
    const Unlikeness worst =
        unlikeness(read_samples(folder_ / "a.png", grey),
                   read_samples(folder_ / ("a-" + std::string(kind) + ".png"), grey));
    RecordProperty(std::string(kind) + "_beside_nothing", worst.beside_nothing);
    RecordProperty(std::string(kind) + "_of_window", std::to_string(worst.of_window));
    const Bounds& most = std::string(kind) == "svg" ? kSvgBounds : kPdfBounds;
    EXPECT_LE(worst.beside_nothing, most.beside_nothing) << kind << ": " << worst.where;
    EXPECT_LE(worst.of_window, most.of_window) << kind << ": " << worst.where;
  }
};

TEST_P(VectorStills, LookLikeThePixels) {
  draw(Arguments{"still"} + GetParam().options);
  ASSERT_TRUE(rasterise(folder_, "a", "", kOnePixelAPoint));
  expect_alike("svg", 255);
  expect_alike("pdf", 255);
}

/// Paper is white: only SVG shows what is seen through.
TEST_P(VectorStills, LookLikeThePixelsOnBlack) {
  draw(Arguments{"still", "--transparent"} + GetParam().options);
  ASSERT_TRUE(rasterise(folder_, "a", "", kOnePixelAPoint));
  expect_alike("svg", 0);
  expect_alike("svg", 255);
  expect_alike("pdf", 255);
}

Arguments sized(const Arguments& options) { return Arguments{"--size", "640x480"} + options; }

/// Overlays, and beside fewer of them diagrams.
std::vector<VectorCase> themes() {
  std::vector<VectorCase> cases;
  for (const char* theme :
       {"article", "lecture", "lecture-light", "chalkboard", "dark", "print", "colorblind"}) {
    std::string name = theme;
    std::ranges::replace(name, '-', '_');
    const Arguments common{"--digits",  "2",
                           "--at",      "4",
                           "--size",    "960x720",
                           "--theme",   theme,
                           "--title",   "Où se cache π ?",
                           "--caption", "Zwei Blöcke zählen"};
    cases.push_back({"theme_" + name, common + Arguments{"--show", kAllOverlays}});
    cases.push_back({"diagrams_" + name,
                     common + Arguments{"--show", "masses,velocities", "--panels", kTwoPanels}});
  }
  return cases;
}

std::vector<VectorCase> each_thing() {
  std::vector<VectorCase> cases;
  for (const std::string& overlay : split(kAllOverlays, ',')) {
    cases.push_back({"overlay_" + overlay, sized({"--at", "#2", "--show", overlay})});
  }
  for (const std::string& panel : split(kAllPanels, ',')) {
    cases.push_back({"panel_" + panel, sized({"--at", "3.7", "--panels", panel})});
  }
  cases.push_back({"plain", sized({"--at", "3.7"})});
  cases.push_back({"title", sized({"--at", "0", "--title", "Two blocks"})});
  cases.push_back({"caption", sized({"--at", "0", "--caption", "and a wall"})});
  cases.push_back({"logo", sized({"--at", "3.7", "--logo", "logo.png", "--caption", "beside it"})});
  cases.push_back({"last", sized({"--at", "last", "--show", kAllOverlays})});
  cases.push_back({"twenty_digits",
                   {"--digits", "20", "--at", "3.6", "--show", "velocities", "--panels",
                    "position,time", "--size", "960x720"}});
  cases.push_back({"width_by_mass", sized({"--at", "4", "--width-by-mass", "--show", "masses"})});
  return cases;
}

/// Shipped scenes with bodies, and one of each kind in every theme.
std::vector<VectorCase> bodies() {
  const auto named = [](const std::string& scene, std::string name, const Arguments& options) {
    std::ranges::replace(name, '-', '_');
    return VectorCase{name, Arguments{scene, "--size", "960x720"} + options};
  };
  std::vector<VectorCase> cases;
  for (const std::string scene : {"three-blocks", "two-walls", "row", "cradle", "superball",
                                  "recoil", "gas", "billiard", "brownian", "wedge", "touch"}) {
    cases.push_back(named(scene, scene, {"--at", "#1+0.3"}));
  }
  for (const char* theme :
       {"article", "lecture", "lecture-light", "chalkboard", "dark", "print", "colorblind"}) {
    const Arguments common{"--at",          "3",         "--theme",        theme, "--title",
                           "Où sont-ils ?", "--caption", "Zwischen Wänden"};
    cases.push_back(named("three-blocks", std::string("blocks_") + theme,
                          common + Arguments{"--show", "masses,energy,momentum,time,velocities"}));
    cases.push_back(named("billiard", std::string("discs_") + theme,
                          common + Arguments{"--show", "masses,energy,momentum,time,trails"}));
  }
  return cases;
}

std::string case_name(const testing::TestParamInfo<VectorCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Themes, VectorStills, testing::ValuesIn(themes()), case_name);
INSTANTIATE_TEST_SUITE_P(Each, VectorStills, testing::ValuesIn(each_thing()), case_name);
INSTANTIATE_TEST_SUITE_P(Bodies, VectorStills, testing::ValuesIn(bodies()), case_name);

using OpaqueVectorStills = VectorStills;

/// What is exposed needs something behind it.
TEST_P(OpaqueVectorStills, LookLikeThePixels) {
  draw(Arguments{"still"} + GetParam().options);
  ASSERT_TRUE(rasterise(folder_, "a", "", kOnePixelAPoint));
  expect_alike("svg", 255);
  expect_alike("pdf", 255);
}

INSTANTIATE_TEST_SUITE_P(
    Each, OpaqueVectorStills,
    testing::Values(VectorCase{"shutter", sized({"--at", "2.9", "--shutter", "1", "--fps", "10"})},
                    VectorCase{"shutter_with_labels",
                               sized({"--at", "2.9", "--shutter", "1", "--fps", "10", "--show",
                                      kAllOverlays, "--theme", "print"})}),
    case_name);

using VectorSheets = VectorStills;

TEST_P(VectorSheets, LookLikeThePixels) {
  draw(Arguments{"sheet"} + GetParam().options);
  ASSERT_TRUE(rasterise(folder_, "a", "-w 2339 -h 1654", "-scale-to-x 2339 -scale-to-y 1654"));
  expect_alike("svg", 255);
  expect_alike("pdf", 255);
}

INSTANTIATE_TEST_SUITE_P(Each, VectorSheets,
                         testing::Values(VectorCase{"plain", {"--frames", "4"}},
                                         VectorCase{"full",
                                                    {"--frames", "6", "--show", kAllOverlays,
                                                     "--panels", kTwoPanels, "--size", "960x720",
                                                     "--title", "Two blocks"}}),
                         case_name);

}  // namespace
}  // namespace piblocks
