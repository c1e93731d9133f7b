#include <fmt/format.h>
#include <fmt/ranges.h>
#include <piblocks/error.hpp>
#include <piblocks/scene.hpp>
#include <piblocks/script.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string>
#include <vector>

#include "core/nearest_name.hpp"

namespace piblocks {
namespace {

template <typename Value>
struct Name {
  const char* text;
  Value value;
};

constexpr auto kContacts = std::to_array<Name<Contacts>>(
    {{"at-once", Contacts::at_once}, {"in-order", Contacts::in_order}});
constexpr auto kThemes = std::to_array<Name<Theme>>({{"article", Theme::article},
                                                     {"lecture", Theme::lecture},
                                                     {"lecture-light", Theme::lecture_light},
                                                     {"chalkboard", Theme::chalkboard},
                                                     {"dark", Theme::dark},
                                                     {"print", Theme::print},
                                                     {"colorblind", Theme::colorblind}});
constexpr auto kOverlays = std::to_array<Name<Overlay>>({{"digits", Overlay::digits},
                                                         {"masses", Overlay::masses},
                                                         {"velocities", Overlay::velocities},
                                                         {"energy", Overlay::energy},
                                                         {"momentum", Overlay::momentum},
                                                         {"time", Overlay::time},
                                                         {"ruler", Overlay::ruler},
                                                         {"trails", Overlay::trails},
                                                         {"angles", Overlay::angles}});
constexpr auto kPanels = std::to_array<Name<Panel>>({{"velocity", Panel::velocity},
                                                     {"position", Panel::position},
                                                     {"unfolded", Panel::unfolded},
                                                     {"time", Panel::time},
                                                     {"count", Panel::count},
                                                     {"ellipse", Panel::ellipse},
                                                     {"mirrors", Panel::mirrors},
                                                     {"conservation", Panel::conservation},
                                                     {"certainty", Panel::certainty},
                                                     {"speeds", Panel::speeds},
                                                     {"separation", Panel::separation}});

constexpr auto kSplits = std::to_array<Name<Split>>(
    {{"auto", Split::automatic}, {"columns", Split::columns}, {"rows", Split::rows}});

std::vector<std::string> texts_in(const auto& table) {
  std::vector<std::string> names;
  names.reserve(table.size());
  for (const auto& name : table) names.emplace_back(name.text);
  return names;
}

std::string joined_texts(const auto& table) {
  return fmt::format("{}", fmt::join(texts_in(table), ", "));
}

auto find_in(const auto& table, std::string_view text) {
  return std::ranges::find_if(table, [&](const auto& name) { return text == name.text; });
}

auto parse(const auto& table, std::string_view text) {
  const auto found = find_in(table, text);
  if (found == table.end()) throw UsageError(must_be_one_of(text, texts_in(table)));
  return found->value;
}

bool has(const auto& table, std::string_view text) { return find_in(table, text) != table.end(); }

std::string text_in(const auto& table, auto value) {
  return std::ranges::find_if(table, [&](const auto& name) { return value == name.value; })->text;
}

/// Parts between colons. @throws UsageError unless there are as many as expected.
template <std::size_t N>
std::array<std::string_view, N> split(std::string_view text, const char* expected) {
  std::array<std::string_view, N> parts;
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t colon = text.find(':');
    if ((colon == std::string_view::npos) != (i + 1 == N)) {
      throw UsageError(std::string("must be ") + expected);
    }
    parts[i] = text.substr(0, colon);
    text.remove_prefix(i + 1 == N ? text.size() : colon + 1);
  }
  return parts;
}

}  // namespace

bool Show::has(Overlay overlay) const noexcept {
  return overlays && std::ranges::count(*overlays, overlay) > 0;
}

Theme parse_theme(std::string_view name) { return parse(kThemes, name); }
Contacts parse_contacts(std::string_view name) { return parse(kContacts, name); }
Overlay parse_overlay(std::string_view name) {
  if (!has(kOverlays, name) && has(kPanels, name)) {
    throw UsageError("is a diagram; name it in show.panels (--panels)");
  }
  return parse(kOverlays, name);
}
Panel parse_panel(std::string_view name) {
  if (!has(kPanels, name) && has(kOverlays, name)) {
    throw UsageError("is drawn over the scene; name it in show.overlays (--show)");
  }
  return parse(kPanels, name);
}
Split parse_split(std::string_view name) { return parse(kSplits, name); }

std::string exact_text(Theme theme) { return text_in(kThemes, theme); }
std::string exact_text(Contacts contacts) { return text_in(kContacts, contacts); }
std::string exact_text(Overlay overlay) { return text_in(kOverlays, overlay); }
std::string exact_text(Panel panel) { return text_in(kPanels, panel); }
std::string exact_text(Split split) { return text_in(kSplits, split); }

std::string theme_names() { return joined_texts(kThemes); }
std::string overlay_names() { return joined_texts(kOverlays); }
std::string panel_names() { return joined_texts(kPanels); }

RgbColor parse_color(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789abcdefABCDEF";
  const bool has_digits =
      text.starts_with('#') && text.find_first_not_of(kDigits, 1) == std::string_view::npos;
  if (text.size() != 7 || !has_digits) {
    throw UsageError("must be a colour as \"#1f77b4\": # and six hexadecimal digits");
  }
  const auto sample = [&](std::size_t begin) {
    const std::string_view two = text.substr(begin, 2);
    std::uint8_t value = 0;
    std::from_chars(two.data(), two.data() + two.size(), value, 16);
    return value;
  };
  return {sample(1), sample(3), sample(5)};
}

std::string exact_text(const RgbColor& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

SlowMotion parse_slow_motion(std::string_view text) {
  const auto parts = split<3>(text, "FROM:TO:FACTOR, as turn-0.3:turn+0.3:10");
  return {parse_instant(parts[0]), parse_instant(parts[1]), parse_rational(parts[2])};
}

Freeze parse_freeze(std::string_view text) {
  const auto parts = split<2>(text, "AT:SECONDS, as turn:2");
  return {parse_instant(parts[0]), parse_rational(parts[1])};
}

std::string exact_text(const SlowMotion& window) {
  return exact_text(window.from) + ':' + exact_text(window.to) + ':' + window.factor.get_str();
}

std::string exact_text(const Freeze& freeze) {
  return exact_text(freeze.at) + ':' + freeze.length_s.get_str();
}

Loupe parse_loupe(std::string_view text) {
  if (text == "auto") return {};
  if (text == "stage") return {.is_stage = true};
  if (text == "off") return {.is_on = false};
  const auto parts =
      split<3>(text, "auto, stage, off, or FROM:TO:ZOOM, as turn-0.01:turn+0.01:100");
  return {.window = LoupeWindow{parse_instant(parts[0]), parse_instant(parts[1]),
                                parse_rational(parts[2])}};
}

std::string exact_text(const Loupe& loupe) {
  if (!loupe.is_on) return "off";
  if (!loupe.window) return loupe.is_stage ? "stage" : "auto";
  const auto& [from, to, zoom] = *loupe.window;
  return exact_text(from) + ':' + exact_text(to) + ':' + zoom.get_str();
}

}  // namespace piblocks
