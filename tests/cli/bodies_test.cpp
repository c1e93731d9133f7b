// Scenes with bodies, from outside: every command prints, draws or refuses them.
#include <fmt/format.h>
#include <piblocks/exact.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

/// Two blocks meet at time 3; at 47 the first meets the third, and all is over.
constexpr const char* kMeeting = R"(
[[body]]
position = 0
velocity = 1
[[body]]
mass = 3
position = 4
[[body]]
position = -20
)";

constexpr const char* kEndless = R"(
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

/// Three discs whose order of collisions double precision knows for a while only.
constexpr const char* kUncertain = R"(
[box]
x = [0, 4]
y = [0, 3]
[[body]]
position = [1, 1]
velocity = [1, 0.7]
radius = 0.5
[[body]]
position = [3, 1.2]
velocity = [-1, 0.3]
radius = 0.6
[[body]]
position = [2, 2.4]
velocity = [0.2, -0.9]
radius = 0.4
[time]
to = 200
)";

constexpr std::array kScenes{"three-blocks", "two-walls", "row",  "cradle",
                             "superball",    "recoil",    "gas",  "billiard",
                             "brownian",     "wedge",     "touch"};

class BodiesCli : public CliFixture {
 protected:
  void SetUp() override {
    write("meeting.toml", kMeeting);
    write("endless.toml", kEndless);
    write("uncertain.toml", kUncertain);
  }
  /// One line, and nothing written.
  void expect_line(const Arguments& arguments, const std::string& line) const {
    const std::vector<std::string> before = entries();
    const CommandResult result = piblocks(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "piblocks: " + line + "\n");
    EXPECT_EQ(entries(), before);
  }
  bool python(const std::string& interpreter, const std::string& program) const {
    write("program.py", program);
    const std::string command = fmt::format("cd '{}' && {} program.py >python.txt 2>&1",
                                            folder_.path().string(), interpreter);
    return std::system(command.c_str()) == 0;
  }
  /// A Python that has this module; empty if there is none.
  std::string python_with(const std::string& module) const {
    for (const char* interpreter : {"python3", "/usr/bin/python3"}) {
      if (python(interpreter, "import " + module)) return interpreter;
    }
    return {};
  }
  std::string first_line_of(const Arguments& arguments) const {
    return lines(output_of(arguments)).front();
  }
};

TEST_F(BodiesCli, LogsOfBlocksAreExact) {
  EXPECT_EQ(output_of({"log", "meeting.toml"}),
            "index,time,first,second,x_first,x_second,v_first,v_second\n"
            "1,3,1,2,3,4,-0.5,0.5\n"
            "2,47,1,3,-19,-20,0,-0.5\n");
}

TEST_F(BodiesCli, LogsOfDiscsHaveTwoCoordinates) {
  write("discs.toml",
        "[box]\nx = ['-inf', 8]\ny = [-3, 'inf']\n"
        "[[body]]\nposition = [0, 0]\nvelocity = [1, 0]\n"
        "[[body]]\nmass = 3\nposition = [4, 0]\n"
        "[[body]]\nposition = [-4, -1]\nvelocity = [0, -1]\n[time]\nto = 7\n");
  EXPECT_EQ(output_of({"log", "discs.toml"}),
            "index,time,first,second,x_first,y_first,x_second,y_second,vx_first,vy_first,"
            "vx_second,vy_second\n"
            "1,1,3,lower,-4,-2,0,-3,0,1,0,0\n"
            "2,2,1,2,2,0,4,0,-0.5,0,0.5,0\n"
            "3,8,2,right,7,0,8,0,-0.5,0,0,0\n");
}

TEST_F(BodiesCli, CountsAreThoseOfTheLog) {
  for (const char* scene : kScenes) {
    const auto rows = lines(output_of({"log", scene}));
    EXPECT_EQ(first_line_of({"count", scene}), std::to_string(rows.size() - 1)) << scene;
    ASSERT_GT(rows.size(), 1U) << scene;
    double before = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const auto fields = split(rows[i], ',');
      ASSERT_EQ(fields[0], std::to_string(i)) << scene;
      ASSERT_GE(std::stod(fields[1]), before) << scene;
      before = std::stod(fields[1]);
    }
  }
}

