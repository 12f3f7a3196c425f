#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`pip install .`: what it says while it compiles, and where it cannot.

usage: pip_test.py BUILD_DIR SOURCE_DIR WORK_DIR

BUILD_DIR has been built for the Python that runs this. Exit code 77 where the tools that make wheels are
not installed.
"""
import importlib.metadata
import os
import pathlib
import pty
import re
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from pip_support import USE, checkout_of, environment, run, skip_without_tools  # noqa: E402

# In place of cmake: it configures nothing, builds in three steps, and installs an empty module. "{build}"
# stands for what the last step does.
CMAKE = """#!/bin/sh
case $1 in
  -S) mkdir -p "$4" && : >"$4/CMakeCache.txt" ;;
  --build) printf '[1/3] Building a\\n[2/3] Building b\\n[3/3] Linking c\\n' ; {build} ;;
  --install) mkdir "$6/kinetri" && : >"$6/kinetri/_kinetri.so" ;;
esac
"""


def in_terminal(command, folder, settings):
    """The exit code of a command that runs in a terminal of its own, and what appears there."""
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.execve(command[0], [str(word) for word in command], settings)
    text = b""
    try:
        while data := os.read(terminal, 1 << 16):
            text += data
    except OSError:
        pass  # The last process has closed it.
    os.close(terminal)
    return os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]), text.decode()


class Pip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        WORK.mkdir(parents=True)
        cls.checkout = checkout_of(SOURCE, WORK)

    def stub_cmake(self, build):
        """The environment in which cmake builds so."""
        folder = WORK / "bin"
        folder.mkdir(exist_ok=True)
        (folder / "cmake").write_text(CMAKE.format(build=build))
        (folder / "cmake").chmod(0o755)
        return environment(PATH=f"{folder}:{os.environ['PATH']}", PIP_NO_INDEX="1", PIP_NO_CACHE_DIR="1")

    # ---- progress ----

    WHEEL = ("-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--wheel-dir", "wheels", ".")

    def test_the_terminal_shows_how_far_it_is(self):
        settings = self.stub_cmake("true")
        code, text = in_terminal((sys.executable, *self.WHEEL), self.checkout, settings)
        self.assertEqual(code, 0, text)
        self.assertIn("  kinetri: compiling, which takes some minutes; pip -v shows each step\r\n", text)
        self.assertRegex(text, r"\n  kinetri: \[1/3\] after 0 s\r\n")
        # The others come at once after it.
        self.assertNotIn("[2/3]", text)
        self.assertEqual(list(self.checkout.glob("build/temp*/cmake")), [])

    def test_without_a_terminal_it_is_built_as_well(self):
        done = subprocess.run([sys.executable, *self.WHEEL, "-v"], cwd=self.checkout, text=True, check=True,
                              env=self.stub_cmake("true"), start_new_session=True, capture_output=True)
        for step in ("[1/3] Building a", "[2/3] Building b", "[3/3] Linking c"):
            self.assertIn(step, done.stdout + done.stderr)
        self.assertNotIn("kinetri: compiling", done.stdout + done.stderr)

    def test_what_fails_is_shown(self):
        done = subprocess.run([sys.executable, *self.WHEEL], cwd=self.checkout, text=True,
                              env=self.stub_cmake("echo 'x.cpp:1: error: b' >&2; exit 3"), capture_output=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout + done.stderr, r"x\.cpp:1: error: b\s+.*cmake --build .* ended with 3; its "
                                                    r"messages are above")
        # What has been compiled is there for another attempt.
        self.assertEqual(len(list(self.checkout.glob("build/temp*/cmake/CMakeCache.txt"))), 1)

    # ---- a Python without what the build needs ----

    def packages(self, name, links=(), versions=()):
        """A folder of packages: those that this Python has, and ones without content."""
        folder = WORK / name
        folder.mkdir()
        for package in links:
            for top in importlib.metadata.files(package):
                top = top.parts[0]
                if not (folder / top).exists() and ".." not in top:
                    (folder / top).symlink_to(importlib.metadata.distribution(package).locate_file(top))
        for package, version in versions:
            (folder / package).mkdir()
            (folder / package / "__init__.py").touch()
            (folder / f"{package}-{version}.dist-info").mkdir()
            (folder / f"{package}-{version}.dist-info" / "METADATA").write_text(
                f"Metadata-Version: 2.1\nName: {package}\nVersion: {version}\n")
        return folder

    def refused(self, python, packages):
        """What the backend says with these packages, line by line."""
        done = subprocess.run(
            [sys.executable, "-m", "pip", "--python", str(python), "install", "--no-build-isolation",
             "--no-index", "--no-deps", "."], cwd=self.checkout, env=environment(PYTHONPATH=str(packages)),
            capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertNotIn("Traceback", done.stdout + done.stderr)
        return [line.strip() for line in (done.stdout + done.stderr).splitlines()]

    @classmethod
    def bare_python(cls):
        """A Python without packages."""
        place = WORK / "bare"
        if not place.exists():
            run(sys.executable, "-m", "venv", "--without-pip", place)
        return place / "bin/python"

    def test_what_is_missing_is_named(self):
        python = self.bare_python()
        begin = f"The build of kinetri runs with {python} (Python {sys.version.split()[0]}),"
        for name, packages, missing in (
                ("none", {}, "setuptools 61 or newer and no wheel and no NumPy"),
                ("old", {"versions": [("setuptools", "60.10.0")]},
                 "setuptools 61 or newer and no wheel and no NumPy"),
                ("first", {"versions": [("setuptools", "61.0.0")]}, "wheel and no NumPy"),
                ("new", {"versions": [("setuptools", "70.1.0")]}, "NumPy"),
                ("wheel", {"versions": [("setuptools", "66.1.1"), ("wheel", "0.38")]}, "NumPy"),
                ("numpy", {"versions": [("setuptools", "66.1.1"), ("numpy", "1.24")]}, "wheel")):
            with self.subTest(name):
                lines = self.refused(python, self.packages(name, **packages))
                self.assertEqual(lines[lines.index(begin) + 1], f"which has no {missing}.")

    def test_the_commands_that_it_names_work(self):
        debian = pathlib.Path("/usr/bin/python3")
        if not debian.exists() or debian.resolve() != pathlib.Path(sys.executable).resolve():
            self.skipTest("the package is not built for Debian's Python")
        lines = self.refused(self.bare_python(), self.packages("nothing"))
        begin = next(i for i, line in enumerate(lines) if line.startswith("sudo apt-get install"))
        home = WORK / "home"
        home.mkdir()
        install, *commands = lines[begin:begin + 3]
        packages = install.removeprefix("sudo apt-get install ").split()
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        for line in (install, *commands):
            self.assertIn(f"    {line}", readme)
        setup = (SOURCE / "scripts/setup.sh").read_text(encoding="utf-8")
        for package in packages:
            self.assertRegex(setup, rf"[ \n]{re.escape(package)}[ \n]")
        # The module of the build, so that nothing is compiled.
        run("sh", "-ec", "\n".join(commands), cwd=self.checkout,
            env=environment(HOME=str(home), KINETRI_BUILD_DIR=str(BUILD), PIP_NO_INDEX="1"))
        text = run(home / "kinetri/bin/python", "-c", USE, cwd=home)
        self.assertRegex(text, rf"^{re.escape(str(home))}/\S+/kinetri/__init__.py \S+ True True\n$")


if __name__ == "__main__":
    BUILD, SOURCE, WORK = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    skip_without_tools()
    unittest.main(argv=sys.argv[:1])
