// Wrong usage: exit code 2, a line for each problem that names the culprit, nothing written.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {

struct BadInput {
  Arguments arguments;
  std::string message;     ///< part of what is said
  std::string scene = {};  ///< contents of scene.toml, if there is to be one
};

std::ostream& operator<<(std::ostream& out, const BadInput& bad) {
  if (bad.arguments.empty()) return out << "nothing";
  for (const std::string& argument : bad.arguments) out << argument << ' ';
  return out << bad.scene;
}

class BadInputTest : public CliFixture, public testing::WithParamInterface<BadInput> {};

TEST_P(BadInputTest, IsRefused) {
  if (!GetParam().scene.empty()) write("scene.toml", GetParam().scene);
  const std::string said = refusal(GetParam().arguments);
  EXPECT_TRUE(said.starts_with("piblocks: ")) << said;
  EXPECT_TRUE(contains(said, GetParam().message));
  EXPECT_EQ(lines(said).size(), 1u) << said;
}

std::string repeated(std::string_view text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

Arguments render(const Arguments& more) { return Arguments{"render", "-o", "a.mp4"} + more; }
Arguments still(const Arguments& more) { return Arguments{"still", "-o", "a.png"} + more; }

INSTANTIATE_TEST_SUITE_P(
    Commands, BadInputTest,
    testing::Values(
        BadInput{{"frobnicate"},
                 "unknown command 'frobnicate': use one of render, join, still, sheet, page, "
                 "log, state, count, min-restitution, scenes, compare, golden, info, manual; see "
                 "'piblocks "
                 "--help'"},
        BadInput{{"redner"}, "unknown command 'redner'; did you mean 'render'? use one of"},
        BadInput{{"help", "cuont"}, "unknown command 'cuont'; did you mean 'count'?"},
        BadInput{{"golden", "chek"}, "golden: unknown command 'chek'; did you mean 'check'?"},
        BadInput{{"render", "--digit=3", "-o", "a.mp4"}, "'--digit=3'; did you mean '--digits'?"},
        BadInput{{"-x"}, "unknown option '-x'"},
        BadInput{{"--digits", "3"}, "unknown option '--digits'"},
        BadInput{{"count", "--frames", "3"}, "count: unknown option '--frames'"},
        BadInput{{"still", "--at", "1", "--from", "0", "-o", "a.png"}, "unknown option '--from'"},
        BadInput{{"render", "--ouput", "a.mp4"}, "render: unknown option '--ouput'"},
        BadInput{{"count", "a.toml", "b.toml"}, "count: unexpected argument 'b.toml'"},
        BadInput{{"info", "everything"}, "info: unexpected argument 'everything'"},
        BadInput{{"render"}, "render: missing -o,--output OUT"},
        BadInput{{"join", "a.part-1-of-1"}, "join: missing -o,--output OUT"},
        BadInput{{"join", "-o", "a.mp4"}, "join: missing PART ..."},
        BadInput{{"join", "none", "-o", "a.mp4"}, "part: cannot open 'none': No such file"},
        BadInput{{"join", ".", "-o", "a.mp4"}, "part: cannot open '.': Is a directory"},
        BadInput{{"join", "scene.toml", "-o", "a.mp4"},
                 "part: 'scene.toml' is no part file",
                 "red.mass = 3"},
        BadInput{{"golden"},
                 "golden: no command: use one of record, check, approve; see 'piblocks "
                 "golden --help'"},
        BadInput{{"golden", "forget"}, "golden: unknown command 'forget': use one of record,"},
        BadInput{{"golden", "check"},
                 "golden check: missing SCENE ...; see 'piblocks golden check --help'"},
        BadInput{
            {"golden", "check", "scene.toml"},
            "golden: missing the folder of the references: --dir DIR for scenes, --against DIR",
            "red.mass = 3"},
        BadInput{{"golden", "check", "--dri", "a"}, "golden check: unknown option '--dri'"},
        BadInput{{"golden", "check", "--dir", "a", "none.toml"}, "cannot read 'none.toml'"},
        BadInput{{"golden", "check", "--dir", "a", "scene.toml", "scene.toml"},
                 "golden: two scenes have the name 'scene'",
                 "red.mass = 3"},
        BadInput{{"still"}, "still: missing --at T and -o,--output OUT"},
        BadInput{{"still", "-o", "a.png"}, "still: missing --at T;"},
        BadInput{{"state"}, "state: missing --at"},
        BadInput{still({"--at", "turn", "--theme", "lecture", "--title",
                        "a\xff"
                        "b"}),
                 "--title: show.title is not valid UTF-8; write it in that encoding"},
        BadInput{still({"--at", "turn", "--caption", "\xcf"}),
                 "--caption: show.caption is not valid UTF-8; write it in that encoding"},
        BadInput{render({"--max-flashes", "0"}), "--max-flashes 0: must be a whole number"},
        BadInput{render({"--max-flashes", "99"}), "--max-flashes 99: must be a whole number"},
        BadInput{{"count", "--digits", "1", "--digits", "2"}, "--digits is given more than once"},
        BadInput{{"count", "--digits", "2", "--mass-ratio", "3"}, "--digits and --mass-ratio"}));

INSTANTIATE_TEST_SUITE_P(
    Parts, BadInputTest,
    testing::Values(
        BadInput{render({"--part", "0/3"}), "--part 0/3: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{render({"--part", "4/3"}), "--part 4/3: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{render({"--part", "1/0"}), "--part 1/0: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{render({"--part", "1"}), "--part 1: must be I/N, such as 2/3"},
        BadInput{render({"--part", "1/2/3"}),
                 "--part 1/2/3: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{render({"--part", "-1/3"}),
                 "--part -1/3: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{{"render", "--part", "1/2", "-o", "null"}, "no parts of output 'null'"},
        BadInput{{"render", "--part", "1/2", "-o", "-"}, "no parts of output '-'"}));

INSTANTIATE_TEST_SUITE_P(
    System, BadInputTest,
    testing::Values(
        BadInput{{"count", "--digits", "0"}, "--digits: digits = 0: must be a whole number"},
        BadInput{{"count", "--digits", "-1"}, "--digits: digits = -1: must be a whole number"},
        BadInput{{"count", "--digits", "1.5"}, "--digits: digits = 1.5: must be a whole number"},
        BadInput{{"count", "--digits", "abc"}, "--digits: digits = abc: must be a whole number"},
        BadInput{{"count", "--digits", "1e9"}, "--digits: digits = 1e9: must be a whole number"},
        BadInput{{"count", "--digits", "0x10"}, "--digits: digits = 0x10: must be a whole number"},
        BadInput{{"count", "--digits", "1_000"}, "digits = 1_000: must be a whole number"},
        BadInput{{"count", "--digits", "\xd9\xa3"}, "digits = \xd9\xa3: must be a whole number"},
        BadInput{{"count", "--mass-ratio", "1,000"}, "1,000: not a number such as 16, 2.5, 1/3"},
        BadInput{{"count", "--mass-ratio", "0"}, "--mass-ratio: red.mass = 0: must be greater"},
        BadInput{{"count", "--mass-ratio", "-2"}, "--mass-ratio: red.mass = -2: must be greater"},
        BadInput{{"count", "--mass-ratio", "inf"}, "--mass-ratio: mass-ratio = inf: not a number"},
        BadInput{{"count", "--mass-ratio", "nan"}, "--mass-ratio: mass-ratio = nan: not a number"},
        BadInput{{"count", "--mass-ratio", "1/0"}, "--mass-ratio: mass-ratio = 1/0: division by"},
        BadInput{{"count", "--mass-ratio", "9^99999999"}, "longer than"}));

INSTANTIATE_TEST_SUITE_P(
    Scene, BadInputTest,
    testing::Values(
        BadInput{{"count", "missing.toml"}, "cannot read 'missing.toml': No such file"},
        BadInput{{"count", "/"}, "cannot read '/': Is a directory"},
        BadInput{{"count", "scene.toml"}, "scene.toml:2: ", "[red]\nmass = = 3\n"},
        BadInput{{"count", "scene.toml"}, "scene.toml:2: red.mas: unknown key", "[red]\nmas = 3\n"},
        BadInput{{"count", "scene.toml"}, "scene.toml:2: red.mass = 0: must be", "[red]\nmass = 0"},
        BadInput{{"count", "scene.toml"},
                 "scene.toml:1: red.mass = 3\\x00: not a number",
                 "red.mass = \"3\\u0000\"\n"},
        BadInput{{"count", "scene.toml"}, "blue.mass = -1", "[blue]\nmass = -1"},
        BadInput{{"count", "scene.toml"}, "blue.mass = inf", "[blue]\nmass = inf"},
        BadInput{{"count", "scene.toml"}, "blue.velocity = nan", "[blue]\nvelocity = nan"},
        BadInput{{"count", "scene.toml"}, "red.width = 0", "[red]\nwidth = 0"},
        BadInput{{"count", "scene.toml"}, "view.fps = -1", "[view]\nfps = -1"},
        BadInput{{"count", "scene.toml"}, "time.speed = inf", "[time]\nspeed = inf"}));

/// One more than each limit that `piblocks info` names; those of a picture are below.
INSTANTIATE_TEST_SUITE_P(
    Limits, BadInputTest,
    testing::Values(
        BadInput{{"count", "--digits", "100001"},
                 "--digits: digits = 100001: must be a whole number from 1"},
        BadInput{{"count", "--mass-ratio", "2^4000001"}, "longer than"},
        BadInput{{"count", "scene.toml"}, "longer than 1048576 bytes", std::string(1048577, '#')},
        BadInput{{"count", "scene.toml"}, "scene.toml:1: ", "a = " + std::string(257, '[')},
        BadInput{render({"--part", "1/100001"}),
                 "--part 1/100001: must be I/N, such as 2/3: I from 1 to N"},
        BadInput{render({"--jobs", "257"}), "--jobs 257: must be a whole number from 1 to 256"},
        BadInput{{"count", "scene.toml"},
                 "scene.toml:4: a key has more than 16 parts",
                 "# a.b\n'a.b' = \"\"\"\n.\"\"\"\n" + repeated("a.", 100'000) + "b = 1\n"},
        BadInput{{"count", "scene.toml"},
                 "scene.toml:1: a key has more than 16 parts",
                 "[" + repeated("'a' . \"b\".", 50'000) + "b]\n"},
        BadInput{{"count", "scene.toml"},
                 "exceeds length limit of 128 digits",
                 "red.mass = 3." + std::string(127, '1')},
        BadInput{{"count", "scene.toml"}, "a.b: unknown key", repeated("a.", 15) + "b = 1"},
        BadInput{{"log", "--digits", "10"}, "3,141,592,653 rows are more than 100,000,000"}));

INSTANTIATE_TEST_SUITE_P(
    Picture, BadInputTest,
    testing::Values(
        BadInput{render({"--size", "0x36"}), "view.size = 0x36: each side must be from 1 to 16384"},
        BadInput{render({"--size", "-64x36"}), "view.size = -64x36: each side"},
        BadInput{render({"--size", "16386x2"}), "view.size = 16386x2: each side"},
        BadInput{render({"--size", "16384x16384"}), "view.size = 16384x16384: a frame must have"},
        BadInput{render({"--size", "wide"}), "view.size = wide: must be two whole numbers"},
        BadInput{render({"--size", "64"}), "view.size = 64: must be two whole numbers"},
        BadInput{render({"--size", "64x36x3"}), "view.size = 64x36x3: must be two whole numbers"},
        BadInput{render({"scene.toml"}), "scene.toml:1: view.size = '': must be two whole numbers",
                 "view.size = ''\n"},
        BadInput{render({"--size", "65x36"}),
                 "size 65x36 is odd: H.264 in 4:2:0 needs even sides; "
                 "use 64x36"},
        BadInput{{"render", "--size", "64x35", "-o", "a.y4m"}, "size 64x35 is odd"},
        BadInput{{"render", "--size", "64x35", "-o", "-"}, "use 64x34"},
        BadInput{render({"--fps", "0"}), "view.fps = 0: must be greater than 0"},
        BadInput{render({"--fps", "-60"}), "view.fps = -60"},
        BadInput{render({"--fps", "nan"}), "view.fps = nan: not a number"},
        BadInput{render({"--fps", "30/0"}), "view.fps = 30/0: division by zero"},
        BadInput{render({"--fps", "1001"}), "at most 1000"},
        BadInput{render({"--shutter", "1.5"}), "view.shutter = 3/2: must be from 0"},
        BadInput{render({"--shutter", "-1/2"}), "view.shutter = -1/2: must be from 0"},
        BadInput{render({"--shutter", "half"}), "view.shutter = half: not a number"},
        BadInput{render({"--shutter", "1", "--transparent"}), "needs an opaque background"},
        BadInput{still({"--at", "1", "--shutter", "2"}), "view.shutter = 2: must be from 0"},
        BadInput{still({"--at", "1", "--size", "0x0"}), "view.size = 0x0"}));

INSTANTIATE_TEST_SUITE_P(
    Times, BadInputTest,
    testing::Values(
        BadInput{render({"--speed", "0"}), "time.speed = 0: must be greater than 0"},
        BadInput{render({"--speed", "-1"}), "time.speed = -1: must be greater than 0"},
        BadInput{render({"--speed", "inf"}), "time.speed = inf: not a number"},
        BadInput{render({"--speed", "1e400"}), "time.speed is beyond the range of a double"},
        BadInput{render({"--from", "5", "--to", "3"}), "time.to = 3: must be after time.from = 5"},
        BadInput{render({"--from", "3", "--to", "3"}), "time.to = 3: must be after time.from = 3"},
        BadInput{render({"--from", "30"}), "time.from = 30: is not before the end"},
        BadInput{render({"--from", "turnip"}), "time.from = turnip: must be a time, 'turn'"},
        BadInput{render({"--to", "first"}), "time.to = first: not a number"},
        BadInput{render({"--to", "last-20"}), "there is nothing to show"},
        BadInput{render({"--to", "#315"}),
                 "time.to: collision #315: the scene has collisions #1 to #314"},
        BadInput{render({"--freeze", "20:1"}), "time.freeze: 20 is outside of what is shown, 0 to"},
        BadInput{render({"--slow-motion", "20:21:2"}), "is outside of what is shown, 0 to"},
        BadInput{render({"--ease", "6"}), "time.ease = 6: must be from 0 (abrupt) to 5 seconds"},
        BadInput{render({"--ease=-1"}), "time.ease = -1: must be from 0 (abrupt) to 5 seconds"},
        BadInput{render({"--hold-start", "turn-0.3"}), "time.hold-start = turn-0.3: not a number"},
        BadInput{render({"--to", "last+-1"}), "must be a time, 'turn', 'last', or '#K'"},
        BadInput{render({"--to", "1e9"}), "60,000,000,000 frames are more than 1,000,000; narrow"},
        BadInput{render({"--speed", "1e-400"}), "frames are more than 1,000,000"},
        BadInput{still({"--at", "noon"}),
                 "--at noon: not a number such as 16, 2.5, 1/3 or 1e6; must be a time, 'turn', "
                 "'last'"},
        BadInput{still({"--at", " "}), "--at  : not a number"},
        BadInput{still({"--at", "1e400"}), "--at 1e400: is beyond the range of a double"},
        BadInput{still({"--at", "#0"}), "#0: the scene has collisions #1 to #314"},
        BadInput{still({"--at", "#315"}), "#315: the scene has collisions #1 to #314"},
        BadInput{still({"--at", "#"}), "--at #: must be a time"},
        BadInput{still({"--at", "#-1"}), "collision #-1: the scene has collisions #1 to #314"},
        BadInput{{"state", "--at", "1,#999"}, "#999: the scene has collisions"},
        BadInput{{"state", "--at", "1,,2"}, "--at 1,,2: '': not a number"},
        BadInput{{"state", "--at", "1,"}, "--at 1,: '': not a number"},
        BadInput{{"state", "--at", "1,last", "--bounds", "--engine", "events"},
                 "--bounds: only known of two blocks beside something immovable, and with --engine "
                 "unfolded; leave it out"},
        BadInput{{"state", "--at", "1", "2"}, "cannot read '2'"},
        BadInput{{"state", "--at", "1", "--at", "2"}, "--at is given more than once"}));

INSTANTIATE_TEST_SUITE_P(
    Output, BadInputTest,
    testing::Values(
        BadInput{{"render", "-o", "a.avi"}, "cannot tell the kind of 'a.avi'"},
        BadInput{{"render", "-o", " "}, "cannot tell the kind of ' '"},
        BadInput{{"render", "-o", "/tmp"}, "cannot tell the kind of '/tmp'"},
        BadInput{{"render", "-o", "a.png"}, "cannot use 'a.png': an image sequence needs a number"},
        BadInput{{"render", "-o", "%d%d.png"}, "two number fields"},
        BadInput{{"render", "-o", "a.svg"}, "cannot use 'a.svg': an image sequence needs a number"},
        BadInput{{"render", "-o", "%d.pdf"}, "a PDF has all frames as its pages; leave '%' out"},
        BadInput{{"render", "--fps", "1000", "-o", "a.pdf"},
                 "13839 pages, and a PDF may have 10000"},
        BadInput{{"render", "-o", "/proc/a.mp4"}, "cannot open '/proc/a.mp4'"},
        BadInput{{"render", "-o", "/proc/%d.png"}, "cannot write into '/proc'"},
        BadInput{{"render", "-o", "/dev/null/a.y4m"}, "'/dev/null/a.y4m': Not a directory"},
        BadInput{{"still", "--at", "1", "-o", "a.jpg"}, "'a.jpg' has no known ending"},
        BadInput{{"still", "--at", "1", "-o", "/proc/a.png"}, "cannot open '/proc/a.png'"},
        BadInput{{"log", "-o", "/"}, "cannot open '/': Is a directory"},
        BadInput{{"log", "-o", "/dev/full"}, "cannot open '/dev/full': not a file"}));

INSTANTIATE_TEST_SUITE_P(
    Encoder, BadInputTest,
    testing::Values(
        BadInput{render({"--crf", "abc"}), "--crf abc: not a number"},
        BadInput{render({"--crf", "-1"}), "crf -1 is out of range; use 1 (best) to 51"},
        BadInput{render({"--crf", "0"}), "crf 0 is out of range; use 1 (best) to 51"},
        BadInput{render({"--crf", "0.9"}), "crf 0.9 is out of range; use 1 (best) to 51"},
        BadInput{render({"--crf", "52"}), "crf 52 is out of range"},
        BadInput{render({"--smallest", "--crf", "20"}), "--smallest chooses the encoder and its"},
        BadInput{render({"--smallest", "--encoder", "builtin"}), "leave out --encoder"},
        BadInput{render({"--encoder", "builtin", "--crf", "20"}), "'builtin' has no crf"},
        BadInput{render({"--smallest", "--start-number", "5"}), "'a.mp4' has no numbers"},
        BadInput{render({"--frames", "60"}), "--frames 60: must be A-B, such as 120-180"},
        BadInput{render({"--frames", "9-5"}), "--frames 9-5: must be A-B"},
        BadInput{render({"--frames", "5-832"}),
                 "there are no frames 5-832; those of the film are 0-831"},
        BadInput{render({"--frames", "1-2", "--part", "1/2"}),
                 "parts, pages and bundles are of the"},
        BadInput{render({"--smallest", "--plays", "5"}), "'a.mp4' does not say how often it plays"},
        BadInput{{"render", "--smallest", "-o", "a.y4m"}, "'a.y4m' has no use for crf"},
        BadInput{render({"--preset", "warp"}), "no preset 'warp'; use one of: ultrafast"},
        BadInput{render({"--encoder", "nope"}), "cannot use encoder 'nope'; use one of: builtin"},
        BadInput{render({"--encoder", "aac"}), "cannot use encoder 'aac'; use one of: builtin"},
        BadInput{render({"--encoder", "libsvtav1"}), "cannot use encoder 'libsvtav1'; use one of"},
        BadInput{render({"--encoder", "mpeg4"}), "cannot use encoder 'mpeg4'; use one of: builtin"},
        BadInput{{"render", "-o", "a.mov", "--encoder", "libvpx-vp9"},
                 "cannot use encoder 'libvpx-vp9'; use one of: builtin"},
        BadInput{{"render", "-o", "a.html", "--encoder", "libsvtav1"},
                 "cannot use encoder 'libsvtav1'; use one of"},
        BadInput{{"render", "-o", "a.webm", "--encoder", "libsvtav1"},
                 "cannot find encoder 'libsvtav1' for *.webm; use one of: libvpx-vp9"},
        BadInput{{"render", "--crf", "20", "-o", "a.y4m"}, "'a.y4m' has no use for crf"},
        BadInput{render({"--jobs", "0"}), "--jobs 0: must be a whole number from 1 to 256"},
        BadInput{render({"--jobs", "abc"}), "--jobs abc: must be"},
        BadInput{render({"--jobs", "1.5"}), "--jobs 1.5: must be"}));

INSTANTIATE_TEST_SUITE_P(
    Formats, BadInputTest,
    testing::Values(
        BadInput{render({"--transparent"}),
                 "'a.mp4' cannot be transparent; use an opaque background or write one of: *.mov"},
        BadInput{{"render", "scene.toml", "-o", "a.gif", "--fps", "25"},
                 "'a.gif' cannot be transparent",
                 "[view]\nbackground = 'transparent'"},
        BadInput{{"count", "scene.toml"},
                 "view.background = glass: must be one of: opaque, transparent, a colour as "
                 "\"#1f77b4\": # and six hexadecimal digits",
                 "[view]\nbackground = 'glass'"},
        BadInput{render({"--transparent", "--opaque"}),
                 "--transparent and --opaque both set the background"},
        BadInput{render({"--background", "#fdf6e3", "--transparent"}),
                 "--transparent and --background both set the background"},
        BadInput{render({"--background", "#12"}),
                 "--background: view.background = #12: must be a colour as \"#1f77b4\""},
        BadInput{render({"--ink", "red"}),
                 "--ink: view.colors.ink = red: must be a colour as \"#1f77b4\""},
        BadInput{{"render", "-o", "a.apng", "--fps", "100000/3001", "--crf", "3"},
                 "no use for crf"},
        BadInput{{"render", "-o", "a.webm", "--size", "65x36"}, "WebM in 4:2:0 needs even sides"},
        BadInput{{"render", "-o", "a.webm", "--encoder", "av1", "--transparent"},
                 "encoder 'libaom-av1' has no transparency; use vp9"},
        BadInput{{"render", "-o", "a.webm", "--encoder", "nope"},
                 "cannot find encoder 'nope' for *.webm; use one of: libvpx-vp9"},
        BadInput{{"render", "-o", "a.webm", "--crf", "64"}, "crf 64 is out of range of *.webm"},
        BadInput{{"render", "-o", "a.mov", "--transparent", "--encoder", "libx264"},
                 "'libx264' has no transparency in *.mov; use prores_ks"},
        BadInput{render({"--size", "8192x8192"}),
                 "8192x8192 are 262144 macroblocks of 16x16 pixels, more than the 139264 of level"},
        BadInput{{"render", "-o", "a.mov", "--size", "8192x4368"}, "more than the 139264 of level"},
        BadInput{{"render", "-o", "a.html", "--size", "8192x8192"}, "level 6.2, the highest"},
        BadInput{render({"--size", "3840x2160", "--fps", "600"}),
                 "more than the 16711680 a second"},
        BadInput{render({"--fps", "1/1000000"}), "a frame can last 131071 s at most"},
        BadInput{{"render", "-o", "a.mov", "--fps", "1/131072", "--transparent"},
                 "frame rate 1/131072 is too low for *.mp4 and *.mov"},
        BadInput{{"render", "-o", "a.mov", "--size", "65x36"}, "H.264 in 4:2:0 needs even sides"},
        BadInput{render({"--for", "cinema"}),
                 "--for cinema: must be one of: powerpoint, keynote, web, editor, shorts, beamer"},
        BadInput{render({"--for", "powrpoint"}), "did you mean 'powerpoint'?"},
        BadInput{render({"--encoder", "libx246"}), "did you mean 'libx264'?"},
        BadInput{render({"--encoder", "libx264", "--preset", "veryfst"}),
                 "did you mean 'veryfast'?"},
        BadInput{{"render", "-o", "a.webm", "--encoder", "libvpx"}, "did you mean 'libvpx-vp9'?"},
        BadInput{{"log", "--engine", "unfoldd"}, "did you mean 'unfolded'?"},
        BadInput{render({"--for", "editor"}),
                 "--for editor: cannot use 'a.mp4' there; write one of: *.mov, *.png"},
        BadInput{{"sheet", "-o", "a.jpg"}, "sheet: 'a.jpg' has no known ending; use .pdf"},
        BadInput{{"sheet", "--frames", "0", "-o", "a.pdf"}, "--frames 0: must be a whole number"},
        BadInput{{"sheet", "--frames", "201", "-o", "a.pdf"}, "a whole number from 1 to 200"},
        BadInput{{"sheet", "--frames", "2", "--at", "1", "-o", "a.pdf"}, "--frames and --at both"},
        BadInput{{"sheet", "--by", "time", "--at", "1", "-o", "a.pdf"}, "--by and --at both"},
        BadInput{{"sheet", "--by", "size", "-o", "a.pdf"}, "--by size: must be count or time"},
        BadInput{{"sheet", "--digits", "1", "--by", "count", "-o", "a.pdf"},
                 "cannot space 12 pictures by count, since the scene shows 3 collisions; use "
                 "--frames 4 or fewer, or --by time"},
        BadInput{{"sheet", "scene.toml", "--by", "count", "-o", "a.pdf"},
                 "since all collisions happen at once; use --by time",
                 "blue.position = 0.5\n"},
        BadInput{{"sheet", "--at", "1,noon", "-o", "a.pdf"}, "--at 1,noon: 'noon': not a number"},
        BadInput{{"sheet", "--at", "#315", "-o", "a.pdf"}, "the scene has collisions #1 to #314"}));

INSTANTIATE_TEST_SUITE_P(
    Log, BadInputTest,
    testing::Values(
        BadInput{{"log", "--from", "5", "--to", "3"}, "--to 3: is before --from 5"},
        BadInput{{"log", "--from", "soon"}, "--from soon: not a number"},
        BadInput{{"log", "--first", "0"}, "--first 0: the scene has collisions 1 to 314"},
        BadInput{{"log", "--first", "1.5"}, "--first 1.5: must be a whole number"},
        BadInput{{"log", "--from", "#315"}, "--from #315: collision #315: the scene has"},
        BadInput{{"log", "--first", "315"}, "--first 315: the scene has collisions 1 to 314"},
        BadInput{{"log", "--limit", "0"}, "--limit 0: must be a whole number from 1 on"},
        BadInput{{"log", "--limit", "many"}, "--limit many: must be a whole number"},
        BadInput{{"log", "--format", "xml"}, "--format xml: must be one of: csv, jsonl, npy"},
        BadInput{{"log", "--engine", "magic"}, "--engine magic: must be unfolded or events"},
        BadInput{{"log", "--engine", "1"}, "--engine 1: must be unfolded or events"},
        BadInput{{"log", "--format", "npy", "--digits", "20", "--first", "9223372036854775808",
                  "--limit", "1"},
                 "log: index 9,223,372,036,854,775,808 does not fit in 64 bits of npy; use csv "
                 "or jsonl"},
        BadInput{{"log", "--digits", "8", "--engine", "events"},
                 "31,415,926 collisions are more than the limit of 5,000,000"}));

using BadInputsTest = CliFixture;

TEST_F(BadInputsTest, EachProblemOfASceneHasItsLine) {
  write("scene.toml", "[blue]\nmass = 0\n[red]\nmas = 1\n[view]\nfps = 0\n");
  const auto problems = lines(refusal({"render", "scene.toml", "--speed", "0", "-o", "a.mp4"}));
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_TRUE(problems[0].starts_with("piblocks: scene.toml:4: red.mas: unknown key"));
  EXPECT_TRUE(problems[1].starts_with("piblocks: scene.toml:2: blue.mass = 0: "));
  EXPECT_TRUE(problems[2].starts_with("piblocks: scene.toml:6: view.fps = 0: "));
  EXPECT_TRUE(problems[3].starts_with("piblocks: --speed: time.speed = 0: "));
}

/// However it is called, and whatever its name ends with.
TEST_F(BadInputsTest, TheSceneThatIsReadIsNotReplaced) {
  const std::string scene = "[red]\nmass = 100\n";
  const auto expect_refused = [&](const std::string& file, const std::string& output,
                                  const Arguments& command) {
    write(file, scene);
    EXPECT_EQ(refusal(command + Arguments{file, "-o", output}),
              "piblocks: --output '" + output + "': would write over the scene file '" + file +
                  "'; choose another name\n");
    EXPECT_EQ(contents(file), scene);
  };
  expect_refused("scene.toml", "scene.toml", {"log"});
  expect_refused("scene.toml", "./scene.toml", {"log", "--format", "npy"});
  expect_refused("scene.toml", folder_ / "scene.toml", {"log"});
  std::filesystem::create_symlink("scene.toml", folder_ / "link.csv");
  expect_refused("scene.toml", "link.csv", {"log"});
  expect_refused("scene.png", "scene.png", {"still", "--at", "1"});
  expect_refused("scene.mp4", "scene.mp4", {"render", "--to", "1"});
  expect_refused("scene.y4m", "./scene.y4m", {"render", "--to", "1"});
}

TEST_F(BadInputsTest, AnotherFileIsReplaced) {
  write("scene.toml", "[red]\nmass = 100\n");
  write("log.csv", "old");
  EXPECT_EQ(output_of({"log", "scene.toml", "-o", "log.csv"}), "");
  EXPECT_EQ(lines(contents("log.csv")).size(), 32u);
}

TEST_F(BadInputsTest, AFolderIsNotReplaced) {
  std::filesystem::create_directory(folder_ / "a.mp4");
  EXPECT_EQ(refusal(render({"--to", "1"})),
            "piblocks: output: cannot open 'a.mp4': Is a directory\n");
}

constexpr const char* kStory = "[[part]]\ncard = 'a'\n[[part]]\ndigits = 2\n";

INSTANTIATE_TEST_SUITE_P(
    Storyboards, BadInputTest,
    testing::Values(
        BadInput{render({"scene.toml", "--digits", "2"}), "--digits: 'scene.toml' is a storyboard",
                 kStory},
        BadInput{render({"scene.toml", "--speed", "2"}), "put time.speed into it", kStory},
        BadInput{render({"scene.toml", "--show", "time"}), "put show.overlays into it", kStory},
        BadInput{render({"scene.toml", "--size", "0x9"}), "--size: view.size = 0x9: each", kStory},
        BadInput{
            {"render", "scene.toml", "--sound", "-o", "a.gif"}, "'a.gif' has no sound", kStory},
        BadInput{render({"scene.toml"}), "scene.toml:2: sound.on: holds for the whole film",
                 "[[part]]\nsound.on = true\n"},
        BadInput{{"render", "scene.toml", "--transparent", "-o", "a.html"},
                 "output: 'a.html' cannot be transparent",
                 kStory},
        BadInput{render({"scene.toml", "--bundle", "talk", "--transparent"}),
                 "bundle: 'a.mp4' cannot be transparent", kStory},
        BadInput{render({"scene.toml", "--bundle", "talk", "--poster", "#3"}),
                 "'#3' is an instant of one run", kStory},
        BadInput{render({"scene.toml", "--shutter", "1"}), "put view.shutter into it", kStory},
        BadInput{render({"scene.toml"}), "scene.toml:2: view.shutter needs an opaque background",
                 "[[part]]\nview.shutter = 1\n[view]\nbackground = 'transparent'\n"},
        BadInput{render({"scene.toml"}), "scene.toml:5: fade = 9: must take at most",
                 std::string(kStory) + "[[part]]\nfade = 9\n"},
        BadInput{still({"scene.toml", "--at", "#3"}), "'#3' is an instant of one run", kStory},
        BadInput{still({"scene.toml", "--at", "-1"}), "-1: the storyboard's video lasts", kStory},
        BadInput{{"count", "scene.toml"}, "'scene.toml' is a storyboard; 'count' takes", kStory},
        BadInput{{"log", "scene.toml"}, "'scene.toml' is a storyboard; 'log' takes", kStory},
        BadInput{{"state", "scene.toml", "--at", "1"}, "a storyboard; 'state' takes", kStory},
        BadInput{{"sheet", "scene.toml", "--at", "1", "-o", "a.pdf"}, "'sheet' takes", kStory}));

}  // namespace
}  // namespace piblocks
