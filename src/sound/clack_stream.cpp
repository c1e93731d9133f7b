#include "sound/clack_stream.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/two_sum.hpp"
#include "physics/impact.hpp"

namespace piblocks {
namespace {

/// Collisions within this width w are one clack. At a frequency f that changes the spectrum by
/// (pi f w)^2/6 at most: -47 dB at 20 kHz, -75 dB at 4 kHz.
constexpr double kWidth_samples = 1.0 / 8;

/// So few collisions stay apart, however close they are.
constexpr int kFew = 2;

/// Longest piece that is looked at as one.
constexpr double kPiece_samples = 1024;

}  // namespace

Time ClackStream::SampleStretch::time_at(double sample) const {
  const Time sum = two_sum(time.hi, (sample - begin) * time_per_sample);
  return two_sum(sum.hi, sum.lo + time.lo);
}

double ClackStream::SampleStretch::sample_at(const Time& t) const {
  return begin + ((t.hi - time.hi) + (t.lo - time.lo)) / time_per_sample;
}

ClackStream::ClackStream(const Log& log, std::span<const Stretch> stretches,
                         const Rational& duration_s, int rate_hz)
    : log_(log), impulse_unit_(log.impulse_unit()) {
  add_first_instant(stretches, rate_hz);
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    const Stretch& stretch = stretches[i];
    const Rational end_s = i + 1 < stretches.size() ? stretches[i + 1].video_s : duration_s;
    const bool continues = !stretches_.empty() && stretches_.back().end_time == stretch.time;
    stretches_.push_back({.begin = to_double(stretch.video_s * rate_hz),
                          .end = to_double(end_s * rate_hz),
                          .time = to_time(stretch.time),
                          .begin_time = stretch.time,
                          .end_time = stretch.time + stretch.speed * (end_s - stretch.video_s),
                          .time_per_sample = to_double(stretch.speed / rate_hz),
                          .continues = continues});
  }
  // A collision at the very beginning has happened in the first frame, and makes a sound.
  sample_ = stretches_.front().begin - 0.5;
  enter_stretch();
}

/// A film that begins with a freeze has the sound of that instant as if it had come there moving.
void ClackStream::add_first_instant(std::span<const Stretch> stretches, int rate_hz) {
  const auto moves = std::ranges::find_if(stretches, [](const Stretch& s) { return s.speed != 0; });
  // A film that runs backwards has it when it leaves that instant.
  if (moves == stretches.begin() || moves == stretches.end() || moves->speed < 0) return;
  const Rational& time = stretches.front().time;
  const double begin = to_double(stretches.front().video_s * rate_hz);
  stretches_.push_back({.begin = begin,
                        .end = begin,
                        .time = to_time(time),
                        .begin_time = time,
                        .end_time = time,
                        .time_per_sample = to_double(moves->speed / rate_hz),
                        .continues = false});
}

void ClackStream::enter_stretch() {
  if (stretch().continues) return;
  // Exact, as for the pictures: a collision just there may have to wait until the film moves on.
  const bool is_early = sample_ < stretch().begin && stretch().time_per_sample > 0;
  const Rational time = is_early ? to_rational(stretch().time_at(sample_)) : stretch().begin_time;
  count_ = log_.count_at(time);
}

void ClackStream::read_until(std::int64_t sample, std::vector<Clack>& clacks) {
  while (current_ < stretches_.size() && sample_ < double(sample)) {
    const double end = std::min({double(sample), stretch().end, sample_ + kPiece_samples});
    const bool is_last = end == stretch().end;
    const Integer count = count_at_end(end, is_last);
    add({sample_, end, count_, count}, clacks);
    sample_ = end;
    count_ = count;
    if (is_last && ++current_ < stretches_.size()) enter_stretch();
  }
}

Integer ClackStream::count_at(double sample) const {
  const Time time = stretch().time_at(sample);
  // In such slow motion the rounding of count_near() would be audible.
  const bool is_slow = std::fabs(stretch().time_per_sample) < 0x1p-45 * std::fabs(time.hi);
  return is_slow ? log_.count_at(to_rational(time)) : log_.count_near(time);
}

/// Within a stretch it does not matter in which piece a collision is found, if none is found twice.
Integer ClackStream::count_at_end(double end, bool is_last) const {
  if (stretch().time_per_sample == 0) return count_;
  const Integer count = is_last ? log_.count_at(stretch().end_time) : count_at(end);
  return stretch().time_per_sample > 0 ? std::max(count, count_) : std::min(count, count_);
}

void ClackStream::add(const Piece& piece, std::vector<Clack>& clacks) const {
  const auto& [begin, end, at_begin, at_end] = piece;
  const Integer number = abs(at_end - at_begin);
  if (number == 0) return;
  if (number <= kFew) return add_one_by_one(piece, clacks);
  const Integer first = std::min(at_begin, at_end) + 1;
  const Integer last = std::max(at_begin, at_end);
  if (end - begin <= kWidth_samples) return add_impacts(first, last, piece, clacks);
  const double middle = (begin + end) / 2;
  const Integer count = std::clamp<Integer>(count_at(middle), first - 1, last);
  add({begin, middle, at_begin, count}, clacks);
  add({middle, end, count, at_end}, clacks);
}

void ClackStream::add_one_by_one(const Piece& piece, std::vector<Clack>& clacks) const {
  const bool forwards = piece.count_at_begin < piece.count_at_end;
  Integer index = piece.count_at_begin;
  while (index != piece.count_at_end) {
    if (forwards) ++index;
    add_impacts(index, index, piece, clacks);
    if (!forwards) --index;
  }
}

/// Adds one clack for the collisions with the wall, and one for those of the blocks.
void ClackStream::add_impacts(const Integer& first, const Integer& last, const Piece& piece,
                              std::vector<Clack>& clacks) const {
  for (const CollisionKind kind : {CollisionKind::wall, CollisionKind::blocks}) {
    const std::optional<Impact> together = log_.impact(kind, first, last);
    if (!together) continue;
    // If a count was rounded, the time may be just outside of the piece.
    const double sample =
        std::max(piece.begin, std::min(piece.end, stretch().sample_at(together->time)));
    clacks.push_back({sample, kind, together->impulse / impulse_unit_, together->position});
  }
}

}  // namespace piblocks
