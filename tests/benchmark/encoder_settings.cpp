// What each of libx264's presets makes of the animation: speed, size and fidelity.
// In: nothing, or the number of frames. Out: CSV on standard output; encoders.md says what
// was chosen.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "circumstances.hpp"
#include "media/output/output.hpp"
#include "media/pixels/yuv.hpp"
#include "support/article_frames.hpp"
#include "support/decode_video.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;
using testing_support::Pixels;

constexpr int kWidth_px = 1920;
constexpr int kHeight_px = 1080;
constexpr int kFramesPerSecond = 60;

/// What one combination of settings came to.
struct Result {
  double encode_s = 0;  ///< of one thread, converting included
  std::uintmax_t size_bytes = 0;
  double luma_psnr_db = 0;
  double rgb_psnr_db = 0;  ///< also holds what halving the chroma loses
  std::string x264;
};

/// Time that this thread has computed for; other programs do not count.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Pixels frame_at(std::int64_t number) {
  return testing_support::article_frame(kWidth_px, kHeight_px,
                                        static_cast<double>(number) / kFramesPerSecond);
}

/// @return seconds spent in the encoder.
double encode(const fs::path& path, const EncoderSettings& settings, std::int64_t frames) {
  const VideoFormat format = {kWidth_px, kHeight_px, kFramesPerSecond};
  const auto output = set_up_output(path, format, settings);
  const auto encoder = output.make_encoder();
  const auto sink = output.open(frames);
  const std::array whole = {PixelRect{0, 0, kWidth_px, kHeight_px}};
  double spent_s = 0;
  for (std::int64_t first = 0; first < frames; first += output.frames_per_chunk) {
    const std::int64_t end = std::min(frames, first + output.frames_per_chunk);
    double start_s = thread_seconds();
    encoder->begin(first);
    spent_s += thread_seconds() - start_s;
    for (std::int64_t number = first; number < end; ++number) {
      const Pixels frame = frame_at(number);
      start_s = thread_seconds();
      encoder->take(frame.view(), whole);
      encoder->encode();
      spent_s += thread_seconds() - start_s;
    }
    start_s = thread_seconds();
    const EncodedChunk encoded = encoder->finish();
    spent_s += thread_seconds() - start_s;
    sink->append(encoded);
  }
  sink->finish();
  return spent_s;
}

/// Mean squared error of the decoded luma against what went into the encoder.
double luma_error(const Pixels& source, const std::vector<std::uint8_t>& decoded) {
  std::vector<std::uint8_t> y(decoded.size());
  std::vector<std::uint8_t> chroma(decoded.size() / 2);
  const std::ptrdiff_t width = source.width_px;
  convert_to_yuv420(source.view(), {0, 0, source.width_px, source.height_px},
                    {.y = {y.data(), width},
                     .cb = {chroma.data(), width / 2},
                     .cr = {chroma.data() + chroma.size() / 2, width / 2}});
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += (y[i] - decoded[i]) * (y[i] - decoded[i]);
  return static_cast<double>(sum) / static_cast<double>(y.size());
}

std::string x264_version(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::size_t at = bytes.find("x264 - core");
  return at == std::string::npos ? "unknown" : bytes.substr(at, bytes.find(" - H.264", at) - at);
}

Result measure(const fs::path& path, const EncoderSettings& settings, std::int64_t frames) {
  Result result;
  result.encode_s = encode(path, settings, frames);
  result.size_bytes = fs::file_size(path);
  result.x264 = x264_version(path);

  double luma_sum = 0;
  double rgb_sum = 0;
  std::int64_t number = 0;
  testing_support::decode_video(path, [&](testing_support::DecodedFrame&& frame) {
    const Pixels source = frame_at(number++);
    luma_sum += luma_error(source, frame.luma);
    rgb_sum += testing_support::rgb_mean_squared_error(source, frame.rgb);
  });
  result.luma_psnr_db = testing_support::psnr_db(luma_sum / static_cast<double>(frames));
  result.rgb_psnr_db = testing_support::psnr_db(rgb_sum / static_cast<double>(frames));
  return result;
}

void run(std::int64_t frames) {
  const fs::path path =
      fs::temp_directory_path() / fmt::format("encoder_settings-{}.mp4", std::time(nullptr));
  const std::string cpu = benchmark::Circumstances::cpu_name();
  fmt::print("date,cpu,x264,preset,crf,frames_per_s,bytes,psnr_y_db,psnr_rgb_db\n");
  for (const char* preset : {"ultrafast", "superfast", "veryfast", "faster", "medium"}) {
    for (const double crf : {12, 15, 18, 21, 23}) {
      const Result result =
          measure(path, {.crf = crf, .preset = preset, .encoder = "libx264"}, frames);
      fmt::print("{:%Y-%m-%d},{},{},{},{},{:.0f},{},{:.1f},{:.1f}\n",
                 fmt::gmtime(std::time(nullptr)), cpu, result.x264, preset, crf,
                 static_cast<double>(frames) / result.encode_s, result.size_bytes,
                 result.luma_psnr_db, result.rgb_psnr_db);
      std::fflush(stdout);
    }
  }
  fs::remove(path);
}

}  // namespace
}  // namespace piblocks

int main(int argc, char** argv) {
  try {
    piblocks::run(argc > 1 ? std::max(1L, std::strtol(argv[1], nullptr, 10)) : 300);
  } catch (const piblocks::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
