#include "cli/golden_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

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
constexpr std::string_view kVersions = "# recorded with ";

bool is_tolerance_option(const std::string& name) {
  return std::ranges::any_of(kToleranceOptions, [&](const char* one) { return one == name; });
}

/// Whether the option has no value.
bool is_flag(const std::string& name) {
  return name == "--count-antialiasing" || name == "--ignore-transparent";
}

/// Whether there is any of the options but masks.
bool has_tolerance(const Command& command) {
  return std::ranges::any_of(kToleranceOptions, [&](const std::string& name) {
    return name != "--mask" && command.is_given(name);
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

std::vector<std::string> lines_of(const fs::path& path) {
  std::error_code error;
  if (fs::status(path, error).type() == fs::file_type::not_found) return {};
  refuse_pipe(path, "golden");
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.ends_with('\r')) line.pop_back();  // written or checked out on Windows
    lines.push_back(line);
  }
  if (file.bad() || !file.eof()) {
    throw IoError(fmt::format("golden: cannot read '{}'", path.string()));
  }
  return lines;
}

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::relative(fs::weakly_canonical(path, error), folder, error);
  return !error && !relative.empty() && *relative.begin() != "..";
}

GoldenSettings::GoldenSettings(const Command& given, const fs::path& references)
    : given_(given), path_(references / kSettings), replaces_(has_tolerance(given)) {
  for (const std::string& line : lines_of(path_)) read(line);
  from_references(given.texts("--mask"));
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
  if (replaces_ && option != "--mask") return all;
  const std::vector<std::string> kept = kept_.texts(option);
  all.insert(all.end(), kept.begin(), kept.end());
  return all;
}

void GoldenSettings::write(Versions versions, const std::set<std::string>& removed) const {
  const bool is_here = versions == Versions::of_this_machine || versions_.empty();
  std::string text = fmt::format("{}{}\n", kVersions, is_here ? library_versions() : versions_);
  for (const std::string& comment : comments_) text += comment + '\n';
  for (const std::string option : kToleranceOptions) {
    std::vector<std::string> values = texts(option);
    if (option == "--mask") values = from_references(values);
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    std::erase_if(values, [&](const std::string& value) {
      const std::size_t end = value.rfind(':');
      return end != std::string::npos && removed.contains(value.substr(0, end));
    });
    for (const std::string& value : values) {
      text += is_flag(option) ? option : fmt::format("{}={}", option, value);
      text += '\n';
    }
  }
  OutputFile file(path_.string(), OutputFile::Contents::text);
  file.write(text);
  file.finish();
}

void GoldenSettings::read(const std::string& line) {
  if (line.starts_with(kVersions)) {
    versions_ = line.substr(kVersions.size());
    return;
  }
  if (line.starts_with('#')) comments_.push_back(line);
  if (line.empty() || line.starts_with('#')) return;
  const std::size_t end = line.find('=');
  const std::string name = line.substr(0, end);
  if (!is_tolerance_option(name)) {
    throw UsageError(fmt::format("golden: '{}' has '{}'; it may have {}, such as --max-delta=3",
                                 path_.string(), shortened(line),
                                 fmt::join(kToleranceOptions, ", ")));
  }
  const bool has_value = end != std::string::npos;
  if (has_value == is_flag(name)) {
    throw UsageError(fmt::format("golden: '{}' has '{}'; {} has {}", path_.string(),
                                 shortened(line), name, has_value ? "no value" : "a value"));
  }
  std::string value = has_value ? line.substr(end + 1) : "true";
  if (name == "--mask") {
    value = with_path(value, [this](const fs::path& path) {
      return (path_.parent_path() / path).lexically_normal();
    });
  } else if (kept_.is_given(name)) {
    throw UsageError(fmt::format("golden: '{}' has {} twice", path_.string(), name));
  }
  kept_.add(name, value);
}

std::vector<std::string> GoldenSettings::from_references(std::vector<std::string> masks) const {
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
