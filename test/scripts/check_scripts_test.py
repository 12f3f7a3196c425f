#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the checks in scripts/: each finds what it is for, and lets pass what is right."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

import check_documents  # noqa: E402
import check_layers  # noqa: E402
import check_sources  # noqa: E402

LICENSE = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
FIRST_INCLUDE = '#include "kinetri/base/platform.h"\n'


class Tree(unittest.TestCase):
    """A test with a source tree of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")


class Layers(Tree):
    def setUp(self):
        super().setUp()
        for layer in check_layers.LAYERS:
            if layer != "apps":
                self.write(f"include/kinetri/{layer}/{layer}.h", "")
        self.write("include/kinetri/kinetri.h", '#include "kinetri/io/io.h"\n')

    def violations(self, path, text):
        self.write(path, text)
        return check_layers.check(self.root)[1]

    def assert_violation(self, path, text, line):
        found = self.violations(path, text)
        self.assertEqual(len(found), 1, found)
        self.assertTrue(found[0].startswith(f"{path}:{line}: "), found[0])

    def test_every_downward_include_passes(self):
        for upper, number in check_layers.LAYERS.items():
            folder = "apps" if upper == "apps" else f"src/{upper}"
            for lower, other in check_layers.LAYERS.items():
                if other < number or (upper == lower != "apps"):
                    text = f'#include "kinetri/{lower}/{lower}.h"\n'
                    self.assertEqual(self.violations(f"{folder}/{lower}.cpp", text), [])

    def test_every_upward_include_fails(self):
        for lower, number in check_layers.LAYERS.items():
            for upper, other in check_layers.LAYERS.items():
                if upper not in ("apps", lower) and other >= number:
                    with self.subTest(lower=lower, upper=upper):
                        path = f"include/kinetri/{lower}/upward.h"
                        text = f'\n#include "kinetri/{upper}/{upper}.h"\n'
                        self.assert_violation(path, text, 2)
                        (self.root / path).unlink()

    def test_relative_and_angle_includes_are_seen(self):
        self.assert_violation("src/base/a.cpp", "#  include <kinetri/io/io.h>\n", 1)
        (self.root / "src/base/a.cpp").unlink()
        text = '#include "../../include/kinetri/io/io.h"\n'
        self.assert_violation("src/base/b.cpp", text, 1)

    def test_tests_are_checked_too(self):
        self.assert_violation("test/base/a_test.cpp", '#include "kinetri/io/io.h"\n', 1)

    def test_tests_may_look_sideways_and_use_support(self):
        self.write("test/support/motions.h", "")
        text = '#include "kinetri/events/events.h"\n#include "../support/motions.h"\n'
        self.assertEqual(self.violations("test/kinetic/a_test.cpp", text), [])

    def test_tests_of_no_layer_may_use_everything(self):
        self.assertEqual(self.violations("test/property/a.cpp", '#include "kinetri/io/io.h"\n'), [])

    def test_the_umbrella_is_for_the_program_only(self):
        text = '#include "kinetri/kinetri.h"\n'
        self.assertEqual(self.violations("apps/kinetri/main.cpp", text), [])
        self.assert_violation("src/simulation/a.cpp", text, 1)

    def test_missing_files_fail(self):
        self.assert_violation("src/io/a.cpp", '#include "nlohmann/json.hpp"\n', 1)

    def test_comments_do_not_count(self):
        text = '// #include "kinetri/io/io.h"\n/*\n#include "kinetri/io/io.h"\n*/\n'
        self.assertEqual(self.violations("src/base/a.cpp", text), [])

    def test_lines_are_counted_through_block_comments(self):
        text = '/* one\n * two */\n#include "kinetri/io/io.h"\n'
        self.assert_violation("src/base/a.cpp", text, 3)

    def test_libraries_where_they_belong_pass(self):
        for path, name in (
            ("src/base/a.cpp", "type_traits"),
            ("src/algebra/a.cpp", "boost/multiprecision/gmp.hpp"),
            ("src/algebra/b.cpp", "gmp.h"),
            ("src/algebra/c.cpp", "CGAL/enum.h"),
            ("src/kinetic/a.cpp", "CGAL/Bbox_2.h"),
            ("src/triangulation/a.cpp", "CGAL/Delaunay_triangulation_2.h"),
            ("src/io/a.cpp", "boost/crc.hpp"),
            ("src/io/b.cpp", "nlohmann/json.hpp"),
            ("src/io/c.cpp", "unistd.h"),
            ("apps/cli/a.cpp", "CLI/CLI.hpp"),
            ("apps/kinetri/b.cpp", "sys/resource.h"),
            ("test/algebra/a_test.cpp", "gtest/gtest.h"),
        ):
            with self.subTest(path=path):
                self.assertEqual(self.violations(path, f"#include <{name}>\n"), [])

    def test_libraries_elsewhere_fail(self):
        for path, name in (
            ("src/base/a.cpp", "boost/optional.hpp"),
            ("src/base/a.cpp", "stdint.h"),
            ("src/algebra/a.cpp", "CGAL/Delaunay_triangulation_2.h"),
            ("src/kinetic/a.cpp", "CGAL/Triangulation_2.h"),
            ("src/kinetic/a.cpp", "CGAL/Delaunay_triangulation_2.h"),
            ("src/events/a.cpp", "CGAL/enum.h"),
            ("src/events/a.cpp", "gmp.h"),
            ("src/triangulation/a.cpp", "fmt/format.h"),
            ("src/simulation/a.cpp", "unistd.h"),
            ("src/io/a.cpp", "CLI/CLI.hpp"),
            ("apps/kinetri/a.cpp", "boost/program_options.hpp"),
        ):
            with self.subTest(path=path, name=name):
                self.assert_violation(path, f"#include <{name}>\n", 1)
                (self.root / path).unlink()

    def test_an_empty_tree_is_no_success(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(check_layers.check(pathlib.Path(folder)), (0, []))


class Sources(Tree):
    def problems(self, path, text):
        self.write(path, text)
        return check_sources.check(self.root)[1]

    def test_a_good_header_passes(self):
        guard = "KINETRI_IO_POINTS_FILE_H"
        text = LICENSE + f"#ifndef {guard}\n#define {guard}\n{FIRST_INCLUDE}#endif\n"
        self.assertEqual(self.problems("include/kinetri/io/points_file.h", text), [])
        found = self.problems("include/kinetri/io/points_file.h", text.replace(FIRST_INCLUDE, ""))
        self.assertEqual(found, ["include/kinetri/io/points_file.h:1: no public header included; "
                                 "expected kinetri/base/platform.h"])

    def test_a_wrong_guard_fails(self):
        text = LICENSE + f"#ifndef KINETRI_H\n#define KINETRI_H\n{FIRST_INCLUDE}#endif\n"
        found = self.problems("include/kinetri/io/points_file.h", text)
        self.assertEqual(
            found, ["include/kinetri/io/points_file.h:1: no include guard KINETRI_IO_POINTS_FILE_H"]
        )

    def test_tests_are_in_a_namespace_named_after_their_file(self):
        path = "test/io/a_test.cpp"
        for right in ("kinetri::a_test", "kinetri::app::a_test", "kinetri::io_a_test"):
            self.assertEqual(self.problems(path, f"{LICENSE}namespace {right} {{\n}}\n"), [])
        for wrong in ("kinetri", "kinetri::test", "kinetri::b_a_test", "a_test"):
            with self.subTest(namespace=wrong):
                found = self.problems(path, f"{LICENSE}namespace {wrong} {{\n}}\n")
                self.assertEqual(found, [f"{path}:1: expected a namespace ...::a_test around the tests"])

    def test_a_source_begins_with_its_own_header(self):
        header = f"{LICENSE}#ifndef KINETRI_IO_A_H\n#define KINETRI_IO_A_H\n{FIRST_INCLUDE}#endif\n"
        own, other = '#include "kinetri/io/a.h"\n', "#include <vector>\n"
        self.assertEqual(self.problems("src/io/a.cpp", LICENSE + other), [])  # it has none
        self.write("include/kinetri/io/a.h", header)
        self.assertEqual(self.problems("src/io/a.cpp", LICENSE + own + other), [])
        for wrong in (other + own, other, ""):
            with self.subTest(text=wrong):
                self.assertEqual(len(self.problems("src/io/a.cpp", LICENSE + wrong)), 1)

    def test_a_missing_license_fails(self):
        for name in ("src/a.cpp", "CMakeLists.txt", "README.md", ".ci/run"):
            with self.subTest(name=name):
                self.assertEqual(len(self.problems(name, "one\ntwo\nthree\n" + LICENSE)), 1)
                (self.root / name).unlink()

    def test_a_path_of_a_machine_fails(self):
        for path in ("/home/" + "someone/x", "/root" + "/x", "/Users" + "/me"):
            with self.subTest(path=path):
                self.assertEqual(len(self.problems("a.sh", f"# {LICENSE}cd {path}\n")), 1)

    def test_ordinary_paths_pass(self):
        text = LICENSE + "// /usr/lib, ~/project/x, a/root/b, ${HOME}/project/x, https://a.org/home\n"
        self.assertEqual(self.problems("a.cpp", text), [])

    def test_blanks_where_none_belong_fail(self):
        for text in ("\tx\n", "x \n", "x"):
            with self.subTest(text=text):
                self.assertEqual(len(self.problems("a.cpp", LICENSE + text)), 1)

    def test_a_precondition_that_no_test_breaks_fails(self):
        text = LICENSE + 'KINETRI_PRECONDITION(!empty(),\n  "the queue is empty");\n'
        self.assertEqual(self.problems("src/events/a.cpp", text),
                         ['src/events/a.cpp:2: "the queue is empty" is in no test; break it in one'])
        test = (LICENSE + "namespace kinetri::a_test {\n}\n" +
                'EXPECT_PRECONDITION_ERROR(top(), "the queue "\n  "is empty");\n')
        self.assertEqual(self.problems("test/events/a_test.cpp", test), [])

    def test_what_is_built_is_not_checked(self):
        self.assertEqual(self.problems("build/test/a.cpp", "x"), [])
        self.assertEqual(check_sources.check(self.root)[0], 0)


class Documents(Tree):
    PROGRAM = "int main() {\n  f();\n\n  g();\n}\n"
    OUTPUT = "one\ntwo\nthree\n"
    GUIDE = "[p](../../examples/p.cpp) [CMake](../../examples/CMakeLists.txt)\n"
    WHOLE = f"```cpp\n{PROGRAM}```\n```text\n{OUTPUT}```\n"

    def setUp(self):
        super().setUp()
        self.write("test/install/consumer/main.cpp", LICENSE + self.PROGRAM)
        self.write("README.md", f"```cpp\n{self.PROGRAM}```\n")
        self.write("examples/p.cpp", LICENSE + self.PROGRAM)
        self.write("examples/p.txt", self.OUTPUT)
        self.write("examples/CMakeLists.txt", "find_package(Kinetri)\n")
        self.write("examples/other.txt", "four\n")
        self.write("docs/guide/p.md", self.GUIDE + self.WHOLE)

    def problems(self, path, text):
        self.write(path, text)
        return check_documents.check(self.root)[1]

    def block_problems(self, language, text):
        page = self.GUIDE + f"```{language}\n{text}```\n"
        return self.problems("docs/guide/p.md", page + self.WHOLE)

    def test_the_program_of_the_readme_is_the_one_that_is_tested(self):
        self.assertEqual(check_documents.check(self.root), (2, []))
        for text in ("", "```cpp\nint main() {\n```\n", f"```\n{self.PROGRAM}```\n"):
            found = self.problems("README.md", text)
            self.assertEqual(
                found, ["README.md:1: no block is the program test/install/consumer/main.cpp"]
            )

    def test_links_of_the_start_page_lead_to_files(self):
        right = '<a href="guide/p.md#x"></a><a href="https://example.org/">\n'
        self.assertEqual(self.problems("docs/index.html", right), [])
        for missing in ('<a href="gone.html">', '<img src="gone.svg">'):
            target = missing.split('"')[1]
            self.assertEqual(self.problems("docs/index.html", right + missing),
                             [f"docs/index.html:2: a link to {target}, which is not there"])

    def test_what_stands_there_passes(self):
        for language, text in (
            ("cpp", self.PROGRAM),
            ("cpp", "  f();\n\n  g();\n"),
            ("cpp", "f();\n\ng();\n"),
            ("text", "two\nthree\n"),
            ("cmake", "find_package(Kinetri)\n"),
            ("sh", "anything\n"),
        ):
            with self.subTest(text=text):
                self.assertEqual(self.block_problems(language, text), [])

    def test_what_stands_elsewhere_or_nowhere_fails(self):
        for language, text in (
            ("cpp", "h();\n"),
            ("cpp", "  f()\n"),
            ("cpp", "  f();\n  g();\n"),
            ("cpp", "    f();\n"),
            ("cpp", "f();\n\n  g();\n"),
            ("cpp", ""),
            ("text", "one\nthree\n"),
            ("text", "tw\n"),
            ("text", "four\n"),
            ("csv", "1,2\n"),
            ("", "one\n"),
            ("python", "f()\n"),
        ):
            with self.subTest(text=text):
                found = self.block_problems(language, text)
                self.assertEqual(len(found), 1, found)
                self.assertTrue(found[0].startswith("docs/guide/p.md:2: "), found[0])

    def test_a_program_that_no_page_shows_fails(self):
        found = self.problems("examples/q.cpp", LICENSE)
        self.assertEqual(found, ["examples/q.cpp:1: no page of docs/guide shows it"])

    def test_a_short_program_or_an_output_that_is_shown_in_part_fails(self):
        part, long = "  g();\n}\n", LICENSE + self.PROGRAM + "\n" * 100
        for block, program, expected in (
            (f"```cpp\n{part}```\n", None, ["the whole of its 6 lines"]),
            (f"```cpp\n{part}```\n```text\n{self.OUTPUT}```\n", long, []),
            (f"```cpp\n{self.PROGRAM}```\n", None, ["the whole of p.txt"]),
            (f"```cpp\n{self.PROGRAM}```\n```text\ntwo\nthree\n```\n", None, ["the whole of p.txt"]),
        ):
            with self.subTest(block=block):
                self.write("examples/p.cpp", program or LICENSE + self.PROGRAM)
                found = self.problems("docs/guide/p.md", self.GUIDE + block)
                prefix = "examples/p.cpp:1: no page of docs/guide shows "
                self.assertEqual(found, [prefix + text for text in expected])

    def test_a_python_program_is_shown_as_it_is(self):
        program, page = '"""What."""\nf()\n', "[q](../../examples/python/q.py)\n"
        self.write("examples/python/q.py", LICENSE.replace("//", "#") + program)
        self.write("examples/python/q.txt", self.OUTPUT)
        whole = f"```python\n{program}```\n```text\n{self.OUTPUT}```\n"
        self.assertEqual(self.problems("docs/guide/q.md", page + whole), [])
        prefix = "examples/python/q.py:1: no page of docs/guide shows "
        for text, expected in ((page, [prefix + "it"]),
                               (page + "```python\nf()\n```\n", [prefix + "the whole of its 3 lines"]),
                               (page + f"```python\n{program}```\n", [prefix + "the whole of q.txt"]),
                               (page + whole + "```python\ng()\n```\n",
                                ["docs/guide/q.md:11: a python block that does not stand in q.py"])):
            with self.subTest(text=text):
                self.assertEqual(self.problems("docs/guide/q.md", text), expected)

    def test_links_that_lead_somewhere_pass(self):
        text = """
