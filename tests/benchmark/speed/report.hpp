// The results as CSV, each row with all that is needed to judge it.
// In: rows. Out: lines on standard output.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "circumstances.hpp"

namespace piblocks::benchmark {

/// What is measured.
struct Subject {
  std::string group;    ///< job, encoders, png, stages, scaling
  std::string series;   ///< rows that are compared with each other
  std::string value;    ///< what varies in the series: threads, digits, a frame size
  std::string name;     ///< of the program, or of the stage
  std::string version;  ///< of the program or library that does the work
  std::int64_t frames = 0;
};

/// How near a video is to what was drawn, in 4:2:0.
struct Quality {
  std::optional<double> psnr_dB = {};        ///< of all samples of all frames
  std::optional<double> least_psnr_dB = {};  ///< of the worst frame
  std::optional<double> ssim = {};           ///< of all planes
};

/// What it came to; medians, where nothing else is said.
struct Result {
  int runs = 0;
  std::optional<double> seconds = {};
  std::optional<double> least_seconds = {};
  std::optional<double> greatest_seconds = {};
  std::optional<double> cpu_seconds = {};
  std::optional<double> peak_MB = {};
  std::optional<double> output_MB = {};
  Quality quality = {};
  /// Seconds a frame, as a multiple of the series' first row in the same round.
  std::optional<double> ratio = {};
  std::optional<double> least_ratio = {};
  std::optional<double> greatest_ratio = {};
};

void print_header();
void print_row(const Circumstances& circumstances, const Subject& subject, const Result& result);
/// What was left out, and why: on standard error.
void print_skipped(const std::string& name, const std::string& reason);

}  // namespace piblocks::benchmark
