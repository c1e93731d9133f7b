// The results as CSV, each row with all that is needed to judge it.
// In: measurements. Out: lines on standard output.
#pragma once

#include "accuracy/measure.hpp"
#include "circumstances.hpp"

namespace piblocks::benchmark {

void print_header();
void print_row(const Circumstances& circumstances, Question question, const Label& label,
               const ReferenceRun& reference, const Measurement& measured);

}  // namespace piblocks::benchmark
