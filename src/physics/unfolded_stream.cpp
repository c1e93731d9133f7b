#include "physics/unfolded_stream.hpp"

#include <algorithm>
#include <utility>

#include "core/two_sum.hpp"

// Compiles a function twice, for every x86-64 processor and for those with AVX2; the dynamic linker
// picks one, before a sanitizer would be ready. Both give the same bits, since nothing is
// contracted.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define PIBLOCKS_VECTOR_CLONES [[gnu::target_clones("avx2", "default")]]
#else
#define PIBLOCKS_VECTOR_CLONES
#endif

// Iterations of the loop that follows do not read what others write.
#if defined(__GNUC__) && !defined(__clang__)
#define PIBLOCKS_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#else
#define PIBLOCKS_INDEPENDENT_ITERATIONS
#endif

namespace piblocks {
namespace {

/// Row i is ray i of a block that begins with the anchor, if the landmark lies behind, or ends with
/// it. Angles are measured from an end of time.
RayTable make_table(const ClosedForm& form, int landmark_sign, int end_sign, bool anchor_is_odd) {
  RayTable table{};
  for (std::size_t step = 0; step < kBlockRays; ++step) {
    const std::size_t row = landmark_sign < 0 ? step : kBlockRays - 1 - step;
    Direction ray = form.direction({double(step), 0}, {});
    if (landmark_sign != end_sign) ray.sine = -ray.sine;
    const bool odd = (step % 2 == 1) != anchor_is_odd;
    // The ray after an odd one is a step further from the past, and a step nearer to the future.
    const Direction even =
        odd ? ray + Direction{-end_sign * form.step.sine, form.step.cosine} : ray;
    const RayKind kind = form.kind(odd);
    table.sine[row] = ray.sine;
    table.cosine[row] = ray.cosine;
    table.even_sine[row] = even.sine;
    table.even_cosine[row] = even.cosine;
    table.blue_reach[row] = kind.blue_reach;
    table.red_reach[row] = kind.red_reach;
    table.side[row] = kind.side;
  }
  return table;
}

/// Fills rows of a batch from `row` on with the rays of one block.
/// @param skip  rows of the table before the first that is used
PIBLOCKS_VECTOR_CLONES
void fill_rows(const ClosedForm& form, double sign, const Direction anchor, const RayTable& table,
               std::size_t skip, std::size_t count, CollisionBatch& batch, std::size_t row) {
  const double* sine = table.sine.data() + skip;
  const double* cosine = table.cosine.data() + skip;
  const double* even_sine = table.even_sine.data() + skip;
  const double* even_cosine = table.even_cosine.data() + skip;
  const double* blue_reach = table.blue_reach.data() + skip;
  const double* red_reach = table.red_reach.data() + skip;
  const double* side = table.side.data() + skip;
  double* time_hi = batch.time_hi.data() + row;
  double* time_lo = batch.time_lo.data() + row;
  double* blue_position = batch.blue_position.data() + row;
  double* blue_velocity = batch.blue_velocity.data() + row;
  double* red_position = batch.red_position.data() + row;
  double* red_velocity = batch.red_velocity.data() + row;
  PIBLOCKS_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const CollisionNumbers now = form.collision(sign, anchor + Direction{sine[i], cosine[i]},
                                                anchor + Direction{even_sine[i], even_cosine[i]},
                                                {blue_reach[i], red_reach[i], side[i]});
    time_hi[i] = now.time_hi;
    time_lo[i] = now.time_lo;
    blue_position[i] = now.blue_position;
    blue_velocity[i] = now.blue_velocity;
    red_position[i] = now.red_position;
    red_velocity[i] = now.red_velocity;
  }
}

/// Times of those rows again, from time 0.
/// @param side        sign of the times
/// @param from_start  direction of the ray that is next to the start, from there
/// @param away        table of directions from that ray
PIBLOCKS_VECTOR_CLONES
void fill_times_from_start(const ClosedForm& form, double side, const Direction anchor,
                           const RayTable& table, std::size_t skip, const Direction from_start,
                           const RayTable& away, std::size_t away_skip, std::size_t count,
                           CollisionBatch& batch, std::size_t row) {
  const double* sine = table.sine.data() + skip;
  const double* cosine = table.cosine.data() + skip;
  const double* away_sine = away.sine.data() + away_skip;
  const double* away_cosine = away.cosine.data() + away_skip;
  double* time_hi = batch.time_hi.data() + row;
  double* time_lo = batch.time_lo.data() + row;
  PIBLOCKS_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    time_hi[i] = form.time_from_start(side, from_start + Direction{away_sine[i], away_cosine[i]},
                                      anchor + Direction{sine[i], cosine[i]});
    time_lo[i] = 0;
  }
}

/// The row nearest to the landmark among the first rows of a block.
std::size_t row_next_to(const Landmark& landmark, std::size_t count) {
  return landmark.sign < 0 ? 0 : count - 1;
}

/// The angle between a landmark and a ray.
/// @param first_steps  from an earlier ray
/// @param later        by so many rays
Direction direction_after(const ClosedForm& form, const Landmark& landmark,
                          const DoubleDouble& first_steps, std::size_t later) {
  DoubleDouble steps = two_sum(first_steps.hi, -landmark.sign * double(later));
  steps.lo += first_steps.lo;
  return form.direction(steps, landmark.beyond);
}

/// wall, blocks, wall, …: the kinds of consecutive rays from an even one on.
constexpr auto kKinds = []() {
  std::array<CollisionKind, CollisionBatch::kCapacity + 1> kinds{};
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    kinds[i] = i % 2 == 0 ? CollisionKind::wall : CollisionKind::blocks;
  }
  return kinds;
}();

}  // namespace

