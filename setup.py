# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles the extension module of the Python package by CMake, for pip (pyproject.toml).

A wheel holds the shared libraries that the module needs, so that it runs where there is only NumPy.
The build needs what the library needs (README.md), and takes several minutes on two processors.

Environment variables:
    KINETRI_BUILD_DIR  a build directory that has been configured with KINETRI_PYTHON=ON for this
                       Python: its module is taken, and nothing else compiled
    CMAKE_ARGS         further options of CMake, for example -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
    CMAKE_BUILD_PARALLEL_LEVEL  how many compilers run at once; by default one a processor, but a
                       gigabyte and a half of memory for each
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version():
    """The version of the project, which CMakeLists.txt has."""
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"^project\(Kinetri VERSION ([0-9.]+) ", text, re.MULTILINE).group(1)


def numpy():
    """The NumPy that the module runs with: pybind11 before 2.12 knows the arrays of NumPy 1 alone."""
    try:
        import pybind11
    except ImportError:
        return "numpy < 2"  # Not known: Debian's, which is older.
    return "numpy" if pybind11.version_info[:2] >= (2, 12) else "numpy < 2"


def jobs():
    """How many compilers to run at once."""
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return max(1, min(os.cpu_count() or 1, memory // 1_500_000_000))


class CmakeBuild(build_ext):
    """Lets CMake compile the module, and takes what belongs to it."""

    def build_extension(self, ext):
        build = pathlib.Path(os.environ.get("KINETRI_BUILD_DIR") or self.configured())
        command = ["cmake", "--build", build, "--target", "kinetri_python"]
        if "CMAKE_BUILD_PARALLEL_LEVEL" not in os.environ:
            command += ["--parallel", str(jobs())]
        self.run_cmake(command)
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        with tempfile.TemporaryDirectory() as folder:
            self.run_cmake(["cmake", "--install", build, "--component", "wheel", "--prefix", folder])
            shutil.copytree(pathlib.Path(folder, "kinetri"), package, dirs_exist_ok=True)

    def configured(self):
        """A build directory for this Python."""
        build = pathlib.Path(self.build_temp).resolve() / "cmake"
        options = [f"-DPython_EXECUTABLE={sys.executable}", "-DCMAKE_BUILD_TYPE=Release",
                   "-DKINETRI_PYTHON=ON", "-DKINETRI_BUILD_PROGRAM=OFF", "-DKINETRI_BUILD_TESTS=OFF",
                   "-DKINETRI_WARNINGS_AS_ERRORS=OFF"]
        try:
            import pybind11
        except ImportError:
            pass  # Then it is where CMake looks.
        else:
            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        if shutil.which("ninja") and "CMAKE_GENERATOR" not in os.environ:
            options.append("-GNinja")
        options += shlex.split(os.environ.get("CMAKE_ARGS", ""))
        self.run_cmake(["cmake", "-S", ROOT, "-B", build, *options])
        return build

    @staticmethod
    def run_cmake(command):
        try:
            subprocess.run([str(word) for word in command], check=True)
        except FileNotFoundError:
            sys.exit("cmake was not found; expected CMake 3.25 or newer (Debian: apt-get install cmake)")
        except subprocess.CalledProcessError as error:
            sys.exit(f"{' '.join(map(str, command))} ended with {error.returncode}; its messages are above")


setup(version=version(), install_requires=[numpy()], cmdclass={"build_ext": CmakeBuild},
      # What CMake compiles it from, CMake knows.
      ext_modules=[Extension("kinetri._kinetri", sources=[])])
