// The form of the help texts.
// In: a command's options and descriptions. Out: its --help, at most 100 columns wide.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace piblocks::cli {

/// The text of an option whose name says all: an empty one would be replaced by CLI11.
inline constexpr const char* kNoText = " ";

/// CLI11's form, but for lean descriptions and a usage line that shows what has to be given.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() { column_width(24); }
  std::string make_usage(const CLI::App* app, std::string name) const override;
  std::string make_description(const CLI::App* app) const override;
};

}  // namespace piblocks::cli
