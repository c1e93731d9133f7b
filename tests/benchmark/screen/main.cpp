// The screen benchmark: the H.264 library against others on the windows of other programs.
// In: options. Out: CSV on standard output; README.md of this folder says what it means.
#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <piblocks/error.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "circumstances.hpp"
#include "median.hpp"
#include "screen/measure.hpp"

namespace piblocks::benchmark {
namespace {

struct Settings {
  std::string commit = "unknown";
  std::string only;
  std::string pictures_folder;
  int rounds = 5;
  std::vector<int> qps = {14, 26};
};

/// A contender at a quantiser, and what its runs came to.
struct Entry {
  const Contender* contender;
  Match match;
  std::size_t bytes = 0;
  int coarser_pictures = 0;
  std::vector<double> cpu_s = {};
  std::vector<double> ratios = {};  ///< to the first entry's time of the same round
};

std::vector<Contender> all_contenders() {
  std::vector<Contender> contenders = piblocks_contenders();
  for (Contender& contender : x264_contenders()) contenders.push_back(std::move(contender));
  if (auto openh264 = openh264_contender()) {
    contenders.push_back(std::move(*openh264));
  } else {
    fmt::print(stderr,
               "screen_benchmark: openh264 is left out: libopenh264-dev was not there when "
               "this was built\n");
  }
  return contenders;
}

/// The first contender at `qp`, the others at its PSNR.
std::vector<Entry> match_all(const std::vector<Contender>& contenders, int qp,
                             const Recording& recording) {
  std::vector<Entry> entries;
  for (const Contender& contender : contenders) {
    if (!entries.empty() && contender.has_qp) {
      entries.push_back({&contender, nearest_match(contender, entries.front().match, recording)});
    } else {
      entries.push_back({&contender, {qp, fidelity(encode(contender, qp, recording), recording)}});
    }
  }
  return entries;
}

/// All in turn, so that what else the machine does in a round slows none of them alone.
void run_rounds(std::vector<Entry>& entries, int rounds, const Recording& recording) {
  for (int round = 0; round < rounds; ++round) {
    for (Entry& entry : entries) {
      const Stream stream = encode(*entry.contender, entry.match.qp, recording);
      entry.bytes = size_bytes(stream);
      entry.coarser_pictures = stream.coarser_pictures;
      entry.cpu_s.push_back(stream.cpu_s / kPictures);
      entry.ratios.push_back(entry.cpu_s.back() / entries.front().cpu_s.back());
    }
  }
}

void print_header() {
  fmt::print(
      "date,commit,cpu,compiler,processors,material,size,pictures,changed_share,reference_qp,name,"
      "version,settings,qp,runs,cpu_seconds,least_cpu_seconds,greatest_cpu_seconds,bytes,coarser_"
      "pictures,psnr_dB,"
      "least_psnr_dB,ratio,least_ratio,greatest_ratio\n");
}

void print_entry(const Settings& settings, const Material& material, const Recording& recording,
                 int reference_qp, const Entry& entry) {
  const Contender& contender = *entry.contender;
  fmt::print(
      "{},{},{},{}x{},{},{:.4g},{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{},{},{:.2f},{:.2f},"
      "{:.4g},{:.4g},{:.4g}\n",
      Circumstances{.commit = settings.commit}.fields(), std::thread::hardware_concurrency(),
      material.name, kScreenWidth_px, kScreenHeight_px, kPictures, recording.changed_share,
      reference_qp, csv_text(contender.name), csv_text(contender.version),
      csv_text(contender.settings), contender.has_qp ? std::to_string(entry.match.qp) : "",
      entry.cpu_s.size(), median(entry.cpu_s).value_or(0), std::ranges::min(entry.cpu_s),
      std::ranges::max(entry.cpu_s), entry.bytes, entry.coarser_pictures,
      entry.match.fidelity.psnr_dB, entry.match.fidelity.least_psnr_dB,
      median(entry.ratios).value_or(0), std::ranges::min(entry.ratios),
      std::ranges::max(entry.ratios));
  std::fflush(stdout);
}

void save_pictures(const Material& material, const std::string& folder) {
  constexpr int kBetween = 40;
  Screen screen;
  const auto application = material.start();
  for (int number = 0; number < kPictures; ++number) {
    application->draw(screen, number);
    if (number % kBetween == kBetween / 2) {
      screen.save_png(fmt::format("{}/{}-{:03}.png", folder, material.name, number));
    }
  }
}

void run(const Settings& settings) {
  const std::vector<Contender> contenders = all_contenders();
  if (settings.pictures_folder.empty()) print_header();
  for (const Material& material : kMaterials) {
    if (!settings.only.empty() && settings.only != material.name) continue;
    if (!settings.pictures_folder.empty()) {
      save_pictures(material, settings.pictures_folder);
      continue;
    }
    const Recording recording = record(material);
    for (const int qp : settings.qps) {
      std::vector<Entry> entries = match_all(contenders, qp, recording);
      run_rounds(entries, settings.rounds, recording);
      for (const Entry& entry : entries) print_entry(settings, material, recording, qp, entry);
    }
  }
}

}  // namespace
}  // namespace piblocks::benchmark

int main(int argc, char** argv) {
  piblocks::benchmark::Settings settings;
  CLI::App app("Measures H.264 encoders on windows of programs and prints CSV.");
  app.add_option("--commit", settings.commit, "Name of the version, for the table");
  app.add_option("--rounds", settings.rounds, "Rounds over all encoders")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--qp", settings.qps, "The library's quantisers")->capture_default_str();
  app.add_option("--only", settings.only,
                 "Measure one material: terminal, plot, slides, editor or drawing")
      ->check(CLI::IsMember({"terminal", "plot", "slides", "editor", "drawing"}));
  app.add_option("--pictures", settings.pictures_folder,
                 "Measure nothing; write some pictures of each material as PNG to this folder")
      ->check(CLI::ExistingDirectory);
  CLI11_PARSE(app, argc, argv);
  try {
    piblocks::benchmark::run(settings);
  } catch (const std::exception& error) {
    fmt::print(stderr, "screen_benchmark: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
