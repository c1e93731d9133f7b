"""Builds the extension by the project's own CMake, two folders up."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

TREE = Path(__file__).resolve().parent.parent.parent


def version():
    """From its one place."""
    text = (TREE / "CMakeLists.txt").read_text()
    return re.search(r"project\(piblocks VERSION ([0-9.]+)", text)[1]


class BuildByCMake(build_ext):
    """Installs the component "python", without its Python files, where setuptools wants it."""

    def build_extension(self, extension):
        folder = Path(self.get_ext_fullpath(extension.name)).resolve().parent
        build = Path(self.build_temp).resolve() / "cmake"
        generator = ["-G", "Ninja"] if self.has_ninja() else []
        self.spawn(
            ["cmake", "-S", str(TREE), "-B", str(build), *generator,
             "-DCMAKE_BUILD_TYPE=Release", "-DPIBLOCKS_BUILD_TESTS=OFF", "-DPIBLOCKS_PYTHON=ON",
             f"-DPython_EXECUTABLE={sys.executable}",
             f"-Dpybind11_DIR={pybind11.get_cmake_dir()}",
             "-DPIBLOCKS_PYTHON_FOLDER=."]
        )
        jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
        self.spawn(["cmake", "--build", str(build), "--target", "piblocks_python", "-j", jobs])
        self.spawn(
            ["cmake", "--install", str(build), "--component", "python", "--strip", "--prefix",
             str(folder)]
        )

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
