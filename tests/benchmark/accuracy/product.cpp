#include <piblocks/two_blocks.hpp>

#include <memory>
#include <span>

#include "accuracy/log_writer.hpp"
#include "accuracy/methods.hpp"

namespace piblocks::benchmark {
namespace {

/// The program's log, through the interface that its users have.
class Product final : public Method {
 public:
  Product() : Method({"piblocks::PairLog", kScalarName<double>, ""}) {}

  WholeLog whole_log(const TwoBlocks& system, std::span<const std::int64_t> wanted,
                     const Deadline& deadline) const override {
    const auto log = make_pair_log(system);
    const auto stream = log->stream(1, log->last());
    LogWriter<double> writer(wanted, deadline);
    const auto batch = std::make_unique<PairBatch>();
    const auto rows = [&](const PairBatch::Column& column) {
      return std::span(column).first(batch->size);
    };
    while (stream->read(*batch)) {
      writer.push_columns(rows(batch->time_hi), rows(batch->blue_position),
                          rows(batch->red_position));
    }
    return writer.finish();
  }

  std::vector<LoggedEvent> single_events(const TwoBlocks& system,
                                         std::span<const std::int64_t> wanted) const override {
    const auto log = make_pair_log(system);
    std::vector<LoggedEvent> events;
    for (const std::int64_t k : wanted) {
      const PairCollision collision = log->blocks_collision(k);
      events.push_back({k, collision.time.hi, collision.blue.position, collision.red.position});
    }
    return events;
  }

  Numbers blue_at(const TwoBlocks& system, const Instants& instants,
                  const Deadline&) const override {
    const auto log = make_pair_log(system);
    std::vector<double> blue;
    blue.reserve(instants.exact.size());
    for (const Rational& time : instants.exact) blue.push_back(log->blocks_at(time).blue.position);
    return blue;
  }

  Integer count(const TwoBlocks& system, const Deadline&) const override {
    return count_collisions(system);
  }
};

}  // namespace

MethodPtr product() { return std::make_unique<Product>(); }

}  // namespace piblocks::benchmark
