// MP4 files of invented access units, read by an independent reader of boxes.
#include "h264/mp4_writer.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "h264/encoder.hpp"
#include "h264/invented_pictures.hpp"

namespace piblocks::h264 {
namespace {

using testing_support::message_of;

/// The file of a stream with these access units.
Mp4Boxes boxes_of(const std::vector<ByteVector>& units, const Mp4Track& track) {
  Mp4Memory file;
  Mp4Writer writer(track, file.writer());
  for (const ByteVector& unit : units) writer.append(unit, &unit == units.data());
  writer.finish();
  return {file.bytes(), file.size};
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

}  // namespace
}  // namespace piblocks::h264
