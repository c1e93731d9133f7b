// What tests of scene files with bodies share.
// In: a file's text. Out: the scene, or its one problem.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "scene/file_fixture.hpp"

namespace piblocks {

class BodiesFile : public FileFixture {
 protected:
  Scene load(const std::string& text) { return std::get<Scene>(script(text)); }

  /// Expects one problem, whose line is "PATH:" and this.
  void expect_problem(const std::string& text, const std::string& line) {
    const std::vector<std::string> found = problems(text);
    ASSERT_EQ(found.size(), 1U) << text << (found.empty() ? "" : "\n" + found.back());
    EXPECT_EQ(found.front(), path_ + ":" + line) << text;
    EXPECT_EQ(found.front().find('\n'), std::string::npos);
  }
};

}  // namespace piblocks
