// How many times as fast as loops from collision to collision the program's log is.
// In: numbers of digits of pi. Out: CSV on standard output.
#pragma once

#include <string>

namespace piblocks::benchmark {

/// Whole logs of 6 and 7 digits, the program's and a loop's in turn, so that a busy machine slows
/// both: medians of `pairs` runs each, and their ratio.
void compare_whole_logs(const std::string& circumstances, int pairs);

}  // namespace piblocks::benchmark
