// What tests of scene files share.
// In: a file's text. Out: what is read from it, or what is wrong with it.
#pragma once

#include <gtest/gtest.h>
#include <piblocks/error.hpp>

#include <fstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace piblocks {

/// @tparam Builder  SceneBuilder or ScriptBuilder.
template <typename Builder>
class FileFixture : public testing::Test {
 protected:
  auto load(const std::string& text) {
    std::ofstream(path_) << text;
    Builder builder;
    builder.read_file(path_);
    return builder.build();
  }

  std::vector<std::string> problems(const std::string& text) {
    try {
      load(text);
    } catch (const SceneError& error) {
      return error.problems();
    }
    return {};
  }

  testing_support::TemporaryFolder folder_;
  std::string path_ = folder_ / "scene.toml";
};

}  // namespace piblocks
