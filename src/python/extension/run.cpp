#include <fmt/format.h>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "cli/script_facts.hpp"
#include "core/stop.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"
#include "scene/run_log.hpp"
#include "scene/run_tables.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// A scene and its log. Nothing is computed yet.
class BoundRun {
 public:
  /// @param operation  named in messages
  /// @param texts      '--engine'; '--to', where the log has to go further than the film
  BoundRun(const BoundScript& script, const char* operation, const Options& texts)
      : scene_(scene_of(script, operation)) {
    const WithoutGil released;
    log_ = cli::make_log(scene_, cli::OptionMap(texts));
  }
  const Scene& scene() const { return scene_; }
  const Log& log() const { return *log_; }
  Table collisions() const { return collision_table(scene_.system); }
  /// Made once, by who holds the GIL. @throws UsageError as state_table()
  const Table& states(bool has_bounds) const {
    std::optional<Table>& table = states_.at(std::size_t(has_bounds));
    if (!table) table = state_table(scene_.system, has_bounds);
    return *table;
  }

 private:
  Scene scene_;
  std::unique_ptr<Log> log_;
  mutable std::array<std::optional<Table>, 2> states_;
};

/// The index of the first row, and their number, both hexadecimal.
py::tuple select(const BoundRun& run, const Options& options) {
  const cli::Rows rows = without_gil([&] {
    cli::Rows selected = cli::select_rows(cli::OptionMap(options), run.log());
    require_certain(run.scene(), run.log(), selected.until);
    return selected;
  });
  return py::make_tuple(hexadecimal(rows.first), hexadecimal(rows.count()));
}

void fill_log(const BoundRun& run, const std::string& first_text, const py::buffer& buffer,
              std::size_t rows) {
  const Integer first(first_text, 16);
  const Table table = run.collisions();
  auto* at = reinterpret_cast<char*>(bytes_of(buffer, rows * table.row_bytes()).data());
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    read_collisions(run.log(), first, first + Integer(rows) - 1, [&](const TableRows& some) {
      check_stop(stop);
      table.write_npy(some, at);
      at += some.size * table.row_bytes();
    });
  });
}

/// Times as texts, or an array of doubles, each of which is the decimal that Python prints.
using Times = std::variant<std::vector<std::string>, py::buffer>;

Rational time_of_text(const std::string& text, const Log& log) {
  return time_of(instant_of("t", text), log);
}

Rational time_of_number(double value, const Log& log) {
  try {
    return rational_from_decimal(value);
  } catch (const UsageError&) {  // not finite: the same words as for a text
    return time_of_text(fmt::format("{}", value), log);
  }
}

std::span<const double> doubles_of(const py::buffer& buffer) {
  const py::buffer_info info = buffer.request();
  if (info.format != py::format_descriptor<double>::format() || info.ndim != 1 ||
      (info.size > 0 && info.strides[0] != sizeof(double))) {
    throw std::invalid_argument("the times must be a contiguous array of doubles");
  }
  return {static_cast<const double*>(info.ptr), std::size_t(info.size)};
}

/// Fills states, and returns the hexadecimal counts if one of them does not fit, or is "infinite".
template <typename List, typename TimeOf>
std::vector<std::string> fill(const BoundRun& run, const List& times, const TimeOf& time_of_one,
                              bool has_bounds, const py::buffer& buffer) {
  const Table& table = run.states(has_bounds);
  auto* at = reinterpret_cast<char*>(bytes_of(buffer, times.size() * table.row_bytes()).data());
  std::vector<std::string> counts;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    for (std::size_t i = 0; i < times.size(); ++i, at += table.row_bytes()) {
      check_stop(stop);
      const Rational time = time_of_one(times[i], run.log());
      require_certain(run.scene(), run.log(), time);
      const StateRow state = state_row(run.log(), time, has_bounds);
      table.write_npy(state.rows(), at);
      if (state.count.fits_slong_p() && !state.is_infinite) continue;
      counts.resize(times.size());
      counts[i] = state.is_infinite ? "infinite" : hexadecimal(state.count);
    }
  });
  return counts;
}

std::vector<std::string> fill_states(const BoundRun& run, const Times& times, bool has_bounds,
                                     const py::buffer& buffer) {
  if (const auto* const texts = std::get_if<std::vector<std::string>>(&times)) {
    return fill(run, *texts, time_of_text, has_bounds, buffer);
  }
  return fill(run, doubles_of(std::get<py::buffer>(times)), time_of_number, has_bounds, buffer);
}

}  // namespace

void bind_run(py::module_& module) {
  using Run = const BoundRun&;
  py::class_<BoundRun, std::shared_ptr<BoundRun>>(module, "Run", "The run of a scene.")
      .def(py::init<const BoundScript&, const char*, const Options&>(), py::arg("script"),
           py::arg("operation"), py::arg("options"), "By the engine that '--engine' names.")
      .def_property_readonly(
          "never_ends", [](Run run) { return run.log().never_ends(); },
          "Whether collisions may go on for ever.")
      .def_property_readonly(
          "row_type", [](Run run) { return run.collisions().row_type(); },
          "What a row of the log has.")
      .def(
          "state_type", [](Run run, bool has_bounds) { return run.states(has_bounds).row_type(); },
          py::arg("has_bounds"), "What a row of states has.")
      .def("select", &select, py::arg("options"), "First index and number of rows, hexadecimal.")
      .def("fill_log", &fill_log, py::arg("first"), py::arg("rows_buffer"), py::arg("rows"),
           "Fills rows as row_type describes them.")
      .def("fill_states", &fill_states, py::arg("times"), py::arg("has_bounds"),
           py::arg("rows_buffer"), "Fills rows as state_type; returns counts that do not fit.");
}

}  // namespace piblocks::python
