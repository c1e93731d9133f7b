#include "accuracy/report.hpp"

#include <fmt/format.h>

#include <cstdio>

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

}  // namespace

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
             csv_text(label.method), csv_text(label.scalar), csv_text(label.parameter),
             reference.digits, reference.count, cell(measured.seconds), cell(ns_per_event),
             cell(measured.worst_time_error), cell(measured.worst_position_error), count, right,
             csv_text(measured.note));
  std::fflush(stdout);
}

}  // namespace piblocks::benchmark
