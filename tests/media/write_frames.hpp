// Drives a sink as the renderer does.
// In: a sink and a function that paints frame n. Out: the complete output.
#pragma once

#include <piblocks/frame_sink.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <thread>
#include <vector>

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

inline EncodedChunk encode_chunk(const FrameSink& sink, std::int64_t first, std::int64_t frames,
                                 const PaintFrame& paint) {
  const auto encoder = sink.begin_chunk(first);
  const std::int64_t end = std::min(frames, first + sink.frames_per_chunk());
  for (std::int64_t number = first; number < end; ++number) encoder->add(paint(number).view());
  return encoder->finish();
}

/// One thread, chunk after chunk.
inline void write_frames(const std::string& output, const VideoFormat& format,
                         const EncoderSettings& settings, std::int64_t frames,
                         const PaintFrame& paint) {
  const auto sink = open_sink(output, format, settings);
  for (std::int64_t first = 0; first < frames; first += sink->frames_per_chunk()) {
    sink->append(encode_chunk(*sink, first, frames, paint));
  }
  sink->finish();
}

/// A thread for each chunk, the last chunk started first, all of them at work at once.
inline void write_frames_by_threads(const std::string& output, const VideoFormat& format,
                                    const EncoderSettings& settings, std::int64_t frames,
                                    const PaintFrame& paint) {
  const auto sink = open_sink(output, format, settings);
  const std::int64_t length = sink->frames_per_chunk();
  std::vector<EncodedChunk> chunks(static_cast<std::size_t>((frames + length - 1) / length));
  std::vector<std::jthread> threads;
  for (std::size_t i = chunks.size(); i-- > 0;) {
    threads.emplace_back([&, i] {
      chunks[i] = encode_chunk(*sink, static_cast<std::int64_t>(i) * length, frames, paint);
    });
  }
  threads.clear();
  for (const EncodedChunk& chunk : chunks) sink->append(chunk);
  sink->finish();
}

}  // namespace piblocks
