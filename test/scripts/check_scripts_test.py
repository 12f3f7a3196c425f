#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the checks in scripts/: each finds what it is for, and lets pass what is right."""
import contextlib
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

import check_documents  # noqa: E402
import check_layers  # noqa: E402
import check_messages  # noqa: E402
import check_sources  # noqa: E402
import run_clang_tidy  # noqa: E402
import summarize_coverage  # noqa: E402
import summarize_tests  # noqa: E402

LICENCE = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
FIRST_INCLUDE = '#include "kinetri/base/cxx20.h"\n'


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
            ("src/io/a.cpp", "fmt/format.h"),
            ("src/io/b.cpp", "nlohmann/json.hpp"),
            ("src/io/c.cpp", "unistd.h"),
            ("apps/kinetri/a.cpp", "CLI/CLI.hpp"),
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
        text = LICENCE + f"#ifndef {guard}\n#define {guard}\n{FIRST_INCLUDE}#endif\n"
        self.assertEqual(self.problems("include/kinetri/io/points_file.h", text), [])
        found = self.problems("include/kinetri/io/points_file.h", text.replace(FIRST_INCLUDE, ""))
        self.assertEqual(found, ["include/kinetri/io/points_file.h:1: no public header included; "
                                 "expected kinetri/base/cxx20.h"])

    def test_a_wrong_guard_fails(self):
        text = LICENCE + f"#ifndef KINETRI_H\n#define KINETRI_H\n{FIRST_INCLUDE}#endif\n"
        found = self.problems("include/kinetri/io/points_file.h", text)
        self.assertEqual(
            found, ["include/kinetri/io/points_file.h:1: no include guard KINETRI_IO_POINTS_FILE_H"]
        )

    def test_a_source_begins_with_its_own_header(self):
        header = f"{LICENCE}#ifndef KINETRI_IO_A_H\n#define KINETRI_IO_A_H\n{FIRST_INCLUDE}#endif\n"
        own, other = '#include "kinetri/io/a.h"\n', "#include <vector>\n"
        self.assertEqual(self.problems("src/io/a.cpp", LICENCE + other), [])  # it has none
        self.write("include/kinetri/io/a.h", header)
        self.assertEqual(self.problems("src/io/a.cpp", LICENCE + own + other), [])
        for wrong in (other + own, other, ""):
            with self.subTest(text=wrong):
                self.assertEqual(len(self.problems("src/io/a.cpp", LICENCE + wrong)), 1)

    def test_a_missing_licence_fails(self):
        for name in ("src/a.cpp", "CMakeLists.txt", "README.md", ".ci/run"):
            with self.subTest(name=name):
                self.assertEqual(len(self.problems(name, "one\ntwo\nthree\n" + LICENCE)), 1)
                (self.root / name).unlink()

    def test_a_path_of_a_machine_fails(self):
        for path in ("/home/" + "someone/x", "/root" + "/x", "/Users" + "/me"):
            with self.subTest(path=path):
                self.assertEqual(len(self.problems("a.sh", f"# {LICENCE}cd {path}\n")), 1)

    def test_ordinary_paths_pass(self):
        text = LICENCE + "// /usr/lib, ~/work/x, a/root/b, ${HOME}/work/x, https://a.org/home\n"
        self.assertEqual(self.problems("a.cpp", text), [])

    def test_blanks_where_none_belong_fail(self):
        for text in ("\tx\n", "x \n", "x"):
            with self.subTest(text=text):
                self.assertEqual(len(self.problems("a.cpp", LICENCE + text)), 1)

    def test_what_is_built_is_not_checked(self):
        self.assertEqual(self.problems("build/test/a.cpp", "x"), [])
        self.assertEqual(check_sources.check(self.root)[0], 0)


