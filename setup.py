# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles the extension module of the Python package by CMake, for pip (pyproject.toml).

A wheel holds the shared libraries that the module needs, so that it runs where there is only NumPy.
The build needs what the library needs (README.md), and takes several minutes on two processors. pip
shows what it prints with -v only; so how far it is appears on the terminal too, if there is one.

Environment variables:
    KINETRI_BUILD_DIR  a build directory that has been configured with KINETRI_PYTHON=ON for this
                       Python: its module is taken, and nothing else compiled. Without it the build
                       directory is removed after the build, unless that fails
    CMAKE_ARGS         further options of CMake, for example -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
    CMAKE_BUILD_PARALLEL_LEVEL  how many compilers run at once; by default one a processor, but a
                       gigabyte and a half of memory for each
"""
import math
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

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


class Terminal:
    """The terminal that the build runs in, for what pip would not show. Without one nothing is written."""

    def __init__(self):
        try:
            self.file = open("/dev/tty", "w", encoding="utf-8")
        except OSError:
            self.file = None

    def write(self, text):
        """Writes a line, if the build runs in the foreground: another process may be writing there else."""
        try:
            if self.file is not None and os.tcgetpgrp(self.file.fileno()) == os.getpgrp():
                self.file.write(f"\n  kinetri: {text}\n")
                self.file.flush()
        except OSError:
            self.file = None  # It is gone.


class Progress:
    """Says on the terminal now and then which step the build has come to, as Ninja and make write it."""

    STEP = re.compile(r"^\[ *(\d+/\d+|\d+%)\]")
    SECONDS = 10

    def __init__(self, terminal):
        self.terminal = terminal
        self.begin = time.monotonic()
        self.last = -math.inf

    def take(self, line):
        now = time.monotonic()
        if (step := self.STEP.match(line)) and now - self.last >= self.SECONDS:
            self.last = now
            self.terminal.write(f"[{step[1]}] after {now - self.begin:.0f} s")


class CmakeBuild(build_ext):
    """Lets CMake compile the module, and takes what belongs to it."""

    def build_extension(self, ext):
        given = os.environ.get("KINETRI_BUILD_DIR")
        build = pathlib.Path(given or self.configured())
        command = ["cmake", "--build", build, "--target", "kinetri_python"]
        if "CMAKE_BUILD_PARALLEL_LEVEL" not in os.environ:
            command += ["--parallel", str(jobs())]
        terminal = Terminal()
        terminal.write("compiling, which takes some minutes; pip -v shows each step")
        self.run_cmake(command, Progress(terminal).take)
        package = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        with tempfile.TemporaryDirectory() as folder:
            self.run_cmake(["cmake", "--install", build, "--component", "wheel", "--prefix", folder])
            shutil.copytree(pathlib.Path(folder, "kinetri"), package, dirs_exist_ok=True)
        if not given:
            shutil.rmtree(build)  # Hundreds of megabytes, which pip would leave among the sources.

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
    def run_cmake(command, take=lambda line: None):
        """Runs cmake, prints what it prints, and calls `take` with each line of that."""
        words = [str(word) for word in command]
        try:
            with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                  errors="replace") as cmake:
                for line in cmake.stdout:
                    print(line, end="", flush=True)
                    take(line)
        except FileNotFoundError:
            sys.exit("cmake was not found; expected CMake 3.25 or newer (Debian: apt-get install cmake)")
        if cmake.returncode != 0:
            sys.exit(f"{' '.join(words)} ended with {cmake.returncode}; its messages are above")


setup(version=version(), install_requires=[numpy()], cmdclass={"build_ext": CmakeBuild},
      # What CMake compiles it from, CMake knows.
      ext_modules=[Extension("kinetri._kinetri", sources=[])])
