#include "h264/h264.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "h264/encoder.hpp"
#include "h264/text.hpp"

namespace h264 = piblocks::h264;

struct piblocks_h264_encoder {
  h264::Encoder encoder;
  std::vector<std::uint8_t> unit = {};
  std::vector<h264::Rect> changed = {};
  std::string problem = {};
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

/// @return how many bytes were copied; 0, and a problem, if there is no room for all.
std::size_t copy(std::span<const std::uint8_t> from, std::uint8_t* to, std::size_t room_bytes,
                 std::string& problem) {
  if (from.size() > room_bytes || to == nullptr) {
    problem = h264::text("h264: a unit has ", from.size(), " bytes, the buffer ", room_bytes);
    return 0;
  }
  std::memcpy(to, from.data(), from.size());
  return from.size();
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
    return new piblocks_h264_encoder{h264::Encoder(config_of(*config))};
  } catch (const std::exception& error) {
    if (message == nullptr || message_bytes == 0) return nullptr;
    const std::size_t size = std::min(std::strlen(error.what()), message_bytes - 1);
    std::memcpy(message, error.what(), size);
    message[size] = '\0';
    return nullptr;
  }
}

void piblocks_h264_close(piblocks_h264_encoder* encoder) { delete encoder; }

size_t piblocks_h264_headers(piblocks_h264_encoder* encoder, uint8_t* unit, size_t unit_bytes) {
  return copy(encoder->encoder.headers(), unit, unit_bytes, encoder->problem);
}

size_t piblocks_h264_encode(piblocks_h264_encoder* encoder, const piblocks_h264_plane planes[3],
                            const piblocks_h264_rect* changed, size_t rects, int is_idr,
                            uint8_t* unit, size_t unit_bytes) {
  try {
    encoder->changed.clear();
    for (std::size_t i = 0; i < rects; ++i) {
      const piblocks_h264_rect& rect = changed[i];
      encoder->changed.push_back({rect.x_px, rect.y_px, rect.width_px, rect.height_px});
    }
    const auto plane = [&](int i) -> h264::Plane {
      return {planes[i].samples, planes[i].stride_bytes};
    };
    encoder->encoder.encode({plane(0), plane(1), plane(2)}, encoder->changed,
                            is_idr != 0 ? h264::PictureType::idr : h264::PictureType::p,
                            encoder->unit);
    return copy(encoder->unit, unit, unit_bytes, encoder->problem);
  } catch (const std::exception& error) {
    encoder->problem = error.what();
    return 0;
  }
}

const char* piblocks_h264_problem(const piblocks_h264_encoder* encoder) {
  return encoder->problem.c_str();
}
