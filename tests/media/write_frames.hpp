// Drives a sink as the renderer does.
// In: an output and a function that paints frame n. Out: the complete output.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "media/output/output.hpp"
#include "support/article_frames.hpp"

namespace piblocks {

using PaintFrame = std::function<testing_support::Pixels(std::int64_t number)>;

inline PaintFrame article_frames(const VideoFormat& format) {
  return [format](std::int64_t number) {
    const double time_s = to_double(Rational(number) / format.frame_rate);
    return testing_support::article_frame(format.width_px, format.height_px, time_s);
  };
}

inline PaintFrame random_frames(const VideoFormat& format) {
  return [format](std::int64_t number) {
    return testing_support::random_frame(format.width_px, format.height_px,
                                         static_cast<std::uint32_t>(number));
  };
}

/// Takes the whole frame, and encodes it.
inline void add(ChunkEncoder& encoder, const ImageView& frame) {
  encoder.take(frame);
  encoder.encode();
}

inline EncodedChunk encode_chunk(const Output& output, ChunkEncoder& encoder, std::int64_t first,
                                 std::int64_t frames, const PaintFrame& paint) {
  if (output.needs_frame_before && first > 0) encoder.take(paint(first - 1).view());
  encoder.begin(first);
  const std::int64_t end = std::min(frames, first + output.frames_per_chunk);
  for (std::int64_t number = first; number < end; ++number) add(encoder, paint(number).view());
  return encoder.finish();
}

inline EncodedChunk encode_chunk(const Output& output, std::int64_t first, std::int64_t frames,
                                 const PaintFrame& paint) {
  return encode_chunk(output, *output.make_encoder(), first, frames, paint);
}

/// One thread and one encoder, chunk after chunk.
inline void write_frames(const std::string& name, const VideoFormat& format,
                         const EncoderSettings& settings, std::int64_t frames,
                         const PaintFrame& paint) {
  const auto output = set_up_output(name, format, settings);
  const auto encoder = output.make_encoder();
  const auto sink = output.open({frames});
  for (std::int64_t first = 0; first < frames; first += output.frames_per_chunk) {
    sink->append(encode_chunk(output, *encoder, first, frames, paint));
  }
  sink->finish();
}

/// A thread and an encoder for each chunk, all at once, the last chunk started first.
inline void write_frames_by_threads(const std::string& name, const VideoFormat& format,
                                    const EncoderSettings& settings, std::int64_t frames,
                                    const PaintFrame& paint) {
  const auto output = set_up_output(name, format, settings);
  const auto sink = output.open({frames});
  const std::int64_t length = output.frames_per_chunk;
  std::vector<EncodedChunk> chunks(static_cast<std::size_t>((frames + length - 1) / length));
  std::vector<std::jthread> threads;
  for (std::size_t i = chunks.size(); i-- > 0;) {
    threads.emplace_back([&, i] {
      chunks[i] = encode_chunk(output, static_cast<std::int64_t>(i) * length, frames, paint);
    });
  }
  threads.clear();
  for (const EncodedChunk& chunk : chunks) sink->append(chunk);
  sink->finish();
}

}  // namespace piblocks
