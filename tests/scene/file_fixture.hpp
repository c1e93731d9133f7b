// What tests of scene files share.
// In: a file's text. Out: what is read from it, or what is wrong with it.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <fstream>
#include <string>
#include <variant>
#include <vector>

#include "support/contains.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {

using testing_support::contains;

class FileFixture : public testing::Test {
 protected:
  Script script(const std::string& text) {
    std::ofstream(path_) << text;
    ScriptBuilder builder;
    builder.read_file(path_);
    return builder.build();
  }

  Scene load(const std::string& text) { return std::get<Scene>(script(text)); }

  /// What is wrong with a file, or with what a builder has read.
  std::vector<std::string> problems(const std::string& text) {
    return said_by([&] { script(text); });
  }
  static std::vector<std::string> problems(const ScriptBuilder& builder) {
    return said_by([&] { builder.build(); });
  }
  /// Expects one problem, whose line is "PATH:" and this.
  void expect_problem(const std::string& text, const std::string& line) {
    EXPECT_EQ(problems(text), std::vector<std::string>{path_ + ":" + line}) << text;
  }

  testing_support::TemporaryFolder folder_;
  std::string path_ = folder_ / "scene.toml";

 private:
  template <typename Action>
  static std::vector<std::string> said_by(const Action& action) {
    try {
      action();
    } catch (const SceneError& error) {
      return error.lines();
    }
    return {};
  }
};

}  // namespace piblocks
