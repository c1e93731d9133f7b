#include <gtest/gtest.h>
#include <piblocks/encode.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>

#include "draw/composed_pictures.hpp"
#include "media/libav/av_module.hpp"
#include "media/mp4/coded_sound.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"
#include "rendered_parts.hpp"
#include "support/contains.hpp"
#include "support/message_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::contains;
using testing_support::file_contents;
using testing_support::TemporaryFolder;

class JoinTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  /// Five seconds of video, with one thing changed.
  static Scene scene(const std::string& key = "time.from", const std::string& value = "1") {
    return scene_with(
        {{"view.size", "64x36"}, {"view.fps", "24"}, {"time.to", "6"}, {key.c_str(), value}});
  }

  std::string problem(const std::vector<std::string>& parts, const std::string& output) const {
    try {
      join(parts, path(output));
    } catch (const UsageError& error) {
      EXPECT_FALSE(fs::exists(path(output)));
      return error.what();
    }
    return "none";
  }

  TemporaryFolder folder_;
};

TEST_F(JoinTest, GivesTheBytesOfASingleRun) {
  for (const std::string name :
       {"a.mp4", "a.y4m", "a.framehash", "a.gif", "a.apng", "a.webp", "%03d.png"}) {
    render_silently({scene(), path("whole/" + name)});
    for (const int count : {1, 3, 40}) {
      RenderJob job{scene(), path("parts/" + name)};
      job.jobs = count % 3 + 1;
      std::vector<std::string> parts = rendered_parts(count, job);
      std::ranges::rotate(parts, parts.begin() + count / 2);
      EXPECT_EQ(join(parts, path("joined/" + name)).frame_count, 120);
      EXPECT_EQ(files_in(path("joined")) == files_in(path("whole")), true) << name << ' ' << count;
      fs::remove_all(path("joined"));
    }
    fs::remove_all(path("whole"));
  }
}

/// What our own film's encoder makes of the sound, and three packets too many.
std::shared_ptr<CodedSound> coded_sound_of(const Scene& scene) {
  const Film film(scene, {FilmUse::audio_only});
  const SoundFormat format = sound_format(film.frames(), film.view().frame_rate);
  const AacSound encoder = av_module().aac_sound(format);
  auto coded = std::make_shared<CodedSound>();
  coded->track = encoder.track;
  coded->track.samples = 0;
  FilmSound samples(film, film.frames(), {}, [](std::int64_t) {});
  const auto packets = encoder.encode(samples);
  while (auto packet = packets->next()) coded->packets.push_back(std::move(packet->bytes));
  coded->packets.resize(coded->packets.size() + 3, {1});
  return coded;
}

TEST_F(JoinTest, AddsSoundThatWasEncodedElsewhere) {
  Scene heard = scene("sound.on", "true");
  render_silently({heard, path("whole.mp4")});
  const auto parts = rendered_parts(3, {scene("sound.on", "false"), path("part.mp4")});
  const auto sound = coded_sound_of(heard);
  EXPECT_EQ(join_with_sound(parts, path("joined.mp4"), sound).frame_count, 144);
  EXPECT_TRUE(file_contents(path("joined.mp4")) == file_contents(path("whole.mp4")));

  sound->packets.resize(100);
  EXPECT_EQ(testing_support::message_of<MediaError>(
                [&] { join_with_sound(parts, path("short.mp4"), sound); }),
            "sound: cannot write to '" + path("short.mp4") + "': the end of the sound is missing");
  EXPECT_FALSE(fs::exists(path("short.mp4")));
}

TEST_F(JoinTest, TakesMoreFilesThanMayBeOpen) {
  const auto parts = rendered_parts(40, {scene(), path("a.y4m")});
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  const rlimit few{20, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &few);
  EXPECT_EQ(join(parts, path("b.y4m")).frame_count, 120);
  ::setrlimit(RLIMIT_NOFILE, &before);
}

TEST_F(JoinTest, NeedsEveryPartOnce) {
  const auto parts = rendered_parts(3, {scene(), path("a.mp4")});
  EXPECT_EQ(problem({}, "b.mp4"), "join: no parts are given");
  EXPECT_EQ(problem({parts[2], parts[0]}, "b.mp4"), "join: part 2 of 3 is missing");
  EXPECT_EQ(problem({parts[1]}, "b.mp4"),
            "join: part 1 of 3 is missing\njoin: part 3 of 3 is missing");
  EXPECT_TRUE(
      contains(problem({parts[0], parts[1], parts[2], parts[0]}, "b.mp4"), "both part 1 of 3"));
}

TEST_F(JoinTest, RefusesPartsOfDifferentJobs) {
  const RenderJob job{scene(), path("a.mp4")};
  const std::string one = rendered_part({1, 2}, job);
  const auto difference = [&](RenderJob other) {
    other.output = path("b.mp4");
    return problem({one, rendered_part({2, 2}, other)}, "c.mp4");
  };
  EXPECT_EQ(difference(job), "none");
  fs::remove(path("c.mp4"));
  const auto ends_with = [&](const RenderJob& other, const std::string& what) {
    const std::string said = difference(other);
    return said.ends_with("they differ in " + what) ? testing::AssertionSuccess()
                                                    : testing::AssertionFailure() << said;
  };
  EXPECT_TRUE(ends_with({scene("red.mass", "10001"), {}}, "red.mass"));
  EXPECT_TRUE(ends_with({scene("view.size", "66x36"), {}}, "view.size"));
  EXPECT_TRUE(ends_with({scene("wall.face", "1/2"), {}}, "wall.face"));
  EXPECT_TRUE(ends_with({scene("time.from", "2"), {}}, "time.from"));
  RenderJob longer = job;
  std::get<Scene>(longer.script).time.to.offset += 1;
  EXPECT_TRUE(ends_with(longer, "time.to"));
  EXPECT_TRUE(ends_with({scene(), {}, {.crf = 20}}, "crf"));
  EXPECT_TRUE(contains(problem({one, rendered_part({2, 3}, job)}, "c.mp4"), "number of parts"));
}

