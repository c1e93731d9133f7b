// Where, when and with what a measurement was made, for the rows of a CSV.
// In: the version's name. Out: the first fields of a row.
#pragma once

#include <string>

namespace piblocks::benchmark {

/// Date, commit, cpu, compiler.
std::string circumstances(const std::string& commit = {});

/// Text as one field of a CSV that needs no quotes: without commas and line breaks.
std::string csv_text(std::string text);

}  // namespace piblocks::benchmark
