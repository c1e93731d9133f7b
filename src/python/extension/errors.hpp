// The library's exceptions as those of the Python package.
// In: what C++ throws. Out: the exception of the same name in piblocks/_errors.py.
#pragma once

#include <pybind11/pybind11.h>

namespace piblocks::python {

void translate_errors();

}  // namespace piblocks::python
