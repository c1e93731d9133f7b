// Every element of the look in five shapes of frame and both lecture themes, as stills show them.
// Those at 1280x720 on dark are pictures, and a person has looked at them; the others are
// checksums. PIBLOCKS_APPROVE_GOLDEN=1 replaces the references by what is drawn now: look at every
// one.
#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "draw/canvas.hpp"
#include "golden/painter.hpp"
#include "render/film.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

using Keys = std::vector<std::pair<const char*, const char*>>;

struct Element {
  const char* name;
  int digits;
  const char* instant;
  Keys keys;
};

void PrintTo(const Element& element, std::ostream* out) { *out << element.name; }

Element panel(const char* name) {
  return {name, 2, "turn+0.1", {{"show.panels", name}, {"red.width", "by-mass"}}};
}

const std::vector<Element> kElements{
    {"blocks", 3, "2.5", {}},
    {"end", 2, "last+1", {}},
    {"masses", 2, "2.5", {{"show.overlays", "masses"}, {"red.width", "by-mass"}}},
    {"mass-above", 3, "2.5", {{"show.overlays", "masses"}}},
    {"velocities", 2, "#3", {{"show.overlays", "velocities"}}},
    {"ruler", 3, "3", {{"show.overlays", "ruler"}}},
    {"read-outs", 3, "3", {{"show.overlays", "time,energy,momentum"}}},
    {"lines", 3, "3", {{"show.title", "Où se cache π ?"}, {"show.caption", "Zwei Blöcke zählen"}}},
    {"hit-at-wall", 1, "#1+0.05", {{"blue.velocity", "-1"}}},
    {"hit-of-blocks", 1, "#1+0.05", {}},
    {"glow", 4, "3.3", {}},
    {"loupe", 5, "turn", {}},
    {"slow-motion", 2, "turn-0.2", {{"time.slow-motion", "auto"}}},
    {"twenty-digits", 20, "turn+1", {}},
    {"base-2", 6, "last", {{"base", "2"}}},
    panel("velocity"),
    panel("ellipse"),
    panel("position"),
    panel("unfolded"),
    panel("mirrors"),
    panel("time"),
    panel("count"),
    panel("conservation"),
    panel("certainty"),
};

constexpr std::array kShapes{"1280x720", "1920x1080", "3840x2160", "1080x1920", "1080x1080"};
constexpr std::array kThemes{"lecture", "lecture-light"};

const fs::path kFolder = PIBLOCKS_GOLDEN_FRAMES;

DrawList draw_list_of(const Element& element, const char* shape, const char* theme) {
  ScriptBuilder builder;
  builder.set("golden", "digits", std::to_string(element.digits));
  builder.set("golden", "view.size", shape);
  builder.set("golden", "view.theme", theme);
  for (const auto& [key, value] : element.keys) builder.set("golden", key, value);
  const Scene scene = builder.build_scene();
  auto log = make_collision_log(scene.system);
  const Rational time = time_of(parse_instant(element.instant), *log);
  return FilmRun(scene, std::move(log), FilmUse::pictures).still(time);
}

std::string checksum(const ImageView& image) {
  uLong sum = crc32(0, nullptr, 0);
  for (int y = 0; y < image.height_px; ++y) {
    sum = crc32_z(sum, image.row(y), std::size_t(image.width_px) * 4);
  }
  return std::to_string(sum);
}

std::vector<char> bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Lines of "SHAPE THEME CHECKSUM".
std::map<std::string, std::string> read_checksums(const fs::path& path) {
  std::map<std::string, std::string> sums;
  std::ifstream file(path);
  std::string shape;
  std::string theme;
  std::string sum;
  while (file >> shape >> theme >> sum) sums[shape + ' ' + theme] = sum;
  return sums;
}

class LookFrames : public testing::TestWithParam<Element> {};

TEST_P(LookFrames, AreUnchanged) {
  const bool is_approving = std::getenv("PIBLOCKS_APPROVE_GOLDEN") != nullptr;
  const testing_support::PainterCheck painter = testing_support::check_painter();
  if (!painter.is_known && !is_approving) GTEST_SKIP() << painter.reason;
  const std::string name = std::string("look-") + GetParam().name;
  const fs::path sums_file = kFolder / (name + ".crc32");
  const auto expected = read_checksums(sums_file);
  std::map<std::string, std::string> found;
  for (const char* shape : kShapes) {
    for (const char* theme : kThemes) {
      const DrawList list = draw_list_of(GetParam(), shape, theme);
      Canvas canvas(list.width_px, list.height_px);
      canvas.paint(list);
      const std::string key = std::string(shape) + ' ' + theme;
      found[key] = checksum(canvas.view());
      const bool is_picture = shape == kShapes.front() && theme == kThemes.front();
      const bool differs = !expected.contains(key) || expected.at(key) != found[key];
      if (!is_approving) {
        EXPECT_FALSE(differs) << name << " in " << key;
      }
      if (!differs && !is_picture) continue;
      const std::vector<std::uint8_t> png = encode_png(canvas.view());
      const fs::path folder = is_approving ? kFolder : fs::path("golden-failures");
      const fs::path picture =
          folder / (is_picture ? name + ".png" : name + '-' + shape + '-' + theme + ".png");
      if (!is_approving && is_picture && !differs) {
        EXPECT_TRUE(std::ranges::equal(bytes_of(kFolder / (name + ".png")), png, {}, [](char c) {
          return static_cast<std::uint8_t>(c);
        })) << "the picture is not the one of the checksum";
        continue;
      }
      if (is_approving && !is_picture) continue;
      fs::create_directories(folder);
      std::ofstream(picture, std::ios::binary)
          .write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
    }
  }
  if (!is_approving) return;
  std::ofstream sums(sums_file);
  for (const auto& [key, sum] : found) sums << key << ' ' << sum << '\n';
  GTEST_SKIP() << "approved " << name;
}

INSTANTIATE_TEST_SUITE_P(Elements, LookFrames, testing::ValuesIn(kElements),
                         [](const auto& element) {
                           std::string name = element.param.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace piblocks
