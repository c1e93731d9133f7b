// What tests of `compare` share.
// In: arguments behind the command. Out: what it said. Small pictures to compare.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/cli_fixture.hpp"
#include "support/hand_made_png.hpp"

namespace piblocks {

/// A pixel of a picture.
struct Spot {
  int x_px;
  int y_px;
  int level;  ///< of red, green and blue
};

class CompareFixture : public CliFixture {
 protected:
  /// Grey but for some pixels, in RGB and 10 pixels high. Missing folders are made.
  void write_grey(const std::string& name, int level, const std::vector<Spot>& spots = {},
                  int width_px = 10) const {
    testing_support::HandMadePng png{.width_px = width_px, .height_px = 10};
    png.levels.assign(std::size_t(width_px) * 10 * 3, level);
    for (const Spot& spot : spots) {
      for (int i = 0; i < 3; ++i) {
        png.levels.at(std::size_t((spot.y_px * width_px + spot.x_px) * 3 + i)) = spot.level;
      }
    }
    std::filesystem::create_directories(std::filesystem::path(folder_ / name).parent_path());
    write(name, testing_support::file_of(png));
  }
  CommandResult compare(const Arguments& arguments) const {
    return piblocks(Arguments{"compare"} + arguments);
  }
  /// The only line of complaint.
  std::string complaint(const Arguments& arguments, int exit_code) const {
    const CommandResult result = compare(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.out;
    EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
    return result.err;
  }
  /// What cannot be read.
  void expect_complaint(const Arguments& arguments, const std::string& what) const {
    const std::string said = complaint(arguments, 5);
    EXPECT_TRUE(contains(said, what));
  }
  /// In the test's folder, if ffmpeg is there.
  bool ffmpeg(const std::string& options) const {
    return shell("ffmpeg -nostdin -loglevel error -y " + options + " && echo done || true") ==
           "done\n";
  }
};

}  // namespace piblocks
