// Sound as a user gets it: in MP4 and WAV, decoded by ffmpeg.
#include <piblocks/two_blocks.hpp>

#include <cmath>
#include <cstring>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

const Arguments kSmallSound{"--theme", "article", "--size", "64x36", "--fps", "10", "--quiet"};

class SoundTest : public CliFixture {
 protected:
  /// The left channel, decoded.
  std::vector<float> left(const std::string& name) const {
    const std::string bytes =
        shell("ffmpeg -nostdin -v error -i " + name + " -f f32le -c:a pcm_f32le -");
    std::vector<float> left(bytes.size() / 8);
    for (std::size_t i = 0; i < left.size(); ++i) std::memcpy(&left[i], bytes.data() + 8 * i, 4);
    return left;
  }
  /// What ffprobe says of a stream, audio or video.
  std::string about(char stream, const std::string& entries, const std::string& name) const {
    return shell(std::string("ffprobe -v error -select_streams ") + stream +
                 " -show_entries stream=" + entries + " -of default=nk=1:nw=1 " + name);
  }
  /// The values that ffmpeg gives one of the metadata, frame by frame.
  std::vector<double> values(const std::string& name, const std::string& filter,
                             const std::string& key) const {
    const std::string text = shell("ffmpeg -nostdin -v error -i " + name + " -af '" + filter +
                                   ",ametadata=print:key=" + key + ":file=-' -f null -");
    std::vector<double> values;
    for (const std::string& line : lines(text)) {
      if (line.starts_with(key)) values.push_back(std::stod(line.substr(key.size() + 1)));
    }
    return values;
  }
  /// The momentary loudness, of 0.4 s, where it is highest.
  double loudest_LUFS(const std::string& name) const {
    return std::ranges::max(values(name, "ebur128=metadata=1", "lavfi.r128.M"));
  }
  double level_db(const std::string& name, const std::string& filter) const {
    return values(name, filter + ",astats=metadata=1", "lavfi.astats.Overall.RMS_level").back();
  }
  double peak_db(const std::string& name) const {
    const std::string text =
        shell("ffmpeg -nostdin -hide_banner -i " + name + " -af ebur128=peak=true -f null - 2>&1");
    const std::size_t at = text.rfind("Peak:");
    return at == std::string::npos ? 99 : std::stod(text.substr(at + 5));
  }
};

/// By how much `other` is late, looked for in a window.
int lag(const std::vector<float>& one, const std::vector<float>& other, std::size_t begin,
        std::size_t end) {
  constexpr int kMost = 12;
  int best = -kMost;
  double highest = -HUGE_VAL;
  for (int shift = -kMost; shift <= kMost; ++shift) {
    double sum = 0;
    for (std::size_t i = std::max<std::size_t>(begin, kMost); i < end; ++i) {
      sum += double(one[i]) * double(other[std::size_t(std::int64_t(i) + shift)]);
    }
    if (sum > highest) best = shift;
    highest = std::max(highest, sum);
  }
  return best;
}

/// Each clack is where it is in the sound alone, to a sample.
void expect_in_place(const std::vector<float>& sound, const std::vector<float>& decoded,
                     int digits) {
  const auto log = make_pair_log(article_blocks(digits));
  for (Integer index = 1; index <= log->last(); ++index) {
    const auto at = std::size_t(log->blocks_collision(index).time.hi * 48000);
    EXPECT_LE(std::abs(lag(sound, decoded, at - 50, at + 400)), 1) << index.get_str();
  }
}

TEST_F(SoundTest, ClacksOfTheVideoAreWhereThoseOfTheSoundAloneAre) {
  for (const std::string digits : {"1", "2", "3"}) {
    output_of(Arguments{"render", "--sound", "--digits", digits, "-o", "a.mp4"} + kSmallSound);
    output_of(Arguments{"render", "--digits", digits, "-o", "a.wav"} + kSmallSound);
    const std::vector<float> sound = left("a.wav");
    const std::vector<float> decoded = left("a.mp4");
    ASSERT_GE(decoded.size(), sound.size());
    expect_in_place(sound, decoded, std::stoi(digits));
    EXPECT_EQ(lag(sound, decoded, 0, sound.size() - 20), 0);
  }
}

TEST_F(SoundTest, IsInPlaceInEveryKindOfVideo) {
  output_of(Arguments{"render", "--digits", "2", "-o", "a.wav"} + kSmallSound);
  const std::vector<float> sound = left("a.wav");
  for (const auto& [name, codec] : {std::pair{"a.mp4", "aac"},
                                    {"a.mov", "aac"},
                                    {"a.webm", "opus"},
                                    {"clear.mov", "pcm_s24le"},
                                    {"clear.webm", "opus"}}) {
    Arguments render{"render", "--sound", "--digits", "2", "-o", name};
    if (std::string(name).starts_with("clear")) render.emplace_back("--transparent");
    output_of(render + kSmallSound);
    EXPECT_EQ(about('a', "codec_name", name), std::string(codec) + "\n");
    EXPECT_EQ(about('v', "start_time", name), "0.000000\n") << name;
    const std::vector<float> decoded = left(name);
    ASSERT_GE(decoded.size() + 20, sound.size()) << name;
    SCOPED_TRACE(name);
    expect_in_place(sound, decoded, 2);
  }
}

