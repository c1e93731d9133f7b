// Films as vector files: the pages of a PDF, and numbered SVG files.
#include <gtest/gtest.h>
#include <piblocks/error.hpp>
#include <piblocks/render.hpp>

#include <algorithm>

#include "draw/canvas.hpp"
#include "render/film.hpp"
#include "rendered_parts.hpp"
#include "support/pdf_pages.hpp"
#include "support/script_of.hpp"
#include "support/temporary_folder.hpp"

namespace piblocks {
namespace {
using testing_support::file_contents;
using testing_support::TemporaryFolder;

/// A card, and a run with motion blur and a diagram. Both stand still for a while.
Script script() {
  return testing_support::script_of(
      "view.size = '320x180'\nview.fps = 5\nview.theme = 'lecture'\n[[part]]\ncard = 'a'\nseconds "
      "= 2\n"
      "[[part]]\ndigits = 2\nshow.panels = ['velocity']\ntime.duration = 3\n");
}

class VectorFilmTest : public testing::Test {
 protected:
  std::string render_to(const std::string& name, const RenderJob& job) const {
    RenderJob named = job;
    named.output = folder_ / name;
    named.jobs = 3;
    render_silently(named);
    return named.output;
  }

  TemporaryFolder folder_;
  RenderJob job_{script(), {}};
  Film film_{script()};
};

TEST_F(VectorFilmTest, EachSvgFileIsTheFrameWithAMark) {
  render_to("f/%03d.svg", job_);
  const auto files = files_in(folder_ / "f");
  ASSERT_EQ(std::int64_t(files.size()), film_.frame_count());
  const std::string mark = "<!-- Software: piblocks render -->\n";
  std::int64_t number = 0;
  for (const auto& [name, contents] : files) {
    std::string text = contents;
    const std::size_t at = text.find(mark);
    ASSERT_NE(at, std::string::npos);
    text.erase(at, mark.size());
    const auto expected = draw_svg(film_.frame(number++));
    EXPECT_TRUE(std::ranges::equal(text, expected, [](char a, std::uint8_t b) {
      return std::uint8_t(a) == b;
    })) << name;
  }
  job_.frames = {3, 8};
  folder_.save("f/004.svg", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + mark);
  render_to("f/%03d.svg", job_);
  EXPECT_TRUE(files_in(folder_ / "f") == files);
  folder_.save("f/004.svg", "mine");
  EXPECT_THROW(render_to("f/%03d.svg", job_), UsageError);
}

TEST_F(VectorFilmTest, APdfFileHasAPageForEachFrame) {
  const std::string whole = file_contents(render_to("a.pdf", job_));
  EXPECT_TRUE(whole == file_contents(render_to("b.pdf", job_)));
  EXPECT_EQ(testing_support::pages_of_pdf(whole), film_.frame_count());
  for (const std::int64_t number : {std::int64_t{0}, film_.frame_count() - 1}) {
    job_.frames = {number, number};
    const auto page = draw_pdf(film_.frame(number));
    EXPECT_TRUE(file_contents(render_to("page.pdf", job_)) ==
                std::string(page.begin(), page.end()));
  }
  job_.frames = {};
  job_.shard = {1, 2};
  EXPECT_THROW(render_to("a.pdf", job_), UsageError);
}

TEST_F(VectorFilmTest, SaysThatNothingIsBlurred) {
  const Rendered rendered = render_silently({script(), folder_ / "a.pdf"});
  ASSERT_EQ(rendered.notes.size(), 1U);
  EXPECT_TRUE(rendered.notes.front().ends_with("has no motion blur: moving bodies are sharp"));
}

}  // namespace
}  // namespace piblocks
