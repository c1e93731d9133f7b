# Checks the check: cmake -DSCRATCH=<folder> -P check_layers_selftest.cmake
# In: small trees made below SCRATCH, most of them wrong in one line. Out: fails unless
# check_layers.cmake finds exactly that line.
cmake_minimum_required(VERSION 3.25)

# Runs the check on a tree of blameless files and FILE, whose third line is LINE.
function(check_tree result output file line)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/include/piblocks/error.hpp "#include <stdexcept>\n")
  file(WRITE ${SCRATCH}/include/piblocks/event_simulator.hpp "#include <Eigen/Core>\n")
  file(WRITE ${SCRATCH}/src/core/exact.cpp "#include <mpfr.h>\n// #include <cairo.h>\n")
  file(WRITE ${SCRATCH}/src/draw/canvas.cpp "#include <ft2build.h>\n#include FT_FREETYPE_H\n"
       "#include <piblocks/two_blocks.hpp>\n#include <cairo-ft.h>\n#include \"physics/exposure.hpp\"\n")
  file(WRITE ${SCRATCH}/src/media/mp4.cpp "#include \"core/output_file.hpp\"\n"
       "#include <sys/stat.h>\n#include <libavformat/avformat.h>\n")
  file(WRITE ${SCRATCH}/src/cli/main.cpp "#include <CLI/CLI.hpp>\n#include <fmt/format.h>\n")
  file(WRITE ${SCRATCH}/${file} "// [ ; \\\n\n${line}\n")
  execute_process(COMMAND ${CMAKE_COMMAND} -DROOT=${SCRATCH}
                          -P ${CMAKE_CURRENT_LIST_DIR}/check_layers.cmake
                  RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  set(${result} "${status}" PARENT_SCOPE)
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

function(expect_clean file line)
  check_tree(status output ${file} "${line}")
  if(NOT status EQUAL 0)
    message(SEND_ERROR "refused in ${file}: ${line}\n${output}")
  endif()
endfunction()

function(expect_fault file line)
  check_tree(status output ${file} "${line}")
  string(FIND "${output}" "${file}:3: " named)
  string(FIND "${output}" "violations of the layers: 1" counted)
  if(status EQUAL 0 OR named LESS 0 OR counted LESS 0)
    message(SEND_ERROR "not found in ${file}: ${line}\n${output}")
  endif()
endfunction()

expect_clean(src/render/render.cpp "#include <piblocks/encode.hpp>")
expect_clean(src/scene/scene.cpp "#include <toml++/toml.h>")

# Upwards and sideways through the layers, by public and by private headers.
expect_fault(src/core/exact.cpp "#include <piblocks/two_blocks.hpp>")
expect_fault(src/physics/log.cpp "  #  include <piblocks/scene.hpp>")
expect_fault(src/media/png.cpp "#include <piblocks/two_blocks.hpp>")
expect_fault(src/media/png.cpp "#include \"draw/surface.hpp\"")
expect_fault(src/h264/cavlc.cpp "#include \"core/output_file.hpp\"")
expect_fault(src/h264/cavlc.cpp "#include <piblocks/error.hpp>")
expect_fault(src/draw/compose.cpp "#include <piblocks/event_simulator.hpp>")
expect_fault(src/draw/compose.cpp "#include \"physics/unfolded.hpp\"")
expect_fault(src/render/render.hpp "#include \"cli/command.hpp\"")
expect_fault(include/piblocks/image.hpp "#include <piblocks/encode.hpp>")
expect_fault(include/piblocks/image.hpp "#include \"core/output_file.hpp\"")
# Libraries.
expect_fault(src/render/render.cpp "#include <libavcodec/avcodec.h>")
expect_fault(src/media/mp4.hpp "#include <cairo.h>")
expect_fault(src/media/mp4.hpp "#include FT_FREETYPE_H")
expect_fault(src/draw/canvas.cpp "#include <mpfr.h>")
expect_fault(src/render/render.cpp "#include <toml++/toml.hpp>")
expect_fault(src/core/exact.cpp "#include <CLI/CLI.hpp>")
expect_fault(src/h264/cavlc.cpp "#include <fmt/format.h>")
expect_fault(src/core/exact.cpp "#include <boost/rational.hpp>")
expect_fault(include/piblocks/render.hpp "#include <cairo.h>")
expect_fault(include/piblocks/error.hpp "#include <fmt/format.h>")
expect_fault(include/piblocks/exact.hpp "#include <mpfr.h>")
expect_fault(include/piblocks/error.hpp "#include <unistd.h>")
# Headers that no table knows.
expect_fault(src/cli/main.cpp "#include <piblocks/no_such_header.hpp>")
expect_fault(src/cli/main.cpp "#include \"options.hpp\"")

function(expect_homeless file)
  check_tree(status output ${file} "")
  string(FIND "${output}" "${file}:1: " named)
  if(status EQUAL 0 OR named LESS 0)
    message(SEND_ERROR "accepted: ${file}\n${output}")
  endif()
endfunction()

expect_homeless(include/piblocks/unlisted.hpp)
expect_homeless(src/unlisted/code.cpp)
expect_homeless(src/loose.cpp)
file(REMOVE_RECURSE ${SCRATCH})