TEST_F(SoundTest, OfProresIsThatOfWav) {
  output_of(Arguments{"render", "--digits", "2", "-o", "a.wav"} + kSmallSound);
  output_of(Arguments{"render", "--sound", "--digits", "2", "--transparent", "-o", "a.mov"} +
            kSmallSound);
  for (const std::string name : {"a.wav", "a.mov"}) {
    shell("ffmpeg -v error -i " + name + " -vn -f s24le " + name + ".raw");
  }
  EXPECT_GT(contents("a.wav.raw").size(), 6U * 48000);
  EXPECT_TRUE(contents("a.wav.raw") == contents("a.mov.raw"));
}

TEST_F(SoundTest, BeginsWithTheVideoAndLastsAsLong) {
  output_of(Arguments{"render", "--sound", "-o", "a.mp4"} + kSmallSound);
  const std::string audio =
      about('a', "start_time,codec_name,channels,sample_rate,duration", "a.mp4");
  EXPECT_EQ(lines(audio).front(), "aac");
  EXPECT_TRUE(contains(audio, "\n48000\n2\n0.000000\n"));
  const std::string video = about('v', "start_time,duration", "a.mp4");
  EXPECT_NEAR(std::stod(lines(audio).back()), std::stod(lines(video).back()), 0.002);
}

/// The sound of a second is in front of its pictures.
TEST_F(SoundTest, PacketsTakeTurnsWithPictures) {
  output_of(Arguments{"render", "--sound", "-o", "a.mp4"} + kSmallSound);
  const std::string packets =
      shell("ffprobe -v error -show_entries packet=codec_type,dts_time,pos -of csv=p=0 a.mp4");
  std::vector<std::pair<std::int64_t, double>> by_place;
  for (const std::string& line : lines(packets)) {
    const std::vector<std::string> values = split(line, ',');
    if (values.size() < 3) continue;  // what is said of a packet besides
    by_place.emplace_back(std::stoll(values.at(2)), std::stod(values.at(1)));
  }
  std::ranges::sort(by_place);
  ASSERT_GT(by_place.size(), 700u);
  for (std::size_t i = 1; i < by_place.size(); ++i) {
    EXPECT_GT(by_place[i].second, by_place[i - 1].second - 1.1);
  }
}

TEST_F(SoundTest, StaysBelowFullScaleForFfmpegToo) {
  for (const std::string digits : {"1", "3", "6", "20"}) {
    output_of(Arguments{"render", "--sound", "--digits", digits, "-o", "a.mp4"} + kSmallSound);
    output_of(Arguments{"render", "--digits", digits, "-o", "a.wav"} + kSmallSound);
    EXPECT_LE(peak_db("a.wav"), -2.4) << digits;
    EXPECT_LE(peak_db("a.mp4"), -1.3) << digits;
  }
}

TEST_F(SoundTest, IsNeverTooLoud) {
  write("four.toml",
        "[[part]]\ncompare = [{digits = 4}, {digits = 5}, {digits = 6}, {digits = 7}]\n");
  std::vector<Arguments> scenes = {
      {"two-walls"}, {"gas"}, {"why-pi"}, {"real-blocks"}, {"four.toml"}};
  for (const char* digits : {"1", "2", "3", "5", "10", "20"}) {
    scenes.push_back({"--digits", digits});
    // As dense as low tones for seconds.
    scenes.push_back({"--digits", digits, "--from", "3", "--to", "4", "--speed", "1/10"});
  }
  for (const Arguments& scene : scenes) {
    output_of(Arguments{"render", "--quiet", "-o", "a.wav"} + scene);
    EXPECT_LT(loudest_LUFS("a.wav"), -16) << scene.back();
    EXPECT_LT(peak_db("a.wav"), -1) << scene.back();
  }
}

/// Up to 100 a second, and in AAC, too.
TEST_F(SoundTest, HasNoClackThatIsTooQuiet) {
  for (const std::string digits : {"1", "2", "3"}) {
    output_of(Arguments{"render", "--sound", "--digits", digits, "-o", "a.mp4"} + kSmallSound);
    const std::vector<float> sound = left("a.mp4");
    const auto log = make_pair_log(article_blocks(std::stoi(digits)));
    std::vector<double> samples;
    for (Integer index = 1; index <= log->last(); ++index) {
      samples.push_back(log->blocks_collision(index).time.hi * 48000);
    }
    for (const double sample : samples) {
      const auto crowd = std::ranges::count_if(
          samples, [&](double other) { return std::fabs(other - sample) <= 2400; });
      if (crowd > 10) continue;
      float peak = 0;
      for (std::size_t i = std::size_t(sample) - 2; i < std::size_t(sample) + 20; ++i) {
        peak = std::max(peak, std::fabs(sound[i]));
      }
      EXPECT_GE(20 * std::log10(peak), -14) << digits << " digits at " << sample;
    }
  }
}

