// Whole frames against pictures that a person has looked at, pixel for pixel.
// PIBLOCKS_APPROVE_GOLDEN=1 replaces the references by what is drawn now: look at every one.
#include <cairo.h>
#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "draw/canvas.hpp"
#include "draw/composition.hpp"
#include "golden/painter.hpp"
#include "physics/exposure.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::check_painter;
using testing_support::kOtherPainterDelta;
using testing_support::PainterCheck;

using Keys = std::vector<std::pair<const char*, const char*>>;

struct GoldenFrame {
  const char* name;
  int digits;
  const char* instant;
  Keys keys;
};

void PrintTo(const GoldenFrame& frame, std::ostream* out) { *out << frame.name; }

/// Something in every colour of a theme.
Keys full(const char* theme) {
  return {{"view.size", "640x360"},
          {"view.theme", theme},
          {"show.overlays", "digits,masses,velocities,time"},
          {"show.panels", "velocity,time"}};
}

Keys showing(const char* overlay) { return {{"view.size", "640x360"}, {"show.overlays", overlay}}; }

Keys exposed(const char* shutter, const char* theme = "article") {
  return {{"view.size", "480x270"},
          {"view.fps", "10"},
          {"view.shutter", shutter},
          {"view.theme", theme}};
}

const std::vector<GoldenFrame> kFrames{
    {"article-start", 3, "0", {{"view.size", "640x360"}}},
    {"article-first-collision", 3, "#1", {{"view.size", "640x360"}}},
    {"article-turn", 3, "3.5", {{"view.size", "640x360"}}},
    {"article-last", 3, "last", {{"view.size", "640x360"}}},
    {"article-odd-size", 3, "4", {{"view.size", "333x187"}}},
    {"portrait-20-digits", 20, "last", {{"view.size", "270x480"}}},
    {"square-9-digits", 9, "3.75", {{"view.size", "320x320"}}},
    {"banner", 5, "4.5", {{"view.size", "640x100"}}},
    {"before-the-start", 3, "-4", {{"view.size", "320x180"}}},
    {"other-geometry",
     2,
     "#7",
     {{"view.size", "480x270"},
      {"wall.face", "1/2"},
      {"blue.width", "0.6"},
      {"blue.position", "2.2"},
      {"red.width", "1.5"}}},
    {"theme-chalkboard", 2, "4", full("chalkboard")},
    {"theme-dark", 2, "4", full("dark")},
    {"theme-print", 2, "4", full("print")},
    {"theme-colorblind", 2, "4", full("colorblind")},
    {"theme-article", 2, "4", full("article")},
    {"overlay-digits", 9, "4.2", showing("digits")},
    {"overlay-masses", 6, "2.5", showing("masses")},
    {"overlay-velocities", 2, "#3", showing("velocities")},
    {"overlay-velocities-touching", 20, "3.5", showing("velocities")},
    {"overlay-energy", 3, "3.4", showing("energy")},
    {"overlay-momentum", 3, "3.4", showing("momentum")},
    {"overlay-time", 3, "3.4", showing("time")},
    {"overlay-ruler", 3, "3.4", showing("ruler")},
    {"shutter-approach", 3, "2.8", exposed("1/2")},
    {"shutter-turn", 9, "3.5", exposed("1")},
    {"shutter-collision", 1, "#1", exposed("1")},
    {"shutter-print", 3, "3.2", exposed("1/2", "print")},
    {"width-by-mass", 2, "4", {{"view.size", "480x270"}, {"red.width", "by-mass"}}},
};

DrawList draw_list_of(const GoldenFrame& frame) {
  ScriptBuilder builder;
  builder.set("digits", "digits", std::to_string(frame.digits));
  for (const auto& [key, value] : frame.keys) builder.set("golden", key, value);
  const Scene scene = builder.build_scene();
  const auto log = make_collision_log(scene.system);
  const Rational time = time_of(parse_instant(frame.instant), *log);
  std::vector<WeightedExposure> exposure;
  if (scene.view.shutter > 0) {
    const Rational open_s = scene.view.shutter / scene.view.frame_rate;
    exposure.push_back({1, expose(*log, time, time + scene.time.speed * open_s)});
  }
  return Composition(scene, *log).frame({log->state_at(time), time, 1, exposure});
}

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