class Messages(Tree):
    """A tree with one listed message, which a source has, and what a test adds."""

    def setUp(self):
        super().setUp()
        self.rows = ["| `<file>:<line>: the row has <n> fields; expected <m>` | 2 | a comma too many | |"]
        self.write("src/io/a.cpp", 'fail(fmt::format("the row has {} fields; "\n  "expected {}", n, m));\n')

    def violations(self):
        self.write("docs/ERRORS.md", "\n".join(["| Message |", "|---|", *self.rows]) + "\n")
        return check_messages.check(self.root)[1]

    def assert_violations(self, *begins):
        found = self.violations()
        self.assertEqual(len(found), len(begins), found)
        for violation, begin in zip(found, begins):
            self.assertTrue(violation.startswith(begin), violation)

    def test_a_listed_message_passes(self):
        self.assert_violations()

    def test_a_message_without_a_row_fails(self):
        self.write("src/io/b.cpp", '\nthrow Input_error(file, 0, "the moon is full");\n')
        self.write("apps/kinetri/c.cpp", '  throw Usage_error(too_long ? "--a: too long" : "--a: too short");\n')
        self.write("include/kinetri/io/d.h", 'inline const char* problem() { return "no cheese left"; }\n')
        self.write("viewer/e.js", "demand(a, `it has ${a} ` +\n  'of these');\n")
        self.write("scripts/f.sh", 'kinetri_fail "the sky fell: $sky"\n')
        self.assert_violations('include/kinetri/io/d.h:1: "no cheese left"',
                               'src/io/b.cpp:2: "the moon is full"',
                               'apps/kinetri/c.cpp:1: "--a: too long"',
                               'apps/kinetri/c.cpp:1: "--a: too short"',
                               'viewer/e.js:1: "it has ${a} of these"',
                               'scripts/f.sh:1: "the sky fell: $sky"')

    def test_what_is_no_message_passes(self):
        self.write("apps/kinetri/c.cpp", 'add("--a", a_, "What a is"); // throw Usage_error("so it is")\n')
        self.write("src/io/b.cpp", 'KINETRI_ASSERT(a, "a is not b"); f("key", R"(a b c)", \'"\');\n')
        self.assert_violations()

    def test_a_changed_message_and_a_row_without_a_message_fail(self):
        self.rows.append("| `the sea is <color>` | Input_error | | |")
        self.write("src/io/b.cpp", 'fail("the sea was " + color);\n')
        self.assert_violations('src/io/b.cpp:1: "the sea was"',
                               'docs/ERRORS.md:4: no source says "the sea is <color>"')

    def test_a_precondition_without_a_test_fails(self):
        self.rows.append("| `the queue is empty` | Precondition_error | | |")
        self.write("src/events/b.cpp", 'KINETRI_PRECONDITION(!empty(), "the queue is empty");\n')
        self.assert_violations('src/events/b.cpp:1: "the queue is empty" is in no test')
        self.write("test/events/b_test.cpp", 'EXPECT_PRECONDITION_ERROR(top(), "the queue "\n"is empty");\n')
        self.assert_violations()


class Misuse(unittest.TestCase):
    def test_a_wrong_command_line_is_named_before_the_usage(self):
        for script, arguments, problem in (
                ("demo.sh", ["--points"], "--points has no value"),
                ("demo.sh", ["now"], "'now' is unknown"),
                ("test.sh", ["--filter"], "--filter has no value"),
                ("test.sh", ["--fast"], "'--fast' is unknown"),
                ("test.sh", ["--compiler", "no-c++"], "--compiler: there is no program no-c++"),
                ("fuzz.sh", ["--seconds", "x"], "--seconds: 'x' is no whole number greater than 0"),
                ("fuzz.sh", ["bugs"], "'bugs' is unknown")):
            with self.subTest(script, arguments=arguments):
                run = subprocess.run([SCRIPTS / script, *arguments], capture_output=True, text=True,
                                     check=False)
                self.assertEqual((run.returncode, run.stdout), (2, ""))
                self.assertTrue(run.stderr.startswith(f"error: {problem}\n\nusage: "), run.stderr)


class Summary(Tree):
    def outcome(self, test):
        self.write("results.xml", f"<testsuite>{test}</testsuite>")
        tree = summarize_tests.ElementTree.parse(self.root / "results.xml")
        return summarize_tests.outcome(tree.getroot().find("testcase"))

    def test_outcomes(self):
        skipped = '<testcase status="notrun"><skipped message="{}"/></testcase>'
        for test, expected in (
            ('<testcase status="run"/>', "passed"),
            ('<testcase status="fail"/>', "failed"),
            ('<testcase status="disabled"/>', "skipped"),
            (skipped.format("SKIP_RETURN_CODE=77"), "skipped"),
            (skipped.format("SKIP_REGULAR_EXPRESSION_MATCHED"), "skipped"),
            (skipped.format("Unable to find executable"), "failed"),
            (skipped.format("Fixture dependency failed"), "failed"),
        ):
            with self.subTest(test=test):
                self.assertEqual(self.outcome(test), expected)


