// The results as CSV, each row with all that is needed to judge it.
// In: measurements. Out: lines on standard output.
#pragma once

#include <string>

#include "accuracy/measure.hpp"

namespace piblocks::benchmark {

/// Where and with what a row was measured.
struct Circumstances {
  std::string commit;
  std::string date = today();
  std::string cpu = cpu_name();

  /// The first fields of a row: date, commit, cpu, compiler.
  std::string fields() const;
  static std::string today();
  static std::string cpu_name();
};

void print_header();
void print_row(const Circumstances& circumstances, Question question, const Label& label,
               const ReferenceRun& reference, const Measurement& measured);

}  // namespace piblocks::benchmark
