// What tests of scene files share.
// In: a file's text. Out: what is read from it, or what is wrong with it.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/script.hpp>

#include <fstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace piblocks {

class FileFixture : public testing::Test {
 protected:
  Script script(const std::string& text) {
    std::ofstream(path_) << text;
    ScriptBuilder builder;
    builder.read_file(path_);
    return builder.build();
  }

  std::vector<std::string> problems(const std::string& text) {
    try {
      script(text);
    } catch (const SceneError& error) {
      return error.problems();
    }
    return {};
  }

  testing_support::TemporaryFolder folder_;
  std::string path_ = folder_ / "scene.toml";
};

}  // namespace piblocks
