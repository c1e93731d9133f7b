// A program of somebody else's that renders with the library.
// In: a folder. Out: the count on standard output; frame.png and video.mp4 in the folder.
#include <piblocks/collision_log.hpp>
#include <piblocks/event_simulator.hpp>
#include <piblocks/png.hpp>
#include <piblocks/render.hpp>
#include <piblocks/script_builder.hpp>
#include <piblocks/version.hpp>

#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

piblocks::Scene small_scene() {
  piblocks::ScriptBuilder builder;
  builder.set("consumer", "view.size", "320x180");
  builder.set("consumer", "view.fps", "20");
  return builder.build_scene();
}

void write_last_frame(const piblocks::Scene& scene, const std::string& path) {
  piblocks::FrameRenderer renderer(scene);
  const piblocks::ImageView frame = renderer.frame(renderer.frame_count() - 1);
  const std::vector<std::uint8_t> png = piblocks::encode_png(frame);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
}

/// The blocks as balls on a line, for the part of the interface that is templates.
std::size_t simulated_count() {
  using Body = piblocks::Particle<double, 1>;
  const auto at = [](double x) { return Body::Vector::Constant(x); };
  piblocks::EventSimulator<double, 1> simulator({
      {1, 0.5, at(2), at(0)},
      {10000, 0.5, at(5), at(-1)},
      {piblocks::kInfiniteMass<double>, 0.5, at(-0.5), at(0)},
  });
  return simulator.run(1000).size();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string folder = argc == 2 ? argv[1] : ".";
    const piblocks::Scene scene = small_scene();
    write_last_frame(scene, folder + "/frame.png");
    piblocks::render({scene, folder + "/video.mp4"}, [](const piblocks::Progress&) {});
    std::cout << "piblocks " << piblocks::kVersion << ": "
              << piblocks::count_collisions(scene.system) << ' ' << simulated_count() << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "consumer: " << error.what() << '\n';
    return 1;
  }
}
