#include <algorithm>
#include <array>
#include <utility>

#include "core/two_sum.hpp"
#include "physics/unfolding.hpp"
#include "physics/vector_clones.hpp"

namespace piblocks {
namespace {

constexpr std::size_t kBlockRays = 64;  // that share one anchor

/// Directions of rays, measured from the first or the last of them, and the other numbers that
/// depend on their order alone, in columns.
struct RayTable {
  using Column = std::array<double, kBlockRays>;

  alignas(64) Column sine;
  alignas(64) Column cosine;
  alignas(64) Column even_sine;  ///< of the next even ray
  alignas(64) Column even_cosine;
  alignas(64) Column blue_reach;
  alignas(64) Column red_reach;
  alignas(64) Column side;
};

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

/// Rows of a table from `skip` on, turned by a direction.
struct TurnedRows {
  double sign;  ///< of the times of these rays
  Direction anchor;
  const RayTable& table;
  std::size_t skip;
};

struct BatchRows {
  PairBatch& batch;
  std::size_t begin;
  std::size_t count;
};

/// Fills rows of a batch with the rays of one block.
PIBLOCKS_VECTOR_CLONES
void fill_rows(const ClosedForm& form, const TurnedRows& rays, const BatchRows& rows) {
  const auto [sign, anchor, table, skip] = rays;
  const auto [batch, row, count] = rows;
  PIBLOCKS_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t from = skip + i;
    const std::size_t to = row + i;
    const CollisionNumbers now =
        form.collision(sign, anchor + Direction{table.sine[from], table.cosine[from]},
                       anchor + Direction{table.even_sine[from], table.even_cosine[from]},
                       {table.blue_reach[from], table.red_reach[from], table.side[from]});
    batch.time_hi[to] = now.time_hi;
    batch.time_lo[to] = now.time_lo;
    batch.blue_position[to] = now.blue_position;
    batch.blue_velocity[to] = now.blue_velocity;
    batch.red_position[to] = now.red_position;
    batch.red_velocity[to] = now.red_velocity;
  }
}

/// Times of those rows again, from time 0.
/// @param from_start  the same rays, from the direction of the one that is next to the start
PIBLOCKS_VECTOR_CLONES
void fill_times_from_start(const ClosedForm& form, const TurnedRows& rays,
                           const TurnedRows& from_start, const BatchRows& rows) {
  const auto [sign, anchor, table, skip] = rays;
  const auto [side, start, away, away_skip] = from_start;
  const auto [batch, row, count] = rows;
  PIBLOCKS_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const Direction from_anchor{table.sine[skip + i], table.cosine[skip + i]};
    const Direction further{away.sine[away_skip + i], away.cosine[away_skip + i]};
    batch.time_hi[row + i] = form.time_from_start(side, start + further, anchor + from_anchor);
    batch.time_lo[row + i] = 0;
  }
}

/// The row nearest to the landmark among the first rows of a block.
std::size_t row_next_to(const Landmark& landmark, std::size_t count) {
  return landmark.sign < 0 ? 0 : count - 1;
}

/// The angle between a landmark and the ray that is `later` rays after another one.
/// @param first_steps  from that other ray
Direction direction_after(const ClosedForm& form, const Landmark& landmark,
                          const DoubleDouble& first_steps, std::size_t later) {
  DoubleDouble steps = two_sum(first_steps.hi, -landmark.sign * double(later));
  steps.lo += first_steps.lo;
  return form.direction(steps, landmark.beyond);
}

/// The kinds of consecutive rays from an even one on.
constexpr auto kKinds = []() {
  std::array<CollisionKind, PairBatch::kCapacity + 1> kinds{};
  for (std::size_t i = 1; i < kinds.size(); i += 2) kinds[i] = CollisionKind::blocks;
  return kinds;
}();

/// The anchor of a block is its ray nearest to the landmark from which the rays are counted. Angles
/// of the other rays are sums of two positive ones, so nothing cancels (README.md, "Collisions, one
/// or all"). Every ray costs two rotations, two divisions and some thirty multiplications and
/// additions without branches, so that the compiler makes vectors of them.
class UnfoldedStream final : public PairStream {
 public:
  UnfoldedStream(const Unfolding& form, RaySpan rays, std::optional<Integer> contact)
      : form_(form),
        next_(std::move(rays.first)),
        last_(std::move(rays.last)),
        index_(std::move(rays.index)),
        contact_(std::move(contact)),
        last_by_past_(floor_mean(form.past.ray, form.turn.ahead.ray)),
        last_by_turn_(floor_mean(form.turn.ahead.ray, form.future.ray)) {}

