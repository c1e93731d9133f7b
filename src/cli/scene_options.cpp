#include "cli/scene_options.hpp"

#include <fmt/format.h>

#include <map>

namespace piblocks::cli {
namespace {

int parse_digits(const std::string& text) {
  const Rational value = parse_rational(text);
  if (value.get_den() != 1 || value < 1 || value > kMaxDigits) {
    throw UsageError(fmt::format("must be a whole number from 1 to {}", kMaxDigits));
  }
  return static_cast<int>(value.get_num().get_si());
}

Rational parse_mass_ratio(const std::string& text) {
  const Rational value = parse_rational(text);
  if (value <= 0) throw UsageError("must be greater than 0");
  return value;
}

}  // namespace

void SceneOptions::add_system(CLI::App& command) {
  command.add_option("scene", file_, "Scene file (TOML); without it, the article's scene")
      ->type_name("SCENE.toml");
  auto* digits = command.add_option("--digits", digits_,
                                    "Count this many digits of pi: m_red = 100^(D-1) m_blue");
  digits->type_name("D");
  command.add_option("--mass-ratio", mass_ratio_, "m_red / m_blue, exactly: 16, 2.5, 1/3, 100^7")
      ->type_name("R")
      ->excludes(digits);
}

void SceneOptions::add_key(CLI::App& command, const std::string& option, const std::string& key,
                           const std::string& help) {
  keys_.push_back(std::make_unique<KeyOption>(KeyOption{option, key, {}, false}));
  KeyOption& slot = *keys_.back();
  command
      .add_option_function<std::string>(
          option,
          [&slot](const std::string& text) {
            slot.text = text;
            slot.given = true;
          },
          help)
      ->type_name("");
}

void SceneOptions::add_size(CLI::App& command) {
  add_key(command, "--size", "view.size", "Frame size in pixels, WxH (default 1920x1080)");
}

void SceneOptions::add_timing(CLI::App& command) {
  add_key(command, "--fps", "view.fps", "Frames per second, N or N/D (default 60)");
  add_key(command, "--from", "time.from", "First instant shown, in simulation time (default 0)");
  add_key(command, "--to", "time.to",
          "End: a time, 'last' (collision) or 'last+S' (default last+1.5)");
  add_key(command, "--speed", "time.speed", "Simulation time per second of video (default 1)");
}

Scene SceneOptions::scene() const {
  SceneBuilder builder;
  if (!file_.empty()) builder.read_file(file_);
  for (const auto& key : keys_) {
    if (key->given) builder.set(key->option, key->key, key->text);
  }
  if (!mass_ratio_.empty()) {
    builder.set_mass_ratio("--mass-ratio",
                           parse_option("--mass-ratio", mass_ratio_, parse_mass_ratio));
  }
  if (!digits_.empty()) {
    const int digits = parse_option("--digits", digits_, parse_digits);
    builder.set_mass_ratio("--digits", power(100, static_cast<unsigned long>(digits - 1)));
  }
  return builder.build();
}

void add_engine(CLI::App& command, Engine& engine) {
  static const std::map<std::string, Engine> kEngines{{"unfolded", Engine::unfolded},
                                                      {"events", Engine::events}};
  command
      .add_option("--engine", engine,
                  "unfolded: closed form (default); events: the event loop, in double precision")
      ->transform(CLI::CheckedTransformer(kEngines).description(""))
      ->type_name("NAME");
}

}  // namespace piblocks::cli
