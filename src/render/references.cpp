#include "render/references.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

#include "core/output_file.hpp"
#include "core/stop.hpp"
#include "draw/canvas.hpp"
#include "render/film.hpp"
#include "render/renderings.hpp"

namespace piblocks {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSoftware = "#software: ";

/// An instant as a part of a file's name.
std::string file_part(std::string instant) {
  std::ranges::replace(instant, '/', '_');
  if (instant.starts_with('#')) instant = "collision-" + instant.substr(1);
  return instant;
}

View golden_view(View view, const Golden& golden) {
  if (golden.size) {
    view.width_px = golden.size->width_px;
    view.height_px = golden.size->height_px;
    return view;
  }
  constexpr int kLongerSide_px = 480;
  const int longer_px = std::max(view.width_px, view.height_px);
  if (longer_px <= kLongerSide_px) return view;
  // To the nearest pixel, and to an even number where the scene has one.
  const auto scaled = [&](int side_px) {
    const int step = side_px % 2 == 0 ? 2 : 1;
    const int divisor = step * longer_px;
    return std::max(step, (side_px * kLongerSide_px + divisor / 2) / divisor * step);
  };
  view.width_px = scaled(view.width_px);
  view.height_px = scaled(view.height_px);
  return view;
}

/// Where FFmpeg has this line: behind the name of the hash.
void add_fingerprint(const fs::path& hashes) {
  std::ifstream rendered(hashes, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(rendered), {});
  text.insert(text.find("#tb "), fmt::format("{}{}\n", kSoftware, painter_fingerprint()));
  OutputFile file(hashes);
  file.write(text);
  file.finish();
}

}  // namespace

References::References(std::string name, const ScriptBuilder& scene, fs::path folder)
    : name_(std::move(name)), folder_(std::move(folder)), script_(scene.build()) {
  if (name_.empty() || name_ == "." || name_ == "..") {
    throw UsageError(fmt::format("golden: references cannot have the name '{}'", name_));
  }
  std::visit(
      [](auto& any) {
        any.view = golden_view(any.view, any.golden);
        any.sound.on = false;  // pictures are what is kept
      },
      script_);
}

const Golden& References::golden() const {
  return std::visit([](const auto& any) -> const Golden& { return any.golden; }, script_);
}

std::vector<std::string> References::files() const {
  std::vector<std::string> files = {name_ + ".framehash"};
  for (const std::string& instant : golden().frames) {
    files.push_back(fmt::format("{}-{}.png", name_, file_part(instant)));
  }
  return files;
}

bool References::exist() const { return has(files().front()); }

bool References::has(const std::string& file) const {
  std::error_code error;
  const fs::file_status status = fs::status(path(file), error);
  if (status.type() == fs::file_type::none) {
    throw IoError(
        fmt::format("golden: cannot read '{}': {}", path(file).string(), error.message()));
  }
  if (!fs::exists(status)) return false;
  if (fs::is_regular_file(status)) return true;
  throw IoError(fmt::format("golden: cannot read '{}': it is no file", path(file).string()));
}

std::string References::fingerprint() const {
  std::ifstream file(path(files().front()));
  for (std::string line; std::getline(file, line) && line.starts_with('#');) {
    if (line.ends_with('\r')) line.pop_back();  // from an editor of another system
    if (line.starts_with(kSoftware)) return line.substr(kSoftware.size());
  }
  return {};
}

void References::draw(
    const std::vector<std::int64_t>& frames,
    const std::function<void(std::int64_t frame, std::vector<std::uint8_t> png)>& use,
    const std::stop_token& stop) const {
  if (frames.empty()) return;
  const Film film(script_, {FilmUse::pictures, stop});
  for (const std::int64_t frame : frames) {
    check_stop(stop);
    use(frame, draw_png(film.frame(frame), stop));
  }
}

void References::render_into(const fs::path& folder, int jobs, const OnProgress& on_progress,
                             const std::stop_token& stop) const {
  const std::vector<std::string> names = files();
  const fs::path hashes = folder / names.front();
  const RenderJob job{script_, hashes, {}, jobs};
  const Film film = film_of(job, stop);
  render_film(job, film, on_progress, stop);
  add_fingerprint(hashes);
  for (std::size_t i = 0; i < golden().frames.size(); ++i) {
    check_stop(stop);
    const DrawList picture = still_picture(film, parse_instant(golden().frames[i]));
    write_file(folder / names[i + 1], draw_png(picture, stop));
  }
}

}  // namespace piblocks
