#include "media/mp4/h264_chunk.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "h264/levels.hpp"
#include "h264/parameter_sets.hpp"
#include "h264/picture.hpp"
#include "media/output/output_kinds.hpp"
#include "media/pixels/yuv.hpp"

namespace piblocks {
namespace {

/// The quantiser; src/h264/README.md has the measurements.
constexpr int kQp = 14;

h264::PictureRate rate_of(const VideoFormat& format) {
  return {format.frame_rate.get_num().get_si(), format.frame_rate.get_den().get_si()};
}

h264::Config config_of(const VideoFormat& format) {
  return {.width_px = format.width_px,
          .height_px = format.height_px,
          .rate_numerator = rate_of(format).numerator,
          .rate_denominator = rate_of(format).denominator,
          .qp = kQp};
}

/// Those of the columns from x_px on.
h264::Planes planes_at(int x_px, const YuvView<std::uint8_t>& view) {
  return {{view.y.samples + x_px, view.y.stride_bytes},
          {view.cb.samples + x_px / 2, view.cb.stride_bytes},
          {view.cr.samples + x_px / 2, view.cr.stride_bytes}};
}

class H264ChunkEncoder final : public ChunkEncoder {
 public:
  H264ChunkEncoder(const H264Stream& stream, MakeSuccessor make_successor)
      : ChunkEncoder(stream.format),
        stream_(stream),
        make_successor_(std::move(make_successor)),
        may_hand_over_(stream.may_hand_over),
        encoder_(stream.config),
        samples_(yuv420_bytes(stream.format.width_px, h264::kLumaSide)) {}

  void begin(std::int64_t first_frame) override {
    next_frame_ = first_frame;
    transformed_ = 0;
    is_handed_over_ = false;
    encoder_.restart();
  }
  void encode() override {
    if (is_handed_over_) return successor_->encode();
    const h264::CodedPicture coded = encoder_.encode(h264::PictureType::p, unit_);
    chunk_.push_back({.bytes = unit_,
                      .pts = next_frame_,
                      .dts = next_frame_,
                      .key_frame = coded.type == h264::PictureType::idr});
    transformed_ += coded.transformed_macroblocks;
    ++next_frame_;
  }
  EncodedChunk finish() override {
    EncodedChunk chunk = std::exchange(chunk_, {});
    if (is_handed_over_) std::ranges::move(successor_->finish(), std::back_inserter(chunk));
    return chunk;
  }
  std::string method() const override {
    std::string method(kBuiltin);
    if (is_handed_over_) method += ", then " + successor_->method();
    return method;
  }

 private:
  void convert(const ImageView& frame, std::span<const PixelRect> rects) override {
    if (is_handed_over_) {
      successor_->take(frame, rects);
    } else if (changes_too_much() && hand_over()) {
      successor_->take(frame);
    } else if (std::exchange(is_behind_, false)) {
      convert_here(frame, PixelRect{0, 0, frame.width_px, frame.height_px});
    } else {
      convert_here(frame, rects);
    }
  }
  void convert_here(const ImageView& frame, std::span<const PixelRect> rects) {
    for (const PixelRect& rect : rects) convert_here(frame, chroma_aligned(rect, frame));
  }
  /// Rows of macroblocks, one after the other: the encoder takes them while they are in the cache.
  void convert_here(const ImageView& frame, const PixelRect& rect) {
    for (int y = rect.y_px; y < rect.bottom_px();) {
      const int end = std::min((y / h264::kLumaSide + 1) * h264::kLumaSide, rect.bottom_px());
      ImageView rows = frame;
      rows.data = frame.row(y);
      rows.height_px = end - y;
      const auto samples = yuv420_view(samples_.data(), rows.width_px, rows.height_px);
      convert_to_yuv420(rows, {rect.x_px, 0, rect.width_px, rows.height_px}, samples);
      encoder_.take(planes_at(rect.x_px, samples), {rect.x_px, y, rect.width_px, rows.height_px});
      y = end;
    }
  }
  /// Makes the next frame a key frame of libavcodec's encoder. @returns whether there is one
  bool hand_over() {
    if (!successor_) successor_ = make_successor_(stream_.format, stream_.config);
    may_hand_over_ = successor_ != nullptr;
    if (!successor_) return false;
    is_handed_over_ = true;
    is_behind_ = true;
    successor_->begin(next_frame_);
    return true;
  }
  /// libavcodec's encoder is the faster one if more than a twentieth of the macroblocks, and more
  /// than a few, have to be transformed (tests/benchmark/encoders.md).
  bool changes_too_much() const {
    constexpr std::int64_t kOneIn = 20;
    constexpr std::int64_t kFew = 64;
    const std::int64_t macroblocks =
        std::int64_t{h264::macroblocks_along(stream_.config.width_px)} *
        h264::macroblocks_along(stream_.config.height_px);
    return may_hand_over_ &&
           transformed_ > std::max(kFew, macroblocks / kOneIn) * stream_.frames_per_chunk;
  }

