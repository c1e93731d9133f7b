// What the tests of faults share.
// In: a kind of output. Out: the command that writes it, small but of several chunks, and judgement
// of what a fault left in the folder.
#pragma once

#include <map>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/cli_fixture.hpp"

namespace piblocks {

struct OutputKind {
  std::string name;
  Arguments arguments;
  /// Whether what it writes passes through libraries that are known to bear no lack of memory.
  bool through_libraries = true;
};

inline std::ostream& operator<<(std::ostream& out, const OutputKind& kind) {
  return out << kind.name;
}

inline std::string name_of(const testing::TestParamInfo<OutputKind>& test) {
  return test.param.name;
}

inline Arguments small_render(const Arguments& output) {
  return Arguments{"render", "--quiet", "--size", "160x90", "--fps",
                   "12",     "--to",    "2",      "--jobs", "2"} +
         output;
}

/// Joins what FaultFixture::make_parts() made.
inline const OutputKind kJoin{
    "Join",
    {"join", "--quiet", "../in/a.mp4.part-1-of-2", "../in/a.mp4.part-2-of-2", "-o", "a.mp4"}};

inline std::vector<OutputKind> every_kind() {
  return {{"Mp4", small_render({"-o", "a.mp4"})},
          {"Mp4Sound", small_render({"--sound", "-o", "a.mp4"})},
          {"Webm", small_render({"--sound", "-o", "a.webm"})},
          {"Gif", small_render({"-o", "a.gif"})},
          {"Apng", small_render({"-o", "a.apng"})},
          {"Webp", small_render({"-o", "a.webp"})},
          {"Wav", small_render({"-o", "a.wav"})},
          {"Page", small_render({"-o", "a.html"})},
          {"Png", small_render({"-o", "%06d.png"})},
          {"Svg", small_render({"-o", "%06d.svg"})},
          {"Pdf", small_render({"-o", "a.pdf"})},
          {"Y4m", small_render({"-o", "a.y4m"})},
          {"Framehash", small_render({"-o", "a.framehash"})},
          {"Part", small_render({"--part", "1/2", "-o", "a.mp4"})},
          kJoin,
          {"StillPng", {"still", "--at", "3", "--size", "640x360", "-o", "a.png"}},
          {"StillSvg", {"still", "--at", "3", "--size", "640x360", "-o", "a.svg"}},
          {"StillPdf", {"still", "--at", "3", "--size", "640x360", "-o", "a.pdf"}},
          {"Sheet", {"sheet", "--frames", "2", "--size", "320x180", "-o", "a.pdf"}},
          {"LogCsv", {"log", "--digits", "3", "-o", "a.csv"}, false},
          {"LogNpy", {"log", "--digits", "3", "--format", "npy", "-o", "a.npy"}, false}};
}

/// The files below a folder and what is in them, a folder as "NAME/".
using Files = std::map<std::string, std::string>;

inline bool is_unfinished(std::string_view name) {
  return name.find(".unfinished-") != std::string_view::npos;
}

inline std::set<std::string> names(const Files& files) {
  std::set<std::string> names;
  for (const auto& [name, contents] : files) names.insert(name);
  return names;
}

/// The program runs in the folder out; in holds what it reads.
class FaultFixture : public testing::Test {
 protected:
  FaultFixture() {
    std::filesystem::create_directory(in());
    std::filesystem::create_directory(out());
  }

  std::filesystem::path in() const { return folder_.path() / "in"; }
  std::filesystem::path out() const { return folder_.path() / "out"; }

  CommandResult run(const Arguments& arguments, CommandOptions options = {}) const {
    options.folder = out();
    return testing_support::run_command(arguments, options);
  }

  Files files() const {
    namespace fs = std::filesystem;
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(out())) {
      const std::string name = entry.path().lexically_relative(out());
      if (entry.is_directory()) {
        files[name + '/'];
      } else {
        files[name] = file_contents(entry.path());
      }
    }
    return files;
  }
  /// The same without what is said to be unfinished.
  Files finished() const {
    Files found = files();
    std::erase_if(found, [](const auto& file) { return is_unfinished(file.first); });
    return found;
  }

  /// @param fault  as fault.c takes it; where a sanitizer leaves no room for that, the test is
  /// skipped.
  static CommandOptions with_fault([[maybe_unused]] const std::string& fault) {
#ifdef PIBLOCKS_FAULT
    return {.environment = { "LD_PRELOAD=" PIBLOCKS_FAULT, "PIBLOCKS_FAULT=" + fault }};
#else
    throw std::logic_error("no faults with a sanitizer");
#endif
  }

  /// What the command writes when nothing is in its way; the folder is empty again afterwards.
  Files undisturbed(const OutputKind& kind) const {
    if (kind.name == kJoin.name) make_parts();
    const CommandResult result = run(kind.arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const Files complete = files();
    EXPECT_FALSE(complete.empty());
    clear();
    return complete;
  }

  /// Files of the same names with other contents, which begin alike: the program knows its own by
  /// that.
  Files put_old_files(const Files& complete) const {
    for (const auto& [name, contents] : complete) {
      std::ofstream(out() / name, std::ios::binary) << contents.substr(0, 100) << "old " << name;
    }
    return files();
  }

  void clear() const {
    for (const auto& entry : std::filesystem::directory_iterator(out())) {
      std::filesystem::remove_all(entry.path());
    }
  }

 private:
  void make_parts() const {
    for (const char* part : {"1/2", "2/2"}) {
      const Arguments arguments = small_render({"--part", part, "-o", "a.mp4"});
      testing_support::run_command(arguments, {.folder = in()});
    }
  }

  TemporaryFolder folder_;
};

#ifdef PIBLOCKS_FAULT
constexpr bool kHasFaults = true;
#else
constexpr bool kHasFaults = false;
#endif

class EveryKindTest : public FaultFixture, public testing::WithParamInterface<OutputKind> {};

}  // namespace piblocks