/// Decoded by Cairo and libpng: not by what wrote it.
class ReferencePicture {
 public:
  explicit ReferencePicture(const fs::path& path)
      : surface_(cairo_image_surface_create_from_png(path.c_str())) {}
  bool is_valid() const { return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS; }
  ImageView view() const {
    return {cairo_image_surface_get_data(surface_.get()),
            cairo_image_surface_get_width(surface_.get()),
            cairo_image_surface_get_height(surface_.get()),
            cairo_image_surface_get_stride(surface_.get())};
  }

 private:
  std::unique_ptr<cairo_surface_t, SurfaceDeleter> surface_;
};

std::uint32_t rgb_at(const ImageView& image, int x, int y) {
  std::uint32_t pixel = 0;
  std::memcpy(&pixel, image.row(y) + 4 * x, 4);
  return pixel & 0xFFFFFF;
}

/// Where two pictures of one size differ, for people; empty if nowhere.
struct PixelDifferences {
  std::int64_t pixels = 0;
  int largest_delta = 0;  ///< of a sample
  std::string first;      ///< its place
};

PixelDifferences difference(const ImageView& expected, const ImageView& actual) {
  PixelDifferences found;
  for (int y = 0; y < expected.height_px; ++y) {
    for (int x = 0; x < expected.width_px; ++x) {
      const std::uint32_t a = rgb_at(expected, x, y);
      const std::uint32_t b = rgb_at(actual, x, y);
      if (a == b) continue;
      if (found.pixels++ == 0) found.first = std::to_string(x) + ", " + std::to_string(y);
      for (const int shift : {0, 8, 16}) {
        const int delta = std::abs(int(a >> shift & 255) - int(b >> shift & 255));
        found.largest_delta = std::max(found.largest_delta, delta);
      }
    }
  }
  return found;
}

void write_file(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

class GoldenFrames : public testing::TestWithParam<GoldenFrame> {};

TEST_P(GoldenFrames, AreUnchanged) {
  const std::string file = std::string(GetParam().name) + ".png";
  const fs::path reference = fs::path(PIBLOCKS_GOLDEN_FRAMES) / file;
  const DrawList list = draw_list_of(GetParam());
  Canvas canvas(list.width_px, list.height_px);
  canvas.paint(list);
  if (std::getenv("PIBLOCKS_APPROVE_GOLDEN") != nullptr) {
    write_file(reference, encode_png(canvas.view()));
    GTEST_SKIP() << "approved " << reference;
  }
  const ReferencePicture expected(reference);
  ASSERT_TRUE(expected.is_valid()) << reference << " is missing or no PNG";
  ASSERT_EQ(expected.view().width_px, list.width_px);
  ASSERT_EQ(expected.view().height_px, list.height_px);
  const PixelDifferences found = difference(expected.view(), canvas.view());
  if (found.pixels == 0) return;
  const PainterCheck painter = check_painter();
  const bool may_differ =
      !painter.is_known && (!painter.has_known_fonts || found.largest_delta <= kOtherPainterDelta);
  if (may_differ) GTEST_SKIP() << painter.reason;
  const fs::path actual = fs::path("golden-failures") / file;
  write_file(actual, encode_png(canvas.view()));
  FAIL() << found.pixels << " pixels differ by up to " << found.largest_delta << ", first at "
         << found.first << "\nexpected " << reference << "\nactual   " << fs::absolute(actual);
}

std::string test_name(const testing::TestParamInfo<GoldenFrame>& info) {
  std::string name = info.param.name;
  for (char& c : name) {
    if (c == '-') c = '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenFrames, testing::ValuesIn(kFrames), test_name);

TEST(GoldenComparison, SeesOnePixelOfOneDigit) {
  Canvas expected(64, 36);
  Canvas actual(64, 36);
  const auto with_digit = [](const char* digit) {
    return DrawList{
        64, 36, Color{255, 255, 255}, {TextItem{ItemId::count, {20, 20}, digit, 7, {}}}};
  };
  expected.paint(with_digit("3"));
  actual.paint(with_digit("8"));
  const PixelDifferences one = difference(expected.view(), actual.view());
  EXPECT_GT(one.pixels, 0);
  EXPECT_GT(one.largest_delta, 0);
  actual.paint(with_digit("3"));
  EXPECT_EQ(difference(expected.view(), actual.view()).pixels, 0);
}

}  // namespace
}  // namespace piblocks
