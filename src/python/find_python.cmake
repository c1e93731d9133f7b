# Whether the Python package can be built here.
# In: nothing. Out: the option PIBLOCKS_PYTHON, and Python's and pybind11's targets where it is ON.
if(NOT DEFINED Python_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that the package is built for")
endif()
find_package(Python 3.9 QUIET COMPONENTS Interpreter Development.Module)
find_package(pybind11 2.10 CONFIG QUIET)

set(PIBLOCKS_PYTHON_DEFAULT OFF)
if(PIBLOCKS_SANITIZE OR PIBLOCKS_FUZZ OR PIBLOCKS_TIDY)
  # An interpreter without the sanitizer cannot load code that has it.
elseif(NOT Python_Development.Module_FOUND)
  message(STATUS "The Python package is left out: no headers of Python (python3-dev)")
elseif(NOT pybind11_FOUND)
  message(STATUS "The Python package is left out: no pybind11 (pybind11-dev)")
else()
  set(PIBLOCKS_PYTHON_DEFAULT ON)
endif()
option(PIBLOCKS_PYTHON "Build the Python package" ${PIBLOCKS_PYTHON_DEFAULT})