TEST_F(JoinTest, TellsLogosApartByWhatIsInTheFile) {
  const auto logo = [this](const std::string& name, std::uint32_t color) {
    const Image image{8, 8, std::vector<std::uint32_t>(64, color)};
    const auto bytes = encode_png(image.view());
    return folder_.save(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  };
  RenderJob job{scene("show.logo", logo("a.png", 0xff00ff00)), path("a.y4m")};
  const std::string one = rendered_part({1, 2}, job);
  logo("a.png", 0xff0000ff);
  EXPECT_TRUE(problem({one, rendered_part({2, 2}, job)}, "b.y4m").ends_with("differ in show.logo"));
  job.script = scene("show.logo", logo("copy.png", 0xff00ff00));
  EXPECT_EQ(problem({one, rendered_part({2, 2}, job)}, "b.y4m"), "none");
}

TEST_F(JoinTest, RefusesAnotherKindOfOutput) {
  const auto parts = rendered_parts(2, {scene(), path("a.y4m")});
  EXPECT_EQ(
      problem(parts, "a.mp4"),
      "join: the parts are of y4m, and '" + path("a.mp4") +
          "' is mp4 by builtin here; choose a name of the kind that they were rendered for, on a "
          "machine with the same libraries");
  EXPECT_TRUE(contains(problem(parts, "a.framehash"), "' is framehash by murmur3 here"));
  const auto videos = rendered_parts(2, {scene(), path("a.mp4")});
  EXPECT_TRUE(problem(videos, "a.y4m").starts_with("join: the parts are of mp4 by builtin, and "));
}

TEST_F(JoinTest, RefusesToReplaceAPart) {
  const auto parts = rendered_parts(1, {scene(), path("a.y4m")});
  fs::rename(parts[0], path("part.y4m"));
  const std::string before = file_contents(path("part.y4m"));
  EXPECT_THROW(join({path("part.y4m")}, path("part.y4m")), UsageError);
  EXPECT_TRUE(file_contents(path("part.y4m")) == before);
}

TEST_F(JoinTest, LeavesNoTraceOfADamagedPart) {
  const auto parts = rendered_parts(2, {scene(), path("a.mp4")});
  fs::resize_file(parts[1], fs::file_size(parts[1]) / 2);
  EXPECT_THROW(join(parts, path("new/a.mp4")), IoError);
  EXPECT_FALSE(fs::exists(path("new")));
}

TEST_F(JoinTest, RefusesNumbersThatMakeNoSense) {
  const std::string part = rendered_parts(1, {scene(), path("a.y4m")}).front();
  const std::string whole = file_contents(part);
  const auto with = [&](const std::string& line, const std::string& other) {
    std::string text = whole;
    text.replace(text.find(line), line.size(), other);
    return problem({folder_.save("changed", text)}, "b.y4m");
  };
  for (const std::string other : {"0/1", "2/1", "1/0", "-1/1", "1", "1/", "/1", "1/1x", ""}) {
    EXPECT_EQ(with("part: 1/1", "part: " + other),
              "join: '" + path("changed") + "' has the invalid part '" + other + "'");
  }
  for (const std::string other : {"0", "-64", "64/3", "99999999999999999999"}) {
    EXPECT_NE(with("view.width: 64", "view.width: " + other), "none");
  }
  for (const std::string other : {"0", "-24", "fast", "1/0"}) {
    EXPECT_EQ(with("view.fps: 24", "view.fps: " + other),
              "join: '" + path("changed") + "' has the invalid view.fps " + other);
  }
  EXPECT_NE(with("frames: 120", "frames: many"), "none");
  EXPECT_NE(with("frames: 120\n", ""), "none");
}

TEST_F(JoinTest, NoticesAPartWithoutItsLastChunks) {
  const std::string part = rendered_parts(1, {scene(), path("a.framehash")}).front();
  std::string text = file_contents(part);
  text.replace(text.find("frames: 120"), 11, "frames: 121");
  EXPECT_THROW(join({folder_.save("changed", text)}, path("b.framehash")), IoError);
}

TEST_F(JoinTest, APartMustBeOneOfItsCount) {
  RenderJob job{scene(), path("a.y4m")};
  for (const Shard part : {Shard{0, 3}, Shard{4, 3}, Shard{-1, -1}, Shard{1, 0}}) {
    job.shard = part;
    EXPECT_THROW(render_silently(job), UsageError);
  }
  for (const char* name : {"-", "null"}) {
    const RenderJob nameless{scene(), name, {}, 1, Shard{1, 1}};
    EXPECT_THROW(render_silently(nameless), UsageError);
  }
  EXPECT_TRUE(folder_.is_empty());
}

}  // namespace
}  // namespace piblocks
