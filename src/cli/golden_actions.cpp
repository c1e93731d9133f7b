#include "cli/golden_actions.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "cli/command.hpp"
#include "cli/exit_code.hpp"
#include "cli/golden_findings.hpp"
#include "core/file_set.hpp"
#include "core/processors.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"
#include "golden/frame_pair.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

int exit_code_of(const GoldenFindings& findings) { return cli::exit_code_of(findings.worst()); }

/// The files of the references that are not there. @throws IoError
std::vector<std::string> missing_files(const References& references) {
  std::vector<std::string> missing = references.files();
  std::erase_if(missing, [&](const std::string& file) { return references.has(file); });
  return missing;
}

/// Says so if the references were painted by something else, which is why they may differ.
void note_fingerprint(const References& references, std::vector<std::string>& lines) {
  const std::string theirs = references.fingerprint();
  const std::string ours = painter_fingerprint();
  if (theirs == ours) return;
  lines.push_back(fmt::format("{}: the references were painted by {}; this is {}",
                              references.name(), theirs.empty() ? "something unnamed" : theirs,
                              ours));
}

/// Renders all references into the temporary folder of `files`, whose commit() moves those of
/// `names` to their place, all or none. @returns the temporary folder.
fs::path render_into(FileSet& files, const References& references,
                     const std::vector<std::string>& names, const OnProgress& on_progress,
                     const std::stop_token& stop) {
  fs::path folder;
  // Hashes come last: where they are, all is.
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    folder = files.add(*name).parent_path();
  }
  references.render_into(folder, processor_count(), on_progress, stop);
  return folder;
}

/// Compares the references that are there. Without hashes, a picture may be anybody's file.
/// @throws UsageError if such a picture is not what is drawn
GoldenFindings compare_with(const References& references, const fs::path& drawn,
                            const std::stop_token& stop) {
  GoldenFindings findings;
  for (const std::string& file : references.files()) {
    if (!references.has(file)) continue;
    findings.compare(references.path(file), drawn / file, nullptr, stop);
    if (references.exist() || findings.worst() == Outcome::equal) continue;
    throw UsageError(fmt::format(
        "golden: cannot record '{}': '{}' is there, and belongs to no references; move it away",
        references.name(), references.path(file).string()));
  }
  return findings;
}

/// At most `most` of them, spread evenly, with the first and the last.
std::vector<std::int64_t> spread(const std::vector<std::int64_t>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<std::int64_t> chosen;
  for (std::size_t i = 0; i < most; ++i) {
    chosen.push_back(frames[most > 1 ? i * (frames.size() - 1) / (most - 1) : 0]);
  }
  return chosen;
}

/// Pictures of what a check has found, in the folder of the scene.
class CheckPictures {
 public:
  CheckPictures(const References& references, const std::string& diff)
      : references_(references),
        folder_(fs::path(diff) / references.name()),
        pictures_(folder_, DiffPictures::Making::when_needed) {}

  DiffPictures& kept() { return pictures_; }

  /// Draws the frames that differ, writes all, and says where they are.
  void finish(const std::vector<std::int64_t>& changed, std::vector<std::string>& lines,
              const std::stop_token& stop) {
    const std::size_t kept = pictures_.count();
    const std::vector<std::int64_t> frames = spread(changed, kMaxShown - kept);
    references_.draw(
        frames,
        [&](std::int64_t frame, const Bytes& png) {
          pictures_.add(frame_key(frame), kActual, png);
        },
        stop);
    pictures_.finish();
    const auto say = [&](const std::string& what) {
      lines.push_back(fmt::format("{}: '{}' has {}", references_.name(), folder_.string(), what));
    };
    if (kept > 0) {
      say("expected, actual and difference of " + counted(std::int64_t(kept), "picture"));
    }
    if (frames.empty()) return;
    say(
        fmt::format("the actual picture of {} of {} frames that differ, {} to {}; of the expected "
                    "ones there are only hashes",
                    frames.size(), changed.size(), picture_name(frame_key(frames.front()), kActual),
                    picture_name(frame_key(frames.back()), kActual)));
  }

 private:
  const References& references_;
  fs::path folder_;
  DiffPictures pictures_;
};

/// Runs `work`, and adds every problem that it throws to the findings. @throws Interrupted
template <typename Work>
void note_failure(const std::string& what, GoldenFindings& findings, const std::string& name,
                  const std::stop_token& stop, const Work& work) {
  try {
    work();
  } catch (const Interrupted&) {
    throw;
  } catch (const UsageError& error) {
    for (const std::string& problem : error.lines()) {
      findings.add(Outcome::unreadable, name, fmt::format("{}: {}", what, problem));
    }
  } catch (const Error& error) {
    if (stop.stop_requested()) throw;
    findings.add(Outcome::unreadable, name, fmt::format("{}: {}", what, error.what()));
  }
}

void compare_all(const References& references, const fs::path& drawn, CheckPictures* pictures,
                 GoldenFindings& findings, const std::stop_token& stop) {
  std::vector<std::string> files = references.files();
  std::rotate(files.begin(), files.begin() + 1, files.end());  // pictures say more than hashes
  for (const std::string& file : files) {
    if (references.has(file)) {
      findings.compare(references.path(file), drawn / file,
                       pictures == nullptr ? nullptr : &pictures->kept(), stop);
    } else {
      findings.add(Outcome::added, file, "there is no reference; 'piblocks golden record' adds it");
    }
  }
}