TEST_F(BodiesCli, CountsOfEndlessRunsNeedATime) {
  expect_line(
      {"count", "endless.toml"},
      "time.to: bodies between walls may collide for ever; say until when, as time.to = 10");
  for (const char* to : {"1", "5", "50", "1/3"}) {
    const auto rows = lines(output_of({"log", "endless.toml", "--to", to}));
    EXPECT_EQ(first_line_of({"count", "endless.toml", "--to", to}),
              std::to_string(rows.size() - 1));
  }
  expect_line({"count", "endless.toml", "--to=-3"},
              "--to: time.to = -3: must be after time.from = 0");
}

/// Equal blocks exchange velocities: each line is met by one that runs through them.
TEST_F(BodiesCli, CountsOfEqualBlocksAreKnown) {
  write("equal.toml",
        "[box]\nx = [0, 10]\n[[body]]\nposition = 0.5\nvelocity = 1\n[[body]]\nposition = 4.5\n"
        "[[body]]\nposition = 7.5\n[[body]]\nposition = 9.5\n");
  // Without their widths they are points at 0, 3, 5 and 6 of 6; in 12 the moving one runs there and
  // back, and at 6 meets the last, the wall, and the last again.
  for (const std::string to : {"2.99", "3", "5", "6", "6.99", "7", "9", "12", "119.5", "1200"}) {
    const std::string found = first_line_of({"count", "equal.toml", "--to", to});
    const double rounds = std::floor(std::stod(to) / 12);
    const double rest = std::stod(to) - 12 * rounds;
    int expected = static_cast<int>(8 * rounds);
    for (const double hit : {3.0, 5.0, 6.0, 6.0, 6.0, 7.0, 9.0}) expected += hit <= rest ? 1 : 0;
    EXPECT_EQ(found, std::to_string(expected)) << to;
  }
}

TEST_F(BodiesCli, StatesAreExactAndInOrder) {
  EXPECT_EQ(output_of({"state", "meeting.toml", "--at", "0,3,5,last"}),
            R"({"time":0,"collisions":"0","bodies":[{"position":0,"velocity":1},)"
            R"({"position":4,"velocity":0},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":3,"collisions":"1","bodies":[{"position":3,"velocity":-0.5},)"
            R"({"position":4,"velocity":0.5},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":5,"collisions":"1","bodies":[{"position":2,"velocity":-0.5},)"
            R"({"position":5,"velocity":0.5},{"position":-20,"velocity":0}]})"
            "\n"
            R"({"time":47,"collisions":"2","bodies":[{"position":-19,"velocity":0},)"
            R"({"position":26,"velocity":0.5},{"position":-20,"velocity":-0.5}]})"
            "\n");
  expect_line({"state", "meeting.toml", "--at=-1"},
              "time -1: the motion of bodies begins at time 0; give a later time");
  expect_line(
      {"state", "meeting.toml", "--at", "turn"},
      "'turn': there is no turn; only two blocks beside a wall have one, if they move; give "
      "a time");
  expect_line({"state", "meeting.toml", "--at", "#3"},
              "collision #3: the scene has collisions #1 to #2");
}