  const H264Stream& stream_;
  MakeSuccessor make_successor_;
  bool may_hand_over_;
  h264::Encoder encoder_;
  std::vector<std::uint8_t> samples_;  // of a row of macroblocks
  Bytes unit_;
  std::int64_t next_frame_ = 0;
  EncodedChunk chunk_;
  std::int64_t transformed_ = 0;  // macroblocks of the chunk's P pictures
  bool is_handed_over_ = false;   // to libavcodec's encoder
  bool is_behind_ = false;        // encoder_ lacks frames that only libavcodec's encoder took
  std::unique_ptr<ChunkEncoder> successor_;
};

}  // namespace

bool is_builtin(const EncoderSettings& settings) {
  if (settings.encoder) return settings.encoder == kBuiltin;
  return !settings.crf && !settings.preset;
}

std::string h264_level_problem(const VideoFormat& format) {
  const std::string problem =
      h264::level_problem(format.width_px, format.height_px, rate_of(format));
  if (problem.empty()) return {};
  return fmt::format(
      "output: H.264 cannot hold this video: {}; make it smaller or slower, or write *.webm, "
      "*.apng or *.png",
      problem);
}

/// The limits are those of Microsoft's page "H.264 Video Decoder" (Media Foundation).
std::vector<std::string> h264_notes(const VideoFormat& format) {
  constexpr int kLongSide_px = 4096;
  constexpr int kShortSide_px = 2304;
  constexpr int kLevel = 51;
  const int level = h264::lowest_level(format.width_px, format.height_px, rate_of(format))->idc;
  if (format.width_px <= kLongSide_px && format.height_px <= kShortSide_px && level <= kLevel)
    return {};
  return {
      fmt::format("H.264 of {}x{} at level {}.{}: Windows, and PowerPoint with it, promises to "
                  "play no more than "
                  "4096x2304 at level 5.1; for these use a smaller --size or fewer --fps",
                  format.width_px, format.height_px, level / 10, level % 10)};
}

H264Stream::H264Stream(const VideoFormat& video_format, const EncoderSettings& settings)
    : format(video_format),
      config(config_of(video_format)),
      frames_per_chunk(frames_in_a_second(video_format.frame_rate)),
      may_hand_over(settings.encoder != kBuiltin) {
  Problems problems;
  problems.add(odd_size_problem(format, "H.264 in 4:2:0"));
  problems.add(h264_level_problem(format));
  if (settings.crf) problems.add(no_crf(kBuiltin));
  if (settings.preset) problems.add(no_preset(kBuiltin));
  problems.check();
  level_idc = h264::lowest_level(format.width_px, format.height_px, rate_of(format))->idc;
  headers = h264::write_parameter_sets(config, level_idc);
}

std::string H264Stream::signature() const {
  return fmt::format("{}, {:02x}", kBuiltin, fmt::join(headers, ""));
}

std::unique_ptr<ChunkEncoder> h264_chunk_encoder(const H264Stream& stream,
                                                 const MakeSuccessor& make_successor) {
  return std::make_unique<H264ChunkEncoder>(stream, make_successor);
}

}  // namespace piblocks
