// The frames of any video that libavformat reads.
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "core/input_file.hpp"
#include "media/libav/av.hpp"
#include "media/libav/av_module.hpp"
#include "media/libav/decoded_frame.hpp"

extern "C" {
#include <libavutil/display.h>
}

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// libavformat takes the end of a cut file for the end of the video.
[[noreturn]] void refuse_cut_file(const std::string& path) {
  throw MediaError(
      fmt::format("video: cannot read '{}': it is cut off before its last frame", path));
}

constexpr std::uint32_t kSegment = 0x18538067;

/// The next number of EBML (RFC 8794, 4). Its first byte's leading zeros count the bytes after it.
/// @param with_mark  whether the bit behind the zeros belongs to the number, as in an element's ID.
/// @return nothing at the end of the file, and for an unknown size.
std::optional<std::uint64_t> ebml_number(std::istream& file, bool with_mark) {
  const int first = file.get();
  if (first <= 0) return std::nullopt;
  const int others = std::countl_zero(std::uint8_t(first));
  const auto mark = std::uint64_t(0x80 >> others);
  std::uint64_t number = std::uint64_t(first) & (with_mark ? 0xff : mark - 1);
  for (int i = 0; i < others; ++i) number = number << 8 | std::uint8_t(file.get());
  const std::uint64_t unknown = (std::uint64_t{1} << (7 * (others + 1))) - 1;
  if (!file || (!with_mark && number == unknown)) return std::nullopt;
  return number;
}

/// One element, the segment, holds all of a Matroska or WebM file.
bool is_cut_matroska(std::istream& file, std::uint64_t file_bytes) {
  while (true) {
    const auto id = ebml_number(file, true);
    const auto bytes = ebml_number(file, false);
    const std::int64_t begin = file.tellg();
    if (!id || !bytes || begin < 0) return false;
    const bool goes_on = *bytes > file_bytes - std::uint64_t(begin);
    if (goes_on || *id == kSegment) return goes_on;
    file.seekg(std::int64_t(*bytes), std::ios::cur);
  }
}

/// Whether a Matroska or WebM file ends before its own structure does, which libavformat does not
/// find. False for other kinds, for a file without its size, such as a live stream, and a pipe.
bool is_cut_off(const std::string& path) {
  if (beginning_of(path, 4) != "\x1a\x45\xdf\xa3") return false;
  std::error_code no_file;
  const std::uintmax_t bytes = fs::file_size(path, no_file);
  std::ifstream file(path, std::ios::binary);
  return !no_file && is_cut_matroska(file, bytes);
}

bool is_y4m(const AVFormatContext& input) {
  return std::string_view(input.iformat->name) == "yuv4mpegpipe";
}

/// libavformat skips the comment by which our y4m says what its colours are.
void take_y4m_matrix(AVFormatContext& input) {
  if (!is_y4m(input) || input.nb_streams == 0) return;
  // This works for a pipe too: libavformat has kept its first bytes.
  const std::int64_t header_bytes = avio_tell(input.pb);
  if (avio_seek(input.pb, 0, SEEK_SET) < 0) return;
  std::string header(std::size_t(header_bytes), '\0');
  avio_read(input.pb, reinterpret_cast<unsigned char*>(header.data()), int(header_bytes));
  header = header.substr(0, header.find('\n')) + ' ';
  if (header.find(fmt::format(" {} ", kY4mMatrixTag)) == std::string::npos) return;
  input.streams[0]->codecpar->color_space = AVCOL_SPC_BT709;
}

/// Whether a file's index leads beyond its end.
bool index_leads_out(AVFormatContext& input, AVStream& stream) {
  const std::int64_t size = avio_size(input.pb);
  const int count = avformat_index_get_entries_count(&stream);
  for (int i = 0; size > 0 && i < count; ++i) {
    const AVIndexEntry& entry = *avformat_index_get_entry(&stream, i);
    if (entry.pos + entry.size > size) return true;
  }
  return false;
}

/// libavcodec 59 to 61 decode WebP, but no animations. The flag stands behind the chunk's head.
void refuse_animated_webp(const std::string& path) {
  constexpr std::size_t kFlags_at = 20;
  const std::string start = beginning_of(path, kFlags_at + 1).value_or("");
  if (start.find("WEBPVP8X") != 8 || (start[kFlags_at] & 2) == 0) return;
  throw MediaError(fmt::format(
      "video: cannot compare '{}': no animated WebP is read here; compare an *.apng", path));
}

