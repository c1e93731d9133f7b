#include "python/extension/errors.hpp"

#include <piblocks/error.hpp>

#include <exception>
#include <string>

#include "core/text.hpp"

namespace piblocks::python {
namespace {

namespace py = pybind11;

/// As the command line prints it: bytes that are no text are escaped.
py::str text_of(const std::string& message) { return py::str(printable(message)); }

py::str text_of(const std::exception& error) { return text_of(std::string(error.what())); }

py::tuple texts_of(const UsageError& error) {
  py::list problems;
  for (const std::string& problem : error.lines()) problems.append(text_of(problem));
  return py::tuple(problems);
}

/// The package makes the error also one of Python's own classes, such as FileNotFoundError.
void raise(const char* name, const py::tuple& problems) {
  const py::module_ errors = py::module_::import("piblocks._errors");
  const py::object error = errors.attr("made")(errors.attr(name), *problems);
  PyErr_SetObject(py::type::of(error).ptr(), error.ptr());
}

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr exception) {
    try {
      if (exception) std::rethrow_exception(exception);
    } catch (const SceneError& error) {
      raise("SceneError", texts_of(error));
    } catch (const UsageError& error) {
      raise("UsageError", texts_of(error));
    } catch (const SimulationError& error) {
      raise("SimulationError", py::make_tuple(text_of(error)));
    } catch (const DrawError& error) {
      raise("DrawError", py::make_tuple(text_of(error)));
    } catch (const MediaError& error) {
      raise("MediaError", py::make_tuple(text_of(error)));
    } catch (const IoError& error) {
      raise("IoError", py::make_tuple(text_of(error)));
    } catch (const Interrupted& error) {
      PyErr_SetObject(PyExc_KeyboardInterrupt, text_of(error).ptr());
    } catch (const Error& error) {
      raise("Error", py::make_tuple(text_of(error)));
    }
  });
}

}  // namespace piblocks::python