/// Of 20 digits, at the rates above 200 a second.
TEST_F(SoundTest, OfASwarmIsABuzzAndNoHiss) {
  output_of({"render", "--digits", "20", "--quiet", "-o", "a.wav"});
  const std::string swarm = "atrim=3.42:3.58";
  const double treble = level_db("a.wav", swarm + ",highpass=f=8000,highpass=f=8000");
  EXPECT_LT(treble, level_db("a.wav", swarm) - 40);
}

TEST_F(SoundTest, IsAKeyOfTheScene) {
  write("scene.toml", "[sound]\non = true\n");
  output_of(Arguments{"render", "scene.toml", "--to", "1", "-o", "on.mp4"} + kSmallSound);
  output_of(Arguments{"render", "scene.toml", "--no-sound", "--to", "1", "-o", "off.mp4"} +
            kSmallSound);
  EXPECT_TRUE(contains(contents("on.mp4"), "mp4a"));
  EXPECT_FALSE(contains(contents("off.mp4"), "mp4a"));
  output_of(Arguments{"render", "--to", "1", "-o", "plain.mp4"} + kSmallSound);
  EXPECT_TRUE(contents("off.mp4") == contents("plain.mp4"));
  write("scene.toml", "[sound]\non = 1\n");
  expect_refusal({"render", "scene.toml", "-o", "a.mp4"}, "sound.on = 1: must be true or false");
}

/// That of a scene is left out, so that one scene makes all outputs; --sound asks for what cannot
/// be.
TEST_F(SoundTest, IsLeftOutWhereItHasNoPlace) {
  write("scene.toml", "[sound]\non = true\n[time]\nto = 1\n[view]\nfps = 5\nsize = '64x36'\n");
  for (const std::string output :
       {"a.y4m", "-", "null", "a.framehash", "%d.png", "a.gif", "a.apng", "a.webp"}) {
    SCOPED_TRACE(output);
    const std::string asked = refusal({"render", "--sound", "-o", output});
    EXPECT_TRUE(
        asked.starts_with("piblocks: --sound: '" + output + "' has no sound; write one of: *.mp4"))
        << asked;
    const CommandResult loud = piblocks({"render", "scene.toml", "-o", output});
    EXPECT_EQ(loud.exit_code, 0) << loud.err;
    const std::string note =
        "piblocks: note: '" + output + "' has no sound; that of the scene is left out\n";
    EXPECT_EQ(count_of(loud.err, note), 1U) << loud.err;
    const std::string file = output == "%d.png" ? "3.png" : output;
    const bool is_file = file.find('.') != std::string::npos;
    const std::string written = is_file ? contents(file) : loud.out;
    const CommandResult silent =
        piblocks({"render", "scene.toml", "--no-sound", "--quiet", "-o", output});
    EXPECT_EQ(silent.err, "");
    EXPECT_TRUE(written == (is_file ? contents(file) : silent.out));
    EXPECT_EQ(piblocks({"render", "scene.toml", "--quiet", "-o", output}).err, "");
    if (output == "null" || output == "-") continue;
    for (const char* part : {"1/2", "2/2"}) {
      output_of({"render", "scene.toml", "--quiet", "--part", part, "-o", output});
    }
    output_of({"join", "--quiet", output + ".part-1-of-2", output + ".part-2-of-2", "-o", output});
    EXPECT_TRUE(contents(file) == written);
  }
}

TEST_F(SoundTest, AloneIsAllThereIs) {
  refusal({"render", "--part", "1/2", "-o", "a.wav"});
  refusal({"render", "--crf", "20", "-o", "a.wav"});
  EXPECT_EQ(refusal({"render", "--no-sound", "-o", "a.wav"}),
            "piblocks: --no-sound: 'a.wav' is the sound alone; leave one of them out\n");
}

TEST_F(SoundTest, AloneLoadsNoCodecsAndTakesLittleMemory) {
  // Ten minutes of film.
  const Arguments render{"render", "--digits", "9",  "--duration", "600",
                         "--fps",  "1",        "-o", "a.wav",      "--quiet"};
  const CommandResult result = piblocks(render, {.environment = {"LD_DEBUG=files"}});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_FALSE(contains(result.err, "libavcodec"));
  if (testing_support::kTellsMemory) {
    EXPECT_LT(result.max_memory_KiB, 64 * 1024);
  }
  EXPECT_EQ(std::filesystem::file_size(folder_ / "a.wav"), 44u + 600u * 48000u * 6u);
}

/// What only the picture would need is neither made nor asked for.
TEST_F(SoundTest, AloneNeedsNoPicture) {
  const Arguments wav{"render", "--digits", "2", "--quiet", "-o", "a.wav"};
  output_of(wav);
  const std::string sound = contents("a.wav");
  output_of(wav + Arguments{"--logo", "missing.png", "--size", "64x36", "--show", "velocities",
                            "--max-flashes", "3"});
  EXPECT_EQ(contents("a.wav"), sound);
}

}  // namespace
}  // namespace piblocks
