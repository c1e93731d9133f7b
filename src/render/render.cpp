// The order of all stages: script -> log -> state -> draw list -> pixels -> packets -> sink.
#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <atomic>
#include <filesystem>

#include "core/ordered_pool.hpp"
#include "core/processors.hpp"
#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "media/output/output.hpp"
#include "media/output/shard_file.hpp"
#include "render/chunks.hpp"
#include "render/film.hpp"
#include "render/flash_meter.hpp"
#include "render/renderings.hpp"
#include "render/step_clock.hpp"
#include "render/video_text.hpp"
#include "scene/run_log.hpp"

namespace piblocks {
namespace {

FrameRange frames_of(const RenderJob& job, const Film& film) {
  const FrameRange all = film.frames();
  const FrameRange frames = job.frames.value_or(all);
  if (0 <= frames.first && frames.first <= frames.last && frames.last <= all.last) return frames;
  throw UsageError(fmt::format("frames: there are no frames {}-{}; those of the film are {}-{}",
                               frames.first, frames.last, all.first, all.last));
}

/// Those of the job. The first picture of a range has the number that it has in the whole sequence.
EncoderSettings settings_of(const RenderJob& job) {
  EncoderSettings settings = job.encoder;
  if (job.frames && has_numbers(job.output)) {
    settings.start_number = settings.start_number.value_or(1) + int(job.frames->first);
  }
  return settings;
}

/// Everything that decides what the frames show, how they sound, and how they are encoded.
struct Plan {
  Plan(const RenderJob& job, const Film& of)
      : film(of),
        frames(frames_of(job, film)),
        sound(soundtrack_of(job)),
        output(set_up_output(
            job.output,
            {film.view().width_px, film.view().height_px, film.view().frame_rate,
             film.view().background == Background::transparent},
            settings_of(job), sound, job.overwrite,
            job.captions_inside ? captions_of(film, frames) : std::vector<Caption>())),
        chunks{output.has_frames ? frames.count() : 0, output.frames_per_chunk} {}

  std::optional<SoundFormat> soundtrack_of(const RenderJob& job) const {
    if (!is_sound_alone(job.output) && !sound_of(job.script).on) return std::nullopt;
    return sound_format(frames, film.view().frame_rate);
  }

  const Film& film;
  FrameRange frames;  ///< of the film; frame 0 of the output is the first of these
  std::optional<SoundFormat> sound;
  Output output;
  Chunks chunks;
};

struct EncodedWork {
  EncodedChunk chunk;
  std::string method = {};
  StepSeconds spent{};
};

std::size_t size_of(const EncodedWork& work) {
  std::size_t size = 0;
  for (const Packet& packet : work.chunk) size += packet.bytes.size();
  return size;
}

/// What one thread works with, chunk after chunk, of pixels.
class Worker {
 public:
  /// @param frames_done  those of all workers.
  Worker(const Plan& plan, bool profile, std::atomic<std::int64_t>& frames_done)
      : plan_(plan),
        profile_(profile),
        frames_done_(frames_done),
        canvas_(plan.film.view().width_px, plan.film.view().height_px, plan.film.view().background),
        encoder_(plan.output.make_encoder()) {}

  /// @param frames  of the output
  EncodedWork work(const FrameRange& frames, const std::stop_token& stop) {
    StepClock clock(profile_, Step::encode);
    canvas_.listen(stop);
    if (plan_.output.needs_frame_before && frames.first > 0) take_frame(frames.first - 1, clock);
    encoder_->begin(frames.first);
    for (auto frame = frames.first; frame <= frames.last; ++frame) {
      check_stop(stop);
      take_frame(frame, clock);
      encoder_->encode();
      frames_done_.fetch_add(1, std::memory_order_relaxed);
    }
    EncodedChunk encoded = encoder_->finish();
    return {std::move(encoded), encoder_->method(), clock.spent()};
  }

 private:
  void take_frame(std::int64_t frame, StepClock& clock) {
    clock.enter(Step::compose);
    DrawList list = plan_.film.frame(plan_.frames.first + frame);
    clock.enter(Step::paint);
    const std::span<const PixelRect> changed = canvas_.update(std::move(list));
    clock.enter(Step::convert);
    encoder_->take(canvas_.view(), changed);
    clock.enter(Step::encode);
  }

