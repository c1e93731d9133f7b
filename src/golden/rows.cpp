#include "golden/rows.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>
#include <string_view>
#include <utility>

#include "core/descriptor.hpp"
#include "core/input_file.hpp"
#include "core/text.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Longer than a line with the longest hash.
constexpr std::size_t kMaxLine = 4096;

bool is_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Stream, dts, pts, duration, size: numbers; and a hash, which is letters and digits.
bool is_frame(std::string_view line) {
  constexpr int kNumbers = 5;
  for (int i = 0; i < kNumbers; ++i) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos || !is_number(line.substr(0, comma))) return false;
    line.remove_prefix(comma + 1);
  }
  return !line.empty() && std::ranges::all_of(line, [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  });
}

std::string without_blanks(std::string line) {
  std::erase_if(line, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
  return line;
}

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
  ComparedPair pair;
  pair.row.name = "header";
  pair.row.outcome = Outcome::mismatch;
  pair.row.problem = fmt::format("{} instead of {}", line(differs.in2, actual.header),
                                 line(differs.in1, reference.header));
  rows.take(std::move(pair));
}

}  // namespace

void Rows::take(ComparedPair pair) {
  is_compared_ |= pair.is_compared;
  for (const std::size_t mask : pair.mask_indices) hides_[mask] = true;
  FrameComparison& row = pair.row;
  row.number = number_++;
  if (row.key.empty()) row.key = row.name;
  ++result_.rows.at(static_cast<std::size_t>(row.outcome));
  result_.reference_frames += pair.has_reference ? 1 : 0;
  result_.actual_frames += pair.has_actual ? 1 : 0;
  const bool differs = row.difference ? !row.difference->is_equal()  // also if it is accepted
                                      : row.outcome == Outcome::different;
  if (differs) ++result_.different_frames;
  if (row.difference && row.difference->masked_pixels > 0) ++result_.masked_frames;
  on_frame_(row);
}

void Rows::check_masks() const {
  if (!is_compared_) return;
  for (std::size_t i = 0; i < hides_.size(); ++i) {
    const Mask& mask = job_.masks[i];
    if (hides_[i] || !mask.must_hide) continue;
    throw UsageError(
        mask.name_pattern.empty()
            ? fmt::format("compare: the mask {} lies outside of every picture that is compared",
                          mask.text)
            : fmt::format("compare: the mask {} hides nothing: no picture that is compared has "
                          "this name, or the mask lies outside of it",
                          mask.text));
  }
}

ComparisonResult Rows::finish() {
  check_masks();
  const bool has_reference = result_.reference_frames > 0;
  const bool has_actual = result_.actual_frames > 0;
  // What cannot be read may hide all frames of the other side.
  if ((!has_reference || !has_actual) && result_.worst() != Outcome::unreadable) {
    set_problem(
        fmt::format("there is no frame in '{}'", has_reference ? job_.actual : job_.reference));
  }
  if (!has_reference && !has_actual) {
    ComparedPair nothing;
    nothing.row.name = job_.actual;
    nothing.row.outcome = Outcome::missing;
    take(std::move(nothing));
  }
  return result_;
}

std::int64_t ComparisonResult::total() const {
  return std::accumulate(rows.begin(), rows.end(), std::int64_t{0});
}

Outcome ComparisonResult::worst() const {
  std::size_t outcome = kOutcomes - 1;
  while (outcome > 0 && rows.at(outcome) == 0) --outcome;
  return static_cast<Outcome>(outcome);
}

const char* name_of(Outcome outcome) {
  constexpr std::array<const char*, kOutcomes> kNames = {
      "equal", "accepted", "different", "new", "missing", "not comparable", "unreadable"};
  return kNames.at(static_cast<std::size_t>(outcome));
}

bool is_framehash(const std::string& name) {
  return has_ending(name, ".framehash") || has_ending(name, ".framemd5");
}

FramehashFile read_framehash(const std::string& path) {
  refuse_pipe(path, "framehash");
  std::ifstream file(path);
  if (!file) {
    throw IoError(fmt::format("framehash: cannot read '{}': {}", path, error_text(errno)));
  }
  FramehashFile result;
  std::vector<char> line(kMaxLine);
  for (std::size_t number = 1; file.getline(line.data(), kMaxLine); ++number) {
    // gcount() counts the line's end, except at the end of the file. A line may have a zero in
    // it.
    const auto length = static_cast<std::size_t>(file.gcount()) - (file.eof() ? 0 : 1);
    const std::string text = without_blanks({line.data(), length});
    if (text.starts_with("#software")) continue;
    const bool is_header = text.empty() || text.front() == '#';
    if (!is_header && !is_frame(text)) {
      throw IoError(fmt::format("framehash: '{}': line {} is no hash of a frame", path, number));
    }
    if (number > kMaxHashes) {
      throw IoError(fmt::format("framehash: '{}' has more than {} lines", path, kMaxHashes));
    }
    if (!text.empty()) (is_header ? result.header : result.frames).push_back(text);
  }
  if (!file.eof() || result.header.empty()) {
    throw IoError(fmt::format("framehash: '{}' is no file of hashes", path));
  }
  return result;
}

void compare_hashes(const ComparisonJob& job, Rows& rows) {
  if (!is_framehash(job.reference) || !is_framehash(job.actual)) {
    throw UsageError("compare: hashes of frames can be compared with hashes only");
  }
  if (job.tolerance != Tolerance() || !job.masks.empty()) {
    throw UsageError("compare: hashes of frames know no tolerance and no masks");
  }
  ComparedPair unreadable{.row = {}, .has_reference = true, .has_actual = true};
  const auto reference = read(job.reference, rows, unreadable.row);
  const auto actual = read(job.actual, rows, unreadable.row);
  if (!reference || !actual) return rows.take(std::move(unreadable));
  compare_headers(*reference, *actual, rows);
  const std::size_t count = std::max(reference->frames.size(), actual->frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_reference = i < reference->frames.size();
    const bool has_actual = i < actual->frames.size();
    ComparedPair pair{.row = {}, .has_reference = has_reference, .has_actual = has_actual};
    pair.row.name = fmt::format("frame {}", i);
    pair.row.outcome = !has_actual                                 ? Outcome::missing
                       : !has_reference                            ? Outcome::added
                       : reference->frames[i] == actual->frames[i] ? Outcome::equal
                                                                   : Outcome::different;
    rows.take(std::move(pair));
  }
}

}  // namespace piblocks
