#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <piblocks/run.hpp>
#include <pybind11/stl.h>

#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include "cli/log_rows.hpp"
#include "cli/script_facts.hpp"
#include "cli/state_text.hpp"
#include "core/stop.hpp"
#include "python/extension/interruptible.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;
using cli::shown;

std::unique_ptr<CollisionLog> make_log(const BoundScript& script,
                                       const std::map<std::string, std::string>& options) {
  const WithoutGil released;
  return cli::make_log(scene_of(script, "log").system, BoundOptions(options));
}

/// A log, by one of the engines. Its log outlives its streams.
class BoundRun {
 public:
  BoundRun(const BoundScript& script, const std::map<std::string, std::string>& options)
      : log_(make_log(script, options)) {}
  const CollisionLog& log() const { return *log_; }

 private:
  std::unique_ptr<CollisionLog> log_;
};

/// The index of the first row, and their number, both hexadecimal.
py::tuple select(const BoundRun& run, const std::map<std::string, std::string>& options) {
  cli::Rows rows;
  {
    const WithoutGil released;
    rows = cli::select_rows(BoundOptions(options), run.log());
  }
  return py::make_tuple(hexadecimal(rows.first), hexadecimal(rows.count()));
}

/// Fills rows, whose indices are those of the log, or begin with 0 if these do not fit.
void fill_log(const BoundRun& run, const std::string& first_text, const py::buffer& buffer,
              std::size_t rows, bool has_indices) {
  const Integer first(first_text, 16);
  const std::span<std::uint8_t> memory = bytes_of(buffer, rows * cli::kRow_bytes);
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    const auto collisions = run.log().stream(first, first + Integer(rows) - 1);
    char* at = reinterpret_cast<char*>(memory.data());
    const char* const end = at + memory.size();
    for (CollisionBatch batch{}; at < end && collisions->read(batch);) {
      check_stop(stop);
      const Integer begin = has_indices ? batch.first : Integer(batch.first - first);
      cli::write_rows(batch, begin.get_si(), at);
      at += batch.size * cli::kRow_bytes;
    }
  });
}

/// A row of an array of states, as kStateType says.
struct StateRow {
  double time;
  std::int64_t count;
  double x_blue;
  double x_red;
  double v_blue;
  double v_red;
};
struct BoundedStateRow {
  StateRow state;
  double x_blue_bound;
  double x_red_bound;
};

constexpr std::string_view kStateType =
    "[('time', '<f8'), ('count', '<i8'), ('x_blue', '<f8'), ('x_red', '<f8'), ('v_blue', '<f8'), "
    "('v_red', '<f8')]";
constexpr std::string_view kBoundType = "[('x_blue_bound', '<f8'), ('x_red_bound', '<f8')]";

/// A state, and its count where it does not fit.
struct FoundState {
  BoundedStateRow row{};
  Integer count;
};

FoundState state_at(const CollisionLog& log, const Rational& time, bool has_bounds) {
  const BlockState state = log.blocks_at(time);
  FoundState found;
  found.row.state = {shown(to_double(time)),     state.count.get_si(),
                     shown(state.blue.position), shown(state.red.position),
                     shown(state.blue.velocity), shown(state.red.velocity)};
  found.count = state.count;
  if (has_bounds) {
    const PositionBounds bounds = cli::bounds_at(log, time);
    found.row.x_blue_bound = shown(bounds.blue);
    found.row.x_red_bound = shown(bounds.red);
  }
  return found;
}

/// @throws UsageError that names the text
Rational time_of_text(const std::string& text, const CollisionLog& log) {
  const BoundOptions options({{"t", text}});
  return time_of(*options.value("t", parse_instant), log);
}

Rational time_of_number(double value, const CollisionLog& log) {
  try {
    return rational_from_decimal(value);
  } catch (const UsageError&) {  // not finite: the same words as for a text
    return time_of_text(fmt::format("{}", value), log);
  }
}

