#include "cli/body_output.hpp"

#include <bit>
#include <cstring>
#include <iterator>

#include "cli/log_rows.hpp"
#include "cli/state_text.hpp"
#include "cli/text_output.hpp"
#include "cli/values.hpp"

namespace piblocks::cli {
namespace {

std::string name_of(const BodySystem& system, std::uint32_t id) {
  if (id < system.bodies.size()) return fmt::format("{}", id + 1);
  return system.walls[id - system.bodies.size()].name;
}

std::string csv_header(const BodySystem& system, const Rows& /*rows*/) {
  return system.dimensions == 1
             ? "index,time,first,second,x_first,x_second,v_first,v_second\n"
             : "index,time,first,second,x_first,y_first,x_second,y_second,vx_first,vy_first,"
               "vx_second,vy_second\n";
}

void append_csv_row(const BodySystem& system, const BodyCollision& c, fmt::memory_buffer& out) {
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{},{},{},{}", c.index.get_str(), shown(c.time.hi), name_of(system, c.first),
                 name_of(system, c.second));
  const auto axes = static_cast<std::size_t>(system.dimensions);
  for (const auto* vector : {&c.first_after.position, &c.second_after.position,
                             &c.first_after.velocity, &c.second_after.velocity}) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      fmt::format_to(to, ",{}", shown(vector->at(axis)));
    }
  }
  out.push_back('\n');
}

std::string no_header(const BodySystem& /*system*/, const Rows& /*rows*/) { return {}; }

void append_json_row(const BodySystem& system, const BodyCollision& c, fmt::memory_buffer& out) {
  const auto name = [&](std::uint32_t id) {
    return id < system.bodies.size() ? name_of(system, id)
                                     : fmt::format("\"{}\"", name_of(system, id));
  };
  const auto motion = [&](const BodyMotion& m) {
    return fmt::format(R"({{"position":{},"velocity":{}}})", vector_text(system, m.position),
                       vector_text(system, m.velocity));
  };
  fmt::format_to(std::back_inserter(out),
                 "{{\"index\":\"{}\",\"time\":{},\"first\":{},\"second\":{},\"first_after\":{},"
                 "\"second_after\":{}}}\n",
                 c.index.get_str(), shown(c.time.hi), name(c.first), name(c.second),
                 motion(c.first_after), motion(c.second_after));
}

std::string npy_head(const BodySystem& system, const Rows& rows) {
  return npy_header(body_row_type(system), rows);
}

template <typename Value>
void append_bytes(Value value, fmt::memory_buffer& out) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof value> bytes{};
  std::memcpy(bytes.data(), &value, sizeof value);
  out.append(bytes.data(), bytes.data() + bytes.size());
}

}  // namespace

std::string_view body_row_type(const BodySystem& system) {
  return system.dimensions == 1
             ? "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('first', '<i4'), "
               "('second', '<i4'), ('x_first', '<f8'), ('x_second', '<f8'), ('v_first', '<f8'), "
               "('v_second', '<f8')]"
             : "[('index', '<i8'), ('time', '<f8'), ('time_low', '<f8'), ('first', '<i4'), "
               "('second', '<i4'), ('x_first', '<f8', (2,)), ('x_second', '<f8', (2,)), "
               "('v_first', '<f8', (2,)), ('v_second', '<f8', (2,))]";
}

void append_body_row(const BodySystem& system, const BodyCollision& c, fmt::memory_buffer& out) {
  const auto number = [&](std::uint32_t id) {
    const auto bodies = static_cast<std::int32_t>(system.bodies.size());
    const auto place = static_cast<std::int32_t>(id);
    return place < bodies ? place + 1 : bodies - place - 1;
  };
  append_bytes(std::int64_t{c.index.get_si()}, out);
  append_bytes(shown(c.time.hi), out);
  append_bytes(shown(c.time.lo), out);
  append_bytes(number(c.first), out);
  append_bytes(number(c.second), out);
  const auto axes = static_cast<std::size_t>(system.dimensions);
  for (const auto* vector : {&c.first_after.position, &c.second_after.position,
                             &c.first_after.velocity, &c.second_after.velocity}) {
    for (std::size_t axis = 0; axis < axes; ++axis) append_bytes(shown(vector->at(axis)), out);
  }
}

BodyLogFormat parse_body_log_format(const std::string& name) {
  return parse_choice<BodyLogFormat>(name, {{"csv", {false, csv_header, append_csv_row}},
                                            {"jsonl", {false, no_header, append_json_row}},
                                            {"npy", {true, npy_head, append_body_row}}});
}

}  // namespace piblocks::cli
