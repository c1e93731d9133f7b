# The Debian packages: piblocks, to be run, libpiblocks-dev, to be built on, and python3-piblocks.
set(PIBLOCKS_MAINTAINER "The piblocks authors <piblocks@piblocks.invalid>" CACHE STRING
    "who makes the packages, with an address that takes mail")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME piblocks)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "renders the colliding blocks that count the digits of pi")
set(CPACK_PACKAGE_VENDOR "The piblocks authors")
set(CPACK_PACKAGE_CONTACT "${PIBLOCKS_MAINTAINER}")
set(CPACK_COMPONENTS_ALL program development)
if(PIBLOCKS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)

# Packages of different releases have different versions, that of the newer release the higher one.
set(system_release 1)
set(system_codename unstable)
if(EXISTS /etc/os-release)
  file(STRINGS /etc/os-release lines REGEX "^(ID|VERSION_ID|VERSION_CODENAME)=")
  string(REGEX REPLACE "[\"']" "" lines "${lines}")
  if(lines MATCHES "(^|;)ID=([a-z]+)" AND CMAKE_MATCH_2 STREQUAL debian)
    if(lines MATCHES "VERSION_ID=([0-9]+)")
      set(system_release 1~deb${CMAKE_MATCH_1})
    endif()
    if(lines MATCHES "VERSION_CODENAME=([a-z]+)")
      set(system_codename ${CMAKE_MATCH_1})
    endif()
  endif()
endif()
set(CPACK_DEBIAN_PACKAGE_RELEASE ${system_release})
set(package_version ${PROJECT_VERSION}-${system_release})
if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
  set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE amd64)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME piblocks)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION video)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# What is loaded, not linked: Debian names libavformat.so.59 libavformat59.
pkg_get_variable(avformat_libdir libavformat libdir)
file(REAL_PATH ${avformat_libdir}/libavformat.so avformat)
if(NOT avformat MATCHES "\\.so\\.([0-9]+)")
  message(FATAL_ERROR "libavformat: no version in the name of '${avformat}'")
endif()
set(avformat libavformat${CMAKE_MATCH_1})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libcairo2 (>= 1.16), ${avformat}")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION
"Two sliding blocks and a wall collide as often as the first digits of pi say.
This program renders the animation as a video (H.264), as numbered pictures,
as raw video or as a still, and states the exact count and all collisions.")

# Debian's names of the pkg-config modules that users of the static library link.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libpiblocks-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
"piblocks (= ${package_version}), libgmp-dev, libmpfr-dev, libtomlplusplus-dev, \
libpng-dev, zlib1g-dev, libdeflate-dev, libfmt-dev")
# For event_simulator.hpp.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS libeigen3-dev)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
"The library behind the program piblocks, for development: its C++ headers, the
static library, and what CMake and pkg-config need to find them.")

# An extension is for one version of Python.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-piblocks)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
"python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python}), python3-numpy, \
libcairo2 (>= 1.16), ${avformat}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-ipywidgets, python3-pytest")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
"The library behind the program piblocks, for Python: scenes from keywords,
counts of any size, logs, states and frames as NumPy arrays, films, the player
and a slider in notebooks, and a plugin of pytest for golden references.")

# Compiles the package's files when it is installed, and takes away what Python made of them.
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/python/postinst
"#!/bin/sh
set -e
if command -v py3compile >/dev/null; then py3compile -p python3-piblocks; fi
")
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/python/prerm
"#!/bin/sh
set -e
if command -v py3clean >/dev/null; then py3clean -p python3-piblocks; fi
")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${CMAKE_CURRENT_BINARY_DIR}/python/postinst ${CMAKE_CURRENT_BINARY_DIR}/python/prerm)

# Policy wants the licences in one file, in the folder of each package; nobody else needs that.
set(doc_folder ${CMAKE_INSTALL_DATAROOTDIR}/doc)
file(READ ${PROJECT_SOURCE_DIR}/LICENSE PIBLOCKS_LICENSE)
foreach(font DejaVu Lato LatinModern)
  file(READ ${PROJECT_SOURCE_DIR}/assets/${font}-LICENSE.txt PIBLOCKS_${font}_LICENSE)
endforeach()
configure_file(copyright.in copyright @ONLY)
# The changes in Debian's form, which only says where ours are, and ours.
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(changelog.in changelog.Debian @ONLY)
add_custom_command(
  OUTPUT changelog.Debian.gz changelog.gz
  COMMAND gzip -9nc changelog.Debian > changelog.Debian.gz
  COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md > changelog.gz
  DEPENDS ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  VERBATIM)
add_custom_target(piblocks_changelog ALL DEPENDS changelog.Debian.gz)
if(PIBLOCKS_PYTHON)
  # pip builds that target alone, and installs its component.
  add_dependencies(piblocks_python piblocks_changelog)
endif()
foreach(package program:piblocks development:libpiblocks-dev python:python3-piblocks)
  string(REPLACE ":" ";" package ${package})
  list(GET package 0 component)
  list(GET package 1 name)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/copyright
                ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz
                ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz
          DESTINATION ${doc_folder}/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

include(CPack)
