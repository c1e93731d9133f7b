// Some frames of a film rendered alone: what they are in the whole.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <filesystem>

#include "rendered_parts.hpp"
#include "support/decode_video.hpp"
#include "support/message_of.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"
#include "support/traced_random.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::file_contents;
using testing_support::TemporaryFolder;

constexpr std::int64_t kFrames = 75;

/// A card, a fade, a run with a clack at every collision.
Script script() {
  return testing_support::script_of(
      "view.size = '64x36'\nview.fps = 15\nsound.on = true\n[[part]]\ncard = 'a'\nseconds = 2\n"
      "[[part]]\nfade = 0.5\ndigits = 2\ntime.duration = 3.5\n");
}

class FrameRangeTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  Rendered render_frames(const std::string& name, const std::optional<FrameRange>& frames,
                         std::optional<int> start_number = {}) const {
    RenderJob job{script(), path(name)};
    job.frames = frames;
    job.encoder.start_number = start_number;
    job.jobs = 2;
    return render_silently(job);
  }
  FrameRange random_range() {
    const std::int64_t first = random_.integer(0, kFrames - 1);
    return {first, random_.integer(first, kFrames - 1)};
  }

  TemporaryFolder folder_;
  TracedRandom random_{20261128};
};

TEST_F(FrameRangeTest, OfASequenceReplacesItsOwnPicturesAndNoOthers) {
  for (const std::optional<int> start :
       {std::optional<int>(), std::optional(0), std::optional(7)}) {
    fs::remove_all(path("f"));
    ASSERT_EQ(render_frames("f/%02d.png", {}, start).frame_count, kFrames);
    const auto whole = files_in(path("f"));
    for (int round = 0; round < 8; ++round) {
      const FrameRange range = random_range();
      SCOPED_TRACE(random_.trace());
      auto marked = whole;
      for (auto& [name, contents] : marked) {  // they stay pictures of a sequence
        contents += "old";
        folder_.save("f/" + name, contents);
      }
      EXPECT_EQ(render_frames("f/%02d.png", range, start).frame_count, range.count());
      for (std::int64_t k = range.first; k <= range.last; ++k) {
        const std::string name = fmt::format("{:02}.png", start.value_or(1) + k);
        marked.at(name) = whole.at(name);
      }
      EXPECT_TRUE(files_in(path("f")) == marked);
    }
  }
}

TEST_F(FrameRangeTest, IsAFilmOfTheSameSamples) {
  constexpr std::size_t kHeader = 44;  // of a WAV file
  constexpr std::size_t kPair = 6;
  constexpr std::size_t kFrame_pairs = 48000 / 15;
  constexpr std::size_t kFade_pairs = 48000 / 200;  // at a cut
  render_frames("a.wav", {});
  const std::string sound = file_contents(path("a.wav"));
  ASSERT_EQ(sound.size(), kHeader + kFrames * kFrame_pairs * kPair);
  render_frames("a.y4m", {});
  const std::string pictures = file_contents(path("a.y4m"));
  const std::size_t header = pictures.find('\n') + 1;
  const std::size_t frame = (pictures.size() - header) / kFrames;
  for (int round = 0; round < 6; ++round) {
    const FrameRange range = random_range();
    SCOPED_TRACE(random_.trace());
    const auto first = std::size_t(range.first);
    const auto count = std::size_t(range.count());
    render_frames("b.wav", range);
    const std::string part = file_contents(path("b.wav")).substr(kHeader);
    ASSERT_EQ(part.size(), count * kFrame_pairs * kPair);
    const std::size_t equal = part.size() - kFade_pairs * kPair;
    EXPECT_TRUE(part.substr(0, equal) ==
                sound.substr(kHeader + first * kFrame_pairs * kPair, equal));
    render_frames("b.y4m", range);
    EXPECT_TRUE(file_contents(path("b.y4m")).substr(header) ==
                pictures.substr(header + first * frame, count * frame));
    EXPECT_EQ(render_frames("b.mp4", range).frame_count, range.count());
    EXPECT_EQ(testing_support::decode_video(path("b.mp4")).frames.size(), count);
  }
}

TEST_F(FrameRangeTest, IsWithinTheFilm) {
  for (const FrameRange range : {FrameRange{0, kFrames}, {-1, 3}, {5, 4}, {kFrames, kFrames}}) {
    EXPECT_EQ(testing_support::message_of<UsageError>([&] { render_frames("a.y4m", range); }),
              fmt::format("frames: there are no frames {}-{}; those of the film are 0-74",
                          range.first, range.last));
  }
  RenderJob job{script(), path("a.mp4")};
  job.frames = {1, 2};
  job.shard = {1, 2};
  EXPECT_THROW(render_silently(job), UsageError);
  EXPECT_TRUE(folder_.is_empty());
}

}  // namespace
}  // namespace piblocks