std::string with_counts(const std::string& line, const std::string& counts) {
  return counts.empty() ? line : line + ": " + counts;
}

}  // namespace

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  throw UsageError(
      fmt::format("golden: cannot use the folder for temporary files, $TMPDIR or /tmp: {}; set "
                  "TMPDIR to one that is there",
                  error.message()));
}

void claim_diff(OverwriteCheck& check, const std::vector<References>& all,
                const std::string& folder, const std::optional<std::string>& diff) {
  check.reads_folder("the folder of the references", folder);
  if (!diff) return;
  const auto is_picture = [](const std::string& name) { return has_ending(name, ".png"); };
  check.writes_some_of("--diff", *diff, *diff, is_picture);
  for (const References& references : all) {
    const fs::path own = fs::path(*diff) / references.name();
    check.writes_some_of("--diff", own, own, is_picture);
  }
}

GoldenResult record_golden(const References& references, const OnProgress& on_progress,
                           const std::stop_token& stop) {
  const std::string& name = references.name();
  GoldenResult kept{"kept",
                    0,
                    {name + ": has references; 'piblocks golden check' compares with them, "
                            "'piblocks golden approve' replaces them"}};
  if (missing_files(references).empty()) return kept;
  FileSet files(references.folder(), name + ".golden");
  const std::vector<std::string> missing = missing_files(references);
  if (missing.empty()) return kept;  // another run has just added them
  const fs::path drawn = render_into(files, references, missing, on_progress, stop);
  const GoldenFindings findings = compare_with(references, drawn, stop);
  std::vector<std::string> lines = findings.lines();
  if (findings.worst() != Outcome::equal) {
    lines.push_back(with_counts(name + ": not recorded, since the references that are there are "
                                       "not what is drawn; 'piblocks golden approve' replaces them",
                                findings.counts()));
    return {"not recorded", exit_code_of(findings), std::move(lines)};
  }
  for (const std::string& file : references.files()) {
    std::error_code is_absent;
    if (std::ranges::count(missing, file) == 0) fs::remove(drawn / file, is_absent);
  }
  if (missing.size() < references.files().size()) {
    for (const std::string& file : missing) lines.push_back(file + ": recorded");
  }
  files.commit();
  lines.push_back(name + ": recorded");
  return {"recorded", 0, std::move(lines)};
}

GoldenResult approve_golden(const References& references, const OnProgress& on_progress,
                            const std::stop_token& stop) {
  const std::string& name = references.name();
  const std::vector<std::string> missing = missing_files(references);
  FileSet files(references.folder(), name + ".golden");
  const fs::path drawn = render_into(files, references, references.files(), on_progress, stop);
  GoldenFindings findings = compare_with(references, drawn, stop);
  const bool is_new = missing.size() == references.files().size();
  for (const std::string& file : missing) findings.add(Outcome::added, file, "new");
  std::vector<std::string> lines = findings.lines();
  if (references.exist()) note_fingerprint(references, lines);
  files.commit();
  const bool is_equal = findings.worst() == Outcome::equal;
  const char* const outcome = is_new ? "recorded" : is_equal ? "equal" : "replaced";
  lines.push_back(
      with_counts(fmt::format("{}: {}", name, outcome), is_new ? "" : findings.counts()));
  return {outcome, 0, std::move(lines)};
}

GoldenResult check_golden(const References& references, const fs::path& scratch,
                          const std::optional<std::string>& diff, const OnProgress& on_progress,
                          const std::stop_token& stop) {
  const std::string& name = references.name();
  GoldenFindings findings;
  std::optional<CheckPictures> pictures;
  if (diff) pictures.emplace(references, *diff);
  bool has_references = true;
  note_failure("cannot be compared", findings, name, stop, [&] {
    has_references = missing_files(references).size() < references.files().size();
    if (!has_references) return;
    const Unfinished drawn(scratch / "piblocks-golden", Unfinished::Kind::folder);
    references.render_into(drawn.path(), processor_count(), on_progress, stop);
    compare_all(references, drawn.path(), pictures ? &*pictures : nullptr, findings, stop);
  });
  if (!has_references) {
    const char* const outcome = "no references";
    return {outcome,
            kMissingReference,
            {fmt::format("{}: {} in '{}'; 'piblocks golden record' makes them", name, outcome,
                         references.folder().string())}};
  }
  std::vector<std::string> notes;
  GoldenFindings failures;
  if (pictures) {
    note_failure("cannot write pictures", failures, name, stop,
                 [&] { pictures->finish(findings.changed_frames(), notes, stop); });
  }
  std::vector<std::string> lines = findings.lines();
  std::ranges::move(failures.lines(), std::back_inserter(lines));
  std::ranges::move(notes, std::back_inserter(lines));
  if (findings.worst() != Outcome::unreadable && references.exist()) {
    note_fingerprint(references, lines);
  }
  lines.push_back(with_counts(fmt::format("{}: {}", name, findings.outcome()), findings.counts()));
  const int failed = failures.worst() == Outcome::equal ? 0 : kFailed;
  return {findings.outcome(), worse_exit_code(exit_code_of(findings), failed), std::move(lines)};
}

}  // namespace piblocks::cli
