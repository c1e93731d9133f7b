// What 'golden' of a folder accepts: options that it keeps beside the references.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "cli/golden_folder.hpp"
#include "cli/tolerance_options.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "core/text.hpp"
#include "draw/canvas.hpp"

namespace piblocks::cli {
namespace fs = std::filesystem;
namespace {

/// Beside the references: comments, of which one says what paints on this machine, and options.
constexpr const char* kSettings = "piblocks-golden.txt";
constexpr const char* kVersions = "# recorded with ";

constexpr std::string_view kMask = "--mask";

/// Whether there is any of the options but masks.
bool has_tolerance(const Command& command) {
  return std::ranges::any_of(kToleranceOptions, [&](const ToleranceOption& option) {
    return option.name != kMask && command.is_given(option.name);
  });
}

/// A mask, with the path changed of the picture that it may be.
template <typename Change>
std::string with_path(const std::string& mask, const Change& change) {
  if (!has_ending(mask, ".png")) return mask;
  const std::size_t begin = mask.rfind(':') + 1;  // 0 if there is no colon
  return mask.substr(0, begin) + change(fs::path(mask.substr(begin))).string();
}

}  // namespace

std::string library_versions() {
  const std::string all = painter_fingerprint();
  return all.substr(0, all.find(", fonts"));
}

GoldenSettings::GoldenSettings(const Command& given, const fs::path& references)
    : given_(given), path_(references / kSettings), replaces_(has_tolerance(given)) {
  for (const std::string& line : lines_of(path_, "golden")) read(line);
  relative_to_references(given.texts("--mask"));
}

void GoldenSettings::apply_to(ComparisonJob& job) const {
  read_tolerance(given_, job);
  ComparisonJob kept;
  try {
    read_tolerance(kept_, kept);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("golden: '{}': {}", path_.string(), error.what()));
  }
  if (!replaces_) job.tolerance = kept.tolerance;
  for (Mask& mask : kept.masks) {
    mask.must_hide = false;
    job.masks.push_back(std::move(mask));
  }
}

std::vector<std::string> GoldenSettings::texts(const std::string& option) const {
  std::vector<std::string> all = given_.texts(option);
  if (replaces_ && option != kMask) return all;
  const std::vector<std::string> kept = kept_.texts(option);
  all.insert(all.end(), kept.begin(), kept.end());
  return all;
}

void GoldenSettings::write(Versions versions, const std::set<std::string>& removed) const {
  const bool is_here = versions == Versions::of_this_machine;
  std::vector<std::string> lines = comments_;
  if (is_here || !versions_.empty()) {
    lines.insert(lines.begin(), kVersions + (is_here ? library_versions() : versions_));
  }
  for (const ToleranceOption& option : kToleranceOptions) {
    std::vector<std::string> values = texts(option.name);
    if (option.name == kMask) {
      values = relative_to_references(std::move(values));
      std::erase_if(values, [&](const std::string& mask) {
        const std::size_t end = mask.rfind(':');
        return end != std::string::npos && removed.contains(mask.substr(0, end));
      });
    }
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    for (const std::string& value : values) {
      lines.push_back(option.name + (option.has_value ? "=" + value : ""));
    }
  }
  const std::string text = fmt::format("{}{}", fmt::join(lines, "\n"), lines.empty() ? "" : "\n");
  write_file(path_.string(), {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void GoldenSettings::read(const std::string& line) {
  if (line.starts_with(kVersions)) {
    versions_ = line.substr(std::string_view(kVersions).size());
    return;
  }
  if (line.starts_with('#')) comments_.push_back(line);
  if (line.empty() || line.starts_with('#')) return;
  const std::size_t end = line.find('=');
  const std::string name = line.substr(0, end);
  const auto* const option = std::ranges::find(kToleranceOptions, name, &ToleranceOption::name);
  if (option == kToleranceOptions.end()) {
    throw UsageError(
        fmt::format("golden: '{}' has '{}'; it may have options such as "
                    "--max-delta=3; 'piblocks golden check --help' has all",
                    path_.string(), shortened(line)));
  }
  const bool has_value = end != std::string::npos;
  if (has_value != option->has_value) {
    throw UsageError(fmt::format("golden: '{}' has '{}'; {} has {}", path_.string(),
                                 shortened(line), name, has_value ? "no value" : "a value"));
  }
  std::string value = has_value ? line.substr(end + 1) : "true";
  if (name == kMask) {
    value = with_path(value, [this](const fs::path& path) { return path_.parent_path() / path; });
  } else if (kept_.is_given(name)) {
    throw UsageError(fmt::format("golden: '{}' has {} twice", path_.string(), name));
  }
  kept_.add(name, value);
}

std::vector<std::string> GoldenSettings::relative_to_references(
    std::vector<std::string> masks) const {
  const fs::path folder = path_.parent_path();
  for (std::string& mask : masks) {
    if (mask.find('\n') != std::string::npos) {
      throw UsageError(
          fmt::format("golden: the mask '{}' has an end of line in its name, and cannot be kept",
                      printable(mask)));
    }
    mask = with_path(mask, [&](const fs::path& path) {
      if (!lies_in(path, folder)) return fs::proximate(path, folder);
      throw UsageError(fmt::format(
          "golden: the mask '{}' is in the folder of the references, where it would count as "
          "one; put it elsewhere",
          path.string()));
    });
  }
  return masks;
}

}  // namespace piblocks::cli
