// Numbered pictures, each a file.
// In: a name with a number field; the pictures, encoded. Out: files that take their names together.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>

#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "core/file_set.hpp"
#include "core/text.hpp"
#include "media/output/frame_pattern.hpp"
#include "media/output/output_kinds.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

/// Numbered pictures in a folder that may hold others. It replaces and removes those of an earlier
/// sequence. It replaces other files only if it is told to, and never removes them.
class PictureSequence final : public FrameSink {
 public:
  /// @param start_number  of the first picture; nothing for 1, as FFmpeg's image2 muxer has it.
  PictureSequence(FramePattern pattern, const PictureKind& kind, const Opening& opening,
                  bool overwrite, std::optional<int> start_number)
      : pattern_(std::move(pattern)),
        kind_(kind),
        overwrite_(overwrite),
        first_(start_number.value_or(1)),
        leaves_later_(start_number.has_value()),
        files_(pattern_.folder(), pattern_.label(), Unfinished::Sharing::exclusive,
               opening.resumption) {
    check_names(opening.frames);
    if (opening.resumption.is_wanted) keep_pictures(opening.frames);
  }

  void append(const EncodedChunk& chunk) override {
    std::int64_t number = next_number();
    counter_.take(chunk);
    for (const Packet& packet : chunk) {
      files_.add(pattern_.name(number++), kind_.with_mark(packet.bytes));
    }
  }
  void finish() override {
    check_names(counter_.frames());  // files may have come meanwhile
    // Pictures of an earlier, longer sequence would look like the end of this one.
    for (auto number = next_number(); !leaves_later_ && is_file(path_of(number)); ++number) {
      if (!kind_.has_mark(path_of(number))) {
        ++left_;
        continue;
      }
      files_.remove(pattern_.name(number));
      ++removed_;
    }
    files_.commit();
  }
  std::int64_t kept_frames() const override { return kept_; }
  std::string aftermath() const override {
    std::vector<std::string> done;
    if (kept_ > 0) done.push_back("kept " + counted(kept_, "picture") + " of an unfinished run");
    if (leaves_later_ && counter_.frames() > 0) {
      done.push_back(
          fmt::format("{} to {}", pattern_.name(first_), pattern_.name(next_number() - 1)));
    }
    if (foreign_ > 0) done.push_back("replaced " + counted(foreign_, "other file"));
    if (removed_ > 0) {
      done.push_back("removed " + counted(removed_, "picture") + " of an earlier run");
    }
    if (left_ > 0) {
      done.push_back("left " + counted(left_, "other file") +
                     (left_ == 1 ? " that follows" : " that follow"));
    }
    return fmt::format("{}", fmt::join(done, ", "));
  }

 private:
  std::int64_t next_number() const { return first_ + counter_.frames(); }
  fs::path path_of(std::int64_t number) const {
    return fs::path(pattern_.folder()) / pattern_.name(number);
  }
  /// FileSet rejects anything else of this name.
  static bool is_file(const fs::path& path) {
    std::error_code unknown;
    return fs::is_regular_file(fs::symlink_status(path, unknown));
  }

  /// Those that were written to the end. A run writes them in their order.
  void keep_pictures(std::int64_t frames) {
    for (; kept_ < frames; ++kept_) {
      const std::string name = pattern_.name(first_ + kept_);
      if (is_whole(files_.add(name))) continue;
      files_.drop(name);
      break;
    }
    counter_ = FrameCounter(kept_);
  }

  /// Files are written from their beginning on.
  bool is_whole(const fs::path& path) const {
    std::string end(kind_.ending.size(), '\0');
    std::ifstream file(path, std::ios::binary);
    file.seekg(-std::ssize(end), std::ios::end);
    file.read(end.data(), std::ssize(end));
    return file && end == kind_.ending;
  }

  /// @throws UsageError if so many pictures would replace other files, unless it is told to.
  void check_names(std::int64_t frames) {
    foreign_ = 0;
    fs::path first;
    for (std::int64_t number = first_; number < first_ + frames; ++number) {
      const fs::path path = path_of(number);
      if (!is_file(path) || kind_.has_mark(path)) continue;
      if (foreign_++ == 0) first = path;
    }
    if (foreign_ == 0 || overwrite_) return;
    throw UsageError(fmt::format(
        "output: '{}'{} there, but not from an earlier run; use another name, or --overwrite to "
        "replace what is there",
        first.string(), foreign_ == 1 ? " is" : fmt::format(" and {} more are", foreign_ - 1)));
  }

  FramePattern pattern_;
  PictureKind kind_;
  bool overwrite_;
  std::int64_t first_;
  bool leaves_later_;  // pictures, of a longer sequence
  FileSet files_;
  FrameCounter counter_;
  std::int64_t foreign_ = 0;  // files that are replaced and were no pictures of a sequence
  std::int64_t kept_ = 0;     // pictures of an unfinished run
  std::int64_t removed_ = 0;  // pictures of an earlier sequence
  std::int64_t left_ = 0;     // other files that have the next numbers
};

}  // namespace

decltype(Output::open) sequence_of(const OutputRequest& request, const PictureKind& kind) {
  return [pattern = FramePattern(request.name), kind, overwrite = request.overwrite,
          start_number = request.settings.start_number](const Opening& opening) {
    return std::make_unique<PictureSequence>(pattern, kind, opening, overwrite, start_number);
  };
}

}  // namespace piblocks
