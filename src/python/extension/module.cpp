// The extension: what the Python package needs of the library, in plain types.
// In: texts as bytes, arrays as buffers. Out: numbers, buffers, exceptions of the package.
#include <piblocks/version.hpp>
#include <pybind11/pybind11.h>

#include "python/extension/errors.hpp"
#include "python/extension/script.hpp"
#include "python/extension/without_gil.hpp"

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
