// What tests of `compare` share.
// In: arguments behind the command. Out: what it said.
#pragma once

#include "cli/cli_fixture.hpp"

namespace piblocks {

class CompareFixture : public CliFixture {
 protected:
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
