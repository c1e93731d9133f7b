// Where, when and with what a measurement was made, for the rows of a CSV.
// In: the version's name. Out: the first fields of a row.
#pragma once

#include <string>

namespace piblocks::benchmark {

struct Circumstances {
  std::string commit;
  std::string date = today();
  std::string cpu = cpu_name();

  /// The first fields of a row: date, commit, cpu, compiler.
  std::string fields() const;
  static std::string today();
  static std::string cpu_name();
};

/// Text as one field of a CSV that needs no quotes: without commas and line breaks.
std::string csv_text(std::string text);

}  // namespace piblocks::benchmark
