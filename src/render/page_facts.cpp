#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/restitution.hpp>
#include <piblocks/run.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/rounded.hpp"
#include "render/video_facts.hpp"

namespace piblocks {
namespace {

using Sink = std::function<void(std::string_view)>;

/// Most decimals of a time; a log's times have no more.
constexpr int kMostDecimals = 30;
/// So that times stay within the range of a double in units of the last decimal.
constexpr double kLargest = 1e250;

/// Decimals that tell two times apart which lie `distance` from each other.
int decimals_for(const Rational& distance, const Rational& span) {
  const double decimals = std::ceil(-rounded::log10(to_double(distance))) + 1;
  const double room = rounded::log10(kLargest) - rounded::log10(std::max(1.0, to_double(span)));
  return static_cast<int>(std::clamp(std::min(decimals, room), 0.0, double{kMostDecimals}));
}

Integer scaled(const Rational& time, int scale) {
  return floor(time * power(10, static_cast<unsigned long>(scale)) + Rational(1, 2));
}

/// Numbers of a sequence as differences.
class Differences {
 public:
  /// @returns the text of what has ended with this number.
  std::string add(const Integer& value) {
    const Integer difference = value - last_;
    last_ = value;
    if (times_ > 0 && difference == difference_) {
      ++times_;
      return {};
    }
    std::string text = end();
    difference_ = difference;
    times_ = 1;
    return text;
  }
  std::string end() const {
    if (times_ == 0) return {};
    if (times_ == 1) return difference_.get_str() + " ";
    return fmt::format("{}~{} ", difference_.get_str(), times_);
  }

 private:
  Integer last_ = 0;
  Integer difference_ = 0;
  std::int64_t times_ = 0;
};

std::vector<Rational> times_of(const Timeline& log, const CollisionRange& range) {
  std::vector<Rational> times;
  for (Integer index = range.first; index <= range.last; ++index) {
    times.push_back(to_rational(log.collision_time(index)));
  }
  return times;
}

std::optional<Rational> least_distance(const std::vector<Rational>& times) {
  std::optional<Rational> least;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const Rational distance = times[i] - times[i - 1];
    if (distance > 0 && (!least || distance < *least)) least = distance;
  }
  return least;
}

/// The slowest motion from frame to frame; the whole span where there is none.
Rational least_step(const Schedule& schedule, const Rational& frame_rate, const Rational& span) {
  Rational least = span;
  for (const Stretch& stretch : schedule.stretches()) {
    if (stretch.speed > 0) least = std::min(least, Rational(stretch.speed / frame_rate));
  }
  return least;
}

}  // namespace

std::vector<CollisionRange> listed_collisions(const Integer& before, const Integer& after) {
  const Integer first = before + 1;
  if (after < first) return {};
  if (after - first < 2 * kListedAtEachEnd) return {{first, after}};
  return {{first, first + (kListedAtEachEnd - 1)}, {after - (kListedAtEachEnd - 1), after}};
}

PageFacts::PageFacts(const Scene& scene, const RunLog& run, const Schedule& schedule)
    : scene_(scene),
      log_(run.timeline()),
      is_endless_(run.blocks() != nullptr && is_endless(*run.blocks())),
      schedule_(schedule),
      frames_(film_frames(schedule)),
      // A loop shows its first frame and the one at which it turns back once.
      frames_before_reversal_(scene.pacing.loop ? frames_ / 2 + 1 : frames_),
      from_(schedule.time_of(0)),
      first_(log_.count_at(from_)),
      most_(log_.count_at(schedule.time_of(frames_before_reversal_ - 1))) {}

VideoCount PageFacts::count() const { return {most_, log_.size(), is_endless_, log_.may_go_on()}; }

void PageFacts::check_range() const {
  if (to_double(schedule_.time_of(frames_before_reversal_ - 1) - from_) <= kLargest) return;
  throw UsageError(
      "page: the times that it would step through are too far apart for a browser's numbers; write "
      "an MP4, or bring time.from and time.to nearer to each other");
}

void PageFacts::write_counts(const Sink& sink) const {
  Differences counts;
  for (std::int64_t frame = 0; frame < frames_; ++frame) {
    const std::string text = counts.add(log_.count_at(schedule_.time_of(frame)));
    if (!text.empty()) sink(text);
  }
  sink(counts.end());
}

void PageFacts::write(const Sink& sink) const {
  const Rational& rate = scene_.view.frame_rate;
  const Rational span = schedule_.time_of(frames_before_reversal_ - 1) - from_;
  const int decimals =
      decimals_for(span > 0 ? least_step(schedule_, rate, span) : Rational(1), span);
  const std::vector<CollisionRange> listed = listed_collisions(first_, most_);
  std::vector<std::vector<Rational>> times;
  int scale = decimals;
  for (const CollisionRange& range : listed) {
    times.push_back(times_of(log_, range));
    if (const auto distance = least_distance(times.back())) {
      scale = std::max(scale, decimals_for(*distance, span));
    }
  }
  sink(fmt::format(
      R"({{"rate":[{},{}],"frames":{},"forth":{},"loop":{},"sound":{},"decimals":{},"scale":{},"from":"{}",)",
      rate.get_num().get_str(), rate.get_den().get_str(), frames_, frames_before_reversal_,
      scene_.pacing.loop, scene_.sound.on, decimals, scale, scaled(from_, scale).get_str()));
  sink(R"("stretches":[)");
  const char* comma = "";
  for (const Stretch& stretch : schedule_.stretches()) {
    sink(fmt::format("{}[{},{},{}]", comma, to_double(stretch.video_s),
                     to_double(stretch.time - from_), to_double(stretch.speed)));
    comma = ",";
  }
  sink(R"(],"lists":[)");
  comma = "";
  for (std::size_t i = 0; i < listed.size(); ++i) {
    sink(fmt::format(R"({}{{"first":"{}","times":")", comma, listed[i].first.get_str()));
    Differences differences;
    for (const Rational& time : times[i]) sink(differences.add(scaled(time, scale)));
    sink(differences.end() + R"("})");
    comma = ",";
  }
  sink(R"(],"counts":")");
  write_counts(sink);
  sink(fmt::format(R"(","infinite":{}}})",
                   is_endless_ ? fmt::format("\"{}\"", log_.size().get_str()) : "null"));
}

}  // namespace piblocks
