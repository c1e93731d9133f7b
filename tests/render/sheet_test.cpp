// Which instants a sheet shows, and what is written below its pictures.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <set>
#include <string>
#include <vector>

#include "render/renderings.hpp"
#include "scene/schedule.hpp"
#include "support/article_scene.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {

Scene scene_of_digits(int digits) { return testing_support::article_scene(digits, 64, 36); }

/// Any masses and places, also parts of a run, and runs before time 0.
Scene any_run(Random& random) {
  Scene scene = scene_of_digits(static_cast<int>(random.integer(1, 40)));
  if (random.integer(0, 1) == 0) scene.system.bodies[1].mass = random.rational(1, 5000, 7) + 1;
  if (random.integer(0, 1) == 0) scene.system.bodies[0].position[0] += random.rational(0, 1, 5);
  if (random.integer(0, 1) == 0) scene.time.from = Rational(random.rational(0, 8, 9) - 4);
  if (random.integer(0, 1) == 0) scene.time.to = random.rational(4, 12, 9);
  return scene;
}

std::vector<Integer> counts_at(const std::vector<Instant>& instants, const PairLog& log) {
  std::vector<Integer> counts;
  for (const Instant& instant : instants) {
    counts.push_back(log.blocks_at(time_of(instant, log)).count);
  }
  return counts;
}

TEST(SheetInstants, AreEquallyFarApartInCount) {
  TracedRandom random(31415);
  int spread = 0;
  for (int i = 0; i < many(300); ++i) {
    const Scene scene = any_run(random);
    const auto log = make_pair_log(scene.system);
    const Span span = span_of(scene, *log);
    const Integer before = log->blocks_at(span.from).count;
    const Integer shown = log->blocks_at(span.to).count - before;
    const int pictures = static_cast<int>(random.integer(2, 40));
    if (shown + 1 < pictures) {
      EXPECT_THROW(spread_instants(scene, pictures, Spacing::count), UsageError);
      EXPECT_EQ(spread_instants(scene, pictures), spread_instants(scene, pictures, Spacing::time));
      continue;
    }
    ++spread;
    const auto counts = counts_at(spread_instants(scene, pictures, Spacing::count), *log);
    ASSERT_EQ(counts.size(), static_cast<std::size_t>(pictures));
    EXPECT_EQ(std::set<Integer>(counts.begin(), counts.end()).size(), counts.size());
    EXPECT_EQ(counts.front(), before);
    EXPECT_EQ(counts.back(), before + shown);
    for (int k = 0; k < pictures; ++k) {
      const Rational even = before + Rational(shown * k) / (pictures - 1);
      const Integer& count = counts[static_cast<std::size_t>(k)];
      EXPECT_LE(abs(Rational(count - even)), Rational(1, 2)) << k << " of " << pictures;
    }
  }
  EXPECT_GT(spread, many(100));
}

TEST(SheetInstants, AreEquallyFarApartInTime) {
  const Scene scene = scene_of_digits(9);
  const auto log = make_pair_log(scene.system);
  const Span span = span_of(scene, *log);
  const std::vector<Instant> instants = spread_instants(scene, 7, Spacing::time);
  for (int k = 0; k < 7; ++k) {
    EXPECT_EQ(instants[static_cast<std::size_t>(k)],
              Instant(Rational(span.from + (span.to - span.from) * k / 6)));
  }
}

TEST(SheetInstants, AreByCountWhereTheTurnIsShown) {
  const auto is_usual = [](const Scene& scene, int pictures, Spacing spacing) {
    return spread_instants(scene, pictures) == spread_instants(scene, pictures, spacing);
  };
  EXPECT_TRUE(is_usual(scene_of_digits(3), 12, Spacing::count));
  EXPECT_TRUE(is_usual(scene_of_digits(2), 32, Spacing::count));
  EXPECT_TRUE(is_usual(scene_of_digits(2), 33, Spacing::time)) << "more pictures than counts";
  EXPECT_TRUE(is_usual(scene_of_digits(1), 12, Spacing::time));
  Scene scene = scene_of_digits(5);
  scene.time.to = Instant::turn();
  EXPECT_TRUE(is_usual(scene, 12, Spacing::count));
  scene.time.to = Instant::turn(Rational(-1, 1'000'000));
  EXPECT_TRUE(is_usual(scene, 12, Spacing::time)) << "ends before the turn";
  scene.time = {Instant::turn(Rational(1, 1'000'000)), Instant::last()};
  EXPECT_TRUE(is_usual(scene, 12, Spacing::time)) << "begins after the turn";
}

TEST(SheetInstants, OfACornerAreByTime) {
  Scene scene = scene_of_digits(3);
  scene.system.bodies[0].position[0] = Rational(1, 2);
  EXPECT_EQ(spread_instants(scene, 5), spread_instants(scene, 5, Spacing::time));
  EXPECT_THROW(spread_instants(scene, 5, Spacing::count), UsageError);
}

