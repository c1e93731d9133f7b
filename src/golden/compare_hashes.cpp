#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "golden/hash_file.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// No lines if the file is missing. Nothing if it cannot be read; then the row says why.
std::optional<FramehashFile> read(const std::string& path, Rows& rows, FrameComparison& row) {
  std::error_code unknown;
  if (fs::status(path, unknown).type() == fs::file_type::not_found) {
    rows.set_problem(fmt::format("there is no '{}'", path));
    return FramehashFile{};
  }
  try {
    return read_framehash(path);
  } catch (const IoError& error) {
    if (row.name.empty()) row.name = fs::path(path).filename();
    add_unreadable(row, error.what());
    return std::nullopt;
  }
}

/// Adds a row if the headers differ. A file that is missing has none.
void compare_headers(const FramehashFile& reference, const FramehashFile& actual, Rows& rows) {
  if (reference.header.empty() || actual.header.empty()) return;
  const auto differs = std::ranges::mismatch(reference.header, actual.header);
  if (differs.in1 == reference.header.end() && differs.in2 == actual.header.end()) return;
  const auto line = [](auto at, const auto& header) {
    return at == header.end() ? std::string("nothing") : "'" + *at + "'";
  };
  FrameComparison row;
  row.name = "header";
  row.outcome = Outcome::mismatch;
  row.problem = fmt::format("{} instead of {}", line(differs.in2, actual.header),
                            line(differs.in1, reference.header));
  rows.take(row, false, false);
}

}  // namespace

void compare_hashes(const ComparisonJob& job, Rows& rows) {
  if (!is_framehash(job.reference) || !is_framehash(job.actual)) {
    throw UsageError("compare: hashes of frames can be compared with hashes only");
  }
  if (!job.tolerance.is_exact() || !job.masks.empty()) {
    throw UsageError("compare: hashes of frames know no tolerance and no masks");
  }
  FrameComparison unreadable;
  const auto reference = read(job.reference, rows, unreadable);
  const auto actual = read(job.actual, rows, unreadable);
  if (!reference || !actual) return rows.take(unreadable, true, true);
  compare_headers(*reference, *actual, rows);
  const std::size_t count = std::max(reference->frames.size(), actual->frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_reference = i < reference->frames.size();
    const bool has_actual = i < actual->frames.size();
    FrameComparison row;
    row.name = fmt::format("frame {}", i);
    row.outcome = !has_actual                                 ? Outcome::missing
                  : !has_reference                            ? Outcome::added
                  : reference->frames[i] == actual->frames[i] ? Outcome::equal
                                                              : Outcome::different;
    rows.take(row, has_reference, has_actual);
  }
}

}  // namespace piblocks
