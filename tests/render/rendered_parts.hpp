// Renderings without a report, and in parts.
// In: a job. Out: its files.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/render.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace piblocks {

inline Rendered render_silently(const RenderJob& job) {
  return render(job, [](const Progress&) {});
}

/// @returns the name of the part
inline std::string rendered_part(const Shard& part, RenderJob job) {
  job.shard = part;
  render_silently(job);
  return shard_name(job.output, part);
}

inline std::vector<std::string> rendered_parts(int count, const RenderJob& job) {
  std::vector<std::string> parts;
  for (int i = 1; i <= count; ++i) parts.push_back(rendered_part({i, count}, job));
  return parts;
}

/// Names and contents of the files in a folder.
inline std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    files[entry.path().filename()] = testing_support::file_contents(entry.path());
  }
  return files;
}

/// Expects the same file from one thread, from two, and joined from three parts.
inline void expect_equal_bytes(const Script& script, const testing_support::TemporaryFolder& folder,
                               const std::string& name) {
  const Rendered whole = render_silently({script, folder / name, {}, 1});
  render_silently({script, folder / ("two-" + name), {}, 2});
  const auto parts = rendered_parts(3, {script, folder / ("part-" + name)});
  EXPECT_EQ(join(parts, folder / ("joined-" + name)).frame_count, whole.frame_count) << name;
  for (const std::string other : {"two-", "joined-"}) {
    const bool is_equal = testing_support::file_contents(folder / name) ==
                          testing_support::file_contents(folder / (other + name));
    EXPECT_TRUE(is_equal) << other << name;
  }
}

}  // namespace piblocks
