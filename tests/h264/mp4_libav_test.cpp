// MP4 files beside those that libavformat writes of the same access units.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "h264/mp4_file.hpp"
#include "media/libav/encoder_setup.hpp"
#include "media/libav/video_encoder.hpp"
#include "media/libav/video_file.hpp"
#include "media/write_frames.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks::h264 {
namespace {

using testing_support::file_contents;
using testing_support::TemporaryFolder;

ByteVector bytes_of(const std::string& path) {
  const std::string text = file_contents(path);
  return {text.begin(), text.end()};
}

/// A video of libx264's pictures, written by libavformat and by us. It is so large that libx264
/// says a level above 2, which the writer keeps.
class Mp4Libav : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    silence_av();
    if (avcodec_find_encoder_by_name("libx264") == nullptr) GTEST_SKIP() << "there is no libx264";
    const VideoFormat format = {
        .width_px = 640, .height_px = 360, .frame_rate = Rational(GetParam())};
    const auto encoder =
        std::make_shared<const VideoEncoder>(format, h264_setup(format, {}, {EncoderKind::h264}));
    const VideoStream& stream = encoder->stream();
    std::ofstream file(ours_, std::ios::binary);
    const auto write_at = [&](std::uint64_t offset, std::span<const std::uint8_t> bytes) {
      file.seekp(std::streamoff(offset));
      file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    };
    Mp4Writer writer(
        {.width_px = format.width_px,
         .height_px = format.height_px,
         .rate = {stream.frame_rate.num, stream.frame_rate.den},
         .headers = {stream.parameters->extradata, std::size_t(stream.parameters->extradata_size)},
         .max_pictures = kPictures},
        write_at);
    const auto sink = open_video_file(theirs_, kMp4, stream, nullptr);
    const auto chunks = libav_chunk_encoder(encoder);
    const std::int64_t length = encoder->frames_per_chunk();
    for (std::int64_t first = 0; first < kPictures; first += length) {
      chunks->begin(first);
      for (std::int64_t i = first; i < std::min(first + length, kPictures); ++i) {
        add(*chunks, article_frames(format)(i).view());
      }
      const EncodedChunk chunk = chunks->finish();
      for (const Packet& packet : chunk) writer.append(packet.bytes, packet.key_frame);
      sink->append(chunk);
    }
    sink->finish();
    writer.finish();
  }

  static constexpr std::int64_t kPictures = 150;
  TemporaryFolder folder_;
  std::string ours_ = folder_ / "ours.mp4";
  std::string theirs_ = folder_ / "theirs.mp4";
};

/// libavformat gives the mean rate as the highest one, and from FFmpeg 6 on leaves the mean open
/// where the encoder did not name one. They are the last fields of the last box, btrt.
void copy_rates(const ByteVector& ours, ByteVector& theirs) {
  constexpr std::size_t kField_bytes = 4;
  if (theirs.size() != ours.size() || theirs.size() < 2 * kField_bytes) return;
  const auto field = theirs.end() - kField_bytes;
  std::copy(ours.end() - 2 * kField_bytes, ours.end() - kField_bytes, field - kField_bytes);
  if (std::all_of(field, theirs.end(), [](auto byte) { return byte == 0; })) {
    std::copy(ours.end() - kField_bytes, ours.end(), field);
  }
}

TEST_P(Mp4Libav, BoxesAreTheSame) {
  const ByteVector our_file = bytes_of(ours_);
  const ByteVector their_file = bytes_of(theirs_);
  const Mp4Boxes ours(our_file, our_file.size());
  const Mp4Boxes theirs(their_file, their_file.size());
  // What differs, and why.
  const std::set<std::string> others = {// room for the index
                                        "free", "free'",
                                        // libavformat's chunks are of 1 MiB, ours of a second
                                        kTables + "stsc", kTables + "stco",
                                        // an empty list of tags
                                        "moov/udta",
                                        // boxes that contain others; stsz is the last of ours
                                        "moov", "moov/trak", "moov/trak/edts", "moov/trak/mdia",
                                        "moov/trak/mdia/minf", "moov/trak/mdia/minf/stbl"};
  std::set<std::string> names(ours.order.begin(), ours.order.end());
  names.insert(theirs.order.begin(), theirs.order.end());
  for (const std::string& name : names) {
    if (others.contains(name)) continue;
    ByteVector their_box = theirs.at(name);
    if (name == kTables + "stsd") copy_rates(ours.at(name), their_box);
    EXPECT_EQ(ours.at(name), their_box) << name;
  }
  EXPECT_FALSE(ours.has("moov/udta"));
  EXPECT_GT(names.size(), 20u);
}

/// What a demuxer tells a decoder.
struct Stream {
  ByteVector headers;
  std::vector<std::int64_t> numbers;
  std::vector<std::string> packets;
};

Stream read(const std::string& path) {
  const AvInputPtr file = open_av_input(path);
  check_av(avformat_find_stream_info(file.get(), nullptr), "read", path);
  const AVStream& stream = *file->streams[0];
  const AVCodecParameters& parameters = *stream.codecpar;
  Stream result;
  result.headers.assign(parameters.extradata, parameters.extradata + parameters.extradata_size);
  result.numbers = {stream.time_base.num,
                    stream.time_base.den,
                    stream.duration,
                    stream.nb_frames,
                    stream.start_time,
                    stream.avg_frame_rate.num,
                    stream.avg_frame_rate.den,
                    parameters.width,
                    parameters.height,
                    parameters.level,
                    parameters.color_space,
                    parameters.color_range,
                    parameters.color_trc,
                    parameters.color_primaries,
                    parameters.bit_rate,
                    stream.disposition,
                    stream.sample_aspect_ratio.num};
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  while (av_read_frame(file.get(), packet.get()) >= 0) {
    std::string text(packet->data, packet->data + packet->size);
    for (const std::int64_t number :
         {packet->pts, packet->dts, packet->duration, std::int64_t(packet->flags)}) {
      text += fmt::format(" {}", number);
    }
    result.packets.push_back(text);
    av_packet_unref(packet.get());
  }
  return result;
}

TEST_P(Mp4Libav, DemuxerReadsTheSame) {
  const Stream ours = read(ours_);
  const Stream theirs = read(theirs_);
  EXPECT_EQ(ours.headers, theirs.headers);
  EXPECT_EQ(ours.numbers, theirs.numbers);
  EXPECT_EQ(ours.packets, theirs.packets);
  EXPECT_EQ(std::ssize(ours.packets), kPictures);
}

INSTANTIATE_TEST_SUITE_P(All, Mp4Libav, testing::Values("60", "30000/1001", "7"),
                         [](const auto& test) { return "Rate" + std::to_string(test.index); });

}  // namespace
}  // namespace piblocks::h264
