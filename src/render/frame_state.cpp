#include "render/frame_state.hpp"

#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "physics/exposure.hpp"

namespace piblocks {
namespace {

/// Hits are counted over 1/4 s of video. A scene that has just begun counts as having stood still
/// before, so that its first hit alone is no high rate.
constexpr int kWindowsPerSecond = 4;
/// With fewer hits than this in a window, the count of evenly spaced hits would vary by one from
/// window to window. The rate then comes from the times of the newest three hits.
constexpr int kFewHits = 8;
constexpr std::size_t kNewest = 3;
/// If three hits have a rate above kMaxHitsPerSecond and the newest is still seen, none of them is
/// older than this.
constexpr double kLongestAge_s = 0.5;

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
std::vector<Passage> passages(const Log& log, const VideoTime& video_time, Integer count,
                              const Rational& begin_s) {
  const auto stretches = video_time.schedule.stretches();
  std::vector<Passage> found;
  auto next = std::ranges::upper_bound(stretches, video_time.video_s, {}, &Stretch::video_s);
  for (Rational now_s = video_time.video_s; now_s > begin_s;) {
    const Stretch& stretch = *--next;
    now_s = std::max(stretch.video_s, begin_s);
    if (stretch.speed == 0) continue;
    const Rational from = stretch.time + stretch.speed * (now_s - stretch.video_s);
    Integer before = log.count_at(from);
    if (before != count) {
      found.push_back({stretch, std::min(before, count) + 1, std::max(before, count)});
    }
    count = std::move(before);
  }
  return found;
}

/// As exact as its age needs it: where time all but stands still, a double-double is too coarse.
Rational time_of(const Log& log, const Collision& collision, const Stretch& stretch) {
  constexpr unsigned long kUsed_bits = 90;  // of the 104 that are right
  Rational rounded = to_rational(collision.time);
  if (abs(stretch.speed) * power(2, kUsed_bits) >= abs(rounded)) return rounded;
  try {
    return log.time_after(collision.index);
  } catch (const Error&) {  // several at once, or an engine that steps
    return rounded;
  }
}

struct AgedCollision {
  Collision collision;
  double age_s;
};

/// Calls visit(index, stretch) for each collision that is passed, the latest first, until that
/// returns false.
template <typename Visit>
void each_passed(const std::vector<Passage>& passages, const Visit& visit) {
  for (const Passage& passage : passages) {
    const bool forward = passage.is_forward();
    Integer index = forward ? passage.last : passage.first;
    for (Integer left = passage.size(); left > 0; --left, index += forward ? -1 : 1) {
      if (!visit(index, passage.stretch)) return;
    }
  }
}

/// The newest collisions that the picture has passed, the latest first.
std::vector<AgedCollision> newest(const Log& log, const std::vector<Passage>& passages,
                                  const Rational& video_s) {
  std::vector<AgedCollision> found;
  each_passed(passages, [&](const Integer& index, const Stretch& stretch) {
    Collision collision = log.collision(index);
    const Rational way_s = (time_of(log, collision, stretch) - stretch.time) / stretch.speed;
    const double age_s = to_double(video_s - stretch.video_s - way_s);
    // Only rounding can make a hit later than the moment.
    found.push_back({std::move(collision), std::max(0.0, age_s)});
    return found.size() < kNewest;
  });
  return found;
}

/// While hits come evenly this is their rate. Afterwards it falls.
double rate_of(const std::vector<AgedCollision>& three) {
  const double newest_s = three.front().age_s;
  const double both_intervals_s = three.back().age_s - newest_s;
  return std::min<double>(2 / std::max(both_intervals_s, newest_s), kWindowsPerSecond * kFewHits);
}

/// Where the surfaces of those that have just met touch.
std::array<double, 2> contact_of(const System& system, const Collision& collision) {
  const std::array<double, 2>& from = collision.first_after.position;
  const Rational& size = system.bodies[collision.first].size;
  const bool is_line = system.dimensions == 1;
  const double reach = to_double(is_line ? size / 2 : size);
  if (collision.second < system.bodies.size()) {
    const std::array<double, 2>& to = collision.second_after.position;
    if (is_line) return {to[0] > from[0] ? from[0] + reach : from[0] - reach, 0};
    const double share = reach / (reach + to_double(system.bodies[collision.second].size));
    return {from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
  }
  const Wall& wall = system.walls[collision.second - system.bodies.size()];
  const double way = to_double(wall.velocity[0]) * collision.time.hi;
  if (is_line) return {to_double(wall.point[0]) + way, 0};
  const std::array normal{to_double(wall.normal[0]), to_double(wall.normal[1])};
  const double share = reach / std::sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
  return {from[0] - share * normal[0], from[1] - share * normal[1]};
}

Hit hit_of(const Log& log, const AgedCollision& aged) {
  const Collision& collision = aged.collision;
  const PairLog* const blocks = log.pair();
  return {collision.index,
          {collision.first, collision.second},
          contact_of(log.system(), collision),
          aged.age_s,
          blocks != nullptr ? blocks->gaps_at_collision(collision.index) : Gaps{}};
}

/// The pairs of the collisions that are passed, each once, the latest first.
/// @param passed  at most so many collisions
std::vector<MetPair> pairs_of(const Log& log, const std::vector<Passage>& passages,
                              const Integer& passed) {
  constexpr std::size_t kMostPairs = 64;
  // Few pairs take turns.
  const std::size_t most = std::min(kMostPairs, 2 * log.system().bodies.size());
  std::vector<MetPair> pairs;
  std::size_t count = 0;  // of collisions
  each_passed(passages, [&](const Integer& index, const Stretch& /*stretch*/) {
    const Collision collision = log.collision(index);
    const MetPair pair{collision.first, collision.second};
    if (std::ranges::find(pairs, pair) == pairs.end()) pairs.push_back(pair);
    return ++count < most && count < passed;
  });
  return pairs;
}

bool is_moving(const VideoTime& video_time) {
  const auto next = std::ranges::upper_bound(video_time.schedule.stretches(), video_time.video_s,
                                             {}, &Stretch::video_s);
  return std::prev(next)->speed != 0;
}

/// Adds the hits and their rate to what is shown at that time.
void add_hits(FrameState& state, const Log& log, const VideoTime& video_time) {
  const auto passed = [&](const Rational& length_s) {
    return passages(log, video_time, state.state.count,
                    std::max<Rational>(video_time.video_s - length_s, 0));
  };
  std::vector<Passage> passages = passed(Rational(1, kWindowsPerSecond));
  Integer count = 0;
  for (const Passage& passage : passages) count += passage.size();
  double rate = kWindowsPerSecond * count.get_d();
  std::vector<AgedCollision> found;
  if (count < kFewHits) {
    passages = passed(Rational(kLongestAge_s));
    found = newest(log, passages, video_time.video_s);
    if (found.size() == kNewest) rate = rate_of(found);
  }
  const bool moves = is_moving(video_time);
  if (moves) state.hits_per_s = rate;
  if (rate > kMaxHitsPerSecond) {
    if (moves) {
      state.met_pairs = pairs_of(log, passages, std::max(count, Integer(found.size())));
    }
    return;
  }
  for (auto aged = found.rbegin(); aged != found.rend(); ++aged) {
    if (aged->age_s < kHitLife_s) state.hits.push_back(hit_of(log, *aged));
  }
}

}  // namespace

FrameState frame_state(const Log& log, const FrameTime& shown, const FrameNeeds& needs,
                       const Rational& speed, const std::optional<VideoTime>& video_time) {
  constexpr std::size_t kMostCorners = 100;
  constexpr std::size_t kAllCorners = std::numeric_limits<std::size_t>::max();
  FrameState state{.state = log.state_at(shown.time),
                   .time = shown.time,
                   .slowdown = shown.slowdown,
                   .pace = to_double(speed / shown.slowdown)};
  for (const TimeSlice& slice : shown.exposure) {
    state.exposure.push_back({to_double(slice.share), expose(log, slice.from, slice.to)});
  }
  if (needs.gaps) state.gaps = log.pair()->gaps_at(shown.time);
  if (needs.trail_s > 0) {
    const Rational from = std::max<Rational>(0, shown.time - speed * needs.trail_s);
    state.trails = log.paths(from, shown.time, kMostCorners);
  }
  if (!needs.paths.empty()) {
    std::vector<std::vector<PathPoint>> whole = log.paths(0, shown.time, kAllCorners);
    state.trails.resize(whole.size());
    for (const std::size_t body : needs.paths) state.trails[body] = std::move(whole[body]);
  }
  if (video_time) state.video_s = to_double(video_time->video_s);
  if (video_time && needs.hits) add_hits(state, log, *video_time);
  if (video_time && needs.moments) {
    state.moment = [&log, gaps = needs.gaps, schedule = &video_time->schedule,
                    now_s = video_time->video_s](double from_now_s) {
      FrameState moment;
      moment.time = schedule->at(schedule->within(now_s + Rational(from_now_s))).time;
      if (gaps) {
        moment.gaps.y2 = log.pair()->y2_bound_at(moment.time);
      } else {
        moment.state = log.state_at(moment.time);
      }
      return moment;
    };
  }
  return state;
}

}  // namespace piblocks
