#include "render/slides.hpp"

#include <fmt/format.h>

#include <vector>

#include "core/text.hpp"
#include "render/captions.hpp"
#include "render/video_text.hpp"

namespace piblocks {
namespace {

constexpr std::string_view kPreamble =
    R"(% In the preamble: \usepackage{graphicx} \usepackage{multimedia}
% A viewer that plays no videos shows the )";

/// As large as fits below a title, at any shape of slide and film. Without a width of its own,
/// \movie is as large as the poster.
constexpr std::string_view kMovie = R"(\centering
\movie[{options}]{{%
  \includegraphics[width=\textwidth,height={height}\textheight,keepaspectratio]{{{poster}}}}}{{{name}}}
)";

/// reveal.js sizes the video by r-stretch, and plays it when the slide is shown. Controls would
/// stay over the last picture of a shot.
constexpr std::string_view kSection = R"(<section{transition}>
  <video class="r-stretch" data-autoplay {controls}{loop}playsinline preload="metadata"{poster}
         aria-label="{alt}">
    <source src="{name}" type="video/mp4">
    <track kind="captions" srclang="en" label="English" src="{captions}">
  </video>
</section>
)";

/// Slides of the film's shape, in centimetres. Without office:styles, LibreOffice would give all
/// slides its own size.
constexpr std::string_view kImpressHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<office:document xmlns:office="urn:oasis:names:tc:opendocument:xmlns:office:1.0"
  xmlns:style="urn:oasis:names:tc:opendocument:xmlns:style:1.0"
  xmlns:draw="urn:oasis:names:tc:opendocument:xmlns:drawing:1.0"
  xmlns:svg="urn:oasis:names:tc:opendocument:xmlns:svg-compatible:1.0"
  xmlns:fo="urn:oasis:names:tc:opendocument:xmlns:xsl-fo-compatible:1.0"
  xmlns:xlink="http://www.w3.org/1999/xlink"
  office:version="1.3" office:mimetype="application/vnd.oasis.opendocument.presentation">
<office:styles/>
<office:automatic-styles><style:page-layout style:name="slide">
<style:page-layout-properties fo:page-width="{width}" fo:page-height="{height}" fo:margin="0cm"/>
</style:page-layout></office:automatic-styles>
<office:master-styles><style:master-page style:name="shots" style:page-layout-name="slide"/></office:master-styles>
<office:body><office:presentation>
)";

/// The last picture lies behind the video, for programs that cannot play it.
constexpr std::string_view kImpressSlide =
    R"(<draw:page draw:name="{number}" draw:master-page-name="shots">
<draw:frame svg:width="{width}" svg:height="{height}"><draw:image xlink:href="{picture}"/></draw:frame>
<draw:frame svg:width="{width}" svg:height="{height}">
<draw:plugin xlink:href="{name}" xlink:type="simple" draw:mime-type="application/vnd.sun.star.media"/>
<svg:desc>{alt}</svg:desc></draw:frame>
</draw:page>
)";

}  // namespace

std::string shot_name(const std::string& video, std::size_t number, std::string_view ending) {
  return fmt::format("{}-{:02}{}", video.substr(0, video.rfind('.')), number, ending);
}

std::string_view beginning_of_latex() { return kPreamble; }

std::string latex_slides(const Film& film, const std::string& video) {
  const std::size_t count = film.segments().size();
  std::string text(kPreamble);
  if (count == 1) {
    return text + "poster.\n" +
           fmt::format(kMovie, fmt::arg("options", "showcontrols"), fmt::arg("height", "0.8"),
                       fmt::arg("poster", "poster.png"), fmt::arg("name", video));
  }
  text +=
      "last picture of a shot. impress.fodp has the same slides,\n% chapters.vtt is for the whole "
      "video.\n";
  for (std::size_t i = 1; i <= count; ++i) {
    text += "\\begin{frame}[plain]\n" +
            fmt::format(kMovie, fmt::arg("options", "autostart,showcontrols"),
                        fmt::arg("height", ""), fmt::arg("poster", shot_name(video, i, ".png")),
                        fmt::arg("name", shot_name(video, i, ".mp4"))) +
            "\\end{frame}\n";
  }
  return text;
}

std::string reveal_slides(const Film& film, const std::string& video) {
  const std::size_t count = film.segments().size();
  const auto section = [&](const std::string& name, const std::string& poster,
                           const std::string& alt, const std::string& captions) {
    return fmt::format(
        kSection, fmt::arg("name", name),
        fmt::arg("poster", poster.empty() ? "" : fmt::format(" poster=\"{}\"", poster)),
        fmt::arg("alt", escaped(alt)), fmt::arg("captions", data_address("text/vtt", captions)),
        fmt::arg("controls", count == 1 ? "controls " : ""), fmt::arg("loop", loop_attribute(film)),
        fmt::arg("transition", count == 1 ? "" : " data-transition=\"none\""));
  };
  if (count == 1) return section(video, "poster.png", describe_film(film), captions(film));
  const std::vector<std::string> alts = describe_segments(film);
  const std::vector<std::string> said = shot_captions(film);
  std::string text;
  for (std::size_t i = 1; i <= count; ++i) {
    const std::string poster = i == 1 ? "" : shot_name(video, i - 1, ".png");
    text += section(shot_name(video, i, ".mp4"), poster, alts[i - 1], said[i - 1]);
  }
  return text;
}

std::string impress_slides(const Film& film, const std::string& video) {
  const std::string width = "28cm";
  const std::string height =
      fmt::format("{:.3f}cm", 28.0 * film.view().height_px / film.view().width_px);
  const std::vector<std::string> alts = describe_segments(film);
  std::string text =
      fmt::format(kImpressHead, fmt::arg("width", width), fmt::arg("height", height));
  for (std::size_t i = 1; i <= film.segments().size(); ++i) {
    text += fmt::format(
        kImpressSlide, fmt::arg("number", i), fmt::arg("width", width), fmt::arg("height", height),
        fmt::arg("picture", shot_name(video, i, ".png")),
        fmt::arg("name", shot_name(video, i, ".mp4")), fmt::arg("alt", escaped(alts[i - 1])));
  }
  return text + "</office:presentation></office:body></office:document>\n";
}

}  // namespace piblocks
