#include "accuracy/method.hpp"

namespace piblocks::benchmark {

WholeLog Method::whole_log(const BlockSystem&, std::span<const std::int64_t>,
                           const Deadline&) const {
  throw NotRun("not run: has no whole log");
}

std::vector<LoggedEvent> Method::single_events(const BlockSystem&,
                                               std::span<const std::int64_t>) const {
  throw NotRun("not run: has no random access");
}

Numbers Method::blue_at(const BlockSystem&, const Instants&, const Deadline&) const {
  throw NotRun("not run: has no positions");
}

Integer Method::count(const BlockSystem&, const Deadline&) const {
  throw NotRun("not run: has no count");
}

}  // namespace piblocks::benchmark
