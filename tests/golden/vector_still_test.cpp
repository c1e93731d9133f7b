// Stills and sheets as SVG and PDF show what they show as PNG: turned into pixels by librsvg and by
// poppler, they are compared with it.
#include <gtest/gtest.h>

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

// ---- Every kind of item once: the ordinary run

const std::vector<VectorCase> kKinds{
    {"overlays",
     {"--digits", "2", "--at", "4", "--size", "640x480", "--theme", "lecture", "--show",
      kAllOverlays, "--title", "Où se cache π ?", "--caption", "Zwei Blöcke zählen", "--logo",
      "logo.png"}},
    {"diagrams_of_gaps",
     {"--at", "3.7", "--size", "640x480", "--shutter", "0", "--panels",
      "position,unfolded,mirrors"}},
    {"diagrams_of_runs",
     {"--at", "3.7", "--size", "640x480", "--shutter", "0", "--panels", "time,count,velocity"}},
    {"ellipse", {"--digits", "2", "--at", "4", "--size", "640x480", "--panels", "ellipse"}},
    {"bars", {"--at", "3.7", "--size", "480x360", "--shutter", "0", "--panels", "conservation"}},
    {"certainty", {"--at", "3.7", "--size", "480x360", "--shutter", "0", "--panels", "certainty"}},
    {"discs", {"touch", "--at", "#1+0.3", "--size", "640x480"}},
    {"row", {"three-blocks", "--at", "#1", "--size", "640x480", "--theme", "print"}},
};

std::string case_name(const testing::TestParamInfo<VectorCase>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Kinds, VectorStills, testing::ValuesIn(kKinds), case_name);

using VectorSheets = VectorStills;

TEST_P(VectorSheets, LookLikeThePixels) {
  draw(Arguments{"sheet", "--frames", "6", "--size", "960x720"} + GetParam().options);
  ASSERT_TRUE(rasterise(folder_, "a", "-w 2339 -h 1654", "-scale-to-x 2339 -scale-to-y 1654"));
  expect_alike("svg", 255);
  expect_alike("pdf", 255);
}

INSTANTIATE_TEST_SUITE_P(Kinds, VectorSheets,
                         testing::Values(VectorCase{
                             "full",
                             {"--theme", "article", "--show", kAllOverlays, "--panels",
                              "velocity,unfolded", "--title", "Two"}}),
                         case_name);

// ---- Every theme and every scene with bodies: the label "long"

std::vector<VectorCase> themes_and_scenes() {
  const auto named = [](std::string name, const Arguments& options) {
    std::ranges::replace(name, '-', '_');
    return VectorCase{name, Arguments{"--size", "960x720"} + options};
  };
  std::vector<VectorCase> cases;
  for (const std::string theme :
       {"article", "lecture", "lecture-light", "chalkboard", "dark", "print", "colorblind"}) {
    const Arguments common{"--theme", theme, "--at", "4", "--title", "π ?", "--caption", "Où ?"};
    cases.push_back(
        named(theme + "-overlays", common + Arguments{"--digits", "2", "--show", kAllOverlays}));
    cases.push_back(named(
        theme + "-diagrams",
        common + Arguments{"--digits", "2", "--show", "masses", "--panels", "velocity,unfolded"}));
    cases.push_back(
        named(theme + "-row", Arguments{"three-blocks", "--show", "masses,energy,time"} + common));
    cases.push_back(
        named(theme + "-discs", Arguments{"billiard", "--show", "masses,trails"} + common));
  }
  for (const std::string scene : {"three-blocks", "two-walls", "row", "cradle", "superball", "gas",
                                  "billiard", "brownian", "wedge", "touch"}) {
    cases.push_back(named(scene, {scene, "--at", "#1+0.3"}));
  }
  cases.push_back(named("recoil", {"recoil", "--at", "4"}));
  return cases;
}

INSTANTIATE_TEST_SUITE_P(All, VectorStills, testing::ValuesIn(themes_and_scenes()), case_name);

}  // namespace
}  // namespace piblocks
