#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Debian packages that cpack makes: their control fields, their files, and that the program
and the Python package run where they are unpacked. (scripts/check_deb.sh installs them.)

usage: packages_test.py BUILD_DIR SOURCE_DIR VERSION WORK_DIR [PYTHON]

PYTHON is the one that the Python package is for. Without it that package must not be made.

Exit code 77 where the tools that make packages are not installed.
"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

SKIPPED = 77
DEVELOPMENT_NEEDS = [
    "libboost-dev", "libcgal-dev (>= 5.5)", "libgmp-dev", "libmpfr-dev", "libtbb-dev"]
# Where the library was built with them.
OPTIONAL = ["libsqlite3-dev", "libexpat1-dev"]


def run(*command, **settings):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE,
                          text=True, **settings).stdout


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(WORK, ignore_errors=True)
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", WORK,
            "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")  # Fast.
        cls.packages = {file.name.split("_")[0]: file for file in WORK.glob("*.deb")}
        for name, file in cls.packages.items():
            run("dpkg-deb", "--extract", file, WORK / name)

    def field(self, name, field):
        return run("dpkg-deb", "--field", self.packages[name], field).strip()

    def files(self, name):
        """The files, relative to the root."""
        root = WORK / name
        return {str(file.relative_to(root)) for file in root.rglob("*") if not file.is_dir()}

    def depends(self, name):
        """What the package depends on, without versions."""
        return re.sub(r" \([^)]*\)", "", self.field(name, "Depends")).split(", ")

    def test_there_is_one_for_each_part(self):
        self.assertEqual(sorted(self.packages),
                         ["kinetri", "libkinetri-dev", "libkinetri-io-dev"] + (["python3-kinetri"] if PYTHON else []))
        for name in self.packages:
            self.assertEqual(self.field(name, "Version"), VERSION + "-1")
            self.assertEqual(self.field(name, "Architecture"),
                             run("dpkg", "--print-architecture").strip())
            self.assertRegex(self.field(name, "Maintainer"), r"^.+ <.+@.+>$")
            owners = {line.split()[1] for line in
                      run("dpkg-deb", "--contents", self.packages[name]).splitlines()}
            self.assertEqual(owners, {"root/root"})

    def test_the_program_depends_on_the_libraries_that_it_is_linked_with(self):
        depends = self.depends("kinetri")
        for name in ("libc6", "libgmp10", "libstdc++6", "libtbb12"):
            self.assertIn(name, depends)
        self.assertFalse([name for name in depends if name.endswith("-dev")])
        self.assertEqual(self.field("kinetri", "Section"), "math")

    def test_the_library_depends_on_what_its_headers_include(self):
        self.assertEqual(self.field("libkinetri-dev", "Depends").split(", "), DEVELOPMENT_NEEDS)
        needs = self.field("libkinetri-io-dev", "Depends").split(", ")
        self.assertEqual([name for name in needs if name not in OPTIONAL],
                         [f"libkinetri-dev (= {VERSION}-1)"])
        for name in ("libkinetri-dev", "libkinetri-io-dev"):
            self.assertEqual(self.field(name, "Section"), "libdevel")

    def test_files_of_the_program(self):
        self.assertEqual(self.files("kinetri"), {
            "usr/bin/kinetri",
            "usr/bin/kinetri-verify",
            "usr/share/bash-completion/completions/kinetri",
            "usr/share/doc/kinetri/changelog.Debian.gz",
            "usr/share/doc/kinetri/copyright",
            "usr/share/fish/vendor_completions.d/kinetri.fish",
            "usr/share/man/man1/kinetri.1.gz",
            "usr/share/man/man1/kinetri-verify.1.gz",
            "usr/share/zsh/vendor-completions/_kinetri",
        })
        page = gzip.decompress((WORK / "kinetri/usr/share/man/man1/kinetri.1.gz").read_bytes())
        self.assertIn(b".SH NAME", page)

    def test_files_of_the_libraries(self):
        files = self.files("libkinetri-dev")
        of_files = self.files("libkinetri-io-dev")
        of_programs = re.compile(  # as in headers/public_headers_test.py
            r"include/kinetri/impl/(io/|kinetic/drawn_box_2|observers/(answer_columns|connections|spanning_tree_rows)"
            r"|simulation/(experiment|playback|wave))")
        headers = {str(file.relative_to(SOURCE)) for file in (SOURCE / "include").rglob("*.h")}
        headers = {file for file in headers if not of_programs.match(file)}
        io = {file for file in headers if file.startswith("include/kinetri/io/")}
        self.assertEqual({file[4:] for file in files if file.startswith("usr/include/")},
                         headers - io | {"include/kinetri/version.h"})
        self.assertEqual({file[4:] for file in of_files if file.startswith("usr/include/")}, io)
        self.assertLessEqual({"libkinetri_io.a", "kinetri-io.pc", "KinetriIoTargets.cmake"},
                             {pathlib.Path(file).name for file in of_files})
        documents = "usr/share/doc/libkinetri-dev/"
        for name in ("copyright", "changelog.Debian.gz", "README.md", "docs/ARCHITECTURE.md"):
            self.assertIn(documents + name, files)
        others = {re.sub(r"/lib/[\w-]+-linux-gnu/", "/lib/", file) for file in files
                  if not file.startswith(("usr/include/", documents))}
        self.assertLessEqual({"usr/lib/libkinetri.a", "usr/lib/pkgconfig/kinetri.pc",
                              "usr/lib/cmake/Kinetri/KinetriConfig.cmake",
                              "usr/lib/cmake/Kinetri/KinetriTargets.cmake"}, others)
        self.assertFalse([file for file in others
                          if not file.startswith(("usr/lib/", "usr/share/lintian/"))])

    def test_the_python_package_depends_on_python_and_numpy_alone(self):
        if not PYTHON:
            self.skipTest("the Python package is not built")
        depends = self.depends("python3-kinetri")
        self.assertLessEqual({"libc6", "libgmp10", "libstdc++6", "libtbb12", "python3", "python3-numpy"},
                             set(depends))
        self.assertFalse([name for name in depends if not name.startswith(("lib", "python3"))
                          or name.endswith("-dev") or name.startswith("kinetri")])
        if pathlib.Path("/usr/share/numpy3/versions").exists():
            self.assertRegex(" ".join(depends), r"\bpython3-numpy-abi\d+\b")
        major, minor = map(int, run(PYTHON, "-c",
                                    "import sys; print(*sys.version_info[:2])").split())
        self.assertIn(f"python3 (>= {major}.{minor}~), python3 (<< {major}.{minor + 1}~)",
                      self.field("python3-kinetri", "Depends"))
        self.assertEqual(self.field("python3-kinetri", "Suggests").split(", "), [
            f"python3-{name}" for name in ("distributed", "matplotlib", "pandas", "tqdm")])
        self.assertEqual(self.field("python3-kinetri", "Section"), "python")
        # What it runs when it is installed and removed.
        control = WORK / "control"
        run("dpkg-deb", "--control", self.packages["python3-kinetri"], control)
        for name in ("postinst", "prerm"):
            self.assertTrue((control / name).stat().st_mode & 0o100)
            run("sh", "-n", control / name)

    def test_files_of_the_python_package(self):
        if not PYTHON:
            self.skipTest("the Python package is not built")
        folder = "usr/lib/python3/dist-packages/kinetri/"
        suffix = run(PYTHON, "-c", "import sysconfig; print(sysconfig.get_config_var('EXT_SUFFIX'))")
        code = {file.name for pattern in ("*.py", "*.pyi", "py.typed")
                for file in (SOURCE / "python/kinetri").glob(pattern)}
        self.assertEqual(self.files("python3-kinetri"), {
            *(folder + name for name in code), folder + "_kinetri" + suffix.strip(),
            "usr/share/doc/python3-kinetri/changelog.Debian.gz",
            "usr/share/doc/python3-kinetri/copyright",
        })

    def test_the_unpacked_python_package_runs(self):
        if not PYTHON:
            self.skipTest("the Python package is not built")
        text = run(PYTHON, "-c", """if True:
            import kinetri
            kd = kinetri.KineticDelaunay(*kinetri.scenario("uniform", 50, seed=1))
            print(kinetri.__file__, kinetri.__version__, len(kd.record(1)) > 5, bool(kd.audit()))""",
                   cwd=WORK, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1", "PYTHONPATH": str(
                       WORK / "python3-kinetri/usr/lib/python3/dist-packages")})
        file = WORK / "python3-kinetri/usr/lib/python3/dist-packages/kinetri/__init__.py"
        self.assertEqual(text, f"{file} {VERSION} True True\n")

    def test_no_file_names_a_path_of_this_machine(self):
        for name in self.packages:
            for file in self.files(name):
                content = (WORK / name / file).read_bytes()
                for path in (BUILD, SOURCE):
                    self.assertNotIn(bytes(path), content, f"{file} names {path}")

    def test_the_unpacked_program_runs(self):
        program = WORK / "kinetri/usr/bin/kinetri"
        points = run(program, "generate", "uniform", "--points", "20", "--seed", "1")
        events = run(program, "simulate", "-", "--until", "2", "--events", "-", "--audit", "end",
                     "--quiet", input=points)
        self.assertGreater(len(events.splitlines()), 5)


if __name__ == "__main__":
    BUILD, SOURCE = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    VERSION, WORK = sys.argv[3], pathlib.Path(sys.argv[4]).resolve()
    PYTHON = sys.argv[5] if len(sys.argv) > 5 else None
    missing = [tool for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps") if not shutil.which(tool)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (Debian: cmake, dpkg-dev)")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
