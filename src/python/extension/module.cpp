// The extension: what the Python package needs of the library, in plain types.
// In: texts as bytes, arrays as buffers. Out: numbers, buffers, exceptions of the package.
#include <piblocks/error.hpp>
#include <piblocks/version.hpp>
#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// As the command line prints it: bytes that are no text are escaped.
py::str text_of(const std::string& message) { return py::str(printable(message)); }

/// The package makes the error also one of Python's own classes, such as FileNotFoundError.
void raise(const char* name, const std::vector<std::string>& lines) {
  py::list problems;
  for (const std::string& line : lines) problems.append(text_of(line));
  const py::module_ errors = py::module_::import("piblocks._errors");
  const py::object error = errors.attr("made")(errors.attr(name), *problems);
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
}

/// The library's exceptions become those of the same names in piblocks/_errors.py.
void translate_errors() {
  py::register_exception_translator([](std::exception_ptr exception) {
    try {
      if (exception) std::rethrow_exception(exception);
    } catch (const SceneError& error) {
      raise("SceneError", error.lines());
    } catch (const UsageError& error) {
      raise("UsageError", error.lines());
    } catch (const SimulationError& error) {
      raise("SimulationError", {error.what()});
    } catch (const DrawError& error) {
      raise("DrawError", {error.what()});
    } catch (const MediaError& error) {
      raise("MediaError", {error.what()});
    } catch (const IoError& error) {
      raise("IoError", {error.what()});
    } catch (const Interrupted& error) {
      PyErr_SetObject(PyExc_KeyboardInterrupt, text_of(error.what()).ptr());
    } catch (const Error& error) {
      raise("Error", {error.what()});
    }
  });
}

}  // namespace
}  // namespace piblocks::python

PYBIND11_MODULE(_piblocks, module) {
  module.doc() = "The library behind the package piblocks; use that.";
  module.attr("VERSION") = piblocks::kVersion;
  piblocks::python::translate_errors();
  piblocks::python::wait_for_work_at_exit();
  piblocks::python::bind_script(module);
  piblocks::python::bind_run(module);
  piblocks::python::bind_frames(module);
  piblocks::python::bind_render(module);
  piblocks::python::bind_golden(module);
  piblocks::python::bind_compare(module);
}
