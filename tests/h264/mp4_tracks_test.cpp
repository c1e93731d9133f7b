// Tracks of sound and captions beside the pictures of an MP4 file.
#include <gtest/gtest.h>

#include "h264/invented_pictures.hpp"

namespace piblocks::h264 {
namespace {

using testing_support::message_of;

/// 48000 samples a second, as an AAC encoder with a delay of 1024 makes them.
Mp4Sound sound_of(std::int64_t samples) {
  return {.rate_hz = 48000,
          .config = {0x11, 0x90, 0x56, 0xe5, 0},
          .packet_samples = 1024,
          .delay = 1024,
          .samples = samples};
}

ByteVector packet_of(std::int64_t number) {
  return ByteVector(std::size_t(5 + number % 31), std::uint8_t(number));
}

struct SoundCase {
  std::int64_t pictures;
  std::int64_t samples;
  std::int64_t ahead;  ///< packets that are appended before the picture that needs them
};

class Mp4SoundTrack : public testing::TestWithParam<SoundCase> {};

TEST_P(Mp4SoundTrack, HasEveryPacketBeforeTheSecondOfPicturesThatFollows) {
  const auto [pictures, samples, ahead] = GetParam();
  Mp4Track track = track_of(pictures);
  track.sound = sound_of(samples);
  track.captions = {{0, "at once"}, {pictures / 2, "two\nlines, π"}};
  if (pictures == 1) track.captions.pop_back();
  Mp4Memory file;
  Mp4Writer writer(track, file.writer());
  const std::int64_t packets = (1024 + samples + 1023) / 1024;
  std::int64_t next = 0;
  for (std::int64_t i = 0; i < pictures; ++i) {
    for (; next < packets && (next - ahead) * 1024 * 60 <= i * 48000; ++next) {
      writer.append_sound(packet_of(next));
    }
    writer.append(after(kStartCode, unit_of(i, is_idr(i))), is_idr(i));
  }
  for (; next < packets; ++next) writer.append_sound(packet_of(next));
  writer.finish();

  const Mp4Boxes boxes(file.bytes(), file.size);
  expect_only_free_holes(file, boxes);
  const auto expect_bytes = [&](const Sample& sample, const ByteVector& bytes) {
    ASSERT_EQ(sample.size, bytes.size());
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(),
                           file.bytes().begin() + std::ptrdiff_t(sample.offset)));
  };
  const std::vector<Sample> units = samples_of(boxes);
  ASSERT_EQ(std::ssize(units), pictures);
  for (std::int64_t i = 0; i < pictures; ++i) {
    const ByteVector unit = unit_of(i, is_idr(i));
    expect_bytes(units[std::size_t(i)], after({0, 0, 0, std::uint8_t(unit.size())}, unit));
  }
  const std::vector<Sample> sounds = samples_of(boxes, tables_of("moov/trak'"));
  ASSERT_EQ(std::ssize(sounds), packets);
  for (std::int64_t i = 0; i < packets; ++i) expect_bytes(sounds[std::size_t(i)], packet_of(i));
  // What was there when a second of pictures began is in front of it.
  for (std::int64_t second = 0; second * 60 < pictures; ++second) {
    const std::int64_t there = std::min(packets - 1, second * 48000 / 1024 + ahead);
    EXPECT_LT(sounds[std::size_t(there)].offset, units[std::size_t(second * 60)].offset);
  }
  // No sample shares a byte with another one, and together they fill mdat.
  std::vector<Sample> all = samples_of(boxes, tables_of("moov/trak''"));
  EXPECT_EQ(all.size(), track.captions.size());
  all.insert(all.end(), units.begin(), units.end());
  all.insert(all.end(), sounds.begin(), sounds.end());
  std::ranges::sort(all, {}, &Sample::offset);
  std::uint64_t at = boxes.starts.at("mdat");
  for (const Sample& sample : all) {
    ASSERT_EQ(sample.offset, at);
    at += sample.size;
  }
  EXPECT_EQ(at, file.size);