class Documents(Tree):
    PROGRAM = "int main() {\n  f();\n\n  g();\n}\n"
    GUIDE = "[p](../../examples/p.cpp) [CMake](../../examples/CMakeLists.txt)\n"

    def setUp(self):
        super().setUp()
        self.write("test/install/consumer/main.cpp", LICENCE + self.PROGRAM)
        self.write("README.md", f"```cpp\n{self.PROGRAM}```\n")
        self.write("examples/p.cpp", LICENCE + self.PROGRAM)
        self.write("examples/p.txt", "one\ntwo\nthree\n")
        self.write("examples/CMakeLists.txt", "find_package(Kinetri)\n")
        self.write("examples/other.txt", "four\n")
        self.write("docs/guide/p.md", self.GUIDE + "```cpp\n  f();\n```\n")

    def problems(self, path, text):
        self.write(path, text)
        return check_documents.check(self.root)[1]

    def block_problems(self, language, text):
        page = self.GUIDE + f"```{language}\n{text}```\n```cpp\nint main() {{\n```\n"
        return self.problems("docs/guide/p.md", page)

    def test_the_program_of_the_readme_is_the_one_that_is_tested(self):
        self.assertEqual(check_documents.check(self.root), (2, []))
        for text in ("", "```cpp\nint main() {\n```\n", f"```\n{self.PROGRAM}```\n"):
            found = self.problems("README.md", text)
            self.assertEqual(
                found, ["README.md:1: no block is the program test/install/consumer/main.cpp"]
            )

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
        found = self.problems("examples/q.cpp", LICENCE)
        self.assertEqual(found, ["examples/q.cpp:1: no page of docs/guide shows it"])

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


