// What tests of the program share.
// In: arguments. Out: what the program said, in pieces, and what it left in its folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "support/contains.hpp"
#include "support/run_command.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {

using testing_support::CommandOptions;
using testing_support::CommandResult;
using testing_support::contains;
using testing_support::file_contents;
using testing_support::RunningCommand;
using testing_support::TemporaryFolder;
using testing_support::wait_until;

using Arguments = std::vector<std::string>;
using Names = std::vector<std::string>;

inline Arguments operator+(Arguments left, const Arguments& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// Each test has an empty folder, in which the program runs.
class CliFixture : public testing::Test {
 protected:
  CommandResult piblocks(const Arguments& arguments, CommandOptions options = {}) const {
    options.folder = folder_.path();
    return testing_support::run_command(arguments, options);
  }
  /// What the program prints when all is well. It may have a note about the scene.
  std::string output_of(const Arguments& arguments) const {
    const CommandResult result = piblocks(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(result.err.empty() || result.err.starts_with("piblocks: note: ")) << result.err;
    return result.out;
  }
  /// The message of a command that fails with this exit code. It changes nothing in the folder.
  std::string refusal(const Arguments& arguments, int exit_code = 2) const {
    const Names before = entries();
    const CommandResult result = piblocks(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << testing::PrintToString(arguments);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(entries(), before);
    return result.err;
  }
  void expect_refusal(const Arguments& arguments, const std::string& message) const {
    EXPECT_TRUE(contains(refusal(arguments), message));
  }
  /// What a shell's command prints, in the test's folder.
  std::string shell(const std::string& command) const {
    const std::string all = "cd '" + folder_.path().string() + "' && { " + command + "; } >printed";
    EXPECT_EQ(std::system(all.c_str()), 0) << command;
    return contents("printed");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string contents(const std::string& name) const { return file_contents(folder_ / name); }
  /// Everything in the folder, sorted, folders included.
  Names entries() const {
    Names names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path())) {
      names.push_back(entry.path().lexically_relative(folder_.path()));
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  /// The names of what is in a folder, sorted.
  Names names_in(const std::string& folder) const {
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder)) {
      names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
  }

  TemporaryFolder folder_;
};

inline std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> pieces;
  std::istringstream in(text);
  for (std::string piece; std::getline(in, piece, separator);) pieces.push_back(piece);
  return pieces;
}

inline std::vector<std::string> lines(const std::string& text) { return split(text, '\n'); }

/// The first column of CSV text.
inline std::vector<std::string> indices(const std::string& csv) {
  std::vector<std::string> found;
  for (const std::string& line : lines(csv)) found.push_back(split(line, ',').front());
  found.erase(found.begin());  // the header
  return found;
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

/// The text of the value at a path such as {"blue", "position"} of a JSON object that has no
/// lists and no blanks; strings without their quotes.
inline std::string json_value(const std::string& object, const std::vector<std::string>& path) {
  std::size_t at = 0;
  for (const std::string& key : path) {
    const std::string quoted = '"' + key + "\":";
    at = object.find(quoted, at);
    if (at == std::string::npos) return "no " + key;
    at += quoted.size();
  }
  const std::string value = object.substr(at, object.find_first_of(",}", at) - at);
  return value.starts_with('"') ? value.substr(1, value.size() - 2) : value;
}

inline double json_number(const std::string& object, const std::vector<std::string>& path) {
  return std::stod(json_value(object, path));
}

}  // namespace piblocks
