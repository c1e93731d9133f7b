// What tests of scenes with bodies share.
// In: nothing. Out: a folder with three scenes, the names of those of the program.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/cli_fixture.hpp"
#include "support/uncertain_discs.hpp"

namespace piblocks {

/// Two blocks meet at time 3; at 47 the first meets the third, and all is over.
inline constexpr const char* kMeeting = R"(
[[body]]
position = 0
velocity = 1
[[body]]
mass = 3
position = 4
[[body]]
position = -20
)";

inline constexpr const char* kClosedBox = R"(
[box]
x = [0, 10]
[[body]]
position = 1
velocity = 1
[[body]]
mass = 2
position = 3
[[body]]
mass = 3
position = 5
)";

/// Scenes of the program whose collisions end, or whose film does.
inline constexpr std::array kBodyScenes{"three-blocks", "two-walls", "row",      "cradle",
                                        "superball",    "gas",       "billiard", "brownian",
                                        "wedge",        "touch"};

class BodiesCli : public CliFixture {
 protected:
  void SetUp() override {
    write("meeting.toml", kMeeting);
    write("endless.toml", kClosedBox);
    write("uncertain.toml", testing_support::uncertain_discs());
  }
  void expect_line(const Arguments& arguments, const std::string& line) const {
    EXPECT_EQ(refusal(arguments), "piblocks: " + line + "\n");
  }
  std::string first_line_of(const Arguments& arguments) const {
    return lines(output_of(arguments)).front();
  }
};

}  // namespace piblocks
