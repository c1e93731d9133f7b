# The Debian packages: piblocks, to be run, and libpiblocks-dev, to be built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME piblocks)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renders the colliding blocks that count the digits of pi")
set(CPACK_PACKAGE_VENDOR "The piblocks authors")
set(CPACK_PACKAGE_CONTACT "The piblocks authors <piblocks@localhost>")
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME piblocks)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION video)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"Two sliding blocks and a wall collide as often as the first digits of pi say.
This program renders the animation as a video (H.264), as numbered pictures,
as raw video or as a still, and states the exact count and all collisions.")

# Debian's names of the pkg-config modules that users of the static library link.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpiblocks-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
"piblocks (= ${PROJECT_VERSION}), libgmp-dev, libmpfr-dev, libtomlplusplus-dev, \
libcairo2-dev, libfreetype-dev, libpixman-1-dev, libpng-dev, zlib1g-dev, \
libfmt-dev")
# For event_simulator.hpp.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libeigen3-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"The library behind the program piblocks, for development: its C++ headers, the
static library, and what CMake and pkg-config need to find them.")

# Policy wants the licences in one file, in the folder of each package; nobody else needs that.
set(doc_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE PIBLOCKS_LICENSE)
foreach(font DejaVu Lato LatinModern)
  file(READ ${PROJECT_SOURCE_DIR}/assets/${font}-LICENSE.txt PIBLOCKS_${font}_LICENSE)
endforeach()
configure_file(copyright.in copyright @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright
        DESTINATION ${doc_folder}/piblocks COMPONENT program EXCLUDE_FROM_ALL)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright
        DESTINATION ${doc_folder}/libpiblocks-dev COMPONENT development EXCLUDE_FROM_ALL)

include(CPack)