/// The only video stream besides covers. Of several, just one would be compared.
int find_video(AVFormatContext& input, const std::string& path) {
  check_av_read(avformat_find_stream_info(&input, nullptr), "read", path);
  const int best = check_av_read(
      av_find_best_stream(&input, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0), "find a video in", path);
  const auto count =
      std::count_if(input.streams, input.streams + input.nb_streams, [](const AVStream* stream) {
        return stream->codecpar->codec_type == AVMEDIA_TYPE_VIDEO &&
               (stream->disposition & AV_DISPOSITION_ATTACHED_PIC) == 0;
      });
  if (count == 0) {
    throw MediaError(fmt::format("video: cannot find a video in '{}': it has only a cover", path));
  }
  if (input.streams[best]->codecpar->codec_id == AV_CODEC_ID_TIFF) {
    throw MediaError(fmt::format(
        "video: cannot compare '{}': a TIFF may have more pages than are read here; convert it to "
        "PNG",
        path));
  }
  if (count == 1) return best;
  throw MediaError(
      fmt::format("video: cannot compare '{}': it has {} videos; take one out of it, such as by "
                  "ffmpeg -map 0:v:0 -c copy",
                  path, count));
}

/// libavcodec's own decoders of VP8 and VP9 ignore the alpha that Matroska keeps beside pictures.
const AVCodec* find_decoder(const AVStream& stream) {
  const AVCodecID codec = stream.codecpar->codec_id;
  const AVDictionaryEntry* const mode = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
  const bool has_alpha = mode != nullptr && std::string_view(mode->value) == "1";
  if (has_alpha && codec == AV_CODEC_ID_VP9) return avcodec_find_decoder_by_name("libvpx-vp9");
  if (has_alpha && codec == AV_CODEC_ID_VP8) return avcodec_find_decoder_by_name("libvpx");
  return avcodec_find_decoder(codec);
}

/// The kinds of threads that a decoder may use. Only these decoders get frame threads: with them
/// the decoder of MPEG-4 Part 2 in libavcodec 59 fails an assertion if the file is damaged.
int threads_of(AVCodecID codec) {
  constexpr std::array kByFrames = {AV_CODEC_ID_H264, AV_CODEC_ID_HEVC, AV_CODEC_ID_VP9,
                                    AV_CODEC_ID_FFV1, AV_CODEC_ID_PRORES};
  const bool is_safe = std::ranges::find(kByFrames, codec) != kByFrames.end();
  return is_safe ? FF_THREAD_FRAME | FF_THREAD_SLICE : FF_THREAD_SLICE;
}

AvCodecContextPtr open_decoder(const AVStream& stream, const std::string& path) {
  const AVCodec* codec = find_decoder(stream);
  if (codec == nullptr) {
    throw MediaError(fmt::format("video: cannot decode '{}': no decoder for {}", path,
                                 avcodec_get_name(stream.codecpar->codec_id)));
  }
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), codec->name);
  check_av_read(avcodec_parameters_to_context(context.get(), stream.codecpar), "decode", path);
  context->max_pixels = kMaxFrame_px;
  context->err_recognition = AV_EF_EXPLODE;
  context->thread_type = threads_of(codec->id);
  context->thread_count = 0;  // one for each processor; the pictures are the same
  check_av_read(avcodec_open2(context.get(), codec, nullptr), "decode", path);
  return context;
}

/// How a display matrix moves the corners of the picture; empty if it leaves them.
std::string turn_of(const std::int32_t* matrix) {
  constexpr std::int32_t kOne = 1 << 16;
  if (matrix[0] == kOne && matrix[1] == 0 && matrix[3] == 0 && matrix[4] == kOne) return {};
  const bool is_mirrored =
      std::int64_t{matrix[0]} * matrix[4] - std::int64_t{matrix[1]} * matrix[3] < 0;
  const double degrees = std::fmod(360 - av_display_rotation_get(matrix), 360);
  return fmt::format("{}turned clockwise by {:.0f} degrees", is_mirrored ? "mirrored and " : "",
                     degrees);
}

