#include "media/video_encoder.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <span>

#include "media/find_encoder.hpp"
#include "media/output_request.hpp"

extern "C" {
#include <libavutil/opt.h>
}

namespace piblocks {
namespace {

// Chosen from the table in src/media/README.md.
constexpr const char* kX264Preset = "ultrafast";
constexpr std::int64_t kX264Qp = 14;
/// Where a preset is given without a quality: slower presets need the rate factor's analysis
/// anyway.
constexpr double kX264Crf = 21;

/// Where an encoder knows no constant quality: bits per pixel of average video, generous for flat
/// shapes.
constexpr double kBitsPerPixel = 0.1;

constexpr double kMaxCrf = 51;
constexpr int kMaxFramesPerChunk = 300;

bool has_option(const AVCodec& codec, const char* name) {
  if (codec.priv_class == nullptr) return false;
  const AVClass* options = codec.priv_class;
  return av_opt_find(&options, name, nullptr, 0, AV_OPT_SEARCH_FAKE_OBJ) != nullptr;
}

AVRational to_av(const Rational& value) {
  return {static_cast<int>(value.get_num().get_si()), static_cast<int>(value.get_den().get_si())};
}

/// At least two: of two IDR pictures in a row with equal headers a decoder cannot tell that they
/// are two (H.264, 7.4.1.2.4).
int frames_in_a_second(const Rational& frame_rate) {
  const Integer frames = floor(frame_rate);
  if (frames > kMaxFramesPerChunk) return kMaxFramesPerChunk;
  return std::max(2, static_cast<int>(frames.get_si()));
}

std::string crf_problem(const AVCodec& codec, double crf) {
  if (!has_option(codec, "crf")) {
    return fmt::format("video: encoder '{}' has no crf; leave it out", codec.name);
  }
  if (crf >= 0 && crf <= kMaxCrf) return {};
  return fmt::format("video: crf {} is out of range; use 0 (lossless) to {}", crf, kMaxCrf);
}

std::string preset_problem(const AVCodec& codec, const std::string& preset) {
  constexpr std::array<std::string_view, 10> kX264Presets = {
      "ultrafast", "superfast", "veryfast", "faster",   "fast",
      "medium",    "slow",      "slower",   "veryslow", "placebo"};
  if (!has_option(codec, "preset")) {
    return fmt::format("video: encoder '{}' has no presets; leave the preset out", codec.name);
  }
  // libx264 takes any text here and refuses it only when it is opened, without a word on why.
  const bool is_unknown = codec.name == kX264 && std::find(kX264Presets.begin(), kX264Presets.end(),
                                                           preset) == kX264Presets.end();
  if (!is_unknown) return {};
  return fmt::format("video: encoder '{}' has no preset '{}'; use one of: {}", codec.name, preset,
                     fmt::join(kX264Presets, ", "));
}

/// Everything that is wrong, found before anything is opened. `codec` is set if there is one.
std::vector<std::string> problems_of(const VideoFormat& format, const EncoderSettings& settings,
                                     const AVCodec*& codec) {
  std::vector<std::string> problems;
  const auto report = [&](std::string problem) {
    if (!problem.empty()) problems.push_back(std::move(problem));
  };
  report(odd_size_problem(format, "H.264 in 4:2:0"));
  try {
    codec = &find_encoder(settings.encoder);
    if (settings.crf) report(crf_problem(*codec, *settings.crf));
    if (settings.preset) report(preset_problem(*codec, *settings.preset));
  } catch (const UsageError& error) {
    report(error.what());
  }
  return problems;
}

void set_picture_format(AVCodecContext& context, const VideoFormat& format) {
  context.width = format.width_px;
  context.height = format.height_px;
  context.pix_fmt = AV_PIX_FMT_YUV420P;
  context.sample_aspect_ratio = {1, 1};
  context.colorspace = AVCOL_SPC_BT709;
  context.color_primaries = AVCOL_PRI_BT709;
  context.color_trc = AVCOL_TRC_BT709;
  context.color_range = AVCOL_RANGE_MPEG;
  context.chroma_sample_location = AVCHROMA_LOC_LEFT;
}

std::span<const std::uint8_t> extradata(const AVCodecContext& context) {
  return {context.extradata, static_cast<std::size_t>(context.extradata_size)};
}

std::span<const std::uint8_t> extradata(const AVCodecParameters& parameters) {
  return {parameters.extradata, static_cast<std::size_t>(parameters.extradata_size)};
}

}  // namespace

VideoEncoder::VideoEncoder(const VideoFormat& format, const EncoderSettings& settings)
    : format_(format),
      settings_(settings),
      frame_rate_(to_av(format.frame_rate)),
      frames_per_chunk_(frames_in_a_second(format.frame_rate)),
      parameters_(own_av<AvParametersPtr>(avcodec_parameters_alloc(), "stream parameters")) {
  std::vector<std::string> problems = problems_of(format, settings, codec_);
  if (!problems.empty()) throw UsageError(std::move(problems));
  try {
    const AvCodecContextPtr first = open_unchecked();
    check_av(avcodec_parameters_from_context(parameters_.get(), first.get()),
             "describe the stream of", codec_->name);
  } catch (const Error& error) {
    throw UsageError(
        fmt::format("{}; usable here: {}", error.what(), fmt::join(usable_h264_encoders(), ", ")));
  }
}

std::string VideoEncoder::signature() const {
  return fmt::format("{}, libavcodec {}, {:02x}", codec_->name, version_text(avcodec_version()),
                     fmt::join(extradata(*parameters_), ""));
}

AvCodecContextPtr VideoEncoder::open() const {
  AvCodecContextPtr context = open_unchecked();
  if (!std::ranges::equal(extradata(*context), extradata(*parameters_))) {
    throw MediaError(fmt::format(
        "video: cannot join the chunks of encoder '{}': their headers differ", codec_->name));
  }
  return context;
}

AvCodecContextPtr VideoEncoder::open_unchecked() const {
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec_), codec_->name);
  set_picture_format(*context, format_);
  context->framerate = frame_rate_;
  context->time_base = av_inv_q(frame_rate_);
  // Never reached: the last chunk of a video may be half as long again as the others.
  context->gop_size = 2 * frames_per_chunk_;
  // Threads inside an encoder may change its output; chunks are what runs in parallel.
  context->thread_count = 1;
  context->flags = static_cast<int>(AV_CODEC_FLAG_GLOBAL_HEADER | AV_CODEC_FLAG_CLOSED_GOP |
                                    AV_CODEC_FLAG_BITEXACT);
  apply_settings(*context);
  check_av(avcodec_open2(context.get(), codec_, nullptr), "open encoder", codec_->name);
  return context;
}

