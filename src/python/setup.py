"""Builds the extension by the project's own CMake, two folders up."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TREE = Path(__file__).resolve().parent.parent.parent


def version():
    """From its one place."""
    text = (TREE / "CMakeLists.txt").read_text()
    return re.search(r"project\(piblocks VERSION ([0-9.]+)", text)[1]


def pybind11_options():
    """pip brings pybind11 as a package of Python, Debian as one of CMake's (pybind11-dev)."""
    try:
        import pybind11
    except ImportError:
        return []
    return [f"-Dpybind11_DIR={pybind11.get_cmake_dir()}"]


class BuildByCMake(build_ext):
    """Builds the component "python", or takes it from the build that PIBLOCKS_BUILD names."""

    def build_extension(self, extension):
        folder = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = Path(os.environ.get("PIBLOCKS_BUILD") or self.build())
        prefix = Path(self.build_temp).resolve() / "prefix"
        self.spawn(
            ["cmake", "--install", str(build), "--component", "python", "--strip", "--prefix",
             str(prefix)]
        )
        folder.mkdir(parents=True, exist_ok=True)
        for library in prefix.glob("lib/python3/dist-packages/piblocks/*.so"):
            shutil.copy2(library, folder)

    def build(self):
        build = Path(self.build_temp).resolve() / "cmake"
        generator = ["-G", "Ninja"] if self.has_ninja() else []
        self.spawn(
            ["cmake", "-S", str(TREE), "-B", str(build), *generator,
             "-DCMAKE_BUILD_TYPE=Release", "-DPIBLOCKS_BUILD_TESTS=OFF", "-DPIBLOCKS_PYTHON=ON",
             f"-DPython_EXECUTABLE={sys.executable}", *pybind11_options()]
        )
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        self.spawn(["cmake", "--build", str(build), "--target", "piblocks_python", "-j", jobs])
        return build

    @staticmethod
    def has_ninja():
        try:
            subprocess.run(["ninja", "--version"], check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError):
            return False
        return True


setup(
    version=version(),
    ext_modules=[Extension("piblocks._piblocks", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
