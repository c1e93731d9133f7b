// What all groups of measurements work with.
// In: options. Out: commands run in an orderly place, and rows of the results.
#pragma once

#include <filesystem>
#include <string>

#include "circumstances.hpp"
#include "speed/process.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks::benchmark {

struct Workbench {
  Circumstances circumstances;
  std::string program;
  int rounds = 1;
  testing_support::TemporaryFolder folder{};
  ProcessRunner runner{folder.path()};

  /// A file that stays until the end.
  std::string kept(const std::string& name) const { return folder / name; }
  /// A file of the next run; the one after it has its place to itself.
  std::string output(const std::string& name) const { return folder.path() / "output" / name; }
  /// Moves out of the way what the last run has written. It is not removed yet: for some seconds
  /// ext4 does not use the inodes of removed files again, and looks long for others.
  void renew_output() const;
  void remove_outputs() const;
  /// Size of what the last run has written.
  double output_MB() const;

  /// "render" with the article's scene.
  Command render(int digits, const std::string& output) const;
  std::string program_version() const;
};

/// Nothing but encoding, by the settings that the program's libx264 has.
Command ffmpeg_ultrafast(const std::string& y4m, const std::string& output);

/// Frames of the article's scene.
/// @param to  as the option --to takes it.
std::int64_t article_frames(int digits, const std::string& to = "last+1.5", int frames_per_s = 60);

}  // namespace piblocks::benchmark
