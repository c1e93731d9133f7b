// How arguments are read, for every option of every command: what is a value, and what is not.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

struct Option {
  Arguments command;  ///< {"golden", "check"}
  std::string name;   ///< "--dir"
  bool takes_value;
};

/// As the program itself tells a shell: "complete -c piblocks -n '… CMD' -l dir -r -d '…'".
std::vector<Option> all_options() {
  std::vector<Option> options;
  const std::string manual = testing_support::run_command({"manual", "fish"}).out;
  for (const std::string& line : lines(manual)) {
    const std::size_t name = line.find(" -l ");
    if (name == std::string::npos) continue;
    Option option;
    const std::string seen = "__fish_seen_subcommand_from ";
    for (std::size_t at = 0; (at = line.find(seen, at)) < name;) {
      at += seen.size();
      option.command.push_back(line.substr(at, line.find_first_of(";'", at) - at));
    }
    const auto rest = split(line.substr(name + 4), ' ');
    option.name = "--" + rest.at(0);
    option.takes_value = rest.at(1) == "-r";
    options.push_back(option);
  }
  return options;
}

using ArgumentsTest = CliFixture;

TEST_F(ArgumentsTest, AnOptionTakesOneValueAndNoMore) {
  const auto options = all_options();
  EXPECT_GT(options.size(), 150U);
  for (const auto& [command, name, takes_value] : options) {
    SCOPED_TRACE(testing::PrintToString(command) + name);
    const auto said = [&](const Arguments& more) { return refusal(command + more); };
    if (!takes_value) {
      if (name == "--help" || name == "--version") continue;
      EXPECT_TRUE(contains(said({name + "=", "--none"}), name + " takes no value"));
      continue;
    }
    // A text may be empty; an empty value is never replaced by the argument behind it.
    const std::string empty = said({name + "=", "--none"});
    EXPECT_TRUE(empty.find("unknown option '--none'") != std::string::npos ||
                empty.starts_with("piblocks: " + name + " needs a value, and this one is empty: "))
        << empty;
    EXPECT_EQ(said({name, "", "--none"}), empty);
    EXPECT_TRUE(contains(said({name + "=-x", "--none"}), "unknown option '--none'"));
  }
}

/// Most likely its value is a variable that is not set.
TEST_F(ArgumentsTest, AnOptionIsNotTheValueOfAnother) {
  const Arguments still{"still", "--at", "1"};
  EXPECT_EQ(refusal(still + Arguments{"--title", "--transparent", "-o", "a.png"}),
            "piblocks: --title needs a value, and '--transparent' follows; if that is the value, "
            "write '--title=--transparent'\n");
  expect_refusal(still + Arguments{"--title", "-o", "a.png"}, "and '-o' follows");
  expect_refusal({"count", "--to", "--", "3"}, "and '--' follows");
  EXPECT_EQ(refusal({"count", "--digits"}), "piblocks: --digits needs a value: --digits D\n");
}

TEST_F(ArgumentsTest, AValueMayBeginWithADash) {
  EXPECT_EQ(json_value(output_of({"state", "--at", "-1"}), {"time"}), "-1");
  EXPECT_EQ(output_of({"state", "--at", "-1"}), output_of({"state", "--at=-1"}));
  const Arguments still{"still", "--at", "1", "--size", "320x180"};
  output_of(still + Arguments{"--title", "-x", "-o", "a.svg"});
  output_of(still + Arguments{"--title=-x", "-ob.svg"});
  output_of(still + Arguments{"--title=--x", "-o=c.svg"});
  output_of(still + Arguments{"--title", "", "-od.svg"});
  output_of(still + Arguments{"--output=e.svg"});
  EXPECT_EQ(contents("a.svg"), contents("b.svg"));
  EXPECT_NE(contents("a.svg"), contents("c.svg"));
  EXPECT_NE(contents("a.svg"), contents("d.svg"));
  EXPECT_EQ(contents("d.svg"), contents("e.svg")) << "an empty title is no title";
}

TEST_F(ArgumentsTest, TwoDashesEndTheOptions) {
  write("-3", "digits = 2\n");
  write("++", "digits = 2\n");
  EXPECT_EQ(output_of({"count", "--", "-3"}), "31\n");
  EXPECT_EQ(output_of({"count", "--digits", "1", "--"}), "3\n");
  EXPECT_EQ(output_of({"count", "++"}), "31\n");
  expect_refusal({"count", "--", "--digits", "1"}, "unexpected argument '1'");
  expect_refusal({"count", "-3"}, "unknown option '-3'");
  expect_refusal({"join", "[a,b]", "-o", "a.mp4"}, "'[a,b]'");
}

TEST_F(ArgumentsTest, AnEmptyArgumentIsNoName) {
  EXPECT_EQ(refusal({"render", "", "-o", "a.mp4"}), "piblocks: render: SCENE is empty\n");
  EXPECT_EQ(refusal({"compare", "a.png", ""}), "piblocks: compare: ACTUAL is empty\n");
  EXPECT_EQ(refusal({"golden", "check", "a.toml", "", "--dir", "d"}),
            "piblocks: golden check: SCENE is empty\n");
  expect_refusal({""}, "unknown command ''");
}

