# SPDX-License-Identifier: GPL-3.0-or-later
"""A case of a message of the program: a command line, with the files and the surroundings that bring the
message about. Cases are in input_messages.py and run_messages.py; messages_test.py runs them.
"""
import dataclasses
import functools
import json
import pathlib
import subprocess
import sys
import tempfile
import zlib

# The arguments of messages_test.py.
PROGRAM, FAULTY_PROGRAM = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])

ONE_FLIP = "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n"
DISCS = "x,y,vx,vy,radius\n0,0,1,0,1\n5,0,0,0,1\n0,9,0,0,1\n"
TRACKS = "t,id,x,y\n0,a,0,0\n0,b,9,0\n5,a,1,1\n5,b,9,1\n"
FILES = {"p.csv": ONE_FLIP, "d.csv": DISCS, "t.csv": TRACKS, "old.csv": "before"}

NO_FILE = "No such file or directory"
DENIED = "Permission denied"


@dataclasses.dataclass
class Case:
    """A command line, and what stands for the placeholders of the row that it brings about."""

    arguments: str
    values: dict
    files: dict = dataclasses.field(default_factory=dict)
    environment: dict = dataclasses.field(default_factory=dict)
    prepare: object = None  # called with the directory, before the run
    meanwhile: object = None  # called with it and the process when that waits for p.csv, a pipe
    output: object = subprocess.PIPE  # a path takes its place
    closes_output: bool = False
    limit_files: int = 0  # how many the process may have open
    unprivileged: bool = False  # as a user whom permissions bind
    faulty: bool = False
    writes: bool = False  # other lines, and outputs
    below: str = ""  # the directory, in that of the files, in which it is run


def case(arguments, files=None, **options):
    fields = {field.name for field in dataclasses.fields(Case)}
    values = {name: str(value) for name, value in options.items() if name not in fields}
    options = {name: value for name, value in options.items() if name in fields}
    return Case(arguments, values, files or {}, **options)


def simulate(more, **options):
    return case("simulate p.csv --until 1 " + more, **options)


def points(content, more="--until 1", **options):
    return case("simulate p.csv " + more, files={"p.csv": content}, file="p.csv", **options)


def walkable(text, **options):
    return case("simulate p.csv --until 1 --areas a --walkable w", files={"w": text}, file="w", **options)


def tracks(content, more="", **options):
    return case("tracks t.csv " + more, files={"t.csv": content}, file="t.csv", **options)


@functools.cache
def checkpoint(content=ONE_FLIP, options="--until 2"):
    """The checkpoint of a run of the points."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, "p.csv")
        path.write_text(content, encoding="utf-8")
        subprocess.run([PROGRAM, "simulate", path, *options.split(), "--checkpoint", f"{folder}/c",
                        "--quiet"], check=True)
        return pathlib.Path(folder, "c").read_text(encoding="utf-8")


def signed(text):
    return text + f"checksum {zlib.crc32(text.encode()):08x}\n"


def forged(change, *run):
    """The checkpoint of the run with a state that was changed, and a checksum that is right."""
    text = checkpoint(*run)
    begin = text.index("\n") + 1
    state = json.loads(text[begin : text.rindex("checksum")])
    change(state)
    return signed(text[:begin] + json.dumps(state) + "\n")


def setter(*keys):
    """Sets the member that all but the last name to the last."""
    *keys, last, value = keys

    def change(state):
        for key in keys:
            state = state[key]
        state[last] = value

    return change
