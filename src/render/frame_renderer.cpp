#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>

#include "draw/canvas.hpp"
#include "render/film.hpp"

namespace piblocks {
namespace {

constexpr std::ptrdiff_t kPixel_bytes = 4;

void check_buffer(const View& view, std::size_t size_bytes, std::ptrdiff_t stride_bytes) {
  const std::ptrdiff_t row_bytes = view.width_px * kPixel_bytes;
  if (stride_bytes < row_bytes) {
    throw UsageError(fmt::format("frame: a stride of {} bytes is less than a row of {} pixels",
                                 stride_bytes, view.width_px));
  }
  // Divided, because a product with the caller's stride might overflow.
  const auto rows_before_last = static_cast<std::size_t>(view.height_px - 1);
  const auto row = static_cast<std::size_t>(row_bytes);
  const auto stride = static_cast<std::size_t>(stride_bytes);
  if (size_bytes < row || (size_bytes - row) / stride < rows_before_last) {
    throw UsageError(fmt::format("frame: {} bytes do not hold {} rows with a stride of {} bytes",
                                 size_bytes, view.height_px, stride_bytes));
  }
}

}  // namespace

struct FrameRenderer::Impl {
  explicit Impl(const Script& script)
      : film(script), canvas(film.view().width_px, film.view().height_px, film.view().background) {}

  Film film;
  Canvas canvas;
};

FrameRenderer::FrameRenderer(const Script& script) : impl_(std::make_unique<Impl>(script)) {}
FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;
FrameRenderer& FrameRenderer::operator=(FrameRenderer&&) noexcept = default;

std::int64_t FrameRenderer::frame_count() const noexcept { return impl_->film.frame_count(); }

ImageView FrameRenderer::frame(std::int64_t number) {
  if (number < 0 || number >= frame_count()) {
    throw UsageError(
        fmt::format("frame: there is no number {}; use 0 to {}", number, frame_count() - 1));
  }
  impl_->canvas.update(impl_->film.frame(number));
  return impl_->canvas.view();
}

void FrameRenderer::copy_frame(std::int64_t number, std::span<std::uint8_t> buffer,
                               std::ptrdiff_t stride_bytes) {
  check_buffer(impl_->film.view(), buffer.size(), stride_bytes);
  const ImageView image = frame(number);
  std::uint8_t* to = buffer.data();
  for (int y = 0; y < image.height_px; ++y) {
    std::copy_n(image.row(y), image.width_px * kPixel_bytes, to + y * stride_bytes);
  }
}

}  // namespace piblocks
