#include <piblocks/bodies.hpp>
#include <piblocks/error.hpp>
#include <piblocks/instant.hpp>
#include <pybind11/stl.h>

#include <cstring>
#include <memory>
#include <span>

#include "cli/body_output.hpp"
#include "cli/log_rows.hpp"
#include "cli/script_facts.hpp"
#include "cli/state_text.hpp"
#include "core/stop.hpp"
#include "python/extension/interruptible.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"
#include "scene/run_log.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;
using cli::shown;
using Options = std::map<std::string, std::string>;

/// The log of a scene with bodies, and the scene.
class BoundBodyRun {
 public:
  /// @param for_states  else '--to' sets the horizon; rows are checked when they are selected
  BoundBodyRun(const BoundScript& script, const Options& texts, bool for_states) {
    const WithoutGil released;
    const BoundOptions options(texts);
    scene_ = scene_of(script, for_states ? "state" : "log");
    for (const char* option : {"--engine", "--bounds"}) {
      if (options.is_given(option)) require_blocks(scene_, option);
    }
    if (!for_states) scene_ = cli::scene_for_log(scene_, options);
    log_ = log_of(scene_);
  }
  const Scene& scene() const { return scene_; }
  const Log& log() const { return *log_; }
  std::size_t bodies() const { return log().system().bodies.size(); }
  std::size_t dimensions() const { return std::size_t(log().system().dimensions); }

 private:
  Scene scene_;
  std::unique_ptr<Log> log_;
};

py::tuple select(const BoundBodyRun& run, const Options& options) {
  cli::Rows rows;
  {
    const WithoutGil released;
    rows = cli::select_rows(BoundOptions(options), run.log());
    require_certain(run.scene(), run.log(), rows.until);
  }
  return py::make_tuple(hexadecimal(rows.first), hexadecimal(rows.count()));
}

void fill_log(const BoundBodyRun& run, const std::string& first_text, const py::buffer& buffer,
              std::size_t rows, std::size_t row_bytes) {
  const Integer first(first_text, 16);
  const std::span<std::uint8_t> memory = bytes_of(buffer, rows * row_bytes);
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    fmt::memory_buffer row;
    for (std::size_t i = 0; i < rows; ++i, row.clear()) {
      check_stop(stop);
      cli::append_body_row(run.log().system(), run.log().collision(first + Integer(i)), row);
      if (row.size() != row_bytes) throw std::invalid_argument("the rows have another size");
      std::memcpy(memory.data() + i * row_bytes, row.data(), row_bytes);
    }
  });
}

template <typename Value>
std::span<Value> array_of(const py::buffer& buffer, std::size_t length) {
  const std::span<std::uint8_t> memory = bytes_of(buffer, length * sizeof(Value));
  return {reinterpret_cast<Value*>(memory.data()), length};
}

/// An instant of the log at which what happens is certain, or may be uncertain.
Rational time_of_text(const BoundBodyRun& run, const std::string& text) {
  const BoundOptions options({{"t", text}});
  const Rational time = time_of(*options.value("t", parse_instant), run.log());
  require_certain(run.scene(), run.log(), time);
  return time;
}

/// Fills an array of times, one of counts, and two with the vectors of all bodies at each time.
/// Returns the hexadecimal counts if one of them does not fit.
std::vector<std::string> fill_states(const BoundBodyRun& run, const std::vector<std::string>& texts,
                                     const py::buffer& times_buffer,
                                     const py::buffer& counts_buffer,
                                     const py::buffer& positions_buffer,
                                     const py::buffer& velocities_buffer) {
  const std::size_t vectors = texts.size() * run.bodies() * run.dimensions();
  const auto times = array_of<double>(times_buffer, texts.size());
  const auto counts = array_of<std::int64_t>(counts_buffer, texts.size());
  double* position = array_of<double>(positions_buffer, vectors).data();
  double* velocity = array_of<double>(velocities_buffer, vectors).data();
  std::vector<std::string> long_counts;
  run_interruptibly([&](const std::stop_token& stop, const CallBack&) {
    for (std::size_t i = 0; i < texts.size(); ++i) {
      check_stop(stop);
      const Rational time = time_of_text(run, texts[i]);
      const BodiesState state = run.log().state_at(time);
      times[i] = shown(to_double(time));
      counts[i] = state.count.get_si();
      if (!state.count.fits_slong_p()) {
        long_counts.resize(texts.size());
        long_counts[i] = hexadecimal(state.count);
      }
      for (const BodyMotion& body : state.bodies) {
        for (std::size_t axis = 0; axis < run.dimensions(); ++axis) {
          *position++ = shown(body.position.at(axis));
          *velocity++ = shown(body.velocity.at(axis));
        }
      }
    }
  });
  return long_counts;
}

}  // namespace

void bind_body_run(py::module_& module) {
  py::class_<BoundBodyRun, std::shared_ptr<BoundBodyRun>>(module, "BodyRun",
                                                          "The log of a scene with bodies.")
      .def(py::init<const BoundScript&, const Options&, bool>(), py::arg("script"),
           py::arg("options"), py::arg("for_states"), "Nothing is computed yet.")
      .def_property_readonly(
          "size", [](const BoundBodyRun& run) { return hexadecimal(run.log().last()); },
          "Collisions from time 0 on, in hexadecimal digits.")
      .def_property_readonly(
          "first_index",
          [](const BoundBodyRun& run) { return hexadecimal(run.log().first_index()); },
          "The first collision, in hexadecimal digits.")
      .def_property_readonly(
          "is_endless",
          [](const BoundBodyRun& run) { return cli::infinite_count(run.log()).has_value(); },
          "Whether the last collision stands for infinitely many.")
      .def_property_readonly(
          "shape",
          [](const BoundBodyRun& run) { return py::make_tuple(run.bodies(), run.dimensions()); },
          "How many bodies there are, and in how many dimensions.")
      .def_property_readonly(
          "row_type",
          [](const BoundBodyRun& run) {
            return std::string(cli::body_row_type(run.log().system()));
          },
          "What a row of the log has.")
      .def(
          "has",
          [](const BoundBodyRun& run, const std::string& index) {
            const WithoutGil released;
            return run.log().is_listed(Integer(index, 16));
          },
          py::arg("index"), "Whether the log lists the collision, in hexadecimal digits.")
      .def("select", &select, py::arg("options"), "First index and number of rows, hexadecimal.")
      .def("fill_log", &fill_log, py::arg("first"), py::arg("rows_buffer"), py::arg("rows"),
           py::arg("row_bytes"), "Fills rows as row_type describes them.")
      .def("fill_states", &fill_states, py::arg("times"), py::arg("times_buffer"),
           py::arg("counts_buffer"), py::arg("positions_buffer"), py::arg("velocities_buffer"),
           "Fills time, count, and positions and velocities of all bodies at each of the times.");
}

}  // namespace piblocks::python