void VideoEncoder::apply_settings(AVCodecContext& context) const {
  const bool is_x264 = codec_->name == kX264;
  std::optional<double> crf = settings_.crf;
  std::optional<std::string> preset = settings_.preset;
  const bool constant_quantiser = is_x264 && !crf && !preset;
  if (is_x264 && !crf && !constant_quantiser) crf = kX264Crf;
  if (is_x264 && !preset) preset = kX264Preset;

  void* options = context.priv_data;
  // Without a rate to control libx264 does not look at a small copy of every frame first.
  if (constant_quantiser) {
    check_av(av_opt_set_int(options, "qp", kX264Qp, 0), "set qp of encoder", codec_->name);
  }
  if (crf) check_av(av_opt_set_double(options, "crf", *crf, 0), "set crf of encoder", codec_->name);
  if (preset) {
    check_av(av_opt_set(options, "preset", preset->c_str(), 0),
             fmt::format("set preset '{}' of encoder", *preset), codec_->name);
  }
  if (!has_option(*codec_, "crf")) {
    context.bit_rate = static_cast<std::int64_t>(kBitsPerPixel * format_.width_px *
                                                 format_.height_px * av_q2d(frame_rate_));
  }
  // A chunk is one group of pictures: no key frame but the first, however much a picture differs
  // from the last. libx264 takes 0 for that, libavcodec's own encoders their largest value.
  if (has_option(*codec_, "sc_threshold")) {
    check_av(av_opt_set_int(options, "sc_threshold", is_x264 ? 0 : 1'000'000'000, 0),
             "set up encoder", codec_->name);
  }
  // With libx264 r3095's macroblock tree, equal frames of 64x48 gave up to three different chunks,
  // depending on what memory held before (not without its vector code). Without the tree the bytes
  // depend on the frames alone; src/media/README.md has what it costs.
  if (has_option(*codec_, "mbtree")) {
    check_av(av_opt_set_int(options, "mbtree", 0, 0), "set up encoder", codec_->name);
  }
  // Unless told not to, libx264 analyses a picture in another way where a processor lacks SSSE3.
  if (has_option(*codec_, "x264-params")) {
    check_av(av_opt_set(options, "x264-params", "cpu-independent=1", 0), "set up encoder",
             codec_->name);
  }
  if (has_option(*codec_, "forced-idr")) {
    check_av(av_opt_set_int(options, "forced-idr", 1, 0), "set up encoder", codec_->name);
  }
}

}  // namespace piblocks