  const Plan& plan_;
  bool profile_;
  std::atomic<std::int64_t>& frames_done_;
  Canvas canvas_;
  std::unique_ptr<ChunkEncoder> encoder_;
};

/// The same as SVG files.
EncodedWork draw_vectors(const Plan& plan, const FrameRange& frames, bool profile,
                         std::atomic<std::int64_t>& frames_done, const std::stop_token& stop) {
  StepClock clock(profile, Step::compose);
  EncodedChunk chunk;
  for (auto frame = frames.first; frame <= frames.last; ++frame) {
    check_stop(stop);
    clock.enter(Step::compose);
    const DrawList list = plan.film.frame(plan.frames.first + frame);
    clock.enter(Step::paint);
    chunk.push_back({.bytes = draw_svg(list), .pts = frame});
    frames_done.fetch_add(1, std::memory_order_relaxed);
  }
  return {std::move(chunk), {}, clock.spent()};
}

/// A half-open range of chunks.
struct ChunkRange {
  std::int64_t begin;
  std::int64_t end;
};

ChunkRange range_of(const std::optional<Shard>& shard, std::int64_t chunks) {
  if (!shard) return {0, chunks};
  return {chunks * (shard->number - 1) / shard->count, chunks * shard->number / shard->count};
}

ShardHeader header_of_shard(const RenderJob& job, const Plan& plan) {
  ShardHeader header = describe(job, plan.output, plan.chunks.frame_count);
  header.emplace_back("part", fmt::format("{}/{}", job.shard->number, job.shard->count));
  return header;
}

std::unique_ptr<FrameSink> open_sink(const RenderJob& job, const Plan& plan) {
  if (job.shard) {
    return open_shard(shard_name(job.output, *job.shard), header_of_shard(job, plan),
                      job.overwrite);
  }
  if (!has_numbers(job.output)) return plan.output.open({plan.chunks.frame_count});
  // For a later --resume.
  ShardHeader header = describe(job, plan.output, plan.chunks.frame_count);
  header.emplace_back("name", std::filesystem::path(job.output).filename());
  header.emplace_back("first-frame", std::to_string(plan.frames.first));
  return plan.output.open({plan.chunks.frame_count, {text_of(header), job.resume}});
}

void check_shard(const RenderJob& job) {
  if (!job.shard) return;
  if (job.shard->number < 1 || job.shard->number > job.shard->count) {
    throw UsageError(fmt::format("part {} of {}: the number must be from 1 to the count",
                                 job.shard->number, job.shard->count));
  }
  if (job.captions_inside) {
    throw UsageError("part: parts have no captions inside; leave --captions or --part out");
  }
  if (!has_parts(job.output)) {
    throw UsageError(
        fmt::format("part: there are no parts of output '{}'; name a file that the "
                    "parts are to be joined to",
                    job.output));
  }
}

/// Packets whose making is charged to the sound, whoever asks for them.
class ClockedPackets final : public PacketSource {
 public:
  ClockedPackets(std::unique_ptr<PacketSource> packets, StepClock& clock)
      : packets_(std::move(packets)), clock_(clock) {}

  std::optional<Packet> next() override {
    const Step before = clock_.step();
    clock_.enter(Step::sound);
    std::optional<Packet> packet = packets_->next();
    clock_.enter(before);
    return packet;
  }

