// MP4 files of invented access units, read by an independent reader of boxes.
#include "h264/mp4_writer.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "h264/encoder.hpp"
#include "h264/mp4_file.hpp"
#include "support/message_of.hpp"

namespace piblocks::h264 {
namespace {

using testing_support::message_of;

/// A sequence parameter set of level 2.0, and a picture parameter set.
const ByteVector kHeaders = {0, 0, 0, 1, 0x67, 66, 0xc0, 20, 0xda, 0, 0, 0, 1, 0x68, 0xce, 0x3c};
constexpr PictureRate kRate = {60, 1};

Mp4Track track_of(std::int64_t max_pictures, PictureRate rate = kRate) {
  return {.width_px = 320,
          .height_px = 180,
          .rate = rate,
          .headers = kHeaders,
          .max_pictures = max_pictures};
}

/// The NAL unit of picture n: of a size of its own.
ByteVector unit_of(std::int64_t number, bool is_idr) {
  ByteVector unit(std::size_t(3 + number % 97), std::uint8_t(1 + number % 255));
  unit[0] = is_idr ? 0x65 : 0x41;
  return unit;
}

/// With bytes before it.
ByteVector after(ByteVector start, const ByteVector& unit) {
  start.insert(start.end(), unit.begin(), unit.end());
  return start;
}

const ByteVector kStartCode = {0, 0, 0, 1};

bool is_idr(std::int64_t number) { return number % 60 == 0; }

void append_pictures(Mp4Writer& writer, std::int64_t pictures) {
  for (std::int64_t i = 0; i < pictures; ++i) {
    writer.append(after(kStartCode, unit_of(i, is_idr(i))), is_idr(i));
  }
}

std::string problem_of(const Mp4Track& track) {
  return message_of<Error>([&] { Mp4Writer(track, [](auto, auto) {}); });
}

/// The file of a stream with these access units.
Mp4Boxes boxes_of(const std::vector<ByteVector>& units, const Mp4Track& track) {
  Mp4Memory file;
  Mp4Writer writer(track, file.writer());
  for (const ByteVector& unit : units) writer.append(unit, &unit == units.data());
  writer.finish();
  return {file.bytes(), file.size};
}

/// Everything but the content of free boxes was written.
void expect_only_free_holes(const Mp4Memory& file, const Mp4Boxes& boxes) {
  std::uint64_t end = 0;
  std::map<std::uint64_t, std::uint64_t> holes;
  for (const auto& [begin, next] : file.written) {
    if (begin != end) holes[end] = begin;
    end = next;
  }
  for (const auto& [begin, hole_end] : holes) {
    const bool is_free =
        (boxes.starts.at("free") == begin && begin + boxes.sizes.at("free") == hole_end) ||
        (boxes.starts.at("free'") == begin && begin + boxes.sizes.at("free'") == hole_end);
    EXPECT_TRUE(is_free) << begin << " to " << hole_end;
  }
}

/// A unit of 2^bits bytes.
ByteVector large_unit(int bits) {
  ByteVector unit(std::size_t{1} << bits, 0xff);
  std::ranges::copy(ByteVector{0, 0, 0, 1, 0x65}, unit.begin());
  return unit;
}

struct Length {
  std::int64_t pictures;
  std::int64_t max_pictures;
};

class Mp4Length : public testing::TestWithParam<Length> {};

TEST_P(Mp4Length, FileHasEveryPicture) {
  const auto [pictures, max_pictures] = GetParam();
  Mp4Memory file;
  Mp4Writer writer(track_of(max_pictures), file.writer());
  append_pictures(writer, pictures);
  writer.finish();

  const Mp4Boxes boxes(file.bytes(), file.size);
  const std::string in_media = "moov/trak/mdia/";
  std::vector<std::string> expected = {
      "ftyp",          "free",           "moov",           "moov/mvhd",
      "moov/trak",     "moov/trak/tkhd", "moov/trak/edts", "moov/trak/edts/elst",
      "moov/trak/mdia"};
  for (const char* box : {"mdhd", "hdlr", "minf", "minf/vmhd", "minf/dinf", "minf/dinf/dref",
                          "minf/stbl", "minf/stbl/stsd", "minf/stbl/stts", "minf/stbl/stss",
                          "minf/stbl/stsc", "minf/stbl/stco", "minf/stbl/stsz"}) {
    if (pictures > 1 || box != std::string("minf/stbl/stss")) expected.push_back(in_media + box);
  }
  expected.insert(expected.end(), {"free'", "mdat"});
  EXPECT_EQ(boxes.order, expected);
  expect_only_free_holes(file, boxes);

  const std::vector<Sample> samples = samples_of(boxes);
  ASSERT_EQ(std::ssize(samples), pictures);
  std::uint64_t at = boxes.starts.at("mdat");
  std::vector<std::size_t> key_frames;
  for (std::int64_t i = 0; i < pictures; ++i) {
    const ByteVector unit = unit_of(i, is_idr(i));
    const ByteVector sample = after({0, 0, 0, std::uint8_t(unit.size())}, unit);
    ASSERT_EQ(samples[std::size_t(i)], (Sample{at, sample.size()})) << i;
    ASSERT_TRUE(std::equal(sample.begin(), sample.end(), file.bytes().begin() + std::ptrdiff_t(at)))
        << i;
    at += sample.size();
    if (is_idr(i)) key_frames.push_back(std::size_t(i));
  }
  EXPECT_EQ(at, file.size);
  if (pictures > 1) {
    EXPECT_EQ(key_frames_of(boxes), key_frames);
  }
  EXPECT_EQ(boxes.at(kTables + "stts").size(), 16u);
  EXPECT_EQ(number_at(boxes.at(kTables + "stts"), 8), std::uint64_t(pictures));
}

INSTANTIATE_TEST_SUITE_P(All, Mp4Length,
                         testing::Values(Length{1, 1}, Length{1, 1000}, Length{59, 60},
                                         Length{60, 60}, Length{61, 61}, Length{120, 5000},
                                         Length{1024, 1024}, Length{1025, 1026}, Length{5000, 5000},
                                         Length{300'000, 300'001}));

/// Sizes come in blocks, and a chunk is at least 245 pictures: 4096 chunks at most.
TEST(Mp4Writer, WritesAMillionPictures) {
  constexpr std::int64_t kPictures = 1'000'000;
  Mp4Memory file;
  Mp4Writer writer(track_of(kPictures), file.writer());
  append_pictures(writer, kPictures);
  writer.finish();
  const Mp4Boxes boxes(file.bytes(), file.size);
  EXPECT_EQ(number_at(boxes.at(kTables + "stsc"), 12), 245u);
  EXPECT_LE(number_at(boxes.at(kTables + "stco"), 4), 4096u);
  EXPECT_LT(file.written.size(), 2000u);
  const std::vector<Sample> samples = samples_of(boxes);
  ASSERT_EQ(std::ssize(samples), kPictures);
  EXPECT_EQ(samples.back().offset + samples.back().size, file.size);
  EXPECT_EQ(file.bytes()[samples[654'321].offset + 5], 1 + 654'321 % 255);
  EXPECT_EQ(key_frames_of(boxes).size(), 16'667u);
}

TEST(Mp4Writer, LeavesOutWhatTheFileSaysElsewhere) {
  const ByteVector delimiter = {0, 0, 0, 1, 9, 0x10};
  const ByteVector information = {0, 0, 1, 6, 5, 1, 7, 0x80};
  const ByteVector slice = {0, 0, 1, 0x65, 1, 2, 0, 0, 3, 1};
  const ByteVector unit = after(after(after(delimiter, kHeaders), information), slice);
  const ByteVector with_zeros = after({0, 0, 0, 0, 1, 0x41, 9}, {0, 0, 0});
  const ByteVector slices = after(slice, {0, 0, 0, 1, 0x65, 3});
  const Mp4Boxes boxes = boxes_of({unit, with_zeros, slices}, track_of(9));
  EXPECT_EQ(boxes.at("mdat"),
            (ByteVector{0, 0, 0, 5, 6,    5, 1, 7,    0x80, 0, 0, 0, 7, 0x65, 1, 2,    0,
                        0, 3, 1, 0, 0,    0, 2, 0x41, 9,  //
                        0, 0, 0, 7, 0x65, 1, 2, 0,    0,    3, 1, 0, 0, 0,    2, 0x65, 3}));
  EXPECT_EQ(samples_of(boxes).size(), 3u);
}

TEST(Mp4Writer, CountsTimeAsLibavformat) {
  struct Case {
    PictureRate rate;
    std::uint64_t scale;
    std::uint64_t units;
  };
  for (const auto& [rate, scale, units] :
       {Case{{60, 1}, 15360, 256}, Case{{30000, 1001}, 30000, 1001}, Case{{1, 1}, 16384, 16384},
        Case{{10'000, 3}, 10'000, 3},
        Case{{2'147'483'647, 2'147'483'647}, 2'147'483'647, 2'147'483'647}}) {
    const Mp4Boxes boxes = boxes_of({{0, 0, 1, 5}, {0, 0, 1, 1}}, track_of(2, rate));
    const bool is_long = 2 * units >= 0xffffffff;
    const ByteVector movie = boxes.at("moov/mvhd");
    const ByteVector media = boxes.at("moov/trak/mdia/mdhd");
    const ByteVector track = boxes.at("moov/trak/tkhd");
    const ByteVector edit = boxes.at("moov/trak/edts/elst");
    EXPECT_EQ(movie[0], is_long ? 1 : 0);
    EXPECT_EQ(number_at(movie, 12), scale);
    EXPECT_EQ(number_at(media, 12), scale);
    EXPECT_EQ(number_at(movie, 16), 2 * units);
    EXPECT_EQ(number_at(media, 16), 2 * units);
    EXPECT_EQ(number_at(track, 20), 2 * units);
    EXPECT_EQ(
        edit,
        (after({0, 0, 0, 0, 0, 0, 0, 1},
               after(ByteVector(edit.begin() + 8, edit.begin() + 12), {0, 0, 0, 0, 0, 1, 0, 0}))));
    EXPECT_EQ(number_at(edit, 8), 2 * units);
    EXPECT_EQ(number_at(boxes.at(kTables + "stts"), 12), units);
  }
}

/// A picture every 36 hours, of 2^31 - 2^14 units.
TEST(Mp4Writer, LongDurationsHave64Bits) {
  constexpr std::uint64_t kUnits = 16384 * 131071ULL;
  const std::vector<ByteVector> units(3, {0, 0, 1, 5});
  const Mp4Boxes boxes = boxes_of(units, track_of(3, {1, 131071}));
  const auto check = [&](const std::string& path, std::size_t at, std::size_t size) {
    const ByteVector content = boxes.at(path);
    EXPECT_EQ(content.size(), size) << path;
    EXPECT_EQ(content[0], 1) << path;
    EXPECT_EQ(number_at(content, at, 8), 3 * kUnits) << path;
  };
  check("moov/mvhd", 24, 112);
  check("moov/trak/tkhd", 28, 96);
  check("moov/trak/mdia/mdhd", 24, 36);
  check("moov/trak/edts/elst", 8, 28);
  EXPECT_EQ(number_at(boxes.at("moov/mvhd"), 20), 16384u);
  EXPECT_EQ(number_at(boxes.at("moov/trak/mdia/mdhd"), 20), 16384u);
  EXPECT_EQ(number_at(boxes.at("moov/trak/tkhd"), 92 - 4), 320u << 16);
  EXPECT_EQ(problem_of(track_of(3, {1, 131072})),
            "h264: rate.denominator of an MP4 file is 131072, not in [1, 131071]");
}

TEST(Mp4Writer, NamesWhatIsOutOfRange) {
  const auto expect = [](auto&& change, const std::string& problem) {
    Mp4Track track = track_of(1);
    change(track);
    EXPECT_EQ(problem_of(track), problem.empty() ? "" : "h264: " + problem);
  };
  expect([](Mp4Track&) {}, "");
  expect([](Mp4Track& track) { track.width_px = 0; },
         "width_px of an MP4 file is 0, not in [1, 65535]");
  expect([](Mp4Track& track) { track.height_px = 65536; },
         "height_px of an MP4 file is 65536, not in [1, 65535]");
  expect([](Mp4Track& track) { track.max_pictures = 0; },
         "max_pictures of an MP4 file is 0, not in [1, 500000000]");
  expect([](Mp4Track& track) { track.max_pictures = 500'000'000; }, "");
  expect([](Mp4Track& track) { track.max_pictures = 500'000'001; },
         "max_pictures of an MP4 file is 500000001, not in [1, 500000000]");
  expect([](Mp4Track& track) { track.rate.numerator = 0; },
         "rate.numerator of an MP4 file is 0, not in [1, 2147483647]");
  expect([](Mp4Track& track) { track.rate.denominator = -1; },
         "rate.denominator of an MP4 file is -1, not in [1, 8388607]");
  const ByteVector start(kHeaders.begin(), kHeaders.begin() + 9);
  expect([&](Mp4Track& track) { track.headers = start; },
         "the headers of an MP4 file lack a parameter set");
  const ByteVector twice = after(kHeaders, kHeaders);
  expect([&](Mp4Track& track) { track.headers = twice; },
         "the headers of an MP4 file have two sets of one type");
  ByteVector high = kHeaders;
  high[5] = 100;
  expect([&](Mp4Track& track) { track.headers = high; },
         "profile_idc of an MP4 file is 100, not 66, 77 or 88");
}

/// An append() that throws changes nothing.
TEST(Mp4Writer, RefusesWhatHasNoRoom) {
  const auto problem = [](Mp4Writer& writer, const ByteVector& unit, bool is_idr) {
    return message_of<Error>([&] { writer.append(unit, is_idr); });
  };
  Mp4Memory file;
  Mp4Writer writer(track_of(2), file.writer());
  EXPECT_THROW(writer.finish(), Error);
  EXPECT_EQ(problem(writer, {}, true),
            "h264: the size of a picture of an MP4 file is 0, not in "
            "[1, 4294967295]");
  EXPECT_EQ(problem(writer, {0, 0, 1, 0x67, 66, 0, 20, 0, 0, 1, 0x65}, true),
            "h264: a picture of an MP4 file comes with other parameter sets");
  EXPECT_EQ(problem(writer, {0, 0, 1, 0x65}, true), "");
  EXPECT_EQ(problem(writer, {0, 0, 1, 0x41}, false), "");
  EXPECT_EQ(problem(writer, {0, 0, 1, 0x41}, false), "h264: an MP4 file has room for 2 pictures");
  writer.finish();
  EXPECT_EQ(Mp4Boxes(file.bytes(), file.size).at("mdat").size(), 10u);
}

/// As many key frames as there is room for, and no more.
TEST(Mp4Writer, FillsTheRoomForKeyFrames) {
  constexpr std::int64_t kKeyFrames = 40;
  for (const std::int64_t announced : {std::int64_t{0}, kKeyFrames}) {
    Mp4Memory file;
    Mp4Track track = track_of(kKeyFrames + 1);
    track.max_key_frames = announced;
    Mp4Writer writer(track, file.writer());
    for (std::int64_t i = 0; i <= kKeyFrames; ++i) {
      writer.append(ByteVector{0, 0, 1, 0x65}, i > 0);
    }
    writer.finish();
    const Mp4Boxes boxes(file.bytes(), file.size);
    EXPECT_EQ(std::ssize(key_frames_of(boxes)), kKeyFrames);
    EXPECT_EQ(std::ssize(samples_of(boxes)), kKeyFrames + 1);
    EXPECT_EQ(boxes.sizes.at("free'"), 8u);  // the header of mdat is short
  }
  Mp4Track track = track_of(3);
  track.max_key_frames = 1;
  Mp4Writer writer(track, [](auto, auto) {});
  writer.append(ByteVector{0, 0, 1, 0x65}, true);
  EXPECT_THROW(writer.append(ByteVector{0, 0, 1, 0x65}, true), Error);
  track.max_key_frames = 4;
  EXPECT_EQ(problem_of(track), "h264: max_key_frames of an MP4 file is 4, not in [1, 3]");
}

/// The longest index: 64 bits for durations and offsets, a shorter last chunk, and all pictures but
/// one are key frames. Of the room, the number of that one is left, and 4 bytes of an offset.
TEST(Mp4Writer, FillsTheWholeRoom) {
  const ByteVector unit = large_unit(27);
  Mp4Memory file(1 << 20);
  Mp4Writer writer(track_of(35, {2'147'483'647, 1'000'000'000}), file.writer());
  for (int i = 0; i < 35; ++i) writer.append(unit, i > 0);
  writer.finish();
  const Mp4Boxes boxes(file.bytes(), file.size);
  EXPECT_EQ(samples_of(boxes).size(), 35u);
  EXPECT_EQ(number_at(boxes.at(kTables + "co64"), 4), 18u);
  EXPECT_EQ(number_at(boxes.at(kTables + "stsc"), 4), 2u);
  EXPECT_EQ(boxes.at("moov/mvhd")[0], 1);
  EXPECT_EQ(boxes.sizes.at("free"), 8u);
  EXPECT_EQ(boxes.sizes.at("free'"), 0u);
}

/// With its header, mdat may have 2^32 - 1 bytes; above, the header is longer.
TEST(Mp4Writer, DataOf4GiBHaveALongHeader) {
  const ByteVector unit = large_unit(27);
  for (const std::size_t missing : {9U, 8U}) {
    Mp4Memory file(1 << 20);
    Mp4Writer writer(track_of(32), file.writer());
    for (int i = 0; i < 31; ++i) writer.append(unit, true);
    writer.append(std::span(unit).first(unit.size() - missing), true);
    writer.finish();
    const Mp4Boxes boxes(file.bytes(), file.size);
    EXPECT_EQ(boxes.sizes.at("mdat"), (std::uint64_t{1} << 32) - missing);
    EXPECT_EQ(boxes.sizes.at("free'"), missing == 9 ? 8U : 0U);
  }
}

TEST(Mp4Writer, OffsetsBeyond4GiBHave64Bits) {
  constexpr std::int64_t kPictures = 130;
  const ByteVector unit = large_unit(26);
  for (const std::int64_t pictures : {std::int64_t{63}, std::int64_t{64}, kPictures}) {
    Mp4Memory file(1 << 20);
    Mp4Writer writer(track_of(kPictures), file.writer());
    for (std::int64_t i = 0; i < pictures; ++i) writer.append(unit, i % 10 == 0);
    writer.finish();
    const Mp4Boxes boxes(file.bytes(), file.size);
    // 64 pictures fill 4 GiB. The second chunk begins after 60, the third beyond.
    EXPECT_EQ(boxes.sizes.at("mdat"), std::uint64_t(pictures) << 26);
    const std::uint64_t header = pictures < 64 ? 8 : 16;
    EXPECT_EQ(boxes.starts.at("mdat"), boxes.starts.at("free'") + boxes.sizes.at("free'") + header);
    EXPECT_EQ(boxes.has(kTables + "co64"), pictures == kPictures);
    const std::vector<Sample> samples = samples_of(boxes);
    ASSERT_EQ(std::ssize(samples), pictures);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_EQ(samples[i], (Sample{boxes.starts.at("mdat") + (i << 26), 1 << 26}));
      EXPECT_TRUE(file.written.contains(samples[i].offset + 4));
    }
    expect_only_free_holes(file, boxes);
  }
}

TEST(Mp4Writer, RaisesTheLevelOfHeadersOnly) {
  const auto raised = [](int from, const Level* to) {
    ByteVector sequence = {0x67, 66, 0xc0, std::uint8_t(from), 0xda};
    raise_level(sequence, to);
    EXPECT_EQ(sequence[4], 0xda);
    return int(sequence[3]);
  };
  const Level level = {.idc = 32,
                       .max_macroblocks_per_s = 0,
                       .max_macroblocks = 0,
                       .max_rate_bps = 0,
                       .max_buffer_bits = 0,
                       .min_compression = 0};
  EXPECT_EQ(raised(31, &level), 32);
  EXPECT_EQ(raised(32, &level), 32);
  EXPECT_EQ(raised(40, &level), 40);
  EXPECT_EQ(raised(31, nullptr), 31);
}

/// The headers say 2.0. 240 macroblocks at 60 pictures/s need 2.1, and a picture of 1 MB overruns
/// the buffers of all levels below 3. avcC says its level twice.
TEST(Mp4Writer, SaysTheLevelOfItsPictures) {
  const auto level_of = [](std::size_t size_bytes) {
    ByteVector unit(size_bytes, 0xff);
    std::ranges::copy(ByteVector{0, 0, 1, 0x65}, unit.begin());
    const ByteVector description = boxes_of({unit}, track_of(1)).at(kTables + "stsd");
    const std::string type = "avcC";
    const auto at = std::search(description.begin(), description.end(), type.begin(), type.end());
    EXPECT_EQ(at[7], at[15]);
    return int(at[7]);
  };
  EXPECT_EQ(level_of(100), 21);
  EXPECT_GE(level_of(1'000'000), 30);
}

/// The most of any 60 pictures, which are a second.
TEST(Mp4Writer, SaysTheHighestRateOfASecond) {
  const auto rates_of = [](std::int64_t pictures, std::int64_t heavy, PictureRate rate) {
    Mp4Memory file;
    Mp4Writer writer(track_of(pictures, rate), file.writer());
    std::vector<std::uint64_t> sizes;
    for (std::int64_t i = 0; i < pictures; ++i) {
      const std::size_t size = i / 10 == heavy / 10 ? 5000 : 20;
      ByteVector unit(size, 0xff);
      std::ranges::copy(ByteVector{0, 0, 1, 0x65}, unit.begin());
      writer.append(unit, true);
      sizes.push_back(size + 1);  // a length of four bytes for a start code of three
    }
    writer.finish();
    const ByteVector description = Mp4Boxes(file.bytes(), file.size).at(kTables + "stsd");
    const std::size_t end = description.size();
    const auto window = std::size_t((rate.numerator - 1) / rate.denominator + 1);
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const std::size_t next = std::min(i + window, sizes.size());
      most =
          std::max(most, std::accumulate(sizes.begin() + std::ptrdiff_t(i),
                                         sizes.begin() + std::ptrdiff_t(next), std::uint64_t{0}));
    }
    const std::uint64_t sum = std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0});
    EXPECT_EQ(number_at(description, end - 8), 8 * most);
    EXPECT_EQ(number_at(description, end - 4),
              8 * sum * std::uint64_t(rate.numerator) / std::uint64_t(rate.denominator * pictures));
  };
  rates_of(200, 100, {60, 1});
  rates_of(200, 0, {30000, 1001});
  rates_of(7, 0, {60, 1});
  rates_of(25, 24, {1, 3});
}

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

TEST(Mp4Writer, ShowsCaptionsFromPictureToPicture) {
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

TEST(Mp4Writer, NamesWhatIsWrongWithOtherTracks) {
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
