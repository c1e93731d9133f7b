// No command writes over what it reads, whatever the names.
#include "cli/cli_fixture.hpp"

namespace piblocks {
namespace {
namespace fs = std::filesystem;

const std::string kScene =
    "[view]\nsize = [64, 36]\nfps = 4\ntheme = \"article\"\n[show]\nlogo = "
    "\"pictures/000001.png\"\n"
    "[time]\nto = 1\n[golden]\nsize = [64, 36]\nframes = [0]\n";

struct Case {
  std::string name;
  std::string command;  // words, separated by blanks
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const Case& tried) { return out << tried.name; }

/// A scene, its logo in a folder of pictures, other names of both, and references.
class OverwritingTest : public CliFixture, public testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    for (const char* at : {"1", "2"}) {
      output_of({"still", "--size", "64x36", "--at", at, "-o",
                 "pictures/00000" + std::string(at) + ".png"});
    }
    fs::copy(folder_ / "pictures", folder_ / "others");
    write("scene.toml", kScene);
    write("story.toml",
          "view = { size = \"64x36\", theme = \"article\" }\n[[part]]\nshow.logo = "
          "\"pictures/000001.png\"\n");
    fs::create_hard_link(folder_ / "scene.toml", folder_ / "hard.mp4");
    fs::create_symlink("scene.toml", folder_ / "soft.mp4");
    fs::create_symlink("pictures", folder_ / "shortcut");
    fs::create_hard_link(folder_ / "pictures/000001.png", folder_ / "hard.png");
    fs::create_symlink("pictures/000001.png", folder_ / "soft.png");
    fs::create_symlink("pictures/new.html", folder_ / "dangling.html");
    output_of({"golden", "record", "scene.toml", "--dir", "golden"});
    for (const char* part : {"1/2", "2/2"}) {
      output_of({"render", "--quiet", "scene.toml", "--part", part, "-o", "a.y4m"});
    }
    fs::create_hard_link(folder_ / "a.y4m.part-1-of-2", folder_ / "b.y4m");
    fs::create_directory(folder_ / "bundle");
    fs::copy(folder_ / "pictures/000001.png", folder_ / "bundle/poster.png");
  }
  std::vector<std::string> state() const {
    std::vector<std::string> state = entries();
    for (std::string& name : state) {
      if (fs::is_regular_file(folder_ / name)) name += ": " + contents(name);
    }
    return state;
  }
};

