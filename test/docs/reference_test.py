#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The reference manual is made without a warning, has a page for each public header and document, and
its links lead somewhere; and the same settings find what is not documented.

usage: reference_test.py DOXYFILE OUTPUT ROOT

Exit code 77 where there is no Doxygen, or another one than that of Debian 12: each version warns of
other things.
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

# Every name that begins with `silent` is one of which nothing is said.
HEADER = """// SPDX-License-Identifier: GPL-3.0-or-later
//
// A header.
#ifndef GUARD
/// Says something.
#define SAID 1
#define silent_macro 1

namespace kinetri {

/// Says something.
class A {
 public:
  /// Says something.
  void said();
  /// @{
  /// Says something of both.
  void said(int x);
  void said(double x);
  /// @}
  friend bool operator==(const A&, const A&) = default;
  int said_too = 0;  ///< says something

  int silent_member();
  // Says something, but not to users.
  int silent_member_with_a_comment();
  int silent_variable = 0;
  using silent_type = int;
  struct silent_nested_class {
    int silent_variable_of_it = 0;
  };

 private:
  void hidden();
};

/// Says something.
void f(int x);
void silent_function(int x);
template <class T>
T silent_template(T x);
class silent_class {
 public:
  void silent_member_of_it();
};
enum class silent_enumeration { a };
inline constexpr int silent_constant = 1;

/// See \\ref nowhere.
void g();

}  // namespace kinetri
#endif
"""

DOXYFILE, OUTPUT, ROOT = None, None, None


def doxygen(settings):
    """What Doxygen says, and its exit code, with more settings than those of the file."""
    text = DOXYFILE.read_text(encoding="utf-8") + "\n" + settings
    run = subprocess.run(["doxygen", "-"], input=text, capture_output=True, encoding="utf-8",
                         check=False)
    return run.stdout + run.stderr, run.returncode


class Reference(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTPUT, ignore_errors=True)
        cls.said, cls.code = doxygen("")
        cls.pages = {page.name: page.read_text(encoding="utf-8")
                     for page in (OUTPUT / "html").glob("*.html")}

    def test_there_is_no_warning(self):
        self.assertEqual((self.said, self.code), ("", 0))

    def test_each_public_header_has_a_page_and_a_group(self):
        headers = [path.relative_to(ROOT / "include")
                   for path in sorted((ROOT / "include").rglob("*.h"))
                   if "impl" not in path.parts and not path.name.endswith("_impl.h")]
        self.assertGreater(len(headers), 40)
        for header in headers:
            with self.subTest(header=header):
                page = header.name.replace("_", "__").replace(".h", "_8h.html")
                self.assertTrue(page in self.pages, page)
                self.assertIn(f"include/{header.parent}/", self.pages[page])
                if len(header.parts) > 2:
                    self.assertIn(f"group__{header.parts[1]}.html", self.pages)

    def test_each_concept_says_what_it_asks_for(self):
        # Doxygen 1.9.4 does not tell of those that do not.
        concepts = 0
        for header in sorted((ROOT / "include").rglob("*.h")):
            lines = header.read_text(encoding="utf-8").splitlines()
            for i, line in enumerate(lines):
                if line.startswith("concept "):
                    concepts += 1
                    with self.subTest(concept=line):
                        self.assertTrue(lines[i - 2].startswith("///"))
        self.assertGreater(concepts, 2)

    def test_what_is_internal_is_not_shown(self):
        shown = [page for page in self.pages if "detail" in page or "_impl" in page]
        self.assertEqual(shown, [])

    def test_each_document_is_a_page_and_its_links_lead_somewhere(self):
        written = {name: text for name, text in self.pages.items()
                   if name.startswith("md_") or name == "index.html"}
        documents = list((ROOT / "docs").rglob("*.md"))
        self.assertGreater(len(written), len(documents))
        names = {name: set(re.findall(r'(?:id|name)="([^"]+)"', text))
                 for name, text in self.pages.items()}
        links = 0
        for page, text in written.items():
            for link in re.findall(r'<a\s[^>]*href="([^"]*)"', text):
                link = html.unescape(link)
                if re.match(r"\w+:", link):
                    continue
                links += 1
                file, _, name = link.partition("#")
                file = urllib.parse.unquote(file) or page
                with self.subTest(page=page, link=link):
                    self.assertTrue((OUTPUT / "html" / file).is_file())
                    self.assertTrue(not name or name in names[file])
        self.assertGreater(links, 100)
        for page, text in written.items():
            prose = re.sub(r"<code>.*?</code>|<pre.*?</pre>|<div class=\"line\">.*?</div>", "", text,
                           flags=re.DOTALL)
            with self.subTest(page=page):
                self.assertNotIn("](", prose)
        for page, text in written.items():
            for picture in re.findall(r'<(?:img|object)[^>]*(?:src|data)="([^"]*)"', text):
                with self.subTest(page=page, picture=picture):
                    self.assertTrue((OUTPUT / "html" / picture).is_file())


class Undocumented(unittest.TestCase):
    @staticmethod
    def check(text):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            header = folder / "base" / "a.h"
            header.parent.mkdir()
            header.write_text(text, encoding="utf-8")
            groups = ROOT / "docs" / "groups.dox"
            return doxygen(f'INPUT = "{header}" "{groups}"\nUSE_MDFILE_AS_MAINPAGE =\n'
                           f'OUTPUT_DIRECTORY = "{folder}"\n')

    def test_what_says_everything_passes(self):
        text = re.sub(r"(?m)^(?!/|#define SAID)(?=.*\bsilent_|template <class T>)", "/// Says it.\n", HEADER)
        self.assertEqual(self.check(text.replace("ref nowhere", "ref f")), ("", 0))

    def test_what_says_nothing_is_found(self):
        said, code = self.check(HEADER)
        self.assertNotEqual(code, 0)
        names = sorted(set(re.findall(r"silent_\w+", HEADER)))
        self.assertGreater(len(names), 10)
        for name in names + ["nowhere"]:
            with self.subTest(name=name):
                self.assertRegex(said, rf"\b{name}\b")
        self.assertNotRegex(said, r"\b(said|SAID|said_too|hidden|f|operator==)\b")


if __name__ == "__main__":
    VERSION = (subprocess.run(["doxygen", "--version"], capture_output=True, encoding="utf-8",
                              check=True).stdout.split() if shutil.which("doxygen") else None)
    if not VERSION or VERSION[0] != "1.9.4":
        print("no doxygen 1.9.4 (Debian 12: doxygen): the reference manual is not checked")
        sys.exit(77)
    DOXYFILE, OUTPUT, ROOT = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    del sys.argv[1:4]
    unittest.main()
