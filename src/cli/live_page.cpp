#include "cli/live_page.hpp"

#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include "core/descriptor.hpp"
#include "core/own_binary.hpp"
#include "core/text.hpp"

namespace piblocks::cli {
namespace {
namespace fs = std::filesystem;

constexpr const char* kPageFile = "piblocks.html";
constexpr std::string_view kMadeBy = R"(<meta name="generator" content="piblocks )";
constexpr std::string_view kScene = R"(<script id="opened-scene" type="application/json">)";
constexpr std::string_view kNoScene = "null";
constexpr std::string_view kSceneEnd = "</script>";

std::string read_page(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> piece{};
  while (in.read(piece.data(), piece.size()) || in.gcount() > 0) {
    text.append(piece.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (!in.eof()) throw IoError(error_text(errno));
  return text;
}

/// Where the text behind the one mark begins. @throws IoError unless the mark is there once
std::size_t behind(std::string_view mark, std::string_view html) {
  const std::size_t at = html.find(mark);
  if (at == std::string_view::npos) throw IoError(fmt::format("it has no '{}'", mark));
  if (html.find(mark, at + 1) != std::string_view::npos) {
    throw IoError(fmt::format("it has several '{}'", mark));
  }
  return at + mark.size();
}

/// @throws IoError that says why the file is not the page of this version
LivePage read_live_page(const fs::path& file) {
  LivePage page{.file = file, .html = read_page(file)};
  const std::string_view html = page.html;
  const std::string_view made_by = html.substr(behind(kMadeBy, html));
  const std::string_view version = made_by.substr(0, made_by.find('"'));
  if (version != kVersion) {
    throw IoError(fmt::format("it is of version {}, not {}", version, kVersion));
  }
  page.scene_begin = behind(kScene, html);
  page.scene_end = page.scene_begin + kNoScene.size();
  const std::string_view rest = html.substr(page.scene_begin);
  if (!rest.starts_with(kNoScene) || !rest.substr(kNoScene.size()).starts_with(kSceneEnd)) {
    throw IoError("it opens a scene already");
  }
  return page;
}

}  // namespace

LivePage find_live_page() {
  std::string reasons;
  for (const fs::path& place : places_of_installed(
           PIBLOCKS_PREFIX, fs::path(PIBLOCKS_PAGE_FOLDER) / kPageFile, PIBLOCKS_PAGE_FROM_BUILD)) {
    const fs::path file = place.lexically_normal();
    try {
      return read_live_page(file);
    } catch (const IoError& error) {
      reasons +=
          fmt::format("{} '{}': {}", reasons.empty() ? ":" : ";", file.string(), error.what());
    }
  }
  throw IoError(
      "page: cannot read the live page; install one of this version, or build it by scripts/web" +
      reasons);
}

void write_page(const LivePage& page, std::string_view toml, OutputFile& out) {
  const std::string_view html = page.html;
  out.write(html.substr(0, page.scene_begin));
  out.write(fmt::format(R"({{"text":{}}})", json_text(toml)));
  out.write(html.substr(page.scene_end));
}

}  // namespace piblocks::cli
