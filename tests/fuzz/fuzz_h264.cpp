// The encoder of H.264 on pictures and changes that the bytes say, some of them encoded again by
// another quantiser. libavcodec has to show every picture as the encoder believes it is shown.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <string>

#include "fuzz/numbers.hpp"
#include "h264/random_pictures.hpp"
#include "h264/stream_fixture.hpp"

namespace {

using namespace piblocks::h264;
using piblocks::fuzz::Numbers;

/// Says at the end how many pictures were compared.
struct Counter {
  ~Counter() { std::fprintf(stderr, "fuzz_h264: %lld pictures were compared\n", pictures); }
  long long pictures = 0;
} counter;

Config config_of(Numbers& numbers) {
  constexpr std::array<std::array<int, 2>, 8> kSizes = {
      {{2, 2}, {16, 16}, {18, 14}, {34, 18}, {64, 16}, {2, 50}, {48, 46}, {80, 64}}};
  const auto [width, height] = kSizes.at(static_cast<std::size_t>(numbers.integer(0, 7)));
  return {.width_px = width, .height_px = height, .qp = numbers.integer(0, kMaxQp)};
}

void check(const Picture& decoded, const std::optional<ShownPicture>& shown) {
  std::string found = "no picture";
  // Samples that are cut off have to be right too: others are predicted from them.
  if (shown && shown->width == 16 * decoded.width_mb() &&
      shown->height == 16 * decoded.height_mb()) {
    found = difference(decoded, *shown);
  }
  ++counter.pictures;
  if (found.empty()) return;
  std::fprintf(stderr, "fuzz_h264: %s\n", found.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int kMostFrames = 16;
  constexpr int kOneIn = 10;  // pictures is a key frame
  Numbers numbers({data, size});
  piblocks::silence_av();
  const StreamHeaders headers(config_of(numbers));
  PictureEncoder encoder(headers.config);
  RandomPictures pictures(headers.width_mb, headers.height_mb, numbers);
  StrictDecoder decoder(headers.bytes);
  check(encoder.decoded(), decoder.decode(encoded_idr(encoder, pictures.picture())));
  for (int frame = 1; frame < kMostFrames && numbers.has_more(); ++frame) {
    pictures.advance();
    const bool is_idr = numbers.integer(1, kOneIn) == 1;
    const Bytes unit = is_idr ? encoded_idr(encoder, pictures.picture())
                              : encoded_p(encoder, pictures.picture(), pictures.changed());
    check(encoder.decoded(), decoder.decode(unit));
  }
  return 0;
}
