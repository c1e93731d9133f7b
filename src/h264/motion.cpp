#include "h264/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace piblocks::h264 {
namespace {

/// The longest vector, each way: some lines of text. Level 2, the lowest, allows 128 samples up and
/// down (table A-1).
constexpr int kRange = 120;

/// So far along each axis motion is looked for everywhere.
constexpr int kAlwaysReach = 8;

/// Motion leaves a smaller sum of differences in 256 samples: what a quantiser leaves doubles with
/// every 6 steps. 768 * 2^((qp - 14)/6), rounded down.
int near_of(int qp) {
  // 2^(i/6). Not std::exp2(), which rounds differently in other C libraries.
  constexpr std::array kSixthRoots{1.0,
                                   1.122462048309373,
                                   1.2599210498948732,
                                   1.4142135623730951,
                                   1.5874010519681994,
                                   1.7817974362806785};
  const int steps = qp + 4;  // 18 below 14, which is three doublings
  return static_cast<int>(std::ldexp(768 * kSixthRoots[std::size_t(steps % 6)], steps / 6 - 3));
}

bool is_zero(MotionVector vector) { return vector == MotionVector{}; }

/// refIdxL0 is 0 or, outside the picture and in intra macroblocks, -1.
bool has_vector(const MacroblockState* state) { return state != nullptr && !state->is_intra; }

MotionVector vector_of(const MacroblockState* state) {
  return has_vector(state) ? state->vector : MotionVector{};
}

int median(int a, int b, int c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

/// Of the luma samples; `limit` or more once it is certain to be no less.
int sum_of_differences(const Samples& source, const Picture& before, int x_px, int y_px,
                       int limit) {
  constexpr int kRows = 4;  // at once
  const std::ptrdiff_t stride = before.stride_bytes(0);
  const std::uint8_t* from = before.plane(0) + y_px * stride + x_px;
  const std::uint8_t* wanted = source.plane(0);
  int sum = 0;
  for (int i = 0; i < kLumaSide / kRows && sum < limit; ++i) {
    for (int row = 0; row < kRows; ++row, from += stride, wanted += kLumaSide) {
      for (int x = 0; x < kLumaSide; ++x) sum += std::abs(wanted[x] - from[x]);
    }
  }
  return sum;
}

/// The nearest of some vectors.
class Nearest {
 public:
  /// @param near  only sums below it are found
  Nearest(const Samples& source, const Picture& before, int x_mb, int y_mb, int near)
      : source_(source),
        before_(before),
        x_mb_(x_mb),
        y_mb_(y_mb),
        near_enough_(near / 2),
        least_(near) {}

  void try_vector(MotionVector vector) {
    const bool is_short = std::abs(vector.x) <= kRange && std::abs(vector.y) <= kRange;
    if (!is_short || !stays_inside(before_, x_mb_, y_mb_, vector)) return;
    const int sum = sum_of_differences(source_, before_, kLumaSide * x_mb_ + vector.x,
                                       kLumaSide * y_mb_ + vector.y, least_);
    if (sum >= least_) return;
    least_ = sum;
    vector_ = vector;
  }
  void take_only_near_enough() { least_ = std::min(least_, near_enough_); }
  bool is_near_enough() const { return least_ < near_enough_; }
  const std::optional<MotionVector>& vector() const { return vector_; }

 private:
  const Samples& source_;
  const Picture& before_;
  int x_mb_;
  int y_mb_;
  int near_enough_;  // a sum below it ends the search
  int least_;
  std::optional<MotionVector> vector_;
};

/// What moves on may do so by a sample more or less than before.
void try_near(MotionVector vector, Nearest& nearest) {
  nearest.try_vector(vector);
  const int x = vector.x != 0 ? 1 : 0;
  const int y = 1 - x;
  for (const int sign : {-1, 1}) {
    if (!nearest.is_near_enough()) nearest.try_vector({vector.x + sign * x, vector.y + sign * y});
  }
}

/// Where something slides or scrolls.
void try_along_axes(int from, int to, Nearest& nearest) {
  for (int i = from; i <= to && !nearest.is_near_enough(); ++i) {
    for (const MotionVector vector : {MotionVector{i, 0}, {-i, 0}, {0, i}, {0, -i}}) {
      nearest.try_vector(vector);
    }
  }
}

/// Where something is dragged.
void try_around(Nearest& nearest) {
  constexpr int kReach = 24;
  nearest.take_only_near_enough();
  for (int y = 1; y <= kReach && !nearest.is_near_enough(); ++y) {
    for (int x = 1; x <= kReach; ++x) {
      for (const MotionVector vector : {MotionVector{x, y}, {-x, y}, {x, -y}, {-x, -y}}) {
        nearest.try_vector(vector);
      }
    }
  }
}

/// Samples of a plane; decoders repeat the picture's edges (8.4.2.2).
struct PlaneReader {
  const std::uint8_t* samples;
  std::ptrdiff_t stride;
  int width;
  int height;

  int at(int x, int y) const {
    return samples[std::clamp(y, 0, height - 1) * stride + std::clamp(x, 0, width - 1)];
  }
};

/// A chroma sample between four of its plane (8.4.2.2.2): the mean of equals if it is on one.
std::uint8_t mean_of_four(int a, int b, int c, int d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) >> 2);
}

