// Streams of random pictures, for decoders that are programs of their own.
// In: a folder. Out: WIDTHxHEIGHT-qpQP.h264 for several sizes and quantisers.
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "h264/callers_picture.hpp"
#include "h264/encoder.hpp"
#include "h264/random_pictures.hpp"

namespace piblocks::h264 {
namespace {

constexpr int kPictures = 120;
constexpr int kPicturesInGroup = 12;

/// The same numbers everywhere, which the standard library's distributions do not promise.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : engine_(seed) {}
  std::int64_t integer(std::int64_t first, std::int64_t last) {
    return first +
           static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(last - first + 1));
  }

 private:
  std::mt19937_64 engine_;
};

std::vector<Rect> macroblocks(const MacroblockSet& changed, int width_mb) {
  std::vector<Rect> rects;
  for (int at = changed.next(0); at >= 0; at = changed.next(at + 1))
    rects.push_back({16 * (at % width_mb), 16 * (at / width_mb), 16, 16});
  return rects;
}

void write(std::ofstream& file, std::span<const std::uint8_t> bytes) {
  file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
}

void write_stream(const std::string& folder, const Config& config) {
  const std::string name = std::to_string(config.width_px) + 'x' +
                           std::to_string(config.height_px) + "-qp" + std::to_string(config.qp);
  std::ofstream file(folder + '/' + name + ".h264", std::ios::binary);
  file.exceptions(std::ios::badbit | std::ios::failbit);
  Encoder encoder(config);
  const int width_mb = (config.width_px + 15) / 16;
  Numbers numbers(static_cast<std::uint32_t>(config.qp));
  RandomPictures pictures(width_mb, (config.height_px + 15) / 16, numbers);
  std::vector<std::uint8_t> unit;
  write(file, encoder.headers());
  for (int i = 0; i < kPictures; ++i) {
    if (i > 0) pictures.advance();
    const std::vector<Rect> all = {{0, 0, config.width_px, config.height_px}};
    encode(encoder, pictures.picture().planes(),
           i == 0 ? all : macroblocks(pictures.changed(), width_mb),
           i % kPicturesInGroup == 0 ? PictureType::idr : PictureType::p, unit);
    write(file, unit);
  }
}

}  // namespace
}  // namespace piblocks::h264

int main(int count, char** arguments) try {
  if (count != 2) {
    std::cerr << "usage: random_streams FOLDER\n";
    return 2;
  }
  for (const int qp : {0, 7, 14, 26, 41}) {
    piblocks::h264::write_stream(arguments[1], {.width_px = 322, .height_px = 180, .qp = qp});
    piblocks::h264::write_stream(arguments[1], {.width_px = 250, .height_px = 234, .qp = qp});
  }
  piblocks::h264::write_stream(arguments[1], {.width_px = 64, .height_px = 16});
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
