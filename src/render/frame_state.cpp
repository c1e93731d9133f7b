#include "render/frame_state.hpp"

#include <algorithm>
#include <iterator>
#include <ranges>
#include <utility>
#include <vector>

#include "physics/exposure.hpp"

namespace piblocks {
namespace {

/// Hits are counted over so much video. A scene that has just begun counts as having stood still
/// before, so that its first hit alone is no high rate.
constexpr int kWindowsPerSecond = 4;

/// Collisions that one stretch of video passes, all in the same direction.
struct Passage {
  Stretch stretch;  ///< with a speed that is not 0
  Integer first;    ///< lowest index
  Integer last;     ///< highest index

  Integer size() const { return last - first + 1; }
  bool is_forward() const { return stretch.speed > 0; }
};

/// What is passed from `begin_s` on until the moment, the latest first.
/// @param count  at the moment
std::vector<Passage> passages(const CollisionLog& log, const VideoMoment& moment, Integer count,
                              const Rational& begin_s) {
  const auto stretches = moment.clock.stretches();
  std::vector<Passage> found;
  auto next = std::ranges::upper_bound(stretches, moment.video_s, {}, &Stretch::video_s);
  for (Rational now_s = moment.video_s; now_s > begin_s;) {
    const Stretch& stretch = *--next;
    now_s = std::max(stretch.video_s, begin_s);
    if (stretch.speed == 0) continue;
    const Rational from = stretch.time + stretch.speed * (now_s - stretch.video_s);
    Integer before = log.state_at(from).count;
    if (before != count) {
      found.push_back({stretch, std::min(before, count) + 1, std::max(before, count)});
    }
    count = std::move(before);
  }
  return found;
}

double age_s(const Time& time, const Stretch& stretch, const Rational& video_s) {
  const Rational since_start = (to_rational(time) - stretch.time) / stretch.speed;
  // Only rounding can make a hit later than the moment.
  return std::max(0.0, to_double(video_s - stretch.video_s - since_start));
}

Hit hit_of(const CollisionLog& log, const Collision& collision, double age_s) {
  const BlockSystem& system = log.system();
  const double contact = collision.kind == CollisionKind::wall
                             ? to_double(system.wall_face)
                             : collision.blue.position + to_double(system.blue.width / 2);
  return {collision.kind, collision.index, contact, age_s, gaps_at_collision(log, collision.index)};
}

bool is_moving(const VideoMoment& moment) {
  const auto next =
      std::ranges::upper_bound(moment.clock.stretches(), moment.video_s, {}, &Stretch::video_s);
  return std::prev(next)->speed != 0;
}

}  // namespace

FrameState frame_state(const CollisionLog& log, const FrameTime& shown, const FrameNeeds& needs) {
  FrameState state{log.state_at(shown.time), shown.time, shown.slower};
  state.exposure.reserve(shown.exposure.size());
  for (const TimeSlice& slice : shown.exposure) {
    state.exposure.push_back({to_double(slice.share), expose(log, slice.from, slice.to)});
  }
  if (needs.gaps) state.gaps = gaps_at(log, shown.time);
  return state;
}

void add_hits(FrameState& state, const CollisionLog& log, const VideoMoment& moment) {
  state.video_s = to_double(moment.video_s);
  const Rational begin_s = std::max<Rational>(moment.video_s - Rational(1, kWindowsPerSecond), 0);
  const std::vector<Passage> found = passages(log, moment, state.state.count, begin_s);
  Integer rate = 0;
  for (const Passage& passage : found) rate += kWindowsPerSecond * passage.size();
  if (is_moving(moment)) state.hits_per_s = rate.get_d();
  if (rate > kMaxHits_per_s) return;
  for (const Passage& passage : found | std::views::reverse) {
    const bool forward = passage.is_forward();
    Integer index = forward ? passage.first : passage.last;
    for (Integer left = passage.size(); left > 0; --left, index += forward ? 1 : -1) {
      const Collision collision = log.collision(index);
      const double age = age_s(collision.time, passage.stretch, moment.video_s);
      if (age < kHitLife_s) state.hits.push_back(hit_of(log, collision, age));
    }
  }
}

}  // namespace piblocks
