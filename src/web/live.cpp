#include "web/live.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <utility>

#include "media/pixels/rgb24.hpp"
#include "physics/logs.hpp"
#include "scene/run_log.hpp"
#include "scene/schedule.hpp"

namespace piblocks::web {
namespace {

View view_in(View view, const std::optional<FrameSize>& size) {
  if (!size) return view;
  view.width_px = size->width_px;
  view.height_px = size->height_px;
  return view;
}

std::variant<FilmRun, Film> make_film(Script script, const View& view) {
  std::visit([&](auto& any) { any.view = view; }, script);
  if (const auto* const scene = std::get_if<Scene>(&script)) return run_of(*scene);
  return Film(script);
}

PixelRect bounding_box(std::span<const PixelRect> rects) {
  if (rects.empty()) return {};
  PixelRect all = rects.front();
  for (const PixelRect& rect : rects) {
    const int right = std::max(all.right_px(), rect.right_px());
    const int bottom = std::max(all.bottom_px(), rect.bottom_px());
    all.x_px = std::min(all.x_px, rect.x_px);
    all.y_px = std::min(all.y_px, rect.y_px);
    all.width_px = right - all.x_px;
    all.height_px = bottom - all.y_px;
  }
  return all;
}

void convert(const ImageView& picture, Patch& patch) {
  const PixelRect& rect = patch.rect;
  patch.rgba.resize(std::size_t{4} * static_cast<std::size_t>(rect.width_px) *
                    static_cast<std::size_t>(rect.height_px));
  std::uint8_t* to = patch.rgba.data();
  for (int y = rect.y_px; y < rect.bottom_px(); ++y) {
    pack_row_rgba(picture, rect, y, to);
    to += std::ptrdiff_t{4} * rect.width_px;
  }
}

}  // namespace

void Screen::update(DrawList list) {
  const Background background = list.background ? Background::opaque : Background::transparent;
  const auto fits = [&](const ImageView& shown) {
    return shown.width_px == list.width_px && shown.height_px == list.height_px &&
           shown.has_alpha == (background == Background::transparent);
  };
  if (!canvas_ || !fits(canvas_->view())) {
    canvas_.reset();  // before the next one takes memory
    canvas_ = std::make_unique<Canvas>(list.width_px, list.height_px, background);
  }
  try {
    patch_.rect = bounding_box(canvas_->update(std::move(list)));
    convert(canvas_->view(), patch_);
  } catch (...) {
    canvas_.reset();  // nobody has seen what is on it, so the next patch is all of it
    throw;
  }
}

LiveScript::LiveScript(Script script, const std::optional<FrameSize>& picture_size)
    : script_(std::move(script)),
      view_(view_in(view_of(script_), picture_size)),
      film_(make_film(script_, view_)) {
  if (const auto* const scene = std::get_if<Scene>(&script_)) plan_film(*scene);
}

/// A scene without a film still has stills.
void LiveScript::plan_film(const Scene& scene) {
  try {
    Schedule schedule = make_schedule(scene, run()->log());
    film_frames(schedule);
    schedule_ = std::move(schedule);
  } catch (const UsageError& error) {
    film_problems_ = error.problems();
  }
}

std::optional<std::int64_t> LiveScript::frame_count() const {
  if (run() == nullptr) return std::get<Film>(film_).frame_count();
  return schedule_ ? std::optional(film_frames(*schedule_)) : std::nullopt;
}

LiveScript::Place LiveScript::place_of_frame(std::int64_t number) const {
  const std::optional<std::int64_t> count = frame_count();
  if (!count) return place_of(Instant());
  const std::int64_t frame = std::clamp<std::int64_t>(number, 0, *count - 1);
  if (run() != nullptr) return {frame, Instant(schedule_->time_of(frame))};
  return {frame, Instant(Rational(to_integer(frame)) / view_of(script_).frame_rate)};
}

LiveScript::Place LiveScript::place_of(const Instant& instant) const {
  if (run() != nullptr) return {std::nullopt, Instant(time_of(instant, run()->log()))};
  return place_of_frame(frame_at(std::get<Film>(film_), instant));
}

std::optional<LiveScript::Place> LiveScript::collision_beside(const Place& place, int step) const {
  if (run() == nullptr) return std::nullopt;
  const Log& log = run()->log();
  const Rational time = time_of(place.instant, log);
  const Integer count = log.count_at(time);
  if (log.state_at(time).is_infinite) return std::nullopt;
  const bool is_at_collision =
      count >= log.first_index() && time_of(Instant::collision(count), log) == time;
  Integer index = step > 0 ? count + 1 : is_at_collision ? count - 1 : count;
  for (;;) {
    if (index < log.first_index()) return place_of_frame(0);
    if (!log.is_listed(index)) return std::nullopt;
    try {
      return place_of(Instant::collision(index));
    } catch (const TiedCollision& tied) {
      if (step > 0) {
        index = tied.last();
      } else {
        --index;
      }
    }
  }
}

std::optional<std::int64_t> LiveScript::frame_near(const Place& place) const {
  if (place.frame) return place.frame;
  if (!schedule_) return std::nullopt;
  const Rational time = time_of(place.instant, run()->log());
  const std::int64_t last = film_frames(*schedule_) - 1;
  const Rational& rate = view_of(script_).frame_rate;
  if (const auto video_s = schedule_->first_shown_s(time)) {
    return std::min(std::int64_t{ceil(*video_s * rate).get_si()}, last);
  }
  return time <= schedule_->time_of(0) ? 0 : last;
}

DrawList LiveScript::picture(const Place& place) const {
  if (run() == nullptr) return std::get<Film>(film_).frame(*place.frame);
  if (place.frame) return run()->frame(*schedule_, *place.frame);
  return run()->still(place.instant);
}

DrawList LiveScript::full_picture(const Place& place) const {
  const View& own = view_of(script_);
  const bool is_full = own.width_px == view_.width_px && own.height_px == view_.height_px;
  return is_full ? picture(place) : LiveScript(script_).picture(place);
}

std::optional<StateRow> LiveScript::state(const Place& place) const {
  if (run() == nullptr) return std::nullopt;
  return state_row(run()->log(), time_of(place.instant, run()->log()), false);
}

std::string LiveScript::state_text(const StateRow& state) const {
  return piblocks::state_text(state_table(run()->log().system(), false), state);
}

LiveSound::LiveSound(const Script& script) : film_(script, {FilmUse::audio_only}) {}

LiveSound::~LiveSound() = default;

std::int64_t LiveSound::size() const {
  return sound_format(film_.frames(), film_.view().frame_rate).size;
}

/// The next pairs, at most a tenth of a second of them.
std::vector<float> LiveSound::read_up_to(std::int64_t end) {
  constexpr std::int64_t kPiece = Soundtrack::kRate_hz / 10;
  std::vector<float> piece(2 * static_cast<std::size_t>(std::min(kPiece, end - next_)));
  const std::size_t pairs = sound_->read(piece);
  piece.resize(2 * pairs);
  next_ += static_cast<std::int64_t>(pairs);
  return piece;
}

void LiveSound::read(std::int64_t first, std::int64_t count) {
  if (!sound_ || first < next_) {
    sound_ =
        std::make_unique<FilmSound>(film_, film_.frames(), std::stop_token(), [](std::int64_t) {});
    next_ = 0;
  }
  samples_.clear();
  const std::int64_t end = std::min(first + count, size());
  while (next_ < std::min(first, end)) {
    if (read_up_to(first).empty()) return;
  }
  while (next_ < end) {
    const std::vector<float> piece = read_up_to(end);
    if (piece.empty()) return;
    samples_.insert(samples_.end(), piece.begin(), piece.end());
  }
}

}  // namespace piblocks::web