  // 15360 units of the movie a second; it is as long as the longer track.
  const std::uint64_t heard = std::uint64_t(samples * 15360 + 47999) / 48000;
  EXPECT_EQ(number_at(boxes.at("moov/mvhd"), 16), std::max(heard, std::uint64_t(pictures * 256)));
  EXPECT_EQ(number_at(boxes.at("moov/mvhd"), 96), 4u) << "the next track";
  EXPECT_EQ(number_at(boxes.at("moov/trak/tkhd"), 12), 1u);
  EXPECT_EQ(number_at(boxes.at("moov/trak'/tkhd"), 12), 2u);
  EXPECT_EQ(number_at(boxes.at("moov/trak''/tkhd"), 12), 3u);
  EXPECT_EQ(number_at(boxes.at("moov/trak'/edts/elst"), 8), heard);
  EXPECT_EQ(number_at(boxes.at("moov/trak'/edts/elst"), 12), 1024u) << "the delay is left out";
  EXPECT_EQ(number_at(boxes.at("moov/trak'/mdia/mdhd"), 16), std::uint64_t(1024 + samples));
  const ByteVector times = boxes.at(tables_of("moov/trak'") + "stts");
  std::uint64_t sum = 0;
  for (std::size_t run = 8; run < times.size(); run += 8) {
    sum += number_at(times, run) * number_at(times, run + 4);
  }
  EXPECT_EQ(sum, std::uint64_t(1024 + samples));
}

INSTANTIATE_TEST_SUITE_P(All, Mp4SoundTrack,
                         testing::Values(SoundCase{1, 800, 0}, SoundCase{60, 48000, 0},
                                         SoundCase{61, 48800, 60}, SoundCase{500, 400000, 3},
                                         SoundCase{500, 400001, 0}, SoundCase{90, 30000, 1},
                                         SoundCase{30, 1'000'000, 0}));

/// The identification header of an encoder with a delay of 312 samples.
ByteVector opus_header() {
  return {'O', 'p', 'u', 's', 'H', 'e', 'a', 'd', 1, 2, 0x38, 1, 0x80, 0xbb, 0, 0, 0x34, 0x12, 0};
}

TEST(Mp4Tracks, OfOpusSayWhatItsDecoderNeeds) {
  Mp4Track track = track_of(60);
  track.sound = {.codec = Mp4SoundCodec::opus,
                 .rate_hz = 48000,
                 .config = opus_header(),
                 .packet_samples = 960,
                 .delay = 312,
                 .samples = 48000};
  Mp4Memory file;
  Mp4Writer writer(track, file.writer());
  append_pictures(writer, 60);
  for (std::int64_t i = 0; i < 51; ++i) writer.append_sound(packet_of(i));
  writer.finish();
  const Mp4Boxes boxes(file.bytes(), file.size);
  const std::string tables = tables_of("moov/trak'");
  const ByteVector entry = boxes.at(tables + "stsd");
  EXPECT_EQ(std::string(entry.begin() + 12, entry.begin() + 16), "Opus");
  const ByteVector expected = {0, 0,    0, 19, 'd',  'O',  'p',  's',  0, 2,
                               1, 0x38, 0, 0,  0xbb, 0x80, 0x12, 0x34, 0};
  EXPECT_TRUE(std::ranges::equal(std::span(entry).subspan(8 + 36), expected));
  EXPECT_EQ(number_at(boxes.at(tables + "sgpd"), 16, 2), 0x10000 - 4u) << "80 ms before";
  EXPECT_EQ(number_at(boxes.at("moov/trak'/edts/elst"), 12), 312u);

  const std::string problem =
      "h264: Opus of an MP4 file has no header of two channels in mapping family 0, or not 48000 "
      "Hz";
  track.sound->rate_hz = 24000;
  EXPECT_EQ(problem_of(track), problem);
  track.sound->rate_hz = 48000;
  EXPECT_EQ(problem_of(track), "");
  track.sound->config.back() = 1;
  EXPECT_EQ(problem_of(track), problem);
  track.sound->config = {0x11, 0x90};
  EXPECT_EQ(problem_of(track), problem);
}