class VideoReader final : public FrameReader {
 public:
  VideoReader(const std::string& path, std::unique_ptr<VideoInput> input)
      : path_(path),
        owner_(std::move(input)),
        input_(owner_->file.get()),
        read_to_(avio_tell(input_->pb)),
        stream_(find_video(*input_, path)),
        decoder_(open_decoder(*input_->streams[stream_], path)),
        packet_(own_av<AvPacketPtr>(av_packet_alloc(), "packet")),
        frame_(own_av<AvFramePtr>(av_frame_alloc(), "frame")),
        is_cut_off_(index_leads_out(*input_, *input_->streams[stream_]) || is_cut_off(path_)) {}

  /// Of a file that is cut off, returns the frames before that place, and throws there.
  bool next() override {
    try {
      if (decode()) return true;
    } catch (const MediaError&) {
      if (!is_cut_off_) throw;  // else that is the reason
    }
    if (is_cut_off_) refuse_cut_file(path_);
    return false;
  }
  std::string layout() const override { return layout_of(*frame_); }
  std::string presentation() const override {
    AVStream* const stream = input_->streams[stream_];
    const AVFrameSideData* const own =
        av_frame_get_side_data(frame_.get(), AV_FRAME_DATA_DISPLAYMATRIX);
    const std::uint8_t* const matrix = own != nullptr ? own->data : display_matrix_of(*stream);
    std::string text =
        matrix == nullptr ? "" : turn_of(reinterpret_cast<const std::int32_t*>(matrix));
    const AVRational aspect = av_guess_sample_aspect_ratio(input_, stream, frame_.get());
    if (aspect.num > 0 && aspect.num != aspect.den) {
      if (!text.empty()) text += ", ";
      text += fmt::format("with pixels of {}:{}", aspect.num, aspect.den);
    }
    return text;
  }
  AnyImage samples() override { return samples_of(*frame_); }
  AnyImage rgb() override { return rgb_of(*frame_, path_); }

 private:
  bool decode() {
    while (true) {
      const int code = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (code == AVERROR_EOF) return false;
      if (code == AVERROR(EAGAIN)) {
        feed();
        continue;
      }
      check_av_read(code, "decode", path_);
      check_damage();
      check_pixel_format(*frame_, path_);
      ++frames_;
      return true;
    }
  }
  /// Gives one packet, or the end, to the decoder.
  void feed() {
    while (true) {
      const int code = av_read_frame(input_, packet_.get());
      if (code == AVERROR_EOF) break;
      check_av_read(code, "read", path_);
      read_to_ = packet_->pos + packet_->size;
      // An empty packet has no picture; to a decoder it would be the end.
      const bool is_video = packet_->stream_index == stream_ && packet_->size > 0;
      if (is_video) {
        if ((packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) refuse_cut_file(path_);
        check_av_read(avcodec_send_packet(decoder_.get(), packet_.get()), "decode", path_);
      }
      av_packet_unref(packet_.get());
      if (is_video) return;
    }
    check_end();
    check_av_read(avcodec_send_packet(decoder_.get(), nullptr), "decode", path_);
  }
  /// Some decoders, such as that of ProRes, return a frame of which a part is old memory.
  void check_damage() const {
    if (frame_->decode_error_flags == 0 && (frame_->flags & AV_FRAME_FLAG_CORRUPT) == 0) return;
    throw MediaError(fmt::format("video: cannot decode '{}': frame {} is damaged", path_, frames_));
  }
  /// YUV4MPEG2 has no index, and libavformat drops half a frame at the end.
  void check_end() const {
    if (is_y4m(*input_) && avio_tell(input_->pb) != read_to_) refuse_cut_file(path_);
  }

  std::string path_;
  std::unique_ptr<VideoInput> owner_;
  AVFormatContext* input_;
  std::int64_t read_to_;  // where the last packet ended, or the header
  int stream_;
  AvCodecContextPtr decoder_;
  AvPacketPtr packet_;
  AvFramePtr frame_;
  bool is_cut_off_;
  std::int64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<FrameReader> decode_video_file(const std::string& path,
                                               const std::stop_token& stop) {
  auto input = std::make_unique<VideoInput>(path, stop);
  if (std::string_view(input->file->iformat->name) == "gif")
    return read_gif(path, std::move(input));
  take_y4m_matrix(*input->file);
  refuse_animated_webp(path);
  return std::make_unique<VideoReader>(path, std::move(input));
}

}  // namespace piblocks
