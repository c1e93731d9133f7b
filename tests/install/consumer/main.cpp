// A program of another project that renders with the library.
// In: a folder. Out: the count on standard output; frame.png and video.mov in the folder.
#include <piblocks/piblocks.hpp>

#include <exception>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  try {
    const std::string folder = argc == 2 ? argv[1] : ".";
    piblocks::ScriptBuilder builder;
    builder.set("consumer", "view.size", "320x180");
    builder.set("consumer", "view.fps", "20");
    const piblocks::Scene scene = builder.build_scene();

    piblocks::FrameRenderer renderer(scene);
    const auto png = piblocks::encode_png(renderer.frame(renderer.frame_count() - 1));
    std::ofstream(folder + "/frame.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), std::ssize(png));
    piblocks::render({scene, folder + "/video.mov"}, [](const piblocks::Progress&) {});
    std::cout << "piblocks " << piblocks::kVersion << ": "
              << piblocks::count_collisions(scene.system) << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "consumer: " << error.what() << '\n';
    return 1;
  }
}