TEST_F(BodiesCli, StatesAreJson) {
  const std::string interpreter = python_with("json");
  if (interpreter.empty()) GTEST_SKIP() << "no python3 here";
  for (const char* scene : kScenes) {
    output_of({"log", scene, "--format", "jsonl", "-o", "log.jsonl"});
    output_of({"log", scene, "-o", "log.csv"});
    write("state.json", output_of({"state", scene, "--at", "0,1,last"}));
    EXPECT_TRUE(python(interpreter, R"(
import csv, json
log = [json.loads(line) for line in open('log.jsonl')]
rows = list(csv.DictReader(open('log.csv')))
states = [json.loads(line) for line in open('state.json')]
assert len(log) == len(rows) and len(states) == 3
assert len({len(state['bodies']) for state in states}) == 1
def flat(value):
    return value if isinstance(value, list) else [value]
for row, line in zip(rows, log):
    assert row['index'] == line['index'] and float(row['time']) == line['time'], row
    assert row['first'] == str(line['first']) and row['second'] == str(line['second']), row
    for side in ('first', 'second'):
        motion = line[side + '_after']
        names = ['x_', 'y_'] if 'y_first' in row else ['x_']
        assert [float(row[name + side]) for name in names] == flat(motion['position']), row
        names = ['vx_', 'vy_'] if 'y_first' in row else ['v_']
        assert [float(row[name + side]) for name in names] == flat(motion['velocity']), row
last = states[-1]
assert last['collisions'] == log[-1]['index'] and last['time'] == log[-1]['time']
def near(a, b):
    return all(abs(x - y) < 1e-9 for x, y in zip(flat(a), flat(b), strict=True))
# The bodies are in the order of the file: the last collision is found by its numbers.
for side in ('first', 'second'):
    if isinstance(log[-1][side], int):
        body = last['bodies'][log[-1][side] - 1]
        for name in ('position', 'velocity'):
            assert near(body[name], log[-1][side + '_after'][name]), (body, log[-1])
)")) << scene
     << ": " << contents("python.txt");
  }
}

TEST_F(BodiesCli, NumpyLoadsWhatCsvSays) {
  const std::string interpreter = python_with("numpy");
  if (interpreter.empty()) GTEST_SKIP() << "no python3 with numpy here";
  for (const char* scene : {"three-blocks", "recoil", "billiard", "wedge"}) {
    output_of({"log", scene, "--format", "npy", "-o", "log.npy"});
    output_of({"log", scene, "-o", "log.csv"});
    EXPECT_TRUE(python(interpreter, R"(
import csv, numpy
log = numpy.load('log.npy')
rows = list(csv.DictReader(open('log.csv')))
assert log.shape == (len(rows),) and len(rows) > 20
walls = {}
for row, line in zip(rows, log):
    assert int(row['index']) == line['index'] and float(row['time']) == line['time'], row
    assert abs(line['time_low']) <= numpy.spacing(line['time']), row
    assert int(row['first']) == line['first'], row
    if row['second'].isdigit():
        assert int(row['second']) == line['second'], row
    else:
        assert line['second'] < 0 and walls.setdefault(row['second'], line['second']) == line['second']
    for side in ('first', 'second'):
        if 'y_first' in row:
            assert (line['x_' + side] == [float(row['x_' + side]), float(row['y_' + side])]).all()
            assert (line['v_' + side] == [float(row['vx_' + side]), float(row['vy_' + side])]).all()
        else:
            assert line['x_' + side] == float(row['x_' + side])
            assert line['v_' + side] == float(row['v_' + side])
order = [name for name in ('left', 'right', 'lower', 'upper', 'slanted-1', 'slanted-2') if name in walls]
assert [walls[name] for name in order] == [-1 - k for k in range(len(order))], walls
)")) << scene
     << ": " << contents("python.txt");
  }
  output_of({"log", "billiard", "--to=-1", "--format", "npy", "-o", "log.npy"});
  EXPECT_TRUE(python(interpreter, "import numpy\nassert numpy.load('log.npy').shape == (0,)"));
}

TEST_F(BodiesCli, RowsAreSelected) {
  using Rows = std::vector<std::string>;
  const auto rows = [&](const Arguments& selection) {
    Rows found;
    for (const std::string& line : lines(output_of(Arguments{"log"} + selection))) {
      found.push_back(split(line, ',').front());
    }
    found.erase(found.begin());
    return found;
  };
  EXPECT_EQ(rows({"meeting.toml", "--from", "3"}), (Rows{"1", "2"}));
  EXPECT_EQ(rows({"meeting.toml", "--from", "3.0000001"}), (Rows{"2"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "47"}), (Rows{"1", "2"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "#1"}), (Rows{"1"}));
  EXPECT_EQ(rows({"meeting.toml", "--to", "2"}), Rows());
  EXPECT_EQ(rows({"meeting.toml", "--first", "2"}), (Rows{"2"}));
  EXPECT_EQ(rows({"three-blocks", "--first", "3", "--limit", "2"}), (Rows{"3", "4"}));
  EXPECT_EQ(rows({"three-blocks", "--limit", "1"}), (Rows{"1"}));
  EXPECT_EQ(rows({"three-blocks", "--from", "last"}), (Rows{"47"}));
  EXPECT_EQ(rows({"billiard", "--from", "#7", "--to", "#9"}), (Rows{"7", "8", "9"}));
  EXPECT_EQ(rows({"three-blocks", "--to", "2.1973684210526"}), (Rows{"1"}));
}

TEST_F(BodiesCli, ComputesFurtherThanTheFilmIfAskedTo) {
  const auto rows = lines(output_of({"log", "two-walls", "--to", "60"}));
  EXPECT_GT(std::stod(split(rows.back(), ',')[1]), 59);
  EXPECT_NE(output_of({"state", "two-walls", "--at", "60"})
                .find(fmt::format("\"collisions\":\"{}\"", rows.size() - 1)),
            std::string::npos);
}

TEST_F(BodiesCli, WhatIsForTwoBlocksIsRefused) {
  const std::string why = ": is for two blocks and a wall, and this scene has [[body]]";
  expect_line({"log", "meeting.toml", "--engine", "events"}, "--engine" + why);
  expect_line({"state", "meeting.toml", "--at", "1", "--engine", "velocities"}, "--engine" + why);
  expect_line({"state", "meeting.toml", "--at", "1", "--bounds"}, "--bounds" + why);
  expect_line({"count", "meeting.toml", "--digits", "3"},
              "--digits: digits: this scene has [[body]] instead of blue, red and the wall");
  expect_line(
      {"still", "meeting.toml", "--at", "1", "--shutter", "1/2", "-o", "a.png"},
      "--shutter: view.shutter motion blur is for two blocks and a wall, and this scene has "
      "[[body]]");
  EXPECT_EQ(entries(),
            (std::vector<std::string>{"endless.toml", "meeting.toml", "uncertain.toml"}));
}

TEST_F(BodiesCli, PagesAndBundlesSayWhatMovesAndHowOftenItMeets) {
  output_of({"render", "endless.toml", "--size", "64x64", "--fps", "5", "--quiet", "--to", "3",
             "-o", "a.html"});
  const std::string page = contents("a.html");
  EXPECT_NE(page.find("without friction"), std::string::npos);
  EXPECT_EQ(page.find("which is all there are"), std::string::npos);
  output_of({"render", "meeting.toml", "--size", "64x64", "--fps", "5", "--quiet", "-o", "a.mp4",
             "--bundle", "talk"});
  const std::string captions = contents("talk/captions.vtt");
  EXPECT_TRUE(captions.starts_with("WEBVTT")) << captions;
  EXPECT_NE(captions.find("which is all there are"), std::string::npos) << captions;
}

TEST_F(BodiesCli, WhatIsNotCertainIsRefusedWithItsTime) {
  const Arguments small{"--size", "320x180", "--fps", "10", "--quiet", "-o", "a.mp4"};
  const CommandResult result = piblocks({"count", "uncertain.toml"});
  EXPECT_EQ(result.exit_code, 2);
  ASSERT_EQ(lines(result.err).size(), 1U) << result.err;
  const std::string before = "certain until time ";
  const std::size_t at = result.err.find(before);
  ASSERT_NE(at, std::string::npos) << result.err;
  const double until = std::stod(result.err.substr(at + before.size()));
  EXPECT_GT(until, 1);
  EXPECT_LT(until, 200);
  for (const Arguments& command :
       {Arguments{"log", "uncertain.toml"}, Arguments{"render", "uncertain.toml"} + small,
        Arguments{"still", "uncertain.toml", "--at", "150", "-o", "a.png"},
        Arguments{"sheet", "uncertain.toml", "-o", "a.pdf"},
        Arguments{"state", "uncertain.toml", "--at", "150"}}) {
    const CommandResult same = piblocks(command);
    EXPECT_EQ(same.exit_code, 2) << command.front();
    EXPECT_EQ(lines(same.err).size(), 1U) << same.err;
    EXPECT_NE(same.err.find(fmt::format("{}{:.6g} only", before, until)), std::string::npos)
        << same.err;
    EXPECT_EQ(entries().size(), 3U) << "nothing is written";
  }
  // What the message advises.
  const std::string to = "as time.to = ";
  const std::string advised =
      split(result.err.substr(result.err.find(to) + to.size()), ',').front();
  const std::string count = first_line_of({"count", "uncertain.toml", "--to", advised});
  EXPECT_GT(std::stoi(first_line_of({"count", "uncertain.toml", "--allow-uncertain"})),
            std::stoi(count));
  EXPECT_NE(output_of({"state", "uncertain.toml", "--at", advised}).find('"' + count + '"'),
            std::string::npos)
      << "before it, all is certain";
  output_of(Arguments{"render", "uncertain.toml", "--to", "2"} + small);
  output_of({"still", "uncertain.toml", "--at", "150", "--allow-uncertain", "--size", "320x180",
             "-o", "a.png"});
  output_of({"state", "uncertain.toml", "--at", "150", "--allow-uncertain"});
}

/// The least restitution lies between numbers that differ in the last printed digit.
TEST_F(BodiesCli, NeedIsWhatCountNeeds) {
  const auto count_with = [&](int digits, const Rational& restitution) {
    write("lossy.toml", fmt::format("digits = {}\n[blocks]\nrestitution = '{}'\n[wall]\n"
                                    "restitution = '{}'\n",
                                    digits, restitution.get_str(), restitution.get_str()));
    return first_line_of({"count", "lossy.toml"});
  };
  const auto one = lines(output_of({"need", "--digits", "1"}));
  ASSERT_GE(one.size(), 2U);
  EXPECT_EQ(one[0], "3 collisions");
  EXPECT_EQ(one[1], "need a restitution of 1: with any loss at all there are more");
  EXPECT_EQ(count_with(1, 1), "3");
  EXPECT_EQ(count_with(1, parse_rational("999999999999999999/1000000000000000000")), "4");
  const std::vector<std::string> counts = {"31", "314", "3141"};
  for (int digits = 2; digits <= 4; ++digits) {
    const std::string& count = counts.at(static_cast<std::size_t>(digits - 2));
    const auto said = lines(output_of({"need", "--digits", std::to_string(digits)}));
    ASSERT_GE(said.size(), 4U);
    EXPECT_EQ(said[0], count + " collisions");
    const std::string begin = "need a restitution of ";
    ASSERT_TRUE(said[1].starts_with(begin)) << said[1];
    const std::string number = said[1].substr(begin.size(), said[1].find("...") - begin.size());
    const Rational step = 1 / power(10, static_cast<unsigned long>(number.size()) - 2);
    const Rational cut = parse_rational(number);
    EXPECT_EQ(count_with(digits, cut + step), count) << number;
    EXPECT_EQ(count_with(digits, cut - step), std::to_string(std::stoi(count) + 1)) << number;
    ASSERT_TRUE(said[2].starts_with("which is 1 - ")) << said[2];
    const Rational loss = parse_rational(said[2].substr(13));
    EXPECT_LE(abs(Rational(1 - cut - loss)), step) << said[2];
    EXPECT_NE(said[3].find(fmt::format("{} collisions with less, {} with more",
                                       std::stoi(count) + 1, count)),
              std::string::npos)
        << said[3];
  }
}

class BodiesRender : public BodiesCli, public testing::WithParamInterface<const char*> {};

TEST_P(BodiesRender, BytesDoNotDependOnJobsNorOnParts) {
  const Arguments render{"render", GetParam(), "--quiet", "--size", "640x360",
                         "--fps",  "5",        "--sound", "-o"};
  output_of(render + Arguments{"a.mp4", "--jobs", "1"});
  output_of(render + Arguments{"b.mp4", "--jobs", "2"});
  ASSERT_GT(contents("a.mp4").size(), 5000U);
  EXPECT_TRUE(contents("a.mp4") == contents("b.mp4"));
  for (const char* part : {"1/3", "2/3", "3/3"}) {
    output_of(render + Arguments{"c.mp4", "--part", part});
  }
  output_of({"join", "--quiet", "c.mp4.part-2-of-3", "c.mp4.part-3-of-3", "c.mp4.part-1-of-3", "-o",
             "c.mp4"});
  EXPECT_TRUE(contents("a.mp4") == contents("c.mp4"));
  output_of({"render", GetParam(), "--quiet", "--size", "640x360", "--fps", "5", "--no-sound", "-o",
             "a.framehash", "--jobs", "2"});
  output_of({"render", GetParam(), "--quiet", "--size", "640x360", "--fps", "5", "--no-sound", "-o",
             "b.framehash", "--jobs", "1"});
  EXPECT_TRUE(contents("a.framehash") == contents("b.framehash"));
}

TEST_P(BodiesRender, AStillIsTheFrameOfItsInstant) {
  const Arguments small{"--size", "640x360", "--fps", "2"};
  output_of(Arguments{"render", GetParam(), "--quiet", "--no-sound", "-o", "%d.png"} + small);
  output_of(
      {"still", GetParam(), "--at", "0", "-o", "still.png", "--fps", "2", "--size", "640x360"});
  EXPECT_TRUE(contents("still.png") == contents("1.png"));
}

TEST_P(BodiesRender, StillsAndSheetsAreOfEveryKind) {
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const Arguments still{"still", GetParam(), "--at", "1", "--size", "640x360", "-o", name};
    output_of(still);
    const std::string first = contents(name);
    output_of(still);
    EXPECT_TRUE(contents(name) == first) << name << " differs the second time";
    output_of({"sheet", GetParam(), "--frames", "4", "-o", std::string("sheet-") + name});
    EXPECT_GT(contents(std::string("sheet-") + name).size(), first.size()) << name;
  }
  EXPECT_TRUE(contents("a.png").starts_with("\x89PNG"));
  EXPECT_NE(contents("a.svg").find("<svg"), std::string::npos);
  EXPECT_TRUE(contents("a.pdf").starts_with("%PDF-"));
}

INSTANTIATE_TEST_SUITE_P(Shipped, BodiesRender,
                         testing::Values("three-blocks", "recoil", "cradle", "billiard", "touch",
                                         "wedge", "gas"),
                         [](const testing::TestParamInfo<const char*>& one) {
                           std::string name = one.param;
                           std::erase(name, '-');
                           return name;
                         });

/// Nothing is heard before the first collision, and each is heard from its time on.
TEST_F(BodiesCli, CollisionsAreHeard) {
  for (const char* scene : {"three-blocks", "billiard", "recoil"}) {
    output_of({"render", scene, "--quiet", "--fps", "10", "-o", "a.wav"});
    const std::string wav = contents("a.wav");
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      std::memcpy(&value, wav.data() + at, sizeof value);
      return value;
    };
    ASSERT_TRUE(wav.starts_with("RIFF"));
    const std::size_t format = wav.find("fmt ");
    const std::size_t rate = number(format + 12);
    const std::size_t row_bytes = number(format + 20) & 0xffff;
    ASSERT_GT(row_bytes, 0U);
    const std::size_t data = wav.find("data") + 8;
    const auto is_silent = [&](double from_s, double to_s) {
      const auto begin = static_cast<std::size_t>(from_s * double(rate)) * row_bytes;
      const auto end = static_cast<std::size_t>(to_s * double(rate)) * row_bytes;
      const std::string part = wav.substr(data + begin, end - begin);
      return part.find_first_not_of('\0') == std::string::npos;
    };
    const auto rows = lines(output_of({"log", scene}));
    const double first = std::stod(split(rows.at(1), ',')[1]);
    EXPECT_TRUE(is_silent(0, first - 0.01)) << scene;
    const double end = double(wav.size() - data) / double(rate * row_bytes) - 0.01;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      const double time = std::stod(split(rows[i], ',')[1]);
      if (time > end) break;
      EXPECT_FALSE(is_silent(time, time + 0.01)) << scene << ", " << rows[i];
    }
  }
}