class Lint(Tree):
    def run_check(self, check, name, text):
        self.write(name, text)
        command = [str(SCRIPTS / "lint.sh"), "--only", check, str(self.root / name)]
        result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if result.returncode == 77:
            self.skipTest(result.stdout.strip())
        return result

    def test_each_check_finds_what_it_is_for(self):
        for check, name, good, bad in (
            ("shell", "a.sh", '#!/bin/bash\necho "$1"\n', "#!/bin/bash\necho $1\n"),
            ("python", "a.py", "print(1)\n", "import os\n"),
            ("javascript", "a.js", "let x = 1;\n", "let x = ;\n"),
        ):
            with self.subTest(check=check):
                self.assertEqual(self.run_check(check, name, good).returncode, 0)
                result = self.run_check(check, name, bad)
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(name, result.stdout)
                self.assertNotIn("lint: ok", result.stdout)

    def test_what_is_not_known_is_refused(self):
        for arguments in (["--only", "spelling"], ["--only"], ["--chnged"], ["no_such_file.sh"]):
            with self.subTest(arguments=arguments):
                result = subprocess.run([str(SCRIPTS / "lint.sh"), *arguments], text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertIn(result.returncode, (1, 2))
                self.assertRegex(result.stderr, "usage|no such file")


class Clang_tidy(Tree):
    """Which sources clang-tidy looks at, and what is made of its output."""

    def setUp(self):
        super().setUp()
        root = run_clang_tidy.ROOT
        self.addCleanup(setattr, run_clang_tidy, "ROOT", root)
        run_clang_tidy.ROOT = self.root.resolve()
        self.write("include/kinetri/io/a.h", "")
        self.write("include/kinetri/io/b.h", '#include "kinetri/io/a.h"\n')
        self.write("include/kinetri/io/lonely.h", "")
        self.write("src/io/a.cpp", '#include "kinetri/io/a.h"\n')
        self.write("src/io/0.cpp", '#include "kinetri/io/b.h"\n')
        self.sources = {"src/io/0.cpp", "src/io/a.cpp"}

    def test_a_header_is_seen_through_a_source_that_includes_it(self):
        for files, expected in (
            (["src/io/0.cpp"], ["src/io/0.cpp"]),
            (["include/kinetri/io/a.h"], ["src/io/a.cpp"]),
            (["include/kinetri/io/b.h"], ["src/io/0.cpp"]),
            (["include/kinetri/io/a.h", "src/io/0.cpp"], ["src/io/0.cpp"]),
        ):
            with self.subTest(files=files):
                self.assertEqual(run_clang_tidy.sources_for(files, self.sources), (expected, []))

    def test_a_header_that_is_not_included_is_named(self):
        header = "include/kinetri/io/lonely.h"
        self.assertEqual(run_clang_tidy.sources_for([header], self.sources), ([], [header]))

    def test_each_source_counts_as_it_is_compiled_first(self):
        build = self.root / "build"
        entries = [{"directory": str(build), "file": file, "command": command} for file, command in (
            ("../src/io/a.cpp", "first"), ("../src/io/a.cpp", "second"), ("made.cpp", "made"),
            ("/usr/x.cpp", "other"))]
        self.write("build/compile_commands.json", json.dumps(entries))
        found = run_clang_tidy.compilations(build.resolve())
        self.assertEqual({k: v["command"] for k, v in found.items()}, {"src/io/a.cpp": "first"})

    def test_findings_are_told_from_each_other(self):
        root = run_clang_tidy.ROOT
        text = f"{root}/a.cpp:1:2: warning: w [x]\n  code\n{root}/a.h:3:4: error: e [y]\n"
        self.assertEqual(list(run_clang_tidy.findings("noise\n" + text)), [
            ("a.cpp:1:2: warning: w [x]", "a.cpp:1:2: warning: w [x]\n  code"),
            ("a.h:3:4: error: e [y]", "a.h:3:4: error: e [y]"),
        ])


class Coverage(Tree):
    def summary(self, files):
        self.write("coverage.json", json.dumps({"files": files}))
        text, arguments = io.StringIO(), sys.argv
        try:
            sys.argv = ["summarize_coverage.py", str(self.root / "coverage.json")]
            with contextlib.redirect_stdout(text):
                code = summarize_coverage.main()
        finally:
            sys.argv = arguments
        return code, text.getvalue()

    def test_layers(self):
        for path, layer in (
            ("include/kinetri/algebra/a.h", "algebra"),
            ("include/kinetri/triangulation/detail/a_impl.h", "triangulation"),
            ("src/io/a.cpp", "io"),
            ("apps/kinetri/a.cpp", "apps"),
            ("include/kinetri/kinetri.h", None),
            ("test/io/a.cpp", None),
            ("bench/a.cpp", None),
        ):
            with self.subTest(path=path):
                self.assertEqual(summarize_coverage.layer_of(path), layer)

    def test_names_are_short(self):
        for name, expected in (
            ("kinetri::f(int, std::vector<int> const&)", "f"),
            ("kinetri::(anonymous namespace)::f()", "f"),
            ("kinetri::A<kinetri::B<int> >::f(int) const", "A::f"),
            ("void kinetri::detail::f<int (*)(int)>(int)", "detail::f"),
            ("kinetri::f(int)::{lambda(auto:1)#1}::operator()(int) const", "f"),
        ):
            with self.subTest(name=name):
                self.assertEqual(summarize_coverage.short_name(name), expected)

    def test_what_is_covered_and_what_is_not(self):
        def line(number, count, *branches):
            return {"line_number": number, "count": count,
                    "branches": [{"count": count} for count in branches]}

        code, text = self.summary([{
            "file": "src/io/a.cpp",
            "lines": [line(1, 2), line(2, 1, 1, 0), line(3, 0), line(4, 0, 0, 0), line(6, 0),
                      line(7, 1, 1, 1), dict(line(8, 0), **{"gcovr/noncode": True})],
            # The third and the fourth are instances of one template.
            "functions": [
                {"name": "kinetri::f()", "lineno": 1, "execution_count": 2},
                {"name": "kinetri::g(int)", "lineno": 3, "execution_count": 0},
                {"name": "void kinetri::h<int>()", "lineno": 5, "execution_count": 1},
                {"name": "void kinetri::h<char>()", "lineno": 5, "execution_count": 0},
            ],
        }, {"file": "test/io/a_test.cpp", "lines": [line(1, 0)]}])
        self.assertEqual(code, 0)
        self.assertIn("""src/io/a.cpp
  never called: g (3)
  never run: 3-4, 6
  a branch never taken: 2
""", text)
        self.assertNotIn("a_test", text)
        rows = {row.split()[0]: row.split()[1:] for row in text.splitlines() if " of " in row}
        expected = "2 of 3 66.6 % 3 of 6 50.0 % 3 of 6 50.0 %".split()
        self.assertEqual(rows["io"], expected)
        self.assertEqual(rows["all"], expected)
        self.assertEqual(rows["base"], "0 of 0 - 0 of 0 - 0 of 0 -".split())

    def test_nearly_all_is_not_all(self):
        self.assertEqual(summarize_coverage.share(9999, 10000), "99.9 %")

    def test_a_report_without_sources_is_no_success(self):
        self.assertEqual(self.summary([])[0], 1)


if __name__ == "__main__":
    unittest.main()