TEST(SheetInstants, AreAtMostTwoHundred) {
  for (const int pictures : {-1, 0, 201}) {
    EXPECT_THROW(spread_instants(scene_of_digits(3), pictures), UsageError) << pictures;
  }
  EXPECT_EQ(spread_instants(scene_of_digits(3), 1), std::vector<Instant>{Rational(0)});
}

std::vector<std::string> captions_of(const Scene& scene, const std::vector<Instant>& instants) {
  std::vector<std::string> captions;
  for (const CaptionedPicture& each : sheet_pictures(run_of(scene), instants)) {
    captions.push_back(each.caption);
  }
  return captions;
}

using Captions = std::vector<std::string>;

TEST(SheetCaptions, GiveTheTime) {
  EXPECT_EQ(
      captions_of(scene_of_digits(3), {Rational(0), Instant::collision(1), Rational(1234567)}),
      (Captions{"t = 0", "t = 2", "t = 1,234,567"}));
  EXPECT_EQ(captions_of(scene_of_digits(3), {Rational(1, 8000), Rational(1, 80000)}),
            (Captions{"t = 0.000125", "t = 1.25×10⁻⁵"}));
}

/// What depends on the video, too: slow motion, blur, hits, and the ellipse that becomes a circle.
TEST(SheetPictures, AreTheStillsOfTheirInstants) {
  Scene scene = scene_of_digits(2);
  scene.view.width_px = 640;
  scene.view.height_px = 360;
  const std::vector<Instant> instants = {Rational(1), Instant::turn(), Instant::collision(30),
                                         Instant::last(), Instant::last(100)};
  for (const Theme theme : {Theme::article, Theme::lecture}) {
    for (const Panel panel : {Panel::ellipse, Panel::mirrors}) {
      for (const bool is_slow : {false, true}) {
        scene.view.theme = theme;
        scene.view.shutter = is_slow ? 0 : Rational(1, 2);
        scene.show.panels = {panel};
        scene.pacing.automatic_slow_motion = is_slow;
        const std::vector<CaptionedPicture> pictures = sheet_pictures(run_of(scene), instants);
        ASSERT_EQ(pictures.size(), instants.size());
        for (std::size_t i = 0; i < instants.size(); ++i) {
          EXPECT_EQ(pictures[i].picture, still_picture(scene, instants[i])) << i;
        }
      }
    }
  }
}

TEST(SheetPictures, AreReportedOneByOneUntilStopped) {
  const std::vector<Instant> instants(5, Rational(1));
  std::vector<std::int64_t> done;
  std::stop_source stop;
  const OnProgress on_progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.frame_count, 5);
    done.push_back(progress.frames_done);
    if (done.size() == 8) stop.request_stop();
  };
  sheet_pictures(run_of(scene_of_digits(2)), instants, on_progress, stop.get_token());
  EXPECT_EQ(done, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_THROW(sheet_pictures(run_of(scene_of_digits(2), stop.get_token()), instants, on_progress,
                              stop.get_token()),
               Interrupted);
  EXPECT_EQ(done.size(), 8);
}

TEST(SheetCaptions, AreAsTheInstantIsNamed) {
  EXPECT_EQ(captions_of(scene_of_digits(3), {Instant::turn(Rational(-3, 10)), Instant::turn(),
                                             Instant::turn(2), Rational(16, 5)}),
            (Captions{"t = turn − 0.3", "t = turn", "t = turn + 2", "t = 3.2"}));
}

TEST(SheetCaptions, AreFromTheTurnWhereTimesLookAlike) {
  const Rational near = Rational(7, 2) + Rational(1, 1'000'000'000);
  EXPECT_EQ(captions_of(scene_of_digits(3), {Rational(7, 2), near, Rational(4)}),
            (Captions{"t = turn", "t = turn + 1×10⁻⁹", "t = 4"}));
  EXPECT_EQ(captions_of(scene_of_digits(3), {near, near}), (Captions{"t = 3.5", "t = 3.5"}))
      << "of one instant, twice";
}

TEST(SheetCaptions, DoNotRepeatThePicture) {
  Scene scene = scene_of_digits(3);
  scene.view.width_px = 640;
  scene.view.height_px = 360;
  scene.show.overlays = {Overlay::time};
  EXPECT_EQ(captions_of(scene, {Rational(0), Rational(4)}),
            (Captions{"t = turn − 3.5", "t = turn + 0.5"}));
  scene.system.bodies[1].velocity[0] = 0;
  EXPECT_EQ(captions_of(scene, {Rational(0), Rational(4)}), (Captions{"", ""})) << "no turn";
}

TEST(SheetCaptions, TellAnyTwoTimesApart) {
  for (int digits = 1; digits <= 30; ++digits) {
    const Scene scene = scene_of_digits(digits);
    const Captions captions = captions_of(scene, spread_instants(scene, 4, Spacing::count));
    EXPECT_EQ(std::set<std::string>(captions.begin(), captions.end()).size(), 4u) << digits;
    for (const std::string& caption : captions) EXPECT_LE(caption.size(), 32u) << caption;
  }
}

}  // namespace
}  // namespace piblocks