TEST(Mp4Tracks, ShowCaptionsFromPictureToPicture) {
  Mp4Track track = track_of(100);
  track.captions = {{10, "first"}, {25, ""}, {99, "π"}};
  Mp4Memory file;
  Mp4Writer writer(track, file.writer());
  append_pictures(writer, 100);
  writer.finish();
  const Mp4Boxes boxes(file.bytes(), file.size);
  const std::string tables = tables_of("moov/trak'");
  std::vector<std::string> texts;
  for (const Sample& sample : samples_of(boxes, tables)) {
    const auto begin = file.bytes().begin() + std::ptrdiff_t(sample.offset);
    EXPECT_EQ(number_at(file.bytes(), sample.offset, 2), sample.size - 2);
    texts.emplace_back(begin + 2, begin + std::ptrdiff_t(sample.size));
  }
  EXPECT_EQ(texts, (std::vector<std::string>{"", "first", "", "π"}));
  const ByteVector times = boxes.at(tables + "stts");
  std::vector<std::uint64_t> durations;
  for (std::size_t run = 8; run < times.size(); run += 8) {
    EXPECT_EQ(number_at(times, run), 1u);
    durations.push_back(number_at(times, run + 4) / 256);
  }
  EXPECT_EQ(durations, (std::vector<std::uint64_t>{10, 15, 74, 1}));
}

TEST(Mp4Tracks, AreRefusedByWhatIsWrong) {
  const auto problem = [](auto&& change) {
    Mp4Track track = track_of(10);
    track.sound = sound_of(8000);
    change(track);
    return problem_of(track);
  };
  EXPECT_EQ(problem([](Mp4Track&) {}), "");
  EXPECT_EQ(problem([](Mp4Track& track) { track.sound->rate_hz = 96000; }),
            "h264: sound.rate_hz of an MP4 file is 96000, not in [1, 65535]");
  EXPECT_EQ(problem([](Mp4Track& track) { track.sound->samples = 0; }),
            "h264: sound.samples of an MP4 file is 0, not in [1, 140737488355328]");
  EXPECT_EQ(problem([](Mp4Track& track) { track.sound->config.clear(); }),
            "h264: the size of sound.config of an MP4 file is 0, not in [1, 64]");
  const std::string order =
      "h264: captions of an MP4 file are not in order, or begin after its end";
  EXPECT_EQ(problem([](Mp4Track& track) { track.captions = {{10, "late"}}; }), order);
  EXPECT_EQ(problem([](Mp4Track& track) { track.captions = {{-1, "early"}}; }), order);
  EXPECT_EQ(problem([](Mp4Track& track) { track.captions = {{3, "a"}, {3, "b"}}; }), order);
  EXPECT_EQ(problem([](Mp4Track& track) {
              track.captions = {{3, std::string(65536, 'a')}};
            }),
            "h264: the size of a caption + 1 of an MP4 file is 65537, not in [1, 65536]");

  Mp4Memory file;
  Mp4Writer silent(track_of(1), file.writer());
  EXPECT_EQ(message_of<Error>([&] { silent.append_sound(packet_of(0)); }),
            "h264: an MP4 file has no sound");
  Mp4Track track = track_of(1);
  track.sound = sound_of(800);
  Mp4Memory other;
  Mp4Writer writer(track, other.writer());
  append_pictures(writer, 1);
  EXPECT_EQ(message_of<Error>([&] { writer.finish(); }),
            "h264: the sound of an MP4 file is missing");
  for (int i = 0; i < 3; ++i) writer.append_sound(packet_of(i));  // one more than is needed
  EXPECT_EQ(message_of<Error>([&] { writer.append_sound(packet_of(3)); }),
            "h264: an MP4 file has room for 3 packets of sound");
}

}  // namespace
}  // namespace piblocks::h264
