// Where a method puts the events of a whole log.
// In: event after event, or columns of events. Out: the wanted ones, exactly; the others have been
// written to memory that stays in the cache, so that no compiler leaves their computation out.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <span>

#include "accuracy/deadline.hpp"
#include "accuracy/method.hpp"

namespace piblocks::benchmark {

template <typename Scalar>
class LogWriter {
 public:
  LogWriter(std::span<const std::int64_t> wanted, const Deadline& deadline)
      : wanted_(wanted), deadline_(deadline) {
    log_.kept.reserve(wanted.size());
  }

  void push(const Scalar& time, const Scalar& blue, const Scalar& red) {
    Row& row = (*block_)[used_];
    row.time = time;
    row.blue = blue;
    row.red = red;
    if (++used_ == block_->size()) flush();
  }

  /// Events of a method that makes columns: they are read where they are.
  void push_columns(std::span<const Scalar> time, std::span<const Scalar> blue,
                    std::span<const Scalar> red) {
    asm volatile("" : : "r"(time.data()), "r"(blue.data()), "r"(red.data()) : "memory");
    take(std::ssize(time), [&](std::size_t i) { return Row{time[i], blue[i], red[i]}; });
  }

  WholeLog finish() {
    flush();
    return std::move(log_);
  }

 private:
  struct Row {
    Scalar time;
    Scalar blue;
    Scalar red;
  };
  using Block = std::array<Row, 1024>;

  void flush() {
    asm volatile("" : : "r"(block_.get()) : "memory");  // the rows have a reader
    take(static_cast<std::int64_t>(used_), [&](std::size_t i) { return (*block_)[i]; });
    used_ = 0;
  }

  /// Counts the next `rows` events, of which row_at() knows each, and keeps the wanted ones.
  template <typename RowAt>
  void take(std::int64_t rows, const RowAt& row_at) {
    const std::int64_t before = log_.count;
    log_.count += rows;
    for (; !wanted_.empty() && wanted_.front() <= log_.count; wanted_ = wanted_.subspan(1)) {
      const Row row = row_at(static_cast<std::size_t>(wanted_.front() - before - 1));
      log_.kept.push_back(
          {wanted_.front(), Reference(row.time), Reference(row.blue), Reference(row.red)});
    }
    // The clock costs as much as a hundred events of the fastest method.
    if (before / kEventsPerCheck != log_.count / kEventsPerCheck) deadline_.check();
  }

  static constexpr std::int64_t kEventsPerCheck = 1 << 14;

  std::unique_ptr<Block> block_ = std::make_unique<Block>();
  std::size_t used_ = 0;
  std::span<const std::int64_t> wanted_;
  const Deadline& deadline_;
  WholeLog log_;
};

}  // namespace piblocks::benchmark