TEST_P(OverwritingTest, IsRefusedBeforeAnythingIsWritten) {
  const auto before = state();
  const CommandResult result = piblocks(split(GetParam().command, ' '));
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_TRUE(contains(result.err, GetParam().message));
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(state() == before);
}
INSTANTIATE_TEST_SUITE_P(
    Of, OverwritingTest,
    testing::Values(
        Case{"SceneByHardLink", "render scene.toml -o hard.mp4",
             "--output 'hard.mp4': would write over the scene file 'scene.toml'"},
        Case{"SceneBySymbolicLink", "render scene.toml -o pictures/../soft.mp4",
             "would write over the scene file"},
        Case{"SceneByLog", "log scene.toml -o ./shortcut/../scene.toml",
             "would write over the scene file"},
        Case{"Logo", "still scene.toml --at 0 -o pictures/000001.png",
             "would write over the logo 'pictures/000001.png'"},
        Case{"LogoByOption", "still --at 0 --logo hard.png -o soft.png",
             "would write over the logo 'hard.png'"},
        Case{"LogoOfAStoryboard", "still story.toml --at 0 -o shortcut/000001.png",
             "would write over the logo"},
        Case{"LogoBySheet", "sheet scene.toml -o hard.png", "would write over the logo"},
        Case{"LogoBySequence", "render scene.toml -o shortcut/%06d.png",
             "--output 'shortcut/%06d.png': would write over the logo"},
        Case{"LogoByBundle", "render --logo bundle/poster.png --bundle bundle -o x.mp4",
             "--bundle 'bundle/poster.png': would write over the logo"},
        Case{"ReferenceByJunit",
             "compare pictures/000001.png others/000001.png --junit pictures/000001.png",
             "--junit 'pictures/000001.png': would write over the reference"},
        Case{"ActualByReport", "compare others/000001.png soft.png --report hard.png",
             "--report 'hard.png': would write over the actual pictures 'soft.png'"},
        Case{"FolderByDiff", "compare pictures others --diff pictures",
             "--diff 'pictures': would write into the reference 'pictures'"},
        Case{"FolderByDiffElsewhere", "compare others pictures --diff others/../shortcut",
             "would write into the actual pictures"},
        Case{"FolderByNewFile", "compare pictures others --report shortcut/new.html",
             "would write into the reference"},
        Case{"FolderByDanglingLink", "compare pictures others --report dangling.html",
             "would write into the reference"},
        Case{"FolderByLinkOutside", "compare pictures others --junit hard.png",
             "would write into the reference"},
        Case{"ReportByReport", "compare pictures others --report new --junit ./new",
             "--junit './new': would write over --report 'new'"},
        Case{"ReportByDiffInANewFolder",
             "compare pictures/000001.png pictures/000002.png --diff new --junit new/1-diff.png",
             "--junit 'new/1-diff.png': would write over --diff 'new'"},
        Case{"DiffByReportInANewFolder",
             "compare pictures/000001.png pictures/000002.png --report ./a/b/0-actual.png --diff "
             "a/b/",
             "--report './a/b/0-actual.png': would write over --diff 'a/b/'"},
        Case{"PicturesOfTheReportByDiff", "compare pictures others --report r.html --diff r-files",
             "--report 'r-files': would write over --diff 'r-files'"},
        Case{"FolderOfReferences", "golden check scene.toml --dir golden --diff golden",
             "--diff 'golden': would write into the folder of the references 'golden'"},
        Case{"FolderOfReferencesBelow",
             "golden check scene.toml --dir golden/../golden --diff ./golden/",
             "would write into the folder of the references"},
        Case{"Part", "join a.y4m.part-1-of-2 a.y4m.part-2-of-2 -o b.y4m",
             "join: output 'b.y4m': would write over the part 'a.y4m.part-1-of-2'"}),
    [](const auto& test) { return test.param.name; });

class AppendingTest : public CliFixture {};

/// As by `piblocks log scene.toml >> scene.toml`.
TEST_F(AppendingTest, ToWhatIsReadIsRefused) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a.png"});
  const std::string before = contents("a.png");
  const CommandResult result =
      piblocks({"compare", "a.png", "a.png"},
               {.out_file = folder_ / "a.png", .out_flags = O_WRONLY | O_APPEND});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(contains(result.err, "standard output: would write over the reference"));
  EXPECT_EQ(contents("a.png"), before);
}

TEST_F(AppendingTest, ToTheSceneIsRefused) {
  write("scene.toml", kScene);
  for (const Arguments& arguments :
       {Arguments{"count", "scene.toml"}, Arguments{"log", "scene.toml"},
        Arguments{"state", "scene.toml", "--at", "1"}}) {
    const CommandResult result =
        piblocks(arguments, {.out_file = folder_ / "scene.toml", .out_flags = O_WRONLY | O_APPEND});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(contents("scene.toml"), kScene);
  }
}

/// Nothing is refused that does no harm.
TEST_F(AppendingTest, BesideWhatIsReadIsFine) {
  output_of({"still", "--size", "64x36", "--at", "1", "-o", "a/000001.png"});
  output_of({"compare", "a/000001.png", "a/000001.png", "--report", "a/r.html", "--junit", "r.xml",
             "--diff", "a/d"});
  output_of({"render", "--quiet", "--theme", "article", "--logo", "a/000001.png", "--size", "64x36",
             "--to", "1", "-o", "a/f%06d.png"});
  EXPECT_TRUE(fs::exists(folder_ / "a/f000001.png"));
}

}  // namespace
}  // namespace piblocks
