// The order of all stages: scene -> log -> state -> draw list -> pixels -> sink.
#include <piblocks/canvas.hpp>
#include <piblocks/collision_log.hpp>
#include <piblocks/compose.hpp>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>
#include <piblocks/timeline.hpp>

#include <algorithm>

#include "render/ordered_pool.hpp"

namespace piblocks {
namespace {

/// Consecutive frames that are encoded together, by number alone.
struct Chunks {
  std::int64_t frame_count;
  std::int64_t frames_per_chunk;

  std::int64_t count() const { return (frame_count + frames_per_chunk - 1) / frames_per_chunk; }
  std::int64_t begin(std::int64_t chunk) const { return chunk * frames_per_chunk; }
  std::int64_t end(std::int64_t chunk) const { return std::min(begin(chunk + 1), frame_count); }
};

}  // namespace

std::int64_t render(const RenderJob& job, const std::function<void(const Progress&)>& on_progress,
                    const std::stop_token& stop) {
  const Scene& scene = job.scene;
  const std::unique_ptr<CollisionLog> log = make_collision_log(scene.system);
  const Timeline timeline(scene, *log);
  const Layout layout = lay_out(scene, log->size());
  const VideoFormat format{scene.view.width_px, scene.view.height_px, scene.view.frame_rate};
  const std::unique_ptr<FrameSink> sink = open_sink(job.output, format, job.encoder);
  const Chunks chunks{timeline.frame_count(), sink->frames_per_chunk()};

  const auto make_worker = [&] {
    const auto canvas = std::make_shared<Canvas>(format.width_px, format.height_px);
    return [&, canvas](std::int64_t chunk, const std::stop_token& halt) {
      const std::unique_ptr<ChunkEncoder> encoder = sink->begin_chunk(chunks.begin(chunk));
      for (std::int64_t frame = chunks.begin(chunk); frame < chunks.end(chunk); ++frame) {
        if (halt.stop_requested()) throw Interrupted("render: interrupted");
        const BlockState state = state_at(*log, timeline.time_of(frame));
        const auto changed = canvas->update(compose(scene, layout, state));
        encoder->add(canvas->view(), changed);
      }
      return encoder->finish();
    };
  };

  on_progress({0, chunks.frame_count});
  OrderedPool<EncodedChunk> pool(chunks.count(), job.jobs, make_worker);
  for (std::int64_t chunk = 0; const auto encoded = pool.take(stop); ++chunk) {
    sink->append(*encoded);
    on_progress({chunks.end(chunk), chunks.frame_count});
  }
  if (stop.stop_requested()) throw Interrupted("render: interrupted");
  sink->finish();
  return chunks.frame_count;
}

}  // namespace piblocks
