// The manual page and what shells need to complete options, asked as these programs would.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

class ManualTest : public CliFixture {
 protected:
  /// What a command prints that complains of nothing.
  std::string shell(const std::string& command) {
    const std::string printed = CliFixture::shell(command + " 2>errors");
    EXPECT_EQ(contents("errors"), "");
    return printed;
  }

  /// What bash offers for the last of these words.
  std::string completed(const std::string& words) {
    write("piblocks.bash", output_of({"manual", "bash"}));
    write("ask.bash", "source ./piblocks.bash\nCOMP_WORDS=(" + words +
                          ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_piblocks\n"
                          "echo \"${COMPREPLY[*]}\"\n");
    return shell("bash -u ask.bash");
  }

  bool is_there(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
  }
};

TEST_F(ManualTest, TheManualPageHasEveryOption) {
  if (!is_there("groff")) GTEST_SKIP() << "groff is not installed";
  write("piblocks.1", output_of({"manual", "man"}));
  const std::string page = shell("groff -Kutf8 -man -ww -Tutf8 -P-cbou piblocks.1");
  for (const char* part :
       {"PIBLOCKS(1)", "piblocks render", "piblocks golden check", "--slow-motion", "turn-0.3",
        "--max-delta", "Example: piblocks render", "EXIT STATUS"}) {
    EXPECT_TRUE(contains(page, part));
  }
}

TEST_F(ManualTest, BashCompletesCommandsOptionsAndWords) {
  EXPECT_EQ(completed("piblocks s"), "still sheet state scenes\n");
  EXPECT_EQ(completed("piblocks golden ''"), "record check approve\n");
  EXPECT_EQ(completed("piblocks golden check --d"), "--dir --diff\n");
  EXPECT_EQ(completed("piblocks render a.toml --slow"), "--slow-motion\n");
  EXPECT_EQ(completed("piblocks still --theme c"), "chalkboard colorblind\n");
  EXPECT_EQ(completed("piblocks render -o ''"), "\n") << "names of files are left to bash";
}

TEST_F(ManualTest, BashCompletesNamesAndFilesOfScenes) {
  write("lecture-2.toml", "");
  for (const char* command : {"render", "still", "golden check", "scenes"}) {
    EXPECT_EQ(completed(std::string("piblocks ") + command + " lec"), "lecture-2.toml lecture\n");
  }
  EXPECT_EQ(completed("piblocks join lec"), "\n") << "parts are files";
}

TEST_F(ManualTest, ZshAndFishReadTheirs) {
  for (const std::string program : {"zsh", "fish"}) {
    const std::string text = output_of({"manual", program});
    EXPECT_TRUE(contains(text, "slow-motion"));
    EXPECT_TRUE(contains(text, "chalkboard dark"));
    EXPECT_TRUE(contains(text, "slow-turn stack storyboard"));
    write("completion", text);
    if (is_there(program)) shell(program + " -n completion");
  }
  if (is_there("fish")) {
    EXPECT_EQ(shell("fish -c 'source completion; complete -C \"piblocks golden \"'"),
              "approve\ncheck\nrecord\n");
    EXPECT_EQ(shell("fish -c 'source completion; complete -C \"piblocks still slow-\"'"),
              "slow-motion\nslow-turn\n");
  }
  if (!is_there("zsh") || !is_there("fish")) {
    GTEST_SKIP() << "zsh or fish is not installed: their syntax is not checked";
  }
}

TEST_F(ManualTest, OtherKindsAreRefused) {
  EXPECT_EQ(refusal({"manual", "tcsh"}),
            "piblocks: KIND tcsh: must be one of: man, bash, zsh, fish\n");
}

TEST_F(ManualTest, HelpIsACommandToo) {
  EXPECT_EQ(output_of({"help"}), output_of({"--help"}));
  EXPECT_EQ(output_of({"help", "golden", "check"}), output_of({"golden", "check", "--help"}));
  const std::string bare = refusal({});
  EXPECT_EQ(bare, output_of({"--help"}));
  EXPECT_TRUE(contains(bare, "Example: piblocks render --digits 3 -o pi-3.mp4"));
}

}  // namespace
}  // namespace piblocks
