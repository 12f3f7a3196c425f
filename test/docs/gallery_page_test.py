#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/gallery/run.html is, byte for byte, what the commands beside it in docs/gallery/README.md write.

usage: gallery_page_test.py PROGRAM FOLDER [--write]

PROGRAM is kinetri, FOLDER is docs/gallery. With --write the page is written again.
"""
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

PAGE = "run.html"
POINTS = "small.csv"
# The commands that make the points and the page; kinetri render reads the page.
COMMAND = re.compile(rf"^    kinetri ((?!render ).*(?:{POINTS}|{PAGE}).*)$", re.MULTILINE)


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--write"]):
        sys.exit(__doc__)
    program, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    commands = COMMAND.findall((folder / "README.md").read_text(encoding="utf-8"))
    if len(commands) != 2 or f"--html {PAGE}" not in commands[-1]:
        sys.exit(f"{folder / 'README.md'}: expected one command that writes {POINTS}, and one that writes {PAGE}; "
                 f"found {commands}")
    with tempfile.TemporaryDirectory(prefix="kinetri-gallery-") as work:
        for command in commands:
            subprocess.run([program, *shlex.split(command)], cwd=work, check=True, capture_output=True)
        written = pathlib.Path(work, PAGE)
        if sys.argv[3:]:
            shutil.copyfile(written, folder / PAGE)
        elif written.read_bytes() != (folder / PAGE).read_bytes():
            sys.exit(f"{folder / PAGE} is not what its commands write now; look at the page that they write, and keep it:\n"
                     f"  {' '.join(map(shlex.quote, [*sys.argv, '--write']))}")


if __name__ == "__main__":
    main()