UnfoldedStream::UnfoldedStream(const Unfolding& form, Integer first, Integer last, Integer index,
                               std::optional<Integer> contact)
    : form_(form),
      next_(std::move(first)),
      last_(std::move(last)),
      index_(std::move(index)),
      contact_(std::move(contact)),
      last_by_past_(floor_mean(form.past.ray, form.turn.ahead.ray)),
      last_by_turn_(floor_mean(form.turn.ahead.ray, form.future.ray)) {}

UnfoldedStream::Stretch UnfoldedStream::stretch_from(const Integer& ray) const {
  const bool late = form_.is_late(ray);
  const bool near_turn = ray > last_by_past_ && ray <= last_by_turn_;
  Stretch stretch{last_, late ? 1 : -1, near_turn ? &form_.turn.seen(late) : &form_.end_near(late),
                  form_.is_near_start(ray)};
  for (const Integer* const cut :
       {&last_by_past_, &form_.turn.ahead.ray, &last_by_turn_, &form_.half_way}) {
    if (*cut >= ray) stretch.last = std::min(stretch.last, *cut);
  }
  return stretch;
}

bool UnfoldedStream::read(CollisionBatch& batch) {
  Integer left = last_ - next_ + 1;
  if (index_ <= 0) left = std::min<Integer>(left, 1 - index_);  // on one side of time 0
  batch.first = index_;
  batch.size = left <= 0 ? 0
                         : static_cast<std::size_t>(
                               std::min<Integer>(left, long(CollisionBatch::kCapacity)).get_ui());
  std::copy_n(kKinds.begin() + (is_odd(next_) ? 1 : 0), batch.size, batch.kind.begin());
  for (std::size_t row = 0; row < batch.size;) {
    Integer of_stretch = stretch_.last - next_ - static_cast<unsigned long>(row) + 1;
    if (stretch_.end_sign == 0 || of_stretch <= 0) {
      stretch_ = stretch_from(next_ + static_cast<unsigned long>(row));
      of_stretch = stretch_.last - next_ - static_cast<unsigned long>(row) + 1;
    }
    const std::size_t rest = batch.size - row;
    const std::size_t rows = of_stretch < static_cast<unsigned long>(rest)
                                 ? static_cast<std::size_t>(of_stretch.get_ui())
                                 : rest;
    fill(row, rows, batch);
    row += rows;
  }
  keep_within(batch);
  next_ += static_cast<unsigned long>(batch.size);
  index_ += static_cast<unsigned long>(batch.size);
  return batch.size > 0;
}

/// time_within() for all rows, which are on one side of time 0.
void UnfoldedStream::keep_within(CollisionBatch& batch) const {
  const double side = batch.first > 0 ? 1 : -1;
  for (std::size_t row = 0; row < batch.size; ++row) {
    const bool is_wrong = side * batch.time_hi[row] < 0;
    batch.time_hi[row] = is_wrong ? 0 : batch.time_hi[row];
    batch.time_lo[row] = is_wrong ? 0 : batch.time_lo[row];
  }
  if (!contact_ || *contact_ < batch.first) return;
  const Integer row = *contact_ - batch.first;
  if (row >= static_cast<unsigned long>(batch.size)) return;
  batch.time_hi[row.get_ui()] = 0;
  batch.time_lo[row.get_ui()] = 0;
}

/// Rows begin … begin + rows - 1 of the batch, which are rays of the stretch from next_ + begin on.
void UnfoldedStream::fill(std::size_t begin, std::size_t rows, CollisionBatch& batch) {
  const ClosedForm& form = form_;
  const int end_sign = stretch_.end_sign;
  const Landmark& landmark = *stretch_.landmark;
  const Integer first = next_ + static_cast<unsigned long>(begin);
  const DoubleDouble first_steps = landmark.steps_from(first);
  for (std::size_t done = 0; done < rows;) {
    const std::size_t count = std::min(rows - done, kBlockRays);
    const std::size_t anchor = done + row_next_to(landmark, count);
    const bool anchor_is_odd = is_odd(first) != (anchor % 2 == 1);
    const Direction seen = direction_after(form, landmark, first_steps, anchor);
    const Direction ray = stretch_.is_near_turn() ? seen.complement() : seen;
    const RayTable& rays = table(landmark, end_sign, anchor_is_odd);
    const std::size_t skip = landmark.sign < 0 ? 0 : kBlockRays - count;
    fill_rows(form, end_sign, ray, rays, skip, count, batch, begin + done);
    if (stretch_.is_near_start) {
      const Landmark& start = form_.start.seen(index_ > 0);
      const Direction from_start =
          direction_after(form, start, start.steps_from(first), done + row_next_to(start, count));
      fill_times_from_start(form, -start.sign, ray, rays, skip, from_start,
                            table(start, start.sign, false),
                            start.sign < 0 ? 0 : kBlockRays - count, count, batch, begin + done);
    }
    done += count;
  }
}

const RayTable& UnfoldedStream::table(const Landmark& landmark, int end_sign, bool anchor_is_odd) {
  auto& made = tables_[landmark.sign < 0 ? 0 : 1][end_sign < 0 ? 0 : 1][anchor_is_odd ? 1 : 0];
  if (!made) {
    made = std::make_unique<RayTable>(make_table(form_, landmark.sign, end_sign, anchor_is_odd));
  }
  return *made;
}

}  // namespace piblocks
