# Tests that hold scenes to references.
#
# piblocks_add_golden_test(NAME <test> SCENE <scene.toml> DIRECTORY <folder> [FRAMES <instant>…])
#
# The test fails if a frame of the scene differs from the references in the folder, or if a
# reference is missing. Pictures of what differs are then in
# <test>-differences/<name of the scene> of the build folder. FRAMES names the instants that are
# kept as pictures, instead of the scene's. This command makes the references, once and after an
# intended change:
#   piblocks golden record|approve <scene.toml> --dir <folder> [--frames <instant>,…]
function(piblocks_add_golden_test)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "NAME;SCENE;DIRECTORY" "FRAMES")
  foreach(argument NAME SCENE DIRECTORY)
    if(NOT ARG_${argument})
      message(FATAL_ERROR "piblocks_add_golden_test: ${argument} is missing")
    endif()
  endforeach()
  if(ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "piblocks_add_golden_test: unknown: ${ARG_UNPARSED_ARGUMENTS}")
  endif()
  cmake_path(ABSOLUTE_PATH ARG_SCENE)
  cmake_path(ABSOLUTE_PATH ARG_DIRECTORY)
  set(frames "")
  if(ARG_FRAMES)
    list(JOIN ARG_FRAMES "," frames)
    set(frames --frames ${frames})
  endif()
  add_test(NAME ${ARG_NAME}
    COMMAND ${PIBLOCKS_PROGRAM} golden check ${ARG_SCENE} --dir ${ARG_DIRECTORY} ${frames}
            --diff ${CMAKE_CURRENT_BINARY_DIR}/${ARG_NAME}-differences)
endfunction()
