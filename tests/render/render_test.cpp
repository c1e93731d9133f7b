#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <filesystem>
#include <fstream>

#include "draw/composed_pictures.hpp"
#include "media/png/png_reader.hpp"
#include "render/renderings.hpp"
#include "rendered_parts.hpp"
#include "scene/schedule.hpp"
#include "support/decode_video.hpp"
#include "support/message_of.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/uncertain_discs.hpp"

namespace piblocks {
namespace {
using testing_support::decode_video;
using testing_support::DecodedVideo;
using testing_support::file_contents;
using testing_support::message_of;
using testing_support::Pixels;
using testing_support::TemporaryFolder;

class RenderTest : public testing::Test {
 protected:
  std::string path(const char* name) const { return folder_ / name; }

  static Scene scene(const char* from, const char* to) {
    return scene_with({{"view.size", "320x180"}, {"time.from", from}, {"time.to", to}});
  }

  TemporaryFolder folder_;
};

constexpr int kRows = 180;
constexpr int kCounterRows = 72;  // above wall and blocks, where chroma counts less than the count

/// The mean squared error of a frame of the video, in its upper rows.
double error_of(Pixels frame, const Scene& scene, const State& state, int rows = kRows) {
  Pixels expected(frame.width_px, frame.height_px);
  expected.words = painted(Pictures(scene).composition.frame({state}));
  for (Pixels* pixels : {&frame, &expected}) {
    pixels->words.resize(std::size_t(rows) * std::size_t(frame.width_px));
  }
  return testing_support::rgb_mean_squared_error(frame, expected);
}

TEST_F(RenderTest, APageThatNoBrowserLoadsIsRefused) {
  const std::filesystem::path video = path("video.mp4.unfinished-1");
  std::ofstream(video).flush();
  std::filesystem::resize_file(video, 400'000'000);
  EXPECT_NO_THROW(check_page_size("a.html", folder_.path(), {7, 9}));
  std::filesystem::resize_file(video, 400'000'001);
  EXPECT_EQ(
      message_of<UsageError>([&] {
        check_page_size("a.html", folder_.path(), {7, 9});
      }),
      "page: 'a.html' is too large after 7 of 9 frames: browsers play at most 400 MB of video "
      "inside a page; write an MP4, perhaps with --bundle, or choose a smaller size");
  std::filesystem::remove(video);
  EXPECT_NO_THROW(check_page_size("a.html", folder_.path(), {7, 9}));
}

TEST_F(RenderTest, EveryVideoFrameShowsItsInstant) {
  const Scene article = scene("3.4", "4.4");
  RenderJob job{article, path("out.mp4"), {}, 2};
  const std::int64_t frames = render_silently(job).frame_count;
  const DecodedVideo video = decode_video(job.output);
  const auto log = make_pair_log(article.system);
  const Schedule schedule = make_schedule(article, *log);
  ASSERT_EQ(std::int64_t(video.frames.size()), frames);
  ASSERT_EQ(frames, film_frames(schedule));
  for (std::int64_t k = 0; k < frames; ++k) {
    const State state = log->state_at(schedule.time_of(k));
    const double mse = error_of(video.frames[std::size_t(k)].rgb, article, state);
    EXPECT_GT(testing_support::psnr_db(mse), 38) << "frame " << k;
  }
}

TEST_F(RenderTest, TheLastFrameReads314) {
  const Scene article = scene("12.2", "last");
  render_silently({article, path("out.mp4"), {}, 2});
  const DecodedVideo video = decode_video(path("out.mp4"));
  const auto log = make_pair_log(article.system);
  const Schedule schedule = make_schedule(article, *log);
  State state = log->state_at(schedule.time_of(film_frames(schedule) - 1));
  ASSERT_EQ(state.count, 314);
  const Pixels& last = video.frames.back().rgb;
  const double as_314 = error_of(last, article, state, kCounterRows);
  for (const int other : {313, 315, 214, 324}) {
    state.count = other;
    EXPECT_GT(error_of(last, article, state, kCounterRows), 4 * as_314) << other;
  }
}

TEST_F(RenderTest, BytesDoNotDependOnTheNumberOfJobs) {
  for (const char* name : {"out.mp4", "out.y4m", "out.framehash"}) {
    std::string first;
    for (const int jobs : {1, 2, 3, 7}) {
      render_silently({scene("1", "6"), path(name), {}, jobs});
      const std::string bytes = file_contents(path(name));
      if (first.empty()) first = bytes;
      EXPECT_EQ(bytes == first, true) << name << " with " << jobs << " jobs";
    }
  }
}

TEST_F(RenderTest, ReportsProgressUpToTheEnd) {
  std::int64_t last = -1;
  const auto on_progress = [&](const Progress& progress) {
    EXPECT_GT(progress.frames_done, last);
    last = progress.frames_done;
    EXPECT_EQ(progress.frame_count, 180);
  };
  const Rendered rendered = render({scene("0", "3"), path("out.framehash"), {}, 2}, on_progress);
  EXPECT_EQ(rendered.frame_count, 180);
  EXPECT_EQ(last, 180);
}

TEST_F(RenderTest, StoppingLeavesNoTrace) {
  for (const char* name : {"out.mp4", "out.y4m", "out.framehash", "frames/%04d.png"}) {
    std::stop_source stop;
    const auto stop_soon = [&](const Progress& progress) {
      if (progress.frames_done > 50) stop.request_stop();
    };
    EXPECT_THROW(render({scene("0", "1000"), path(name), {}, 2}, stop_soon, stop.get_token()),
                 Interrupted);
    EXPECT_TRUE(folder_.is_empty()) << name;
  }
}

TEST_F(RenderTest, FailingLeavesNoTrace) {
  EXPECT_THROW(render_silently({scene("0", "1"), path("out.avi"), {}, 2}), UsageError);
  EXPECT_THROW(render_still(scene("0", "1"), Instant::last(), path("out.jpg")), UsageError);
  EXPECT_THROW(render_still(scene("0", "1"), Instant::collision(315), path("out.png")), UsageError);
  EXPECT_TRUE(folder_.is_empty());
}

// The bodies are certain until a time between 13.4 and 13.5. Back and forth, frame 3860 shows an
// uncertain time, and those from 3866 on certain ones.
TEST_F(RenderTest, RejectsUncertainCollisionsBeforeTheFirstFrame) {
  const std::string text = "view.size = '320x180'\nview.fps = 10\nview.theme = 'article'\n" +
                           testing_support::uncertain_discs();
  const auto reports_of = [&](RenderJob job) {
    int reports = 0;
    EXPECT_THROW(render(job, [&](const Progress&) { ++reports; }), UsageError) << job.output;
    return reports;
  };
  for (const char* loop : {"", "time.loop = true\n"}) {
    const Script script = testing_support::script_of(loop + text);
    for (const char* name : {"a.mp4", "a.wav", "a%d.svg", "a.pdf", "a.html"}) {
      EXPECT_EQ(reports_of({script, path(name)}), 0) << name;
    }
    RenderJob job{script, path("a.mp4")};
    job.frames = {130, 135};
    EXPECT_EQ(reports_of(job), 0);
    EXPECT_TRUE(folder_.is_empty());
    job.frames = {120, 134};
    EXPECT_EQ(render_silently(job).frame_count, 15);
    std::filesystem::remove(job.output);
  }
  RenderJob exposed{testing_support::script_of("view.shutter = 1\n" + text), path("b.mp4")};
  exposed.frames = {120, 134};  // until 13.5
  EXPECT_EQ(reports_of(exposed), 0);
  RenderJob backwards{testing_support::script_of("time.loop = true\n" + text), path("a.mp4")};
  backwards.frames = {3860, 3900};
  EXPECT_EQ(reports_of(backwards), 0);
  backwards.frames = {3866, 3900};
  EXPECT_EQ(render_silently(backwards).frame_count, 35);
  backwards.output = path("back.wav");  // the volume depends on earlier frames
  EXPECT_EQ(reports_of(backwards), 0);
}

TEST_F(RenderTest, AStillIsTheFrameOfItsInstant) {
  const Scene slow = scene_with({{"view.size", "640x360"},
                                 {"time.from", "3.5"},
                                 {"time.to", "3.51"},
                                 {"time.slow-motion", "turn-0.1:turn+0.1:10"}});
  for (const Scene& shown : {scene("3.5", "3.51"), slow}) {
    render_silently({shown, path("frame%d.png"), {}, 1});
    render_still(shown, Rational(7, 2), path("still.png"));
    EXPECT_EQ(read_png(path("frame1.png")).words, read_png(path("still.png")).words);
  }
}

}  // namespace
}  // namespace piblocks