/// A chroma plane by a vector in half samples, inside the picture.
void predict_chroma_inside(const Picture& before, int plane, int x, int y, std::uint8_t* to) {
  const std::ptrdiff_t stride = before.stride_bytes(plane);
  const std::uint8_t* at = before.plane(plane) + (y >> 1) * stride + (x >> 1);
  const std::ptrdiff_t right = x & 1;
  const std::ptrdiff_t below = (y & 1) * stride;
  for (int row = 0; row < kChromaSide; ++row, at += stride, to += kChromaSide) {
    for (int i = 0; i < kChromaSide; ++i) {
      to[i] = mean_of_four(at[i], at[i + right], at[i + below], at[i + right + below]);
    }
  }
}

/// The same for all planes where the vector leads out of the picture.
void predict_outside(const Picture& before, int x, int y, Samples& samples) {
  for (int plane = 0; plane < 3; ++plane) {
    const int side = side_of(plane);
    const PlaneReader reader{before.plane(plane), before.stride_bytes(plane),
                             side * before.width_mb(), side * before.height_mb()};
    const int from_x = plane == 0 ? x : x >> 1;
    const int from_y = plane == 0 ? y : y >> 1;
    const int right = plane == 0 ? 0 : x & 1;
    const int below = plane == 0 ? 0 : y & 1;
    for (int i = 0; i < side * side; ++i) {
      const int column = from_x + i % side;
      const int row = from_y + i / side;
      samples.plane(plane)[i] =
          mean_of_four(reader.at(column, row), reader.at(column + right, row),
                       reader.at(column, row + below), reader.at(column + right, row + below));
    }
  }
}

}  // namespace

MotionVector predicted_vector(const Neighbours& neighbours) {
  const auto& [above, left, corner] = neighbours;
  if (above == nullptr && corner == nullptr) return vector_of(left);
  const std::array all = {left, above, corner};
  if (std::ranges::count_if(all, has_vector) == 1) {
    return vector_of(*std::ranges::find_if(all, has_vector));
  }
  const MotionVector a = vector_of(left);
  const MotionVector b = vector_of(above);
  const MotionVector c = vector_of(corner);
  return {median(a.x, b.x, c.x), median(a.y, b.y, c.y)};
}

MotionVector skip_vector(const Neighbours& neighbours) {
  for (const MacroblockState* state : {neighbours.left, neighbours.above}) {
    if (state == nullptr || (has_vector(state) && is_zero(state->vector))) return {};
  }
  return predicted_vector(neighbours);
}

bool stays_inside(const Picture& picture, int x_mb, int y_mb, MotionVector vector) {
  const auto fits = [](int at_mb, int distance, int size_mb) {
    const int first = kLumaSide * at_mb + distance;
    return first >= 0 && first + kLumaSide <= kLumaSide * size_mb;
  };
  return fits(x_mb, vector.x, picture.width_mb()) && fits(y_mb, vector.y, picture.height_mb());
}

void predict_moved(const Picture& before, int x_mb, int y_mb, MotionVector vector,
                   Samples& samples) {
  const int x = kLumaSide * x_mb + vector.x;
  const int y = kLumaSide * y_mb + vector.y;
  if (is_zero(vector)) return before.load(x_mb, y_mb, samples);
  if (!stays_inside(before, x_mb, y_mb, vector)) return predict_outside(before, x, y, samples);
  const std::ptrdiff_t stride = before.stride_bytes(0);
  for (int row = 0; row < kLumaSide; ++row) {
    std::memcpy(samples.plane(0) + row * kLumaSide, before.plane(0) + (y + row) * stride + x,
                kLumaSide);
  }
  for (int plane = 1; plane < 3; ++plane) {
    predict_chroma_inside(before, plane, x, y, samples.plane(plane));
  }
}

std::optional<MotionVector> MotionSearch::find(const Samples& source, const Picture& before,
                                               int x_mb, int y_mb, const Neighbours& neighbours) {
  Nearest nearest(source, before, x_mb, y_mb, near_);
  if (!is_zero(skip_vector(neighbours))) nearest.try_vector({});
  for (const MacroblockState* state : {neighbours.left, neighbours.above, neighbours.corner}) {
    if (!is_zero(vector_of(state))) nearest.try_vector(vector_of(state));
  }
  for (const MotionVector vector : recent_) {
    if (!nearest.is_near_enough()) try_near(vector, nearest);
  }
  if (!nearest.is_near_enough()) try_along_axes(1, kAlwaysReach, nearest);
  if (!nearest.is_near_enough() && searches_left_ > 0) {
    try_along_axes(kAlwaysReach + 1, reach_, nearest);
    if (reach_ == kRange && !nearest.vector()) try_around(nearest);
    searches_left_ =
        nearest.is_near_enough() ? std::max(searches_left_, kMostSearches) : searches_left_ - 1;
  }
  if (nearest.is_near_enough()) remember(*nearest.vector());
  return nearest.vector();
}

MotionSearch::MotionSearch(int qp) : near_(near_of(qp)) {}

void MotionSearch::begin_group() {
  recent_.clear();
  searches_left_ = kMostSearches;
}

void MotionSearch::begin_picture(int changed_macroblocks) {
  // What scrolls is large, and may go far. Beside it, searches fail where a window ends.
  constexpr int kOneSearchIn = 64;
  constexpr int kFew = 256;
  searches_left_ = std::min(searches_left_ + 1, kMostSearches) + changed_macroblocks / kOneSearchIn;
  reach_ = changed_macroblocks < kFew ? kShortReach : kRange;
}

void MotionSearch::remember(MotionVector vector) {
  constexpr std::size_t kRemembered = 4;
  if (is_zero(vector)) return;
  std::erase(recent_, vector);
  recent_.insert(recent_.begin(), vector);
  if (recent_.size() > kRemembered) recent_.pop_back();
}

}  // namespace piblocks::h264
