#include "accuracy/report.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace piblocks::benchmark {
namespace {

std::string name(Question question) {
  switch (question) {
    case Question::whole_log:
      return "whole log";
    case Question::instants:
      return "instants";
    case Question::count:
      return "count";
  }
  return {};
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : std::string();
}

std::string cell(std::string text) {
  std::ranges::replace(text, ',', ';');
  std::ranges::replace(text, '\n', ' ');
  return text;
}

}  // namespace

std::string Circumstances::fields() const {
  return fmt::format("{},{},{},GCC {}", date, cell(commit), cell(cpu), __VERSION__);
}

std::string Circumstances::today() {
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
}

std::string Circumstances::cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

void print_header() {
  fmt::print(
      "date,commit,cpu,compiler,question,method,scalar,parameter,digits,events,seconds,"
      "ns_per_event,worst_time_error,worst_position_error,count,count_right,note\n");
}

void print_row(const Circumstances& circumstances, Question question, const Label& label,
               const ReferenceRun& reference, const Measurement& measured) {
  std::optional<double> ns_per_event;
  if (measured.seconds && question != Question::instants) {
    ns_per_event = *measured.seconds * 1e9 / static_cast<double>(reference.count);
  }
  std::string count;
  std::string right;
  if (measured.count) {
    count = measured.count->get_str();
    right = *measured.count == reference.count ? "yes" : "no";
  }
  fmt::print("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", circumstances.fields(), name(question),
             cell(label.method), cell(label.scalar), cell(label.parameter), reference.digits,
             reference.count, cell(measured.seconds), cell(ns_per_event),
             cell(measured.worst_time_error), cell(measured.worst_position_error), count, right,
             cell(measured.note));
  std::fflush(stdout);
}

}  // namespace piblocks::benchmark
