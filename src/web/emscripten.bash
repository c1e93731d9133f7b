# How all is compiled for a browser. To be sourced, after `web` is set to the folder of the build.
# shellcheck shell=bash

# Code for 64 bits, so that GMP has limbs of 64 bits and a long holds a count, lowered to memory of
# 32 bits, which every browser has. That pass of Emscripten 3.1 does not know vector instructions.
flags=(-sMEMORY64=2 -fwasm-exceptions -sSUPPORT_LONGJMP=wasm -Wno-experimental)
compile_flags=(-O2 -ffp-contract=off "${flags[@]}")
export CFLAGS="${compile_flags[*]}" CXXFLAGS="${compile_flags[*]}"
export LDFLAGS="${flags[*]}"
export PKG_CONFIG_LIBDIR=${web:?}/prefix/lib/pkgconfig
export PKG_CONFIG_PATH=$PKG_CONFIG_LIBDIR

# Debian's Emscripten has the libraries for 32 bits only, and may not make others: these get a cache of
# their own.
export EM_CONFIG=$web/emscripten.config EM_CACHE=$web/cache
if [[ ! -e $EM_CONFIG ]]; then
  sed 's/^FROZEN_CACHE.*/FROZEN_CACHE = False/' /usr/share/emscripten/.emscripten >"$EM_CONFIG"
fi

# At -O3, code is a tenth larger and no faster.
export cmake_options=(-G Ninja -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_C_FLAGS_RELEASE=-O2 -DNDEBUG" "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG"
  "-DCMAKE_C_FLAGS=${flags[*]}" "-DCMAKE_CXX_FLAGS=${flags[*]}" "-DCMAKE_EXE_LINKER_FLAGS=${flags[*]}"
  "-DCMAKE_FIND_ROOT_PATH=$web/prefix" "-DCMAKE_PREFIX_PATH=$web/prefix"
  "-DCMAKE_INSTALL_PREFIX=$web/prefix")
