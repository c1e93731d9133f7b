// The public Encoder of H.264 on configs, pictures and rectangles that the bytes say. libavcodec
// decodes every picture without an error and near its source; neither coarser rectangles nor what
// was before a restart change a byte; the units fit into an MP4 file.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/numbers.hpp"
#include "h264/callers_picture.hpp"
#include "h264/deviation_bound.hpp"
#include "h264/encoder.hpp"
#include "h264/mp4_writer.hpp"
#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"

namespace {

using namespace piblocks::h264;
using piblocks::fuzz::Numbers;

constexpr int kMostFrames = 16;

/// Says at the end how many pictures there were.
struct Counter {
  ~Counter() {
    std::fprintf(stderr, "fuzz_h264_stream: %lld pictures were compared; %lld restarts\n", pictures,
                 restarts);
  }
  long long pictures = 0;
  long long restarts = 0;
} counter;

void require(bool is_right, const std::string& what) {
  if (is_right) return;
  std::fprintf(stderr, "fuzz_h264_stream: %s\n", what.c_str());
  std::abort();
}

PictureRate rate_of(const Config& config) {
  return {config.rate_numerator, config.rate_denominator};
}

/// One that some level holds.
Config config_of(Numbers& numbers) {
  constexpr std::array kNumerators = {60, 30000, 1, 1, 172, 360, 990, 11880, 65535, 500'000};
  constexpr std::array kDenominators = {1, 1001, 1, 30, 1, 1, 1, 1, 2, 1};
  Config config;
  config.width_px = 2 * numbers.integer(1, 48);
  config.height_px = 2 * numbers.integer(1, 40);
  config.qp = numbers.integer(0, kMaxQp);
  const auto rate = static_cast<std::size_t>(numbers.integer(0, kNumerators.size() - 1));
  config.rate_numerator = kNumerators[rate];
  config.rate_denominator = kDenominators[rate];
  return config;
}

/// Rectangles that cover what has changed, and others.
std::vector<Rect> rects_of(const MacroblockSet& changed, const Config& config, Numbers& numbers) {
  const int width_mb = (config.width_px + 15) / 16;
  std::vector<Rect> rects;
  constexpr int kMostEven = 2'147'483'646;
  const int way = numbers.integer(0, 3);
  if (way == 0) return {{0, 0, kMostEven, 1 << 30}};
  for (int i = changed.next(0); i >= 0; i = changed.next(i + 1)) {
    const int x = 16 * (i % width_mb);
    const int y = 16 * (i / width_mb);
    rects.push_back(way == 1 ? Rect{x, y, 22, 18} : Rect{x, y, 16, 16});
  }
  if (way == 2) return rects;
  const auto even = [&] { return 2 * numbers.integer(0, 100); };
  rects.push_back({even(), even(), even(), even()});
  rects.push_back({kMostEven, kMostEven, kMostEven, kMostEven});
  rects.push_back({4, 6, 0, 2});
  return rects;
}

/// A stream, and all that is checked with each of its pictures.
class Stream {
 public:
  Stream(const Config& config, const Encoder& encoder)
      : config_(config),
        decoder_({encoder.headers().begin(), encoder.headers().end()}),
        file_({.width_px = config.width_px,
               .height_px = config.height_px,
               .rate = rate_of(config),
               .headers = encoder.headers(),
               .max_pictures = kMostFrames},
              [](auto, auto) {}) {}

  void take(const Planes& source, const CodedPicture& coded,
            const std::vector<std::uint8_t>& unit) {
    ++counter.pictures;
    const auto shown = decoder_.decode(unit);
    require(shown.has_value(), "no picture");
    const std::string problem =
        excess(source, config_.width_px, config_.height_px, *shown, config_.qp);
    require(problem.empty(), problem);
    file_.append(unit, coded.type == PictureType::idr);
  }
  void finish() { file_.finish(); }

 private:
  Config config_;
  StrictDecoder decoder_;
  Mp4Writer file_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kOneIn = 10;  // pictures is a key frame, and the first after a restart
  piblocks::silence_av();
  Numbers numbers({data, size});
  const Config config = config_of(numbers);
  Encoder encoder(config);
  auto other = std::make_unique<Encoder>(config);  // is told that all may have changed
  auto stream = std::make_unique<Stream>(config, encoder);
  CallersPicture callers(config.width_px, config.height_px, numbers.integer(0, 70));
  RandomPictures pictures((config.width_px + 15) / 16, (config.height_px + 15) / 16, numbers);
  std::vector<std::uint8_t> unit;
  std::vector<std::uint8_t> other_unit;
  const std::vector<Rect> all = {{0, 0, config.width_px, config.height_px}};
  PictureType last = PictureType::idr;
  for (int frame = 0; frame < kMostFrames && (frame == 0 || numbers.has_more()); ++frame) {
    if (frame > 0) pictures.advance();
    const int chance = numbers.integer(1, kOneIn);
    // After a key frame, idr_pic_id would be another one.
    if (chance == 2 && last == PictureType::p) {
      ++counter.restarts;
      stream->finish();
      encoder.restart();
      stream = std::make_unique<Stream>(config, encoder);
      other = std::make_unique<Encoder>(config);
    }
    callers.copy(pictures.picture());
    const Planes source = callers.planes();
    const PictureType type = chance == 1 && frame > 0 ? PictureType::idr : PictureType::p;
    const std::vector<Rect> changed = rects_of(pictures.changed(), config, numbers);
    const CodedPicture coded = encode(encoder, source, frame == 0 ? all : changed, type, unit);
    last = coded.type;
    stream->take(source, coded, unit);
    encode(*other, source, all, type, other_unit);
    require(unit == other_unit, "the bytes depend on what was before, or on the rectangles");
  }
  stream->finish();
  return 0;
}
