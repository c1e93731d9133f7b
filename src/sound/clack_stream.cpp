#include "sound/clack_stream.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/two_sum.hpp"
#include "physics/impact.hpp"

namespace piblocks {
namespace {

/// Collisions so close are one clack. What that does to the spectrum at f is a factor of
/// 1 - (pi f w)^2/6 at most: -47 dB at 20 kHz, -75 dB at 4 kHz.
constexpr double kWidth_samples = 1.0 / 8;

/// So few are told apart, however close they are.
constexpr int kFew = 2;

/// What is looked at in one go while nothing happens.
constexpr double kPiece_samples = 1024;

}  // namespace

Time ClackStream::Segment::time_at(double sample) const {
  const Time sum = two_sum(time.hi, (sample - begin) * time_per_sample);
  return two_sum(sum.hi, sum.lo + time.lo);
}

double ClackStream::Segment::sample_at(const Time& t) const {
  return begin + ((t.hi - time.hi) + (t.lo - time.lo)) / time_per_sample;
}

ClackStream::ClackStream(const CollisionLog& log, std::span<const Stretch> stretches,
                         const Rational& duration_s, int rate_hz)
    : log_(log) {
  add_first_instant(stretches, rate_hz);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    const Rational end_s = i + 1 < stretches.size() ? stretches[i + 1].video_s : duration_s;
    const bool continues = !segments_.empty() && segments_.back().end_time == stretch.time;
    segments_.push_back({.begin = to_double(stretch.video_s * rate_hz),
                         .end = to_double(end_s * rate_hz),
                         .time = to_time(stretch.time),
                         .begin_time = stretch.time,
                         .end_time = stretch.time + stretch.speed * (end_s - stretch.video_s),
                         .time_per_sample = to_double(stretch.speed / rate_hz),
                         .continues = continues});
  }
  // A collision at the very beginning has happened in the first frame, and is to be heard.
  sample_ = segments_.front().begin - 0.5;
  enter(segments_.front());
}

/// A film that begins standing still hears what happens just then as if it had come there moving.
void ClackStream::add_first_instant(std::span<const Stretch> stretches, int rate_hz) {
  const auto moves = std::ranges::find_if(stretches, [](const Stretch& s) { return s.speed != 0; });
  // Backwards it is heard when the film leaves that instant.
  if (moves == stretches.begin() || moves == stretches.end() || moves->speed < 0) return;
  const Rational& time = stretches.front().time;
  const double begin = to_double(stretches.front().video_s * rate_hz);
  segments_.push_back({.begin = begin,
                       .end = begin,
                       .time = to_time(time),
                       .begin_time = time,
                       .end_time = time,
                       .time_per_sample = to_double(moves->speed / rate_hz),
                       .continues = false});
}

void ClackStream::enter(const Segment& segment) {
  if (segment.continues) return;
  // Exact, as for the pictures: what happens just there may have to wait until the film moves on.
  const bool is_early = sample_ < segment.begin && segment.time_per_sample > 0;
  const Rational time = is_early ? to_rational(segment.time_at(sample_)) : segment.begin_time;
  count_ = log_.state_at(time).count;
}

void ClackStream::read_until(std::int64_t sample, std::vector<Clack>& clacks) {
  while (current_ < segments_.size() && sample_ < double(sample)) {
    const Segment& segment = segments_[current_];
    const double end = std::min({double(sample), segment.end, sample_ + kPiece_samples});
    const bool is_last = end == segment.end;
    const Integer count = count_at_end(segment, end, is_last);
    add({sample_, end, count_, count}, segment, clacks);
    sample_ = end;
    count_ = count;
    if (is_last && ++current_ < segments_.size()) enter(segments_[current_]);
  }
}

Integer ClackStream::count_at(const Segment& segment, double sample) const {
  const Time time = segment.time_at(sample);
  // So slow that the rounding of count_near() would be heard.
  const bool is_slow = std::fabs(segment.time_per_sample) < 0x1p-45 * std::fabs(time.hi);
  return is_slow ? log_.state_at(to_rational(time)).count : count_near(log_, time);
}

/// Between the ends of a stretch it does not matter in which piece a collision is found, as long as
/// none is found twice.
Integer ClackStream::count_at_end(const Segment& segment, double end, bool is_last) const {
  if (segment.time_per_sample == 0) return count_;
  const Integer count = is_last ? log_.state_at(segment.end_time).count : count_at(segment, end);
  return segment.time_per_sample > 0 ? std::max(count, count_) : std::min(count, count_);
}

void ClackStream::add(const Piece& piece, const Segment& segment,
                      std::vector<Clack>& clacks) const {
  const auto& [begin, end, at_begin, at_end] = piece;
  const Integer number = abs(at_end - at_begin);
  if (number == 0) return;
  if (number <= kFew) return add_one_by_one(piece, segment, clacks);
  const Integer first = std::min(at_begin, at_end) + 1;
  const Integer last = std::max(at_begin, at_end);
  if (end - begin <= kWidth_samples) {
    add_impact(CollisionKind::wall, first, last, piece, segment, clacks);
    add_impact(CollisionKind::blocks, first, last, piece, segment, clacks);
    return;
  }
  const double middle = (begin + end) / 2;
  const Integer count = std::clamp<Integer>(count_at(segment, middle), first - 1, last);
  add({begin, middle, at_begin, count}, segment, clacks);
  add({middle, end, count, at_end}, segment, clacks);
}

void ClackStream::add_one_by_one(const Piece& piece, const Segment& segment,
                                 std::vector<Clack>& clacks) const {
  const bool forwards = piece.count_at_begin < piece.count_at_end;
  Integer index = piece.count_at_begin;
  while (index != piece.count_at_end) {
    if (forwards) ++index;
    add_impact(CollisionKind::wall, index, index, piece, segment, clacks);
    add_impact(CollisionKind::blocks, index, index, piece, segment, clacks);
    if (!forwards) --index;
  }
}

void ClackStream::add_impact(CollisionKind kind, const Integer& first, const Integer& last,
                             const Piece& piece, const Segment& segment,
                             std::vector<Clack>& clacks) const {
  const std::optional<Impact> together = impact(log_, kind, first, last);
  if (!together) return;
  // Where a count was rounded the time may be on the other side of the piece's end.
  const double sample =
      std::max(piece.begin, std::min(piece.end, segment.sample_at(together->time)));
  clacks.push_back({sample, kind, together->impulse, together->blue_position});
}

}  // namespace piblocks
