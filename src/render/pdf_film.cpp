#include <fmt/format.h>
#include <piblocks/error.hpp>

#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "render/renderings.hpp"
#include "render/step_clock.hpp"

namespace piblocks {

Rendered render_pdf(const RenderJob& job, const Film& film, const FrameRange& frames,
                    const OnProgress& on_progress, const std::stop_token& stop) {
  constexpr std::int64_t kMaxPages = 10'000;
  if (frames.count() > kMaxPages) {
    throw UsageError(fmt::format(
        "output: '{}' would have {} pages, and a PDF may have {}; show fewer frames a second, as "
        "by --fps 25, or some of them, by --frames A-B",
        job.output, frames.count(), kMaxPages));
  }
  StepClock clock(job.profile, Step::compose);
  OutputFile file(job.output);
  PdfPages pages(film.view().width_px, film.view().height_px);
  on_progress({0, frames.count()});
  for (std::int64_t frame = frames.first; frame <= frames.last; ++frame) {
    check_stop(stop);
    clock.enter(Step::compose);
    const DrawList list = film.frame(frame);
    clock.enter(Step::paint);
    file.write(pages.add(list));
    on_progress({frame - frames.first + 1, frames.count()});
  }
  clock.enter(Step::write);
  file.write(pages.finish());
  check_stop(stop);
  file.finish();
  Rendered rendered{.frame_count = frames.count(), .profile = {}};
  if (job.profile) rendered.profile = {clock.spent(), processor_seconds(CLOCK_PROCESS_CPUTIME_ID)};
  return rendered;
}

}  // namespace piblocks
