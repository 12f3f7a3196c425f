#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of scripts/doxygen_filter.py and of scripts/check_names.py: what Doxygen gets to read, and
which names are found to be wrong."""
import pathlib
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

import check_names  # noqa: E402
import doxygen_filter  # noqa: E402


class Tree(unittest.TestCase):
    """A test with a source tree of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        return file


class Filter(Tree):
    def assert_filtered(self, path, text, expected):
        self.assertEqual(doxygen_filter.filtered(self.write(path, text), self.root), expected)

    def test_the_beginning_of_a_header_is_the_comment_of_the_file_and_its_layer_a_group(self):
        self.assert_filtered(
            "include/kinetri/io/a.h",
            "// SPDX\n//\n// What it is.\n#ifndef A\n// Why.\nnamespace kinetri {\n"
            "int f();  // says so\n}  // namespace kinetri\n",
            "/// \\file\n///\n/// What it is.\n#ifndef A\n// Why.\n"
            "namespace kinetri { /** \\addtogroup io */ /** @{ */\n"
            "int f();  // says so\n/** @} */ }  // namespace kinetri\n")

    def test_a_header_beside_the_layers_belongs_to_the_lowest(self):
        self.assert_filtered("include/kinetri/version.h", "// SPDX\nnamespace kinetri {\n",
                             "/// \\file\nnamespace kinetri { /** \\addtogroup base */ /** @{ */\n")

    def test_a_defaulted_comparison_says_what_it_does_unless_it_does_so_itself(self):
        comparison = "  friend bool operator==(const A&, const A&) = default;"
        self.assert_filtered("io/a.h", f"int x;\n{comparison}\n",
                             f"int x;\n{comparison}  ///< Compares all members.\n")
        self.assert_filtered("io/a.h", f"int x;\n  /// @}}\n{comparison}\n",
                             f"int x;\n  /// @}}\n{comparison}  ///< Compares all members.\n")
        self.assert_filtered("io/a.h", f"  /// Says it.\n{comparison}\n",
                             f"  /// Says it.\n{comparison}\n")

    def test_explicit_instantiations_and_friends_are_not_seen(self):
        self.assert_filtered("io/a.h", "  friend class B<\n      int>;\n  friend bool f(A);\n",
                             "\n\n  friend bool f(A);\n")
        self.assert_filtered("io/a.h", "extern template class A<int>;\nextern template int f(\n"
                             "    const A<int>&);\nint g();\n", "\n\n\nint g();\n")

    def test_an_indented_block_in_a_comment_is_code_and_an_indented_line_of_a_list_is_none(self):
        self.assert_filtered("io/a.h", "///\n///   a  b\n///     c\n/// text\n///   more\n",
                             "///\n///     a  b\n///       c\n/// text\n///   more\n")

    def test_headings_are_named_by_the_document_and_links_to_them_follow(self):
        self.write("README.md", "")
        self.write("docs/B.md", "<!-- no heading -->\n# The other\n")
        self.assert_filtered(
            "docs/A.md", "# What `it` is, and why\n[other](../README.md#the-end) [a](#b) [c](B.md)\n[d](../README.md)\n",
            "# What `it` is, and why {#docs_A-what-it-is-and-why}\n"
            "[other](@ref README-the-end) [a](@ref docs_A-b) [c](@ref docs_B-the-other)\n[d](@ref index)\n")

    def test_links_to_other_files_are_text_and_pictures_and_addresses_stay(self):
        self.assert_filtered("A.md", "[licence](LICENSE) ![p](p.png) [w](https://a.b/c.html#d)\n",
                             "licence ![p](p.png) [w](https://a.b/c.html#d)\n")

    def test_a_picture_is_named_without_its_folders(self):
        self.assert_filtered("docs/A.md", "![p](../gallery/p.png) ![q](https://a.b/q.png)\n",
                             "![p](p.png) ![q](https://a.b/q.png)\n")

    def test_code_with_an_apostrophe_gets_double_marks(self):
        self.assert_filtered("A.md", "`a` don't `f, f'` it's `b`\n", "`a` don't ``f, f'`` it's `b`\n")

    def test_blocks_of_code_stay_as_they_are(self):
        text = "```sh\n# no heading [a](LICENSE) `f'`\n```\n"
        self.assert_filtered("A.md", text, text)


class Names(Tree):
    def setUp(self):
        super().setUp()
        self.write("include/kinetri/io/a.h", "int there();  // not_there\n")

    def violations(self, path, text):
        self.write(path, text)
        return check_names.check(self.root)[1]

    def test_names_and_paths_are_looked_for_in_the_code_but_not_in_its_comments(self):
        self.assertEqual(self.violations("docs/ARCHITECTURE.md", "`there()` `io/a.h` gone\n"), [])
        self.assertEqual(self.violations("docs/ARCHITECTURE.md", "`not_there` `io/b.h`\n"),
                         ["docs/ARCHITECTURE.md:1: `not_there` is not in the code",
                          "docs/ARCHITECTURE.md:1: no such file: io/b.h"])

    def test_names_of_others_pass_in_their_document_alone(self):
        self.assertEqual(self.violations("docs/TERMINOLOGY.md", "`Simulator`\n"), [])
        self.assertEqual(len(self.violations("docs/MATH.md", "`Simulator`\n")), 1)

    def test_of_the_migration_guide_our_column_and_our_code_count(self):
        text = ("`theirs`\n\n| `theirs` | `there` |\n\n```cpp\n// CGAL 4.11\ntheirs();\n```\n"
                "```cpp\n// Kinetri\nthere();  // and a comment\n```\n")
        self.assertEqual(self.violations("docs/MIGRATION.md", text), [])
        text = "| `there` | `gone` |\n```cpp\n// Kinetri: now\nthere(lost);\n```\n"
        self.assertEqual(self.violations("docs/MIGRATION.md", text),
                         ["docs/MIGRATION.md:1: `gone` is not in the code",
                          "docs/MIGRATION.md:4: `lost` is not in the code"])


if __name__ == "__main__":
    unittest.main()