# A *name*, with `code()`
## Twice
## Twice
[a](../README.md) ![b](../examples/p.txt) [c](guide/p.md) [d](../examples) [e](#a-name-with-code)
[f](a.md#twice-1) [g](https://a.org/none.md) `[h](none.md)` [i](../examples/p.txt#L3) [j](<a.md>)
    [k](none.md)
```sh
[l](none.md)
# no heading
```
"""
        self.assertEqual(self.problems("docs/a.md", text), [])

    def test_links_that_lead_nowhere_fail(self):
        for link in (
            "none.md", "README.md", "../none/a.md", "a.md#none", "#twice-2", "a.md#no-heading",
            "../../outside.md", "../..", "/README.md", "<none.md>", 'none.md "a title"',
        ):
            for text in (f"[a]({link})", f"words ![a]({link}), [b](a.md)", f"- [a\\_b]({link})"):
                with self.subTest(text=text):
                    page = f"# Twice\n# Twice\n{text}\n```sh\n# no heading\n```\n"
                    found = self.problems("docs/a.md", page)
                    self.assertEqual(len(found), 1, found)
                    self.assertTrue(found[0].startswith("docs/a.md:3: a link to "), found[0])

    def test_links_whose_text_is_broken_are_seen(self):
        self.assertEqual(len(self.problems("docs/a.md", "a [b\nc](none.md) d\n")), 1)

    def test_links_of_the_other_kind_are_seen(self):
        self.assertEqual(self.problems("docs/a.md", "[a]: a.md\n"), [])
        self.assertEqual(len(self.problems("docs/a.md", "[a]: none.md\n")), 1)

    def test_what_is_built_is_not_checked(self):
        self.assertEqual(self.problems("build/a.md", "[a](none.md)"), [])


class Shell_scripts(Tree):
    """The shell scripts, in a root of their own with programs of the test's instead of the system's."""

    def setUp(self):
        super().setUp()
        self.root = self.root / "a folder" / "kinetri"
        shutil.copytree(SCRIPTS, self.root / "scripts")
        self.program("dpkg-query", "echo installed")

    def program(self, name, text):
        self.write(f"bin/{name}", f"#!/bin/sh\n{text}\n")
        (self.root / "bin" / name).chmod(0o755)

    def run_script(self, *command):
        path = f"{self.root / 'bin'}:{os.environ['PATH']}"
        return subprocess.run([str(word) for word in command], capture_output=True, text=True,
                              check=False, env={**os.environ, "PATH": path})

    def test_a_wrong_command_line_is_named_before_the_usage(self):
        for script, arguments, problem in (
                ("demo.sh", ["--points"], "--points has no value"),
                ("demo.sh", ["now"], "'now' is unknown"),
                ("test.sh", ["--preset"], "--preset has no value"),
                ("test.sh", ["--preset", "fast"], "--preset: 'fast' is unknown"),
                ("test.sh", ["--compiler", "no-c++"], "--compiler: there is no program no-c++"),
                ("lint.sh", ["spelling"], "'spelling' is unknown"),
                ("fuzz.sh", ["--seconds", "x"], "--seconds: 'x' is no whole number greater than 0"),
                ("fuzz.sh", ["bugs"], "'bugs' is unknown")):
            with self.subTest(script, arguments=arguments):
                run = self.run_script(self.root / "scripts" / script, *arguments)
                self.assertEqual((run.returncode, run.stdout), (2, ""))
                self.assertTrue(run.stderr.startswith(f"error: {problem}"), run.stderr)
                self.assertIn("\n\nusage: ", run.stderr)

    def test_the_last_line_of_the_tests_counts_them(self):
        self.program("cmake", "exit 0")
        line = "1/9 Test #1: a.b ..... "
        for output, last, code in (
                ("100% tests passed, 0 tests failed out of 9", "9 passed, 0 failed", 0),
                (f"{line}***Skipped 0.1 sec\n100% tests passed, 0 tests failed out of 9",
                 "8 passed, 0 failed, 1 skipped", 0),
                (f"{line}***Failed 0.1 sec\n78% tests passed, 2 tests failed out of 9",
                 "7 passed, 2 failed", 1),
                (f"{line}***Skipped 0.1 sec\n100% tests passed, 0 tests failed out of 1",
                 "0 passed, 0 failed, 1 skipped", 1),
                ("No tests were found!!!", "No tests were found!!!", 1)):
            with self.subTest(output):
                self.program("ctest", f"printf '{output.replace('%', '%%')}\\n'; exit 8")
                run = self.run_script(self.root / "scripts/test.sh")
                self.assertEqual((run.stdout.splitlines()[-1], run.returncode), (last, code), run)

    def test_cases_of_one_process_are_counted_and_named(self):
        self.program("cmake", "exit 0")
        results = self.root / "results"
        results.write_text("1/3 Testing: a.1\n[ RUN      ] A.x\n[       OK ] A.x (0 ms)\n[ RUN      ] A.y\nwhy"
                           "[  SKIPPED ] A.y (0 ms)\n[  SKIPPED ] A.y\n2/3 Testing: a.2\n[ RUN      ] A.z\n"
                           "[       OK ] A.z (0 ms)\n[ RUN      ] A.u\n[  FAILED  ] A.u, where GetParam() = 3 (0 ms)\n"
                           "[ RUN      ] A.v\n3/3 Testing: b\n", encoding="utf-8")
        folder = self.root / "build/test/Testing/Temporary"
        folder.mkdir(parents=True)
        self.program("ctest", f"""cp '{results}' '{folder}/LastTest.log'
            echo '1/3 Test #1: a.1 ... Passed 0.1 sec\n2/3 Test #2: a.2 ...***Exception: SegFault 0.1 sec'
            echo '3/3 Test #3: b ... Passed 0.1 sec\n66% tests passed, 1 tests failed out of 3'""")
        run = self.run_script(self.root / "scripts/test.sh")
        self.assertEqual(run.stdout.splitlines()[-4:],
                         ["skipped: a.A.y", "failed: a.A.u", "failed: a.A.v", "3 passed, 2 failed, 1 skipped"])

    def test_the_tests_say_how_long_they_take_before_they_begin(self):
        self.program("cmake", "exit 0")
        self.program("ctest", "echo '100% tests passed, 0 tests failed out of 9'")
        run = self.run_script(self.root / "scripts/test.sh")
        self.assertRegex(run.stdout, r"^To build everything .* about an hour of processor time, 35 minutes on")
        self.assertLess(run.stdout.index("an hour"), run.stdout.index("Building in "))
        some = self.run_script(self.root / "scripts/test.sh", "-R", "kinetic")
        self.assertTrue(some.stdout.startswith("Building in "), some.stdout)

    def test_what_takes_long_says_how_far_it_is(self):
        for step in ("[12/87] Building CXX object", "[ 34%] Building CXX object", " 5/9 Test  #1: a"):
            with self.subTest(step):
                run = self.run_script("bash", "-euc", f"""source '{self.root}/scripts/setup.sh'
                    kinetri_progress_seconds=0.2
                    kinetri_quietly building '{self.root}/log' sh -c 'echo "{step}"; sleep 1'""")
                shown = step.split(" Building")[0].split("  #")[0]
                self.assertIn(f"  {shown} (", run.stdout, run.stderr)
                self.assertEqual(run.returncode, 0)

    def test_what_fails_shows_its_errors(self):
        run = self.run_script("bash", "-euc", f"""source '{self.root}/scripts/setup.sh'
            kinetri_quietly building '{self.root}/log' sh -c 'echo a; echo "x.cpp:1: error: b"; exit 3'""")
        self.assertEqual(run.returncode, 1)
        self.assertEqual(run.stderr, f"x.cpp:1: error: b\nerror: building failed; all of its output is in {self.root}/log\n")

    def test_a_package_that_cannot_be_installed_is_named(self):
        self.program("dpkg-query", '[ "$3" = libcgal-dev ] || echo installed')
        self.program("apt-get", "exit 100")
        self.program("apt-cache", "exit 100")
        run = self.run_script(self.root / "scripts/setup.sh", "demo")
        self.assertEqual(run.returncode, 1)
        self.assertIn("apt-get install -y libcgal-dev", run.stderr)
        if os.geteuid() == 0:
            self.assertIn("could not install: libcgal-dev\nNot in its package lists: libcgal-dev", run.stderr)
            self.assertIn("cmake --preset release && cmake --build --preset release", run.stderr)

    def test_each_check_finds_what_it_is_for(self):
        for folder in (".ci", "apps", "bench", "data", "examples", "include", "src", "test", "viewer"):
            (self.root / folder).mkdir()
        for check, name, good, bad in (
            ("format", "src/a.cpp", "int a;\n", "int  a;\n"),
            ("shell", "scripts/a.sh", '#!/bin/bash\necho "$1"\n', "#!/bin/bash\necho $1\n"),
            ("python", "test/a.py", "print(1)\n", "import os\n"),
            ("javascript", "viewer/a.js", "let x = 1;\n", "let x = ;\n"),
        ):
            with self.subTest(check=check):
                self.write(name, good)
                run = self.run_script(self.root / "scripts/lint.sh", check)
                if run.returncode == 77:
                    self.skipTest(run.stdout.strip())
                self.assertEqual((run.returncode, run.stdout), (0, "lint: ok\n"), run.stderr)
                self.write(name, bad)
                run = self.run_script(self.root / "scripts/lint.sh", check)
                self.assertEqual(run.returncode, 1, run.stdout)
                self.assertIn(name, run.stdout + run.stderr)
                self.assertIn(f"found something: {check}", run.stderr)


if __name__ == "__main__":
    unittest.main()
