#include "screen/measure.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "media/libav/av.hpp"

namespace piblocks::benchmark {
namespace {

// Of H.264; libx264 takes 0 for another profile, without loss.
constexpr int kLeastQp = 1;
constexpr int kGreatestQp = 51;

/// Of all threads of the process, whatever threads an encoder starts.
double process_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::int64_t squared_error(const std::uint8_t* a, const std::uint8_t* b, int count) {
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

std::int64_t squared_error(const AVFrame& decoded, const Picture& picture) {
  const std::uint8_t* const planes[] = {picture.y(), picture.cb(), picture.cr()};
  std::int64_t sum = 0;
  for (int plane = 0; plane < 3; ++plane) {
    const int width = plane == 0 ? kScreenWidth_px : kScreenWidth_px / 2;
    const int height = plane == 0 ? kScreenHeight_px : kScreenHeight_px / 2;
    for (int y = 0; y < height; ++y) {
      sum += squared_error(decoded.data[plane] + std::ptrdiff_t{y} * decoded.linesize[plane],
                           planes[plane] + std::ptrdiff_t{y} * width, width);
    }
  }
  return sum;
}

double psnr_dB(double squared_error, double samples) {
  if (squared_error == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255.0 * 255.0 * samples / squared_error);
}

AvCodecContextPtr open_decoder() {
  const AVCodec* const codec = avcodec_find_decoder(AV_CODEC_ID_H264);
  auto context = own_av<AvCodecContextPtr>(avcodec_alloc_context3(codec), "decoder");
  context->thread_count = 1;
  check_av(avcodec_open2(context.get(), codec, nullptr), "open decoder", "h264");
  return context;
}

/// Takes the pictures of a decoder in order and adds up how wrong they are.
class Comparison {
 public:
  explicit Comparison(const Recording& recording) : recording_(recording) {}

  void take(const AVFrame& decoded) {
    if (count_ == recording_.pictures.size() || decoded.width != kScreenWidth_px ||
        decoded.height != kScreenHeight_px) {
      throw Error("a decoded stream has too many pictures, or other ones");
    }
    const std::int64_t error = squared_error(decoded, recording_.pictures[count_++]);
    sum_ += error;
    greatest_ = std::max(greatest_, error);
  }

  Fidelity result() const {
    if (count_ != recording_.pictures.size()) {
      throw Error(fmt::format("a decoded stream has {} pictures", count_));
    }
    constexpr double kSamples = 1.5 * double(Picture::kLuma);
    return {.psnr_dB = psnr_dB(double(sum_), kSamples * double(count_)),
            .least_psnr_dB = psnr_dB(double(greatest_), kSamples)};
  }

 private:
  const Recording& recording_;
  std::size_t count_ = 0;
  std::int64_t sum_ = 0;
  std::int64_t greatest_ = 0;
};

}  // namespace

Stream encode(const Contender& contender, int qp, const Recording& recording) {
  const auto encoder = contender.make(qp);
  Stream stream;
  stream.units.reserve(recording.pictures.size());
  for (const Picture& picture : recording.pictures) {
    const double start_s = process_seconds();
    const auto unit = encoder->encode(picture);
    stream.cpu_s += process_seconds() - start_s;
    stream.units.emplace_back(unit.begin(), unit.end());
  }
  stream.coarser_pictures = encoder->coarser_pictures();
  return stream;
}

std::size_t size_bytes(const Stream& stream) {
  std::size_t sum = 0;
  for (const auto& unit : stream.units) sum += unit.size();
  return sum;
}

Fidelity fidelity(const Stream& stream, const Recording& recording) {
  const AvCodecContextPtr decoder = open_decoder();
  const auto packet = own_av<AvPacketPtr>(av_packet_alloc(), "packet");
  const auto frame = own_av<AvFramePtr>(av_frame_alloc(), "frame");
  Comparison comparison(recording);
  const auto take_pictures = [&] {
    while (avcodec_receive_frame(decoder.get(), frame.get()) == 0) comparison.take(*frame);
  };
  for (const auto& unit : stream.units) {
    check_av(av_new_packet(packet.get(), int(unit.size())), "allocate", "packet");
    std::ranges::copy(unit, packet->data);
    check_av(avcodec_send_packet(decoder.get(), packet.get()), "decode", "h264");
    av_packet_unref(packet.get());
    take_pictures();
  }
  check_av(avcodec_send_packet(decoder.get(), nullptr), "decode", "h264");
  take_pictures();
  return comparison.result();
}

Match nearest_match(const Contender& contender, const Match& wanted, const Recording& recording) {
  constexpr int kReach = 12;
  constexpr double kNear_dB = 0.25;
  Match best;
  double least_dB = std::numeric_limits<double>::infinity();
  // PSNR falls with the quantiser.
  int finest = std::max(kLeastQp, wanted.qp - kReach);
  int coarsest = std::min(kGreatestQp, wanted.qp + kReach);
  while (finest <= coarsest && least_dB > kNear_dB) {
    const int qp = (finest + coarsest) / 2;
    const Match match = {qp, fidelity(encode(contender, qp, recording), recording)};
    const double above_dB = match.fidelity.psnr_dB - wanted.fidelity.psnr_dB;
    if (std::abs(above_dB) < least_dB) {
      least_dB = std::abs(above_dB);
      best = match;
    }
    if (above_dB > 0) {
      finest = qp + 1;
    } else {
      coarsest = qp - 1;
    }
  }
  return best;
}

}  // namespace piblocks::benchmark