 private:
  std::unique_ptr<PacketSource> packets_;
  StepClock& clock_;
};

/// The soundtrack on its way to a sink. Nothing of it is made before the sink asks for it.
struct SoundWork {
  std::unique_ptr<SampleSource> samples;
  std::unique_ptr<PacketSource> packets;
};

/// The sound of a plan that has one. @param sound  as render_film() takes it
SoundWork sound_of(const Plan& plan, FilmSound* sound, const OnProgress& on_progress,
                   StepClock& clock, const std::stop_token& stop) {
  const auto report = [&](std::int64_t samples) {
    if (plan.output.has_frames || samples == plan.sound->size) return;
    const std::int64_t frames = plan.frames.count();
    on_progress({samples * frames / plan.sound->size, frames});
  };
  SoundWork work;
  SampleSource* samples = sound;
  if (sound != nullptr) {
    sound->begin(plan.frames);
  } else {
    work.samples = std::make_unique<FilmSound>(plan.film, plan.frames, stop, report);
    samples = work.samples.get();
  }
  work.packets = std::make_unique<ClockedPackets>(plan.output.encode_sound(*samples), clock);
  return work;
}

/// Those of the output, and what each run has to say.
std::vector<std::string> notes_of(const Plan& plan) {
  std::vector<std::string> notes = plan.output.notes;
  for (const PlacedSegment& placed : plan.film.segments()) {
    for (const FilmRun& run : placed.segment.runs()) {
      const Rational end = span_of(run.scene(), run.log()).to;
      auto note = tie_note(run.log(), run.log().count_at(end));
      if (note && std::ranges::find(notes, *note) == notes.end()) notes.push_back(*std::move(note));
    }
  }
  return notes;
}

/// More workers than processors make nothing faster: these are started only if all fit into some
/// 600 MB.
int workers_of(const RenderJob& job, const View& view) {
  constexpr std::int64_t kMost_bytes = 600'000'000;
  constexpr std::int64_t kWorker_bytes = 90;  // a pixel: those of VP9, the most that was measured
  const std::int64_t pixels = std::int64_t{view.width_px} * view.height_px;
  const auto fitting =
      static_cast<int>(std::min<std::int64_t>(kMost_bytes / kWorker_bytes / pixels, job.jobs));
  return std::min(job.jobs, std::max(fitting, processor_count()));
}

/// Hands on how many frames of all workers are done, if that has changed.
std::function<void()> frames_report(const std::atomic<std::int64_t>& done, std::int64_t count,
                                    const OnProgress& on_progress) {
  return [&done, count, &on_progress, reported = std::int64_t{-1}]() mutable {
    const std::int64_t now = done;
    if (std::exchange(reported, now) != now) on_progress({now, count});
  };
}

using Pool = OrderedPool<EncodedWork>;

/// Makes the function of one thread: frames of the output -> packets.
std::function<EncodedWork(const FrameRange&, const std::stop_token&)> make_worker(
    const RenderJob& job, const Plan& plan, std::atomic<std::int64_t>& frames_done) {
  if (is_vector(job.output)) {
    return [&](const FrameRange& frames, const std::stop_token& stop) {
      return draw_vectors(plan, frames, job.profile, frames_done, stop);
    };
  }
  const auto worker = std::make_shared<Worker>(plan, job.profile, frames_done);
  return [worker](const FrameRange& frames, const std::stop_token& stop) {
    return worker->work(frames, stop);
  };
}

/// @param sound  as render_film() takes it
Rendered render_chunks(const RenderJob& job, const Plan& plan, const OnProgress& on_progress,
                       const std::stop_token& stop, FilmSound* sound) {
  const ChunkRange range = range_of(job.shard, plan.chunks.count());
  Rendered rendered{plan.output.has_frames
                        ? plan.chunks.begin(range.end) - plan.chunks.begin(range.begin)
                        : plan.frames.count(),
                    {}};
  if (job.resume && job.shard &&
      has_shard(shard_name(job.output, *job.shard), header_of_shard(job, plan), stop)) {
    rendered.aftermath = "kept what an earlier run has made";
    return rendered;
  }
  const std::unique_ptr<FrameSink> sink = open_sink(job, plan);
  const std::int64_t kept = sink->kept_frames();
  const std::int64_t first = std::max(range.begin, plan.chunks.ended_by(kept));
  std::atomic<std::int64_t> frames_done = kept;
  const auto report = frames_report(frames_done, rendered.frame_count, on_progress);
  report();
  StepClock clock(job.profile, Step::mux);
  SoundWork sound_work;
  if (plan.sound && (!job.shard || job.shard->number == 1)) {
    sound_work = sound_of(plan, sound, on_progress, clock, stop);
    sink->take_sound(*sound_work.packets);
  }
  const auto make_task = [&]() -> Pool::Task {
    return [&, work_on = make_worker(job, plan, frames_done)](std::int64_t task,
                                                              const std::stop_token& halt) {
      const std::int64_t chunk = first + task;
      return work_on({std::max(plan.chunks.begin(chunk), kept), plan.chunks.end(chunk) - 1}, halt);
    };
  };
  Pool pool(range.end - first, workers_of(job, plan.film.view()), make_task, size_of);
  while (const auto done = pool.take(stop, std::ref(report))) {
    sink->append(done->chunk);
    if (job.profile) rendered.profile.chunk_methods.push_back(done->method);
    add(rendered.profile.steps, done->spent);
    report();
  }
  check_stop(stop);
  clock.enter(Step::write);
  sink->finish();
  rendered.aftermath = sink->aftermath();
  if (!plan.output.has_frames) on_progress({rendered.frame_count, rendered.frame_count});
  if (job.profile)
    add(rendered.profile, {clock.spent(), processor_seconds(CLOCK_PROCESS_CPUTIME_ID)});
  return rendered;
}

}  // namespace

Film film_of(const RenderJob& job, const std::stop_token& stop) {
  check_shard(job);
  return Film(job.script,
              {is_sound_alone(job.output) ? FilmUse::audio_only : FilmUse::pictures, stop});
}

Rendered render_film(const RenderJob& job, const Film& film, const OnProgress& on_progress,
                     const std::stop_token& stop, FilmSound* sound) {
  const Plan plan(job, film);
  film.require_certain(plan.frames, plan.sound.has_value());
  if (job.max_flashes && plan.output.has_frames) {
    check_flashes(plan.film, *job.max_flashes, stop, plan.frames);
  }
  Rendered rendered = plan.output.open ? render_chunks(job, plan, on_progress, stop, sound)
                                       : render_pdf(job, film, plan.frames, on_progress, stop);
  rendered.notes = notes_of(plan);  // by now the collisions of all frames are known
  return rendered;
}

namespace {

/// Leaves out sound, and lowers a frame rate, that the job's output cannot have.
/// @returns a note about each change, and about motion blur.
std::vector<std::string> fit_to_output(RenderJob& job) {
  std::vector<std::string> notes;
  const auto fit = [&](auto& script) {
    if (script.sound.on && !takes_sound(job.output)) {
      script.sound.on = false;
      notes.push_back(fmt::format("'{}' has no sound; that of the scene is left out", job.output));
    }
    const auto most = max_frame_rate_of(job.output);
    if (most && script.view.frame_rate > *most) {
      notes.push_back(
          fmt::format("'{}' shows at most {} frames a second, not {}; it is rendered at {}",
                      job.output, *most, script.view.frame_rate.get_str(), *most));
      script.view.frame_rate = *most;
    }
  };
  std::visit(fit, job.script);
  const auto is_blurred = [](const Scene* scene) { return scene->view.shutter > 0; };
  if (is_vector(job.output) && std::ranges::any_of(scenes_of(job.script), is_blurred)) {
    notes.push_back(fmt::format("'{}' has no motion blur: moving bodies are sharp", job.output));
  }
  return notes;
}

Rendered render_fitted(const RenderJob& job, const OnProgress& on_progress,
                       const std::stop_token& stop) {
  if (job.frames && (job.shard || job.bundle || is_page(job.output))) {
    throw UsageError("frames: parts, pages and bundles are of the whole film; leave frames out");
  }
  if (job.resume && !job.shard && !has_numbers(job.output)) {
    throw UsageError(fmt::format(
        "resume: only pictures of a sequence and parts of a video are kept, and '{}' is neither; "
        "render it in parts (--part), or leave resume out",
        job.output));
  }
  if ((job.bundle || is_page(job.output)) && (job.encoder.plays || job.encoder.start_number)) {
    throw UsageError(fmt::format(
        "output: '{}' has no use for plays or a start number; leave them out", job.output));
  }
  if (job.bundle) return render_bundle(job, on_progress, stop);
  if (is_page(job.output)) return render_page(job, on_progress, stop);
  return render_film(job, film_of(job, stop), on_progress, stop);
}

}  // namespace

Rendered render(const RenderJob& job, const OnProgress& on_progress, const std::stop_token& stop) {
  RenderJob fitted = job;
  std::vector<std::string> notes = fit_to_output(fitted);
  Rendered rendered = render_fitted(fitted, on_progress, stop);
  rendered.notes.insert(rendered.notes.begin(), notes.begin(), notes.end());
  return rendered;
}

std::string shard_name(const std::string& output, const Shard& shard) {
  return fmt::format("{}.part-{}-of-{}", output, shard.number, shard.count);
}

}  // namespace piblocks