/// Fills states, and returns the hexadecimal counts if one of them does not fit, or is "infinite".
template <typename Times, typename TimeOf>
std::vector<std::string> fill_states(const CollisionLog& log, const Times& times,
                                     const TimeOf& time_of_one, bool has_bounds,
                                     std::span<std::uint8_t> memory) {
  const std::size_t row_bytes = has_bounds ? sizeof(BoundedStateRow) : sizeof(StateRow);
  std::vector<std::string> counts;
  const std::optional<Integer> infinite = cli::infinite_count(log);
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      check_stop(stop);
      const FoundState found = state_at(log, time_of_one(times[i], log), has_bounds);
      std::memcpy(memory.data() + i * row_bytes, &found.row, row_bytes);
      const bool is_infinite = found.count == infinite;
      if (found.count.fits_slong_p() && !is_infinite) continue;
      counts.resize(times.size());
      counts[i] = is_infinite ? "infinite" : hexadecimal(found.count);
    }
  });
  return counts;
}

py::list states_of_texts(const BoundRun& run, const std::vector<std::string>& times,
                         bool has_bounds, const py::buffer& buffer) {
  const std::size_t row_bytes = has_bounds ? sizeof(BoundedStateRow) : sizeof(StateRow);
  return py::cast(fill_states(run.log(), times, time_of_text, has_bounds,
                              bytes_of(buffer, times.size() * row_bytes)));
}

py::list states_of_numbers(const BoundRun& run, const py::buffer& times, bool has_bounds,
                           const py::buffer& buffer) {
  const py::buffer_info info = times.request();
  if (info.format != py::format_descriptor<double>::format() || info.ndim != 1 ||
      (info.size > 0 && info.strides[0] != sizeof(double))) {
    throw std::invalid_argument("the times must be a contiguous array of doubles");
  }
  const std::span numbers(static_cast<const double*>(info.ptr), std::size_t(info.size));
  const std::size_t row_bytes = has_bounds ? sizeof(BoundedStateRow) : sizeof(StateRow);
  return py::cast(fill_states(run.log(), numbers, time_of_number, has_bounds,
                              bytes_of(buffer, numbers.size() * row_bytes)));
}

}  // namespace

void bind_run(py::module_& module) {
  py::class_<BoundRun, std::shared_ptr<BoundRun>>(module, "Run", "The log of a scene's collisions.")
      .def(py::init<const BoundScript&, const std::map<std::string, std::string>&>(),
           py::arg("script"), py::arg("options"), "By the engine that '--engine' names.")
      .def_property_readonly(
          "size", [](const BoundRun& run) { return hexadecimal(run.log().last()); },
          "Collisions from time 0 on, in hexadecimal digits.")
      .def_property_readonly(
          "first_index", [](const BoundRun& run) { return hexadecimal(run.log().first_index()); },
          "The first collision of all time, in hexadecimal digits.")
      .def_property_readonly(
          "is_endless",
          [](const BoundRun& run) { return cli::infinite_count(run.log()).has_value(); },
          "Whether the last collision stands for infinitely many.")
      .def(
          "has",
          [](const BoundRun& run, const std::string& index) {
            const WithoutGil released;
            return run.log().is_listed(Integer(index, 16));
          },
          py::arg("index"), "Whether the log lists the collision, in hexadecimal digits.")
      .def("select", &select, py::arg("options"), "First index and number of rows, hexadecimal.")
      .def("fill_log", &fill_log, py::arg("first"), py::arg("rows_buffer"), py::arg("rows"),
           py::arg("has_indices"), "Fills rows as ROW_TYPE describes them.")
      .def("states_of_texts", &states_of_texts, py::arg("times"), py::arg("has_bounds"),
           py::arg("rows_buffer"), "Fills rows as STATE_TYPE; returns counts that do not fit.")
      .def("states_of_numbers", &states_of_numbers, py::arg("times"), py::arg("has_bounds"),
           py::arg("rows_buffer"), "The same for an array of doubles.");
  module.attr("ROW_TYPE") = std::string(cli::kRowType);
  module.attr("STATE_TYPE") = std::string(kStateType);
  module.attr("BOUND_TYPE") = std::string(kBoundType);
}

}  // namespace piblocks::python
