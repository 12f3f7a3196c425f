#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The source distribution and the wheel of the Python package: what is in them, that the former can be
built, and that the latter runs where the libraries that it was built with are not installed.

usage: wheel_test.py BUILD_DIR SOURCE_DIR VERSION WORK_DIR

BUILD_DIR has been built for the Python that runs this; its module is put into the wheel. Exit code 77
where the tools that make wheels are not installed.
"""
import email
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import unittest
import zipfile

sys.dont_write_bytecode = True
from pip_support import USE, checkout_of, environment, run, skip_without_tools  # noqa: E402

MODULE = "_kinetri" + sysconfig.get_config_var("EXT_SUFFIX")
# Runs the rest of its arguments where the files before -- cannot be read: each is empty there.
HIDE = 'while [ "$1" != -- ]; do mount --bind /dev/null "$1"; shift; done; shift; exec "$@"'


def libraries_of(module):
    """The shared libraries that the loader finds for it: their paths by name."""
    return dict(re.findall(r"^\s*(\S+) => (.+) \(0x", run("ldd", module), re.MULTILINE))


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        checkout = checkout_of(SOURCE, WORK)
        run(sys.executable, "setup.py", "--quiet", "sdist", "--dist-dir", WORK, cwd=checkout)
        cls.archive = WORK / f"kinetri-{VERSION}.tar.gz"
        with tarfile.open(cls.archive) as archive:
            archive.extractall(WORK)
        cls.sources = WORK / f"kinetri-{VERSION}"
        run(sys.executable, "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps",
            "--no-cache-dir", "--wheel-dir", WORK, cls.sources,
            env=environment(KINETRI_BUILD_DIR=str(BUILD)))
        cls.wheels = list(WORK.glob("*.whl"))
        cls.site = WORK / "site"
        with zipfile.ZipFile(cls.wheels[0]) as wheel:
            wheel.extractall(cls.site)
        cls.package = cls.site / "kinetri"

    def test_its_name_says_version_and_machine(self):
        tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
        platform = sysconfig.get_platform().replace("-", "_")
        self.assertEqual([file.name for file in self.wheels],
                         [f"kinetri-{VERSION}-{tag}-{tag}-{platform}.whl"])

    def test_files(self):
        code = {file.name for pattern in ("*.py", "*.pyi", "py.typed")
                for file in (SOURCE / "python/kinetri").glob(pattern)}
        files = {str(file.relative_to(self.package)) for file in self.package.rglob("*")
                 if file.is_file()}
        others = files - code - {MODULE, "licenses/bundled_libraries.md"}
        self.assertLess(code, files)
        self.assertFalse([name for name in others
                          if not re.match(r"lib\w+\.so\.\d+$|licenses/[\w.-]+\.txt$", name)])

    def test_metadata(self):
        folder = self.site / f"kinetri-{VERSION}.dist-info"
        metadata = email.message_from_string((folder / "METADATA").read_text())
        self.assertEqual(metadata["Version"], VERSION)
        self.assertEqual(metadata["License"], "GPL-3.0-or-later")
        needed = metadata.get_all("Requires-Dist")
        needed = [name for name in needed if "extra" not in name]
        self.assertEqual(len(needed), 1)
        self.assertRegex(needed[0], r"^numpy( ?\(?<2\)?)?$")
        self.assertEqual((folder / "LICENSE").read_bytes(), (SOURCE / "LICENSE").read_bytes())

    def test_it_has_the_libraries_that_no_other_package_brings(self):
        module = self.package / MODULE
        found = libraries_of(module)
        self.assertLessEqual({"libgmp.so.10", "libtbb.so.12"}, set(found))
        system = re.compile(r"(libc|libm|libdl|librt|libpthread|libstdc\+\+|libgcc_s)\.so")
        for name, path in found.items():
            if not system.match(name):
                self.assertEqual(pathlib.Path(path).parent, self.package, name)
        # The module names each of them itself, since they do not look for one another here.
        text = run("readelf", "--dynamic", module)
        self.assertLessEqual({file.name for file in self.package.glob("lib*.so*")},
                             set(re.findall(r"NEEDED.*\[(\S+)\]", text)))
        self.assertEqual(re.findall(r"R(?:UN)?PATH\).*\[(.*)\]", text), ["$ORIGIN"])

    def test_it_names_the_licenses_of_these(self):
        table = (self.package / "licenses/bundled_libraries.md").read_text()
        for file in self.package.glob("lib*.so*"):
            name = file.name.split(".so")[0]
            self.assertRegex(table, rf"\| `{name}` \|.*\| ([\w.-]+(-or-later|-2\.0)|MIT|blessing)\b")
            if pathlib.Path("/etc/debian_version").exists():
                text = (self.package / f"licenses/{name}.txt").read_text()
                for license in re.findall(r"/common-licenses/([\w.-]*\w)", text):
                    self.assertTrue((self.package / f"licenses/{license}.txt").is_file(), license)

    def test_no_file_names_a_path_of_this_machine(self):
        for file in self.package.rglob("*"):
            if file.is_file():
                for path in (BUILD, SOURCE, WORK):
                    self.assertNotIn(bytes(path), file.read_bytes(), f"{file} names {path}")

    def test_it_is_installed_in_a_virtual_environment(self):
        place = WORK / "venv"
        run(sys.executable, "-m", "venv", "--without-pip", "--system-site-packages", place)
        run(sys.executable, "-m", "pip", "--python", place / "bin/python", "install", "--no-index",
            "--quiet", self.wheels[0])
        text = run(place / "bin/python", "-c", USE, cwd=WORK)
        self.assertRegex(text, rf"^{re.escape(str(place))}/\S+/kinetri/__init__.py {VERSION} True True\n$")

    def test_it_runs_where_these_are_not_installed(self):
        unshare = ["unshare", "--user", "--map-root-user", "--mount", "--fork"]
        if not shutil.which("unshare") or subprocess.run(
                [*unshare, "mount", "--bind", "/dev/null", "/dev/zero"],
                stderr=subprocess.DEVNULL).returncode != 0:
            self.skipTest("no namespace of mounts can be made here")
        built = BUILD / "python/kinetri" / MODULE
        of_python = libraries_of(sys.executable)
        hidden = {str(pathlib.Path(path).resolve()) for name, path in libraries_of(built).items()
                  if (self.package / name).exists() and name not in of_python}
        self.assertGreaterEqual(len(hidden), 2)
        command = [*unshare, "sh", "-ec", HIDE, "sh", *hidden, "--", sys.executable, "-c", USE]
        text = run(*command, cwd=WORK, env=environment(PYTHONPATH=str(self.site)))
        self.assertEqual(text, f"{self.package}/__init__.py {VERSION} True True\n")
        # They are hidden: what has none of its own does not run.
        with self.assertRaisesRegex(AssertionError, r"lib\w+\.so\.\d+: file too short"):
            run(*command, cwd=WORK, env=environment(PYTHONPATH=str(BUILD / "python")))

    def test_the_source_distribution_has_what_the_build_needs(self):
        # CMake stops where a source is missing; the headers and what they include are all there.
        run("cmake", "-S", self.sources, "-B", WORK / "configured", "-DKINETRI_PYTHON=ON",
            f"-DPython_EXECUTABLE={sys.executable}", "-DKINETRI_BUILD_PROGRAM=OFF",
            "-DKINETRI_BUILD_TESTS=OFF")
        for folder in ("include", "src", "python/src", "python/kinetri", "viewer"):
            for file in (SOURCE / folder).rglob("*"):
                if file.is_file() and "__pycache__" not in file.parts:
                    self.assertTrue((self.sources / file.relative_to(SOURCE)).is_file(), file)
        with tarfile.open(self.archive) as archive:
            self.assertFalse([name for name in archive.getnames() if re.search(r"\.(so|pyc)\b", name)])


if __name__ == "__main__":
    BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    VERSION, WORK = sys.argv[3], pathlib.Path(sys.argv[4]).resolve()
    skip_without_tools()
    unittest.main(argv=sys.argv[:1])
