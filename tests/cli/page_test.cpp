// render -o NAME.html: a page that holds the video; what it does is checked in a browser
// (tests/golden/check_page).
#include "cli/cli_fixture.hpp"
#include "core/text.hpp"

namespace piblocks {
namespace {

using PageTest = CliFixture;

const Arguments kRenderPage{"render", "--quiet", "--size", "64x36", "--fps", "24", "--to", "5"};

/// The base64 between the quotes of the page's video.
std::string video_of(const std::string& page) {
  const std::string start = "src=\"data:video/mp4;base64,";
  const std::size_t at = page.find(start) + start.size();
  return page.substr(at, page.find('"', at) - at);
}

TEST_F(PageTest, HoldsTheBytesOfTheMp4) {
  output_of(kRenderPage + Arguments{"-o", "a.html"});
  output_of(kRenderPage + Arguments{"-o", "a.mp4"});
  EXPECT_EQ(entries(), (Names{"a.html", "a.mp4"}));
  const std::string video = contents("a.mp4");
  const std::string text =
      base64({reinterpret_cast<const std::uint8_t*>(video.data()), video.size()});
  EXPECT_TRUE(video_of(contents("a.html")) == text);
}

TEST_F(PageTest, TakesSettingsOfTheEncoder) {
  output_of(kRenderPage + Arguments{"--encoder", "libx264", "--crf", "40", "-o", "a.html"});
  output_of(kRenderPage + Arguments{"-o", "b.html"});
  EXPECT_FALSE(video_of(contents("a.html")) == video_of(contents("b.html")));
}

TEST_F(PageTest, RefusesWhatAPageCannotBe) {
  EXPECT_EQ(refusal(kRenderPage + Arguments{"-o", "new/a.html", "--part", "1/2"}),
            "piblocks: part: there are no parts of page 'new/a.html'; render it whole, or the "
            "parts of an MP4\n");
  EXPECT_EQ(refusal(kRenderPage + Arguments{"-o", "new/a.html", "--transparent"}),
            "piblocks: output: 'new/a.html' cannot be transparent: a page shows an MP4; use "
            "an opaque background\n");
  EXPECT_EQ(refusal({"render", "--size", "65x37", "-o", "new/a.html"}),
            "piblocks: output: size 65x37 is odd: H.264 in 4:2:0 needs even sides; use 64x36\n");
}

TEST_F(PageTest, IsNotJoined) {
  output_of(kRenderPage + Arguments{"-o", "a.mp4", "--part", "1/1"});
  EXPECT_EQ(refusal({"join", "a.mp4.part-1-of-1", "-o", "a.html"}),
            "piblocks: join: 'a.html' cannot be made of parts; render the page whole\n");
}

TEST_F(PageTest, HoldsAStoryboard) {
  write("story.toml",
        "view = { size = '64x36', fps = 10 }\n[[part]]\ncard = 'Two <blocks>'\n"
        "seconds = 1\n[[part]]\ndigits = 1\ntime.to = 1\ntime.loop = true\n");
  output_of({"render", "story.toml", "--quiet", "-o", "a.html"});
  const std::string page = contents("a.html");
  EXPECT_TRUE(contains(page, "<title>Two &lt;blocks&gt;</title>"));
  EXPECT_TRUE(contains(page, "<track kind=\"chapters\""));
  EXPECT_TRUE(contains(page, "data-rate=\"10/1\" data-frames=\"28\" controls playsinline"));
  EXPECT_TRUE(
      contains(page, "<p id=\"description\">A film in 2 parts. Part 1. “Two &lt;blocks&gt;”"));
}

/// Another file beside the video makes it too large at once.
TEST_F(PageTest, IsGivenUpOnceItsVideoIsTooLarge) {
  RunningCommand command({"render", "--quiet", "--size", "320x180", "--to", "9999", "-o", "a.html"},
                         {.folder = folder_.path()});
  const auto has_begun = [&] {
    const Names names = entries();
    return !names.empty() && contains(names.back(), "video.mp4");
  };
  ASSERT_TRUE(wait_until(has_begun));
  const std::filesystem::path large = folder_ / (entries().front() + "/large");
  std::ofstream(large).flush();
  std::filesystem::resize_file(large, 400'000'001);
  const CommandResult result = command.wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(result.err.starts_with("piblocks: page: 'a.html' is too large after ")) << result.err;
  EXPECT_EQ(entries(), Names{});
}

TEST_F(PageTest, TextsAreEscaped) {
  output_of({"render", "--quiet", "--to", "1", "--fps", "10", "--title",
             "</title><script>alert(1)</script>", "-o", "a.html"});
  EXPECT_FALSE(contains(contents("a.html"), "alert(1)</script>"));
}

}  // namespace
}  // namespace piblocks