  bool read(PairBatch& batch) override {
    Integer left = std::min<Integer>(last_ - next_ + 1, long(PairBatch::kCapacity));
    if (index_ <= 0) left = std::min<Integer>(left, 1 - index_);  // on one side of time 0
    batch.first = index_;
    batch.size = left > 0 ? left.get_ui() : 0;
    std::copy_n(kKinds.begin() + (is_odd(next_) ? 1 : 0), batch.size, batch.kind.begin());
    for (std::size_t row = 0; row < batch.size;) {
      const Integer ray = next_ + static_cast<unsigned long>(row);
      if (stretch_.end_sign == 0 || stretch_.last < ray) stretch_ = stretch_from(ray);
      const Integer of_stretch = stretch_.last - ray + 1;
      const std::size_t rest = batch.size - row;
      const std::size_t rows = of_stretch < rest ? of_stretch.get_ui() : rest;
      fill(row, rows, batch);
      row += rows;
    }
    keep_within(batch);
    next_ += static_cast<unsigned long>(batch.size);
    index_ += static_cast<unsigned long>(batch.size);
    return batch.size > 0;
  }

 private:
  /// Rays that are computed in one way.
  struct Stretch {
    Integer last;
    int end_sign = 0;  ///< of the nearer end of time; 0 if there is no stretch yet
    const Landmark* landmark = nullptr;  ///< nearest: that end, or the turn
    bool is_near_start = false;
  };

  Stretch stretch_from(const Integer& ray) const {
    const bool late = form_.is_late(ray);
    const bool near_turn = ray > last_by_past_ && ray <= last_by_turn_;
    Stretch stretch{last_, late ? 1 : -1,
                    near_turn ? &form_.turn.seen(late) : &form_.end_near(late),
                    form_.is_near_start(ray)};
    for (const Integer* const cut :
         {&last_by_past_, &form_.turn.ahead.ray, &last_by_turn_, &form_.half_way}) {
      if (*cut >= ray) stretch.last = std::min(stretch.last, *cut);
    }
    return stretch;
  }

  /// Rows begin … begin + rows - 1 of the batch: rays of the stretch from next_ + begin on.
  void fill(std::size_t begin, std::size_t rows, PairBatch& batch) {
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
      const Direction ray = landmark.sign != end_sign ? seen.complement() : seen;
      const auto skip = [&](int sign) { return sign < 0 ? 0 : kBlockRays - count; };
      const TurnedRows& rays{double(end_sign), ray, table(landmark, end_sign, anchor_is_odd),
                             skip(landmark.sign)};
      const BatchRows to{batch, begin + done, count};
      fill_rows(form, rays, to);
      if (stretch_.is_near_start) {
        const Landmark& start = form_.start.seen(index_ > 0);
        const Direction from_start =
            direction_after(form, start, start.steps_from(first), done + row_next_to(start, count));
        fill_times_from_start(
            form, rays,
            {double(-start.sign), from_start, table(start, start.sign, false), skip(start.sign)},
            to);
      }
      done += count;
    }
  }

  const RayTable& table(const Landmark& landmark, int end_sign, bool anchor_is_odd) {
    const int row = (landmark.sign < 0 ? 0 : 4) + (end_sign < 0 ? 0 : 2) + (anchor_is_odd ? 1 : 0);
    auto& made = tables_[static_cast<std::size_t>(row)];
    if (!made) {
      made = std::make_unique<RayTable>(make_table(form_, landmark.sign, end_sign, anchor_is_odd));
    }
    return *made;
  }

  /// Only rounding can carry a collision past time 0. All rows are on one side of it.
  void keep_within(PairBatch& batch) const {
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

  const Unfolding& form_;
  Integer next_;
  Integer last_;
  Integer index_;
  std::optional<Integer> contact_;
  Stretch stretch_;
  Integer last_by_past_;                             // later rays are nearer to the turn
  Integer last_by_turn_;                             // later rays are nearer to the future
  std::array<std::unique_ptr<RayTable>, 8> tables_;  // by the parameters of make_table()
};

}  // namespace

std::unique_ptr<PairStream> make_unfolded_stream(const Unfolding& form, const RaySpan& rays,
                                                 const std::optional<Integer>& contact) {
  return std::make_unique<UnfoldedStream>(form, rays, contact);
}

}  // namespace piblocks
