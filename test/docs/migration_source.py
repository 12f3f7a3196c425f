#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the code for Kinetri in docs/MIGRATION.md as one program, as that document says it compiles.

usage: migration_source.py DOCUMENT SOURCE
"""
import pathlib
import re
import sys


def main():
    document, source = (pathlib.Path(argument) for argument in sys.argv[1:3])
    blocks = re.findall(r"(?m)^```cpp\n// Kinetri(.*)\n((?:(?!```).*\n)*)```$",
                        document.read_text(encoding="utf-8"))
    outside = [code for title, code in blocks if "namespace scope" in title]
    inside = [code for title, code in blocks if "namespace scope" not in title]
    if not outside or len(inside) < 8:
        sys.exit(f"{document}: expected blocks of code that begin with // Kinetri")
    source.write_text("\n".join(
        ["#include <kinetri/kinetri.h>", "#include <iostream>", "#include <vector>", *outside,
         "int main() {", *inside, "}", ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
