#include "cli/golden_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "core/text.hpp"
#include "golden/difference.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// Consecutive frames about which the same is found.
struct Frames {
  Outcome outcome = Outcome::equal;
  std::int64_t first = 0;
  std::int64_t last = 0;
};

bool is_of_frame(Outcome outcome) { return outcome <= Outcome::missing; }

/// "frames 12 to 480 differ".
std::string text_of(const Frames& frames) {
  const bool is_one = frames.first == frames.last;
  const std::string named = is_one ? fmt::format("frame {}", frames.first)
                                   : fmt::format("frames {} to {}", frames.first, frames.last);
  if (frames.outcome == Outcome::different) return named + (is_one ? " differs" : " differ");
  return fmt::format("{} {} {}", named, is_one ? "is" : "are", name_of(frames.outcome));
}

/// The row with the file's name, which the row of a picture has already.
std::string line_of(const std::string& file, const FrameComparison& row) {
  return row.name == file ? row_text(row) : fmt::format("{}: {}", file, row_text(row));
}

}  // namespace

void GoldenFindings::add(Outcome outcome, const std::string& file, const std::string& what) {
  ++pictures_.at(static_cast<std::size_t>(outcome));
  shown_.add(outcome, fmt::format("{}: {}", file, what));
}

void GoldenFindings::compare(const fs::path& reference, const fs::path& actual,
                             DiffPictures* pictures, const std::stop_token& stop) {
  const ComparisonJob job{reference, actual};
  const std::string file = reference.filename();
  if (has_ending(file, ".png")) return compare_pictures(job, file, pictures, stop);
  compare_hashes(job, file, stop);
}

void GoldenFindings::compare_hashes(const ComparisonJob& job, const std::string& file,
                                    const std::stop_token& stop) {
  std::int64_t number = 0;
  std::optional<Frames> open;
  const auto close = [&] {
    if (open) shown_.add(open->outcome, fmt::format("{}: {}", file, text_of(*open)));
    open.reset();
  };
  const auto on_row = [&](const FrameComparison& row) {
    const bool is_frame = is_of_frame(row.outcome);
    ++(is_frame ? frames_ : pictures_).at(static_cast<std::size_t>(row.outcome));
    if (!is_frame) return shown_.add(row.outcome, line_of(file, row));
    const std::int64_t frame = number++;
    if (open && row.outcome != open->outcome) close();
    if (row.outcome == Outcome::equal) return;
    if (row.outcome != Outcome::missing) changed_frames_.push_back(frame);
    if (!open) open = Frames{row.outcome, frame, frame};
    open->last = frame;
  };
  compare_files(job, on_row, stop);
  close();
}

void GoldenFindings::compare_pictures(const ComparisonJob& job, const std::string& file,
                                      DiffPictures* pictures, const std::stop_token& stop) {
  const auto on_row = [&](const FrameComparison& row) {
    ++pictures_.at(static_cast<std::size_t>(row.outcome));
    if (row.is_accepted()) return;
    shown_.add(row.outcome, line_of(file, row));
    if (pictures == nullptr || !row.difference || pictures->count() == kMaxShown) return;
    for (const FramePicture& picture : pictures_of(row)) {
      pictures->add(file, picture.kind, picture.png);
    }
  };
  compare_files(job, on_row, stop);
}

Outcome GoldenFindings::worst() const {
  std::size_t outcome = kOutcomes - 1;
  while (outcome > 0 && frames_.at(outcome) == 0 && pictures_.at(outcome) == 0) --outcome;
  return static_cast<Outcome>(outcome);
}

const char* GoldenFindings::outcome() const {
  const Outcome found = worst();
  if (found == Outcome::equal || found == Outcome::unreadable) return name_of(found);
  constexpr auto kAdded = static_cast<std::size_t>(Outcome::added);
  constexpr auto kOther = static_cast<std::size_t>(Outcome::different);
  const bool differs = frames_.at(kOther) > 0 || pictures_.at(kOther) > 0;
  const bool lacks_files_only = found == Outcome::added && frames_.at(kAdded) == 0 && !differs;
  return lacks_files_only ? "incomplete" : "different";
}

std::string GoldenFindings::counts() const {
  std::string text;
  const auto add_part = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  for (const auto& [counts, what] :
       {std::pair(frames_, "frames"), std::pair(pictures_, "pictures")}) {
    const auto of = [&rows = counts](Outcome outcome) {
      return rows.at(static_cast<std::size_t>(outcome));
    };
    const std::int64_t different = of(Outcome::different);
    if (different > 0) {
      add_part(fmt::format("{} of {} {} differ", different, different + of(Outcome::equal), what));
    }
  }
  for (const auto& [counts, outcome, what] :
       {std::tuple(frames_, Outcome::missing, "frames missing"),
        std::tuple(frames_, Outcome::added, "frames new"),
        std::tuple(pictures_, Outcome::mismatch, "not comparable"),
        std::tuple(pictures_, Outcome::added, "without a reference"),
        std::tuple(pictures_, Outcome::unreadable, "unreadable")}) {
    const std::int64_t count = counts.at(static_cast<std::size_t>(outcome));
    if (count > 0) add_part(fmt::format("{} {}", count, what));
  }
  return text;
}

}  // namespace piblocks::cli
