#include "python/extension/picture.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "core/input_file.hpp"
#include "media/png/png_chunk.hpp"
#include "media/png/png_reader.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// Samples in memory as the only frame.
class SampleReader final : public FrameReader {
 public:
  explicit SampleReader(AnyImage samples) : samples_(std::move(samples)) {}

  bool next() override { return true; }
  AnyImage samples() override { return samples_; }

 private:
  AnyImage samples_;
};

struct Shape {
  int height_px = 0;
  int width_px = 0;
  std::size_t channels = 1;
};

Shape shape_of(const py::buffer_info& info) {
  const auto& shape = info.shape;
  const bool has_channels = shape.size() == 3 && (shape[2] == 3 || shape[2] == 4);
  if (shape.size() != 2 && !has_channels) throw std::invalid_argument("the array has another form");
  py::ssize_t step = info.itemsize;
  for (std::size_t axis = shape.size(); axis-- > 0; step *= shape[axis]) {
    if (info.strides[axis] != step) throw std::invalid_argument("the array has gaps");
  }
  const bool fits = std::max(shape[0], shape[1]) <= kMaxSide_px && shape[0] * shape[1] > 0 &&
                    shape[0] * shape[1] <= kMaxFrame_px;
  if (!fits) {
    throw UsageError(fmt::format(
        "compare: cannot take a picture of {}x{} pixels: each side must have 1 to {} pixels, and "
        "the whole picture at most {}; cut it into parts",
        shape[1], shape[0], kMaxSide_px, kMaxFrame_px));
  }
  return {int(shape[0]), int(shape[1]), has_channels ? std::size_t(shape[2]) : 1};
}

/// Words of alpha, red, green and blue, the highest first.
template <typename Sample, typename Word>
void fill(const void* samples, const Shape& shape, std::vector<Word>& words) {
  constexpr int kBits = 8 * sizeof(Sample);
  constexpr Word kOpaque = Word{static_cast<Sample>(-1)} << (3 * kBits);
  words.resize(std::size_t(shape.width_px) * std::size_t(shape.height_px));
  const auto* at = static_cast<const Sample*>(samples);
  for (Word& word : words) {
    const bool is_grey = shape.channels == 1;
    const Word green = at[is_grey ? 0 : 1];
    const Word blue = at[is_grey ? 0 : 2];
    const Word alpha = shape.channels == 4 ? Word{at[3]} << (3 * kBits) : kOpaque;
    word = alpha | Word{at[0]} << (2 * kBits) | green << kBits | blue;
    at += shape.channels;
  }
}

/// Reads the picture, or notes why it cannot be read.
Fetched read(std::unique_ptr<FrameReader> frame) {
  Fetched fetched{.is_there = true, .key = "picture.png", .frame = std::move(frame)};
  try {
    fetched.frame->next();
  } catch (const Error& error) {
    fetched.problem = error.what();
  }
  return fetched;
}

}  // namespace

Picture Picture::of_samples(const py::buffer& buffer) {
  const py::buffer_info info = buffer.request();
  const Shape shape = shape_of(info);
  if (info.itemsize == 1) {
    Image image{shape.width_px, shape.height_px};
    fill<std::uint8_t>(info.ptr, shape, image.words);
    return Picture(AnyImage(std::move(image)));
  }
  if (info.itemsize != 2) throw std::invalid_argument("the array has other samples");
  DeepImage image{.width_px = shape.width_px, .height_px = shape.height_px};
  fill<std::uint16_t>(info.ptr, shape, image.words);
  return Picture(AnyImage(std::move(image)));
}

Picture Picture::of_png(const std::string& bytes) {
  return Picture(Bytes(bytes.begin(), bytes.end()));
}

Picture Picture::of_path(const std::string& path) { return Picture(path); }

Fetched Picture::fetch(const std::string& role) const {
  if (const auto* png = std::get_if<Bytes>(&content_)) return read(read_png_bytes(role, *png));
  if (const auto* samples = std::get_if<AnyImage>(&content_)) {
    return read(std::make_unique<SampleReader>(*samples));
  }
  const std::filesystem::path path = *this->path();
  Fetched fetched = fetch_picture({.name = path.string(), .path = path});
  fetched.key = path.filename().string();
  return fetched;
}

Bytes Picture::png() const {
  if (const auto* samples = std::get_if<AnyImage>(&content_)) {
    const auto* deep = std::get_if<DeepImage>(samples);
    return deep != nullptr ? encode_png_samples(*deep) : encode_png_samples(flattened(*samples));
  }
  const Fetched fetched = fetch("the picture");
  if (!fetched.problem.empty()) throw IoError(fetched.problem);
  if (const auto* png = std::get_if<Bytes>(&content_)) return *png;
  return whole_file(*path(), "compare");
}

}  // namespace piblocks::python