TEST_F(ArgumentsTest, HelpIsPrintedWhateverElseIsSaid) {
  const std::string help = output_of({"count", "--help"});
  for (const Arguments& arguments :
       {Arguments{"help", "count"}, Arguments{"help", "count", "--", "--digits", "1"},
        Arguments{"count", "--none", "-h"}, Arguments{"count", "--digits", "-h"},
        Arguments{"count", "a.toml", "b.toml", "--help"}}) {
    EXPECT_EQ(output_of(arguments), help) << arguments.back();
  }
  EXPECT_TRUE(contains(output_of({"golden", "check", "-h"}), "Usage: piblocks golden check SCENE"));
  expect_refusal({"cuont", "--help"}, "did you mean 'count'?");
  expect_refusal({"count", "--", "--help"}, "cannot read '--help'");
}

/// Options do not stand before their command; what is told first is told.
TEST_F(ArgumentsTest, TheFirstProblemIsTold) {
  expect_refusal({"--digits", "3", "count"}, "unknown option '--digits'");
  expect_refusal({"--quiet", "render", "-o", "a.mp4"}, "unknown option '--quiet'");
  expect_refusal({"still", "-at", "1"}, "'-at'; did you mean '--at'?");
  expect_refusal({"still", "-output", "a.png"}, "did you mean '--output'?");
  EXPECT_EQ(refusal({"count", "--dig", "3"}),
            "piblocks: count: unknown option '--dig'; did you mean '--digits'? see 'piblocks count "
            "--help'\n");
}

/// Dashes that an editor has made longer, and a ~ that no shell has replaced.
TEST_F(ArgumentsTest, WhatLooksLikeAnOptionOrAPathIsNotTakenForAFile) {
  for (const char* option : {"\u2013digits", "\u2014digits", "\u2212digits"}) {
    EXPECT_EQ(refusal({"count", option, "3"}),
              "piblocks: unknown option '" + std::string(option) +
                  "', which begins with another character than '-'; did you mean '--digits'?\n");
  }
  expect_refusal({"render", "\u2013outptu=a.mp4"}, "did you mean '--output'?");
  EXPECT_EQ(refusal({"render", "--output=~/a.mp4"}),
            "piblocks: --output: the shell has not replaced the ~ of '~/a.mp4'; write '--output "
            "~/a.mp4' without quotes, or './~/a.mp4' for a folder of this name\n");
  expect_refusal({"golden", "record", "article", "--dir=~"}, "the ~ of '~'");
  output_of({"still", "--at", "1", "--size", "320x180", "--title", "~/", "-o", "~a.svg"});
  EXPECT_EQ(entries(), Arguments{"~a.svg"});
}

TEST_F(ArgumentsTest, LongArgumentsMakeShortMessages) {
  const std::string long_word(100'000, 'x');
  for (const Arguments& arguments :
       {Arguments{long_word}, Arguments{"count", "--" + long_word}, Arguments{"count", long_word},
        Arguments{"count", "--digits", long_word}, Arguments{"log", "--format", long_word},
        Arguments{"render", "-o", long_word}, Arguments{"state", "--at", long_word}}) {
    EXPECT_LT(refusal(arguments).size(), 1000U) << arguments.front();
  }
}

TEST_F(ArgumentsTest, ASceneMayComeFromStandardInput) {
  write("scene.toml", "digits = 2\nview.size = '64x36'\ntime.to = 1\n");
  const auto from_input = [&](const Arguments& arguments) {
    return piblocks(arguments, {.in_file = folder_ / "scene.toml"});
  };
  EXPECT_EQ(from_input({"count", "-"}).out, "31\n");
  EXPECT_EQ(from_input({"log", "-"}).out, output_of({"log", "scene.toml"}));
  EXPECT_EQ(from_input({"state", "-", "--at", "1"}).out,
            output_of({"state", "scene.toml", "--at", "1"}));
  EXPECT_EQ(from_input({"render", "-", "--quiet", "-o", "-"}).out,
            output_of({"render", "scene.toml", "--quiet", "-o", "-"}));
  EXPECT_EQ(from_input({"golden", "check", "-", "--dir", "d"}).err,
            "piblocks: scene: cannot read '-': a file or a name is needed here, not standard "
            "input\n");
  write("scene.toml", "digits = 2\nviev.size = '64x36'\n");
  EXPECT_EQ(from_input({"count", "-"}).err,
            "piblocks: standard input:2: viev.size: unknown key; did you mean 'view.size'?\n");
  EXPECT_EQ(refusal({"count", "-"}),
            "piblocks: scene: standard input is empty; leave '-' out for the default scene\n");
  write("scene.toml", std::string(1048577, '#'));
  EXPECT_TRUE(
      contains(from_input({"count", "-"}).err, "'standard input' is longer than 1048576 bytes"));
}

}  // namespace
}  // namespace piblocks
