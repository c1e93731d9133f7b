// Names: what their endings mean, and what messages make of them.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

using NamesTest = CliFixture;

/// Whatever a scene file, a name or a file of hashes says to the terminal.
TEST_F(NamesTest, MessagesHaveNothingThatATerminalObeys) {
  write("scene.toml", "\"\\u001b]0;x\\u0007\" = 1\n[view]\nfps = \"\\u009b2J\"\n");
  write("a.framehash", "#\x1b[2J\n0,0,0,1,1,0\n");
  write("b.framehash", "#\x9b\n0,0,0,1,1,0\n");
  const std::string name = "x\x1b[31m\xff\xc2\x9b";
  for (const Arguments& arguments :
       {Arguments{"count", "scene.toml"}, Arguments{"count", name}, Arguments{"render", "-o", name},
        Arguments{name}, Arguments{"count", "--" + name},
        Arguments{"still", "--at", name, "-o", "a.png"},
        Arguments{"render", "--digits", "1", "--size", "64x36", "--fps", "1", "-o", name + ".gif"},
        Arguments{"render", "--theme", name, "-o", "null"},
        Arguments{"compare", "a.framehash", "b.framehash"}}) {
    const CommandResult result = piblocks(arguments);
    const std::string said = result.out + result.err;
    EXPECT_EQ(said.find_first_of("\x1b\x07\x9b\xff"), std::string::npos) << said;
    EXPECT_TRUE(contains(said, "\\x1b"));
  }
}

TEST_F(NamesTest, CapitalsMakeNoOtherKindOfFile) {
  const Arguments small{"--size", "64x36", "--to", "0.1", "--fps", "10", "--quiet", "-o"};
  for (const auto& [name, start] : {std::pair{"a.Y4M", "YUV4MPEG2"},
                                    {"%d.PNG", "\x89PNG"},
                                    {"a.FrameHash", "#format"},
                                    {"a.HTML", "<!DOCTYPE html>"}}) {
    output_of(Arguments{"render"} + small + Arguments{name});
    const std::string file = name == std::string("%d.PNG") ? "1.PNG" : name;
    EXPECT_TRUE(contents(file).starts_with(start)) << name;
  }
  output_of(Arguments{"render", "--for", "powerpoint"} + small + Arguments{"a.MP4"});
  EXPECT_EQ(contents("a.MP4").substr(4, 4), "ftyp");
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a.Png"});
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a.SVG"});
  output_of({"sheet", "--size", "64x36", "-o", "a.PDF"});
  EXPECT_TRUE(contents("a.Png").starts_with("\x89PNG"));
  EXPECT_TRUE(contents("a.SVG").starts_with("<?xml"));
  EXPECT_TRUE(contents("a.PDF").starts_with("%PDF"));
  EXPECT_EQ(piblocks({"compare", "a.Png", "a.Png"}).exit_code, 0);
  EXPECT_EQ(piblocks({"compare", "a.FrameHash", "a.FrameHash"}).exit_code, 0);
}

TEST_F(NamesTest, AnUnknownKindIsAnsweredByAllKinds) {
  for (const char* kind :
       {"*.mp4", "*.mov", "*.webm", "*.gif", "*.apng", "*.webp", "*.png", "*.svg", "*.pdf", "*.y4m",
        "- (", "*.framehash", "null", "*.wav", "*.html"}) {
    expect_refusal({"render", "-o", "a.xyz"}, kind);
  }
  for (const char* kind : {".png", ".svg", ".pdf", "- for PNG"}) {
    expect_refusal({"still", "--at", "1", "-o", "a.xyz"}, kind);
    expect_refusal({"sheet", "-o", "a.xyz"}, kind);
  }
}

}  // namespace
}  // namespace piblocks
