// A square slides over grey, as an MP4 file: what a user of the library writes.
// In: the file's name. Out: 100 pictures of 320x180 pixels, 25 a second.
#include <array>
#include <exception>
#include <fstream>
#include <iostream>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/mp4_writer.hpp"

namespace h264 = piblocks::h264;

constexpr int kWidth_px = 320;
constexpr int kHeight_px = 180;
constexpr int kPictures = 100;

void fill(std::vector<std::uint8_t>& luma, const h264::Rect& rect, std::uint8_t value) {
  for (int y = rect.y_px; y < rect.y_px + rect.height_px; ++y) {
    for (int x = rect.x_px; x < rect.x_px + rect.width_px; ++x) luma[y * kWidth_px + x] = value;
  }
}

void write_film(const char* name) {
  const h264::Config config{.width_px = kWidth_px, .height_px = kHeight_px, .rate_numerator = 25};
  h264::Encoder encoder(config);
  std::ofstream file(name, std::ios::binary);
  file.exceptions(std::ios::badbit | std::ios::failbit);
  const h264::Mp4Track track{kWidth_px, kHeight_px, {25, 1}, encoder.headers(), kPictures};
  h264::Mp4Writer mp4(track, [&](std::uint64_t offset, std::span<const std::uint8_t> bytes) {
    file.seekp(static_cast<std::streamoff>(offset));
    file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  });

  std::vector<std::uint8_t> luma(kWidth_px * kHeight_px, 128);
  const std::vector<std::uint8_t> chroma(kWidth_px / 2 * kHeight_px / 2, 128);
  const h264::Planes planes{
      {luma.data(), kWidth_px}, {chroma.data(), kWidth_px / 2}, {chroma.data(), kWidth_px / 2}};
  h264::Rect square{};
  std::vector<std::uint8_t> unit;
  for (int i = 0; i < kPictures; ++i) {
    const h264::Rect before = square;
    square = {2 * i, 60, 64, 64};
    fill(luma, before, 128);
    fill(luma, square, 235);
    const auto type = i % 50 == 0 ? h264::PictureType::idr : h264::PictureType::p;
    encoder.encode(planes, std::array{before, square}, type, unit);
    mp4.append(unit, type == h264::PictureType::idr);
  }
  mp4.finish();
}

int main(int count, char** arguments) try {
  if (count == 2) write_film(arguments[1]);
  return count == 2 ? 0 : 2;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
