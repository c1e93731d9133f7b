#include "h264/mp4_boxes.hpp"

namespace piblocks::h264 {
namespace {

/// kMax32 itself means "unknown".
bool is_long(std::uint64_t duration) { return duration >= kMax32; }

}  // namespace

void TrackWriter::put_movie(std::uint64_t time_scale, std::uint64_t duration,
                            std::uint64_t next_id) {
  box("mvhd", [&] {
    put_version(is_long(duration));
    put_times(duration, {time_scale});
    put_all({0x10000, 0x1000000, 0, 0});  // rate 1, volume 1
    put_unit_matrix();
    put_zeros(24);
    put(next_id, 4);
  });
}

void TrackWriter::put_track_header(const Head& head) {
  box("tkhd", [&] {
    put_version(is_long(head.duration), 3);  // enabled, in the movie
    put_times(head.duration, {head.id, 0});
    put_zeros(8);
    put_all({head.group, head.volume << 16});  // below layer 0
    put_unit_matrix();
    put_all({head.width_px << 16, head.height_px << 16});
  });
}

void TrackWriter::put_chunks(std::span<const ChunkRun> runs,
                             std::span<const std::uint64_t> offsets) {
  box("stsc", [&] {
    put_all({0, runs.size()});
    for (const ChunkRun& run : runs) put_all({run.first, run.samples, 1});
  });
  const bool is_far = !offsets.empty() && offsets.back() > kMax32;
  box(is_far ? "co64" : "stco", [&] {
    put_all({0, offsets.size()});
    for (const std::uint64_t offset : offsets) put(offset, is_far ? 8 : 4);
  });
}

void TrackWriter::put_chunks(std::span<const SampleChunk> chunks) {
  std::vector<ChunkRun> runs;
  std::vector<std::uint64_t> offsets;
  for (const auto& [offset, samples] : chunks) {
    offsets.push_back(offset);
    if (runs.empty() || runs.back().samples != samples) runs.push_back({offsets.size(), samples});
  }
  put_chunks(runs, offsets);
}

void TrackWriter::put_sizes(std::span<const std::uint32_t> sizes) {
  box("stsz", [&] {
    put_all({0, 0, sizes.size()});
    for (const std::uint32_t size : sizes) put(size, 4);
  });
}

void TrackWriter::put_times(std::uint64_t duration, std::initializer_list<std::uint64_t> between) {
  const int size_bytes = is_long(duration) ? 8 : 4;
  for (int i = 0; i < 2; ++i) put(0, size_bytes);  // of creation and change
  put_all(between);
  put(duration, size_bytes);
}

void TrackWriter::put_edits(const Head& head) {
  box("edts", [&] {
    box("elst", [&] {
      const int size_bytes = is_long(head.duration) ? 8 : 4;
      put_version(is_long(head.duration));
      put(1, 4);
      put(head.duration, size_bytes);
      put(head.media_start, size_bytes);
      put(0x10000, 4);  // media_rate 1
    });
  });
}

void TrackWriter::put_media_header(const Head& head) {
  box("mdhd", [&] {
    put_version(is_long(head.media_duration));
    put_times(head.media_duration, {head.time_scale});
    put(0x55c40000, 4);  // language "und"
  });
  box("hdlr", [&] {
    put_zeros(8);
    put(head.handler);
    put_zeros(12);
    put(head.name);
    put(0, 1);
  });
}

void TrackWriter::put_data_reference() {
  box("dinf", [&] {
    box("dref", [&] {
      put_all({0, 1});
      box("url ", [&] { put(1, 4); });  // the data are in this file
    });
  });
}

}  // namespace piblocks::h264
