#include "speed/workbench.hpp"

#include <fmt/format.h>
#include <piblocks/run.hpp>
#include <piblocks/scene.hpp>

#include "scene/schedule.hpp"

namespace piblocks::benchmark {
namespace fs = std::filesystem;

void Workbench::renew_output() const {
  const fs::path path = folder.path() / "output";
  for (int number = 0; fs::exists(path); ++number) {
    const fs::path old = folder.path() / fmt::format("output-{}", number);
    if (!fs::exists(old)) fs::rename(path, old);
  }
  fs::create_directory(path);
}

void Workbench::remove_outputs() const {
  fs::remove_all(folder.path() / "output");
  for (int number = 0;; ++number) {
    const fs::path old = folder.path() / fmt::format("output-{}", number);
    if (fs::remove_all(old) == 0) return;
  }
}

double Workbench::output_MB() const {
  double bytes = 0;
  for (const auto& file : fs::directory_iterator(folder.path() / "output")) {
    bytes += static_cast<double>(file.file_size());
  }
  return bytes / 1e6;
}

Command Workbench::render(int digits, const std::string& output) const {
  return {program, "render", "--digits", std::to_string(digits), "-o", output};
}

std::string Workbench::program_version() const {
  return last_line(runner.run({program, "--version"}).out);
}

Command ffmpeg_ultrafast(const std::string& y4m, const std::string& output) {
  return {"ffmpeg",    "-y",         "-loglevel",    "error",
          "-i",        y4m,          "-c:v",         "libx264",
          "-preset",   "ultrafast",  "-qp",          "14",
          "-g",        "60",         "-x264-params", "mbtree=0:scenecut=0",
          "-movflags", "+faststart", output};
}

std::int64_t article_frames(int digits, const std::string& to, int frames_per_s) {
  Scene scene;
  scene.view.frame_rate = frames_per_s;
  scene.system = article_system(digits);
  scene.time.to = parse_instant(to);
  return film_frames(make_schedule(scene, *make_collision_log(scene.system)));
}

}  // namespace piblocks::benchmark
