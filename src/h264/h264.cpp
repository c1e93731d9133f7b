#include "h264/h264.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/text.hpp"

namespace h264 = piblocks::h264;

struct piblocks_h264_encoder {
  h264::Encoder encoder;
  std::size_t max_unit_bytes;
  std::vector<std::uint8_t> unit = {};
  std::vector<h264::Rect> changed = {};
  std::string text = {};
  const char* problem = "";  // of the text, or a constant
};

namespace {

h264::Config config_of(const piblocks_h264_config& config) {
  return {.width_px = config.width_px,
          .height_px = config.height_px,
          .rate_numerator = config.rate_numerator,
          .rate_denominator = config.rate_denominator,
          .qp = config.qp,
          .level_idc = config.level_idc};
}

void require_room(std::size_t needed_bytes, const std::uint8_t* unit, std::size_t unit_bytes) {
  if (unit != nullptr && unit_bytes >= needed_bytes) return;
  throw h264::Error(h264::text("h264: a unit may have ", needed_bytes, " bytes, the buffer has ",
                               unit == nullptr ? 0 : unit_bytes));
}

std::size_t copy(std::span<const std::uint8_t> from, std::uint8_t* to) {
  std::ranges::copy(from, to);
  return from.size();
}

/// What `action` returns; 0, and a problem, if it throws.
template <typename Action>
std::size_t result_of(const Action& action, piblocks_h264_encoder& encoder) noexcept {
  try {
    try {
      return action();
    } catch (const h264::Error& error) {
      encoder.text = error.what();
      encoder.problem = encoder.text.c_str();
    }
  } catch (const std::exception&) {
    encoder.problem = "h264: out of memory";
  }
  return 0;
}

}  // namespace

piblocks_h264_config piblocks_h264_default_config(int width_px, int height_px) {
  const h264::Config config;
  return {width_px,  height_px,       config.rate_numerator, config.rate_denominator,
          config.qp, config.level_idc};
}

size_t piblocks_h264_max_unit_bytes(const piblocks_h264_config* config) {
  try {
    return h264::Encoder::max_unit_bytes(config_of(*config));
  } catch (const std::exception&) {
    return 0;
  }
}

piblocks_h264_encoder* piblocks_h264_open(const piblocks_h264_config* config, char* message,
                                          size_t message_bytes) {
  try {
    return new piblocks_h264_encoder{
        .encoder = h264::Encoder(config_of(*config)),
        .max_unit_bytes = h264::Encoder::max_unit_bytes(config_of(*config))};
  } catch (const std::exception& error) {
    if (message == nullptr || message_bytes == 0) return nullptr;
    const std::size_t size = std::min(std::strlen(error.what()), message_bytes - 1);
    std::memcpy(message, error.what(), size);
    message[size] = '\0';
    return nullptr;
  }
}

void piblocks_h264_close(piblocks_h264_encoder* encoder) {
  delete encoder;  // NOLINT(cppcoreguidelines-owning-memory): this is the owner
}

size_t piblocks_h264_headers(piblocks_h264_encoder* encoder, uint8_t* unit, size_t unit_bytes) {
  return result_of(
      [&] {
        const std::span<const std::uint8_t> headers = encoder->encoder.headers();
        require_room(headers.size(), unit, unit_bytes);
        return copy(headers, unit);
      },
      *encoder);
}

size_t piblocks_h264_encode(piblocks_h264_encoder* encoder, const piblocks_h264_plane planes[3],
                            const piblocks_h264_rect* changed, size_t rects, int is_idr,
                            uint8_t* unit, size_t unit_bytes) {
  const auto plane = [&](int i) -> h264::Plane {
    return {planes[i].samples, planes[i].stride_bytes};
  };
  return result_of(
      [&] {
        require_room(encoder->max_unit_bytes, unit, unit_bytes);
        encoder->changed.clear();
        for (const piblocks_h264_rect& rect : std::span(changed, rects)) {
          encoder->changed.push_back({rect.x_px, rect.y_px, rect.width_px, rect.height_px});
        }
        encoder->encoder.encode({plane(0), plane(1), plane(2)}, encoder->changed,
                                is_idr != 0 ? h264::PictureType::idr : h264::PictureType::p,
                                encoder->unit);
        return copy(encoder->unit, unit);
      },
      *encoder);
}

const char* piblocks_h264_problem(const piblocks_h264_encoder* encoder) { return encoder->problem; }
