#include "physics/unfolded_stream.hpp"

#include <algorithm>
#include <utility>

#include "core/vector_clones.hpp"

namespace piblocks {
namespace {

Integer middle(const Integer& a, const Integer& b) {
  Integer result;
  mpz_fdiv_q_2exp(result.get_mpz_t(), Integer(a + b).get_mpz_t(), 1);
  return result;
}

/// Row i of the table is ray i of a block that ends or begins with the anchor.
RayTable make_table(const ClosedForm& form, int sign, bool anchor_is_odd) {
  RayTable table{};
  for (std::size_t step = 0; step < kBlockRays; ++step) {
    const std::size_t row = sign < 0 ? step : kBlockRays - 1 - step;
    const Direction ray = form.direction({double(step), 0}, {});
    const bool odd = (step % 2 == 1) != anchor_is_odd;
    // The ray after an odd one is a step further from the past, and a step nearer to the future.
    const Direction even = odd ? ray + Direction{-sign * form.step.sine, form.step.cosine} : ray;
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
                               const std::optional<Integer>& contact)
    : form_(form),
      next_(std::move(first)),
      last_(std::move(last)),
      index_(std::move(index)),
      contact_(contact),
      last_of_past_(middle(form.past.ray, form.future.ray)) {}

bool UnfoldedStream::read(CollisionBatch& batch) {
  Integer left = last_ - next_ + 1;
  if (index_ <= 0) left = std::min<Integer>(left, 1 - index_);  // on one side of time 0
  batch.first = index_;
  batch.size = left <= 0 ? 0
                         : static_cast<std::size_t>(
                               std::min<Integer>(left, long(CollisionBatch::kCapacity)).get_ui());
  std::copy_n(kKinds.begin() + (is_odd(next_) ? 1 : 0), batch.size, batch.kind.begin());
  const Integer of_past = last_of_past_ - next_ + 1;
  const std::size_t turn =
      of_past <= 0
          ? 0
          : static_cast<std::size_t>(std::min<Integer>(of_past, long(batch.size)).get_ui());
  fill(form_.past, 0, turn, batch);
  fill(form_.future, turn, batch.size - turn, batch);
  keep_within(batch);
  next_ += static_cast<unsigned long>(batch.size);
  index_ += static_cast<unsigned long>(batch.size);
  return batch.size > 0;
}

/// As time_within(), for all rows, which are on one side of time 0.
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

/// Rows begin … begin + rows - 1 of the batch, which are the rays from next_ + begin on.
void UnfoldedStream::fill(const RoundedAsymptote& end, std::size_t begin, std::size_t rows,
                          CollisionBatch& batch) {
  if (rows == 0) return;
  const ClosedForm& form = form_;
  const Integer first = next_ + static_cast<unsigned long>(begin);
  const DoubleDouble first_steps = end.steps_from(first);
  for (std::size_t done = 0; done < rows;) {
    const std::size_t count = std::min(rows - done, kBlockRays);
    const std::size_t anchor = done + (end.sign < 0 ? 0 : count - 1);
    DoubleDouble steps = two_sum(first_steps.hi, -end.sign * double(anchor));
    steps.lo += first_steps.lo;
    const bool anchor_is_odd = is_odd(first) != (anchor % 2 == 1);
    fill_rows(form, end.sign, form.direction(steps, end.beyond), table(end.sign, anchor_is_odd),
              end.sign < 0 ? 0 : kBlockRays - count, count, batch, begin + done);
    done += count;
  }
}

const RayTable& UnfoldedStream::table(int sign, bool anchor_is_odd) {
  auto& made = tables_[sign < 0 ? 0 : 1][anchor_is_odd ? 1 : 0];
  if (!made) made = std::make_unique<RayTable>(make_table(form_, sign, anchor_is_odd));
  return *made;
}

}  // namespace piblocks