TEST_F(BodiesCli, AStoryboardMayHaveBodies) {
  write("story.toml", R"(
view.size = [640, 360]
view.fps = 10
view.theme = "lecture"
sound.on = true
[[part]]
digits = 1
time.to = 3
[[part]]
fade = 0.5
time.to = 4
show.title = "Two blocks"
show.panels = ["time"]
[[part.body]]
position = 0
velocity = 1
[[part.body]]
position = 3
mass = 2
[[part]]
time.to = 2
box.x = [0, 9]
box.y = [0, 3]
compare = [
  { body = [{ position = [1.1, 1.1], velocity = [1, 0] }, { position = [5, 1.5] }] },
  { body = [{ position = [1.1, 1.1], velocity = [3, 0] }, { position = [5, 1.5] }] },
]
)");
  const Arguments render{"render", "story.toml", "--quiet", "-o"};
  output_of(render + Arguments{"a.mp4", "--jobs", "1"});
  output_of(render + Arguments{"b.mp4", "--jobs", "2"});
  EXPECT_TRUE(contents("a.mp4") == contents("b.mp4"));
  for (const char* part : {"1/2", "2/2"}) output_of(render + Arguments{"c.mp4", "--part", part});
  output_of({"join", "--quiet", "c.mp4.part-1-of-2", "c.mp4.part-2-of-2", "-o", "c.mp4"});
  EXPECT_TRUE(contents("a.mp4") == contents("c.mp4"));
  output_of(render + Arguments{"%03d.png", "--no-sound"});
  const std::vector<std::string> all = entries();
  const auto frames = std::ranges::count_if(
      all, [](const std::string& name) { return name.size() == 7 && name.ends_with(".png"); });
  EXPECT_EQ(frames, 85) << "five belong to two parts";
  output_of({"still", "story.toml", "--at", "8", "-o", "still.png"});
  EXPECT_TRUE(contents("still.png") == contents("081.png"));
}

TEST_F(BodiesCli, AComparisonOfUncertainBodiesIsRefused) {
  write("story.toml", std::string("view.size = '640x360'\n[[part]]\ntime.to = 200\nbox.x = [0, 4]\n"
                                  "box.y = [0, 3]\ncompare = [") +
                          R"({ body = [{ position = [1, 1], radius = 0.5 }] },
  { body = [{ position = [1, 1], velocity = [1, 0.7], radius = 0.5 },
            { position = [3, 1.2], velocity = [-1, 0.3], radius = 0.6 },
            { position = [2, 2.4], velocity = [0.2, -0.9], radius = 0.4 }] }]
)");
  const CommandResult result = piblocks({"render", "story.toml", "-o", "a.mp4"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(lines(result.err).size(), 1U) << result.err;
  EXPECT_NE(result.err.find("is certain until time "), std::string::npos) << result.err;
  EXPECT_EQ(entries().size(), 4U);
}

}  // namespace
}  // namespace piblocks
