#include "speed/workbench.hpp"

#include <piblocks/collision_log.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/timeline.hpp>

namespace piblocks::benchmark {

void Workbench::clear_output() const {
  const std::filesystem::path path = folder.path() / "output";
  std::filesystem::remove_all(path);
  std::filesystem::create_directory(path);
}

double Workbench::output_MB() const {
  double bytes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder.path() / "output")) {
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

std::int64_t article_frames(int digits, const std::string& to) {
  Scene scene;
  scene.system = article_system(digits);
  scene.time.to = parse_end(to);
  return Timeline(scene, *make_collision_log(scene.system)).frame_count();
}

}  // namespace piblocks::benchmark
