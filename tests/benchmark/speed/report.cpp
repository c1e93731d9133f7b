#include "speed/report.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <thread>

namespace piblocks::benchmark {
namespace {

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : std::string();
}

}  // namespace

void print_header() {
  fmt::print(
      "date,commit,cpu,compiler,processors,group,series,value,name,version,frames,runs,seconds,"
      "least_seconds,greatest_seconds,frames_per_second,cpu_seconds,peak_MB,output_MB,ratio,least_"
      "ratio,greatest_ratio,psnr_dB,least_psnr_dB,ssim\n");
}

void print_row(const Circumstances& circumstances, const Subject& subject, const Result& result) {
  std::optional<double> frames_per_second;
  if (result.seconds) frames_per_second = static_cast<double>(subject.frames) / *result.seconds;
  fmt::print("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
             circumstances.fields(), std::thread::hardware_concurrency(), subject.group,
             subject.series, subject.value, csv_text(subject.name), csv_text(subject.version),
             subject.frames, result.runs, cell(result.seconds), cell(result.least_seconds),
             cell(result.greatest_seconds), cell(frames_per_second), cell(result.cpu_seconds),
             cell(result.peak_MB), cell(result.output_MB), cell(result.ratio),
             cell(result.least_ratio), cell(result.greatest_ratio), cell(result.quality.psnr_dB),
             cell(result.quality.least_psnr_dB),
             result.quality.ssim ? fmt::format("{:.6f}", *result.quality.ssim) : std::string());
  std::fflush(stdout);
}

void print_skipped(const std::string& name, const std::string& reason) {
  fmt::print(stderr, "speed_benchmark: {} is left out: {}\n", name, reason);
}

}  // namespace piblocks::benchmark
