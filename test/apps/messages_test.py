#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Brings about every message of the program, which messages.txt lists: each case runs the program on
something that is wrong, and expects exactly one listed message, byte for byte, its exit code, nothing on
standard output, and a directory as it was before. Every listed message has a case.

usage: messages_test.py PROGRAM FAULTY_PROGRAM
"""
import dataclasses
import functools
import json
import os
import pathlib
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIST = pathlib.Path(__file__).with_name("messages.txt")
SECTION = re.compile(r"\[exit code (\d+)(, usage)?\]")
PLACEHOLDER = re.compile(r"<[a-z]\w*>")

PROGRAM, FAULTY_PROGRAM = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])

# Listed messages that are not brought about, by the reason.
WITHOUT_CASE = {
    "only where the system has an empty mounted directory": [
        "<path>: is where a file system is mounted; expected a directory in it"],
    "it would take a file of many gigabytes": [
        "<file>:<line>: there are too many points; expected at most 4294967294"],
}

ONE_FLIP = "x,y,vx,vy\n0,0,0,0\n4,0,0,0\n0,4,0,0\n3,3,1,1\n"
DISCS = "x,y,vx,vy,radius\n0,0,1,0,1\n5,0,0,0,1\n0,9,0,0,1\n"
TRACKS = "t,id,x,y\n0,a,0,0\n0,b,9,0\n5,a,1,1\n5,b,9,1\n"
FILES = {"p.csv": ONE_FLIP, "d.csv": DISCS, "t.csv": TRACKS, "old.csv": "before"}

COMMANDS = "generate, simulate, resume, tracks, wave, experiment, completion, manual or help"
SCENARIOS = "uniform, gaussian, constant-speed, one-mover, lattice or lattice-jitter"
POINTS_COLUMNS = "x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any order"
TRACKS_COLUMNS = "t,id,x,y, in any order"
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


def tracks(content, more="", **options):
    return case("tracks t.csv " + more, files={"t.csv": content}, file="t.csv", **options)


def usage_cases():
    yield case("", commands=COMMANDS)
    yield case("stimulate", word="stimulate", name="simulate")
    yield case("arrange", word="arrange", commands=COMMANDS)
    yield case("help arrange", word="arrange", commands=COMMANDS)
    yield case("generate uniform --point 5", word="--point", name="--points")
    yield simulate("--evnets e.csv", word="--evnets", name="--events")
    yield case("--wrong", word="--wrong", commands=COMMANDS)
    yield case("--quiet simulate p.csv --until 1", word="--quiet")
    yield case("--points 5 generate uniform --points 5", word="--points")
    yield case("generate --points 5 uniform --points 5", word="--points")
    yield case("generate", commands=SCENARIOS)
    yield case("generate spiral", word="spiral", commands=SCENARIOS)
    yield simulate("--wrong", word="--wrong")
    yield simulate("q.csv", word="q.csv")
    yield case("resume p.csv --until 3 --box 0,0,1,1", word="--box")
    yield case("generate uniform --points 5 --spacing 1", word="--spacing")
    yield case("simulate p.csv", option="--until", value="T")
    yield case("resume p.csv", option="--until", value="T")
    yield case("generate uniform", option="--points", value="N")
    for command, argument in (("simulate", "POINTS"), ("resume", "CHECKPOINT"), ("tracks", "TRACKS")):
        yield case(command, argument=argument)
    yield case("completion", argument="SHELL", choices="bash|zsh|fish")
    yield case("completion tcsh", option="SHELL", text="tcsh", choices="bash, zsh or fish")
    yield case("manual page", word="page")
    yield case("simulate p.csv --until", option="--until")
    yield case("simulate p.csv --until=", option="--until")
    yield simulate("--fps", option="--fps")
    yield simulate("--until 2", option="--until")
    yield simulate("--fps 1 --frames-per-time 2", option="--fps")
    yield simulate("--quiet=perhaps", flag="--quiet", value="perhaps")
    yield case("experiment --output r --events e", option="--events", other="--single")
    yield case("experiment --seed 3", option="--seed", other="--single")
    yield case("experiment --single 50 --output r", option="--output", other="--single")


def number_cases():
    """Values of options."""
    for text in ("soon", "", "1,5", "--1"):
        yield case(f"simulate p.csv --until '{text}'" if text else "generate uniform --points 1 --side ''",
                   option="--until" if text else "--side", text=text)
    for text in ("inf", "-nan"):
        yield case(f"simulate p.csv --until {text}", option="--until", text=text)
    yield case("simulate p.csv --until 1e999", option="--until", text="1e999")
    yield simulate("--from nan", option="--from", text="nan")
    yield simulate("--box 0,0,1,inf", option="--box", text="inf")
    yield simulate("--frames f --fps many", option="--fps,--frames-per-time", text="many")
    yield case("wave --until x", option="--until", text="x")
    yield simulate("--collisions log --radius -0.5", option="--radius", number=-0.5)
    yield simulate("--frames f --fps 0", option="--fps,--frames-per-time", number=0)
    yield case("tracks t.csv --max-gap 0", option="--max-gap", number=0)
    yield case("wave --speed 0", option="--speed", number=0, lowest=1e-100, highest=1e100)
    yield case("generate lattice --points 5 --speed 0.5", option="--speed", number=0.5, lowest=1,
               highest=9007199254740992)
    yield case("generate uniform --points 5 --speed -1", option="--speed", number=-1, lowest=1e-100,
               highest=1e100)
    for text in ("-1", "many", "", "1.5", "1e3", "100000001", "9" * 23, "0x10", " 5"):
        yield case(f"generate uniform --points '{text}'", option="--points", text=text,
                   highest=100000000)
    yield case("generate uniform --points 5 --seed -1", option="--seed", text="-1",
               highest=18446744073709551615)
    yield case("experiment --single 101", option="--single", text="101", highest=100)
    for option, word, choices in (("--audit", "all", "none, end or events"),
                                  ("--progress", "loud", "auto, always or never"),
                                  ("--collisions", "bump", "none, log, swap, elastic, stop or remove")):
        yield simulate(f"{option} {word}", option=option, text=word, choices=choices)
    yield case("tracks t.csv --format xml", option="--format", text="xml", choices="rows or frames")
    yield case("experiment --output r --collisions none", option="--collisions", text="none",
               choices="log, swap, elastic, stop or remove")
    yield case("generate lattice --points 5 --movers two", option="--movers", text="two",
               choices="none, one, columns or all")


def meaning_cases():
    """Options that do not go together."""
    yield simulate("--from 1.5", until=1, **{"from": 1.5}, what="--from")
    yield case("simulate p.csv --until -1", until=-1, **{"from": 0}, what="--from")
    yield case("tracks t.csv --until -1", until=-1, **{"from": 0}, what="the first observation")
    yield case("resume c --until 1.5", files={"c": checkpoint()}, until=1.5, file="c", time=2)
    yield simulate("--box 0,0,1", text="0,0,1", n=3)
    yield simulate("--box 0,0,1,2,3", text="0,0,1,2,3", n=5)
    yield simulate("--box 0,0,1,2,", text="0,0,1,2,", n=5)
    yield simulate("--box 5,0,5,9", text="5,0,5,9")
    yield simulate("--rim")
    yield simulate("--rim --box -5,-5,15,5 --radius 5", radius=5)
    yield simulate("--radius 1")
    yield case("tracks t.csv --radius 1")
    yield case("simulate d.csv --until 1 --collisions log --radius 1", file="d.csv")
    for option in ("--collisions", "--rim"):
        yield simulate("--collisions swap" if option == "--collisions" else "--rim --box -5,-5,5,5",
                       option=option, file="p.csv")
    yield case("tracks t.csv --collisions log")
    yield case("tracks t.csv --fps 25")
    yield simulate("--fps 5", option="--fps,--frames-per-time")
    yield simulate("--frames-per-time 5", option="--fps,--frames-per-time")
    yield case("tracks t.csv --frames-per-time 5", option="--frames-per-time")
    yield simulate("--frames f --fps 1e9", option="--fps,--frames-per-time", rate="1000000000",
                   **{"from": 0}, until=1, most=1000000)
    nowhere = {"PATH": "/nowhere"}
    yield simulate("--plot plot.svg", environment=nowhere, otherwise="no --plot")
    yield case("experiment --output r", environment=nowhere, otherwise="--no-plots")
    yield case("tracks t.csv --closest 0")
    yield case("experiment --output r --points 0")
    yield case("experiment --output r --seeds 0")
    yield case("experiment")
    yield case("wave --columns 0", option="--columns")
    yield case("wave --rows 0", option="--rows")
    yield case("wave --rows 1000000 --columns 2", columns=2, rows=1000000, most=1000000)
    yield case("wave --radius 5", radius=5, half=5)
    yield case("wave --jitter 5", jitter=5, room=4.921875)
    yield simulate("--edges p.csv", option="--edges", path="p.csv")
    yield case("resume c --until 3 --checkpoint c", files={"c": checkpoint()}, option="--checkpoint",
               path="c")
    yield simulate("--edges old.csv --events ./old.csv", option="--events", other="--edges",
                   path="old.csv")
    yield simulate("--edges - --stats -", option="--edges", other="--stats", path="-")
    yield case("tracks t.csv --closest 1 --edges -", option="--edges", other="--closest", path="-")
    yield simulate("--frames f --edges f/edges.csv", option="--edges", path="f/edges.csv",
                   other="--frames", directory="f", prepare=lambda d: (d / "f").mkdir())
    yield simulate("--frames ./f/ --vtu f", option="--vtu", path="f", other="--frames",
                   directory="./f/")
    yield simulate("--frames f --vtu f/v", option="--vtu", path="f/v", other="--frames", directory="f",
                   prepare=lambda d: (d / "f").mkdir())
    yield simulate("--frames f --edges f", option="--edges", path="f", other="--frames", directory="f")
    yield case("wave --html x --events x", option="--events", other="--html", path="x")


def table_cases():
    """Files of points and tracks."""
    for content, command in (("points", "simulate {} --until 1"), ("tracks", "tracks {}"),
                             ("a simulation's state", "resume {} --until 1")):
        yield case(command.format("."), file=".", content=content)
        yield case(command.format("missing"), file="missing", content=content, reason=NO_FILE)
        yield case(command.format("old.csv"), file="old.csv", content=content, reason=DENIED,
                   unprivileged=True, prepare=lambda d: (d / "old.csv").chmod(0))
    for content, command in (("points", "simulate"), ("tracks", "tracks")):
        yield case(f"{command} /proc/self/mem" + (" --until 1" if command == "simulate" else ""),
                   file="/proc/self/mem", line=1, content=content)
    yield points("", columns=POINTS_COLUMNS)
    yield points("# x,y,vx,vy\n\n", columns=POINTS_COLUMNS)
    yield case("simulate - --until 1", file="standard input", columns=POINTS_COLUMNS)
    yield tracks("", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy\n" + "1" * (1 << 20) + ",2,3,4\n", line=2, row="point")
    yield tracks("t,id,x,y\n" + "1" * (1 << 20) + ",2,3,4\n", line=2, row="observation")
    yield tracks("t,id,x,y,z\n", line=1, column="z", columns=TRACKS_COLUMNS)
    yield tracks("t;id;x;y\n", line=1, column="t;id;x;y", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy,id\n1,2,3,4,\n", line=2, column="id")
    yield points("x,y,vx,vy,id\n1,2,3,4,a\n2,2,3,4,a\n", line=3, id="a", first=2)
    yield points('x,y,vx,vy\n"1,2,3,4\n', line=2, text='"1,2,3,4')
    yield points('x,y,vx,vy\n"1"2,2,3,4\n', line=2, text="2", separator=",")
    yield points("x;y;vx;vy\n1,5;2;3;4\n", line=2, column="x", text="1,5")
    yield tracks("# id frame x y\n1 1 0 0\n", "--format frames", line=1, columns="id frame x y")
    yield tracks("# framerate: 16\n1 1 0 0\n", "--format frames --fps 25", line=1, rate=16, fps=25)
    yield points("\n# c\nx,y,x,vx,vy\n", line=3, column="x", columns=POINTS_COLUMNS)
    yield points("x,y,vx\n1,2,3\n", line=1, column="vy", columns=POINTS_COLUMNS)
    yield tracks("t,id,x\n", line=1, column="y", columns=TRACKS_COLUMNS)
    yield points("x,y,vx,vy,ax\n1,2,3,4,5\n", line=1, column="ay", first="ax", second="ay")
    yield points("x,y,vx,vy,jy\n1,2,3,4,5\n", line=1, column="jx", first="jx", second="jy")
    yield points("x,y,vx,vy\n1,2,3,4\n1,2,3\n", line=3, n=3, columns=4)
    yield points("x,y,vx,vy\n1,2,3,4,5\n", line=2, n=5, columns=4)
    yield points("x,y,vx,vy\n1\n", line=2, columns=4)
    yield tracks("0 a 1\n", "--format frames", line=1, n=3)
    yield tracks("5\n", "--format frames", line=1)
    yield points("x,y,vx,vy\n1,,3,4\n", line=2, column="y")
    yield tracks("t,id,x,y\n1, ,3,4\n", line=2, column="id")
    yield points("x,y,vx,vy\n1,two,3,4\n", line=2, column="y", text="two")
    yield tracks("5 a zero 0\n", "--format frames", line=1, column="x", text="zero")
    yield points("x,y,vx,vy\n1,2,nan,4\n", line=2, column="vx", text="nan")
    yield points("x,y,vx,vy\n1,2,3,-inf\n", line=2, column="vy", text="-inf")
    yield points("x,y,vx,vy\n1e400,2,3,4\n", line=2, column="x", text="1e400")
    yield points("x,y,vx,vy,radius\n1,2,3,4,-1\n", line=2, radius=-1)
    discs = "--until 1 --collisions elastic"
    yield points("x,y,vx,vy,radius\n1,1,1,0,0\n", discs, line=2)
    yield points("x,y,vx,vy,radius\n1,1,1,0,1\n5,5,0,0,2\n", discs, line=3, radius=2, other=1, first=2)
    yield points(ONE_FLIP + "4,0,0,0\n", line=6, first=3, motion="velocity")
    yield points("x,y,vx,vy,jx,jy\n1,2,3,4,5,6\n1,2,3,4,5,6\n", line=3, first=2, motion="derivatives")
    box = "--until 1 --box 0,0,10,10"
    yield points("x,y,vx,vy\n0,0,1,0\n5,12,0,0\n", box, line=3, time=0, x=5, y=12, side="upper",
                 position=10)
    yield points("x,y,vx,vy\n1,5,1,0\n5,5,0,0\n", box + " --rim --radius 2", line=2, time=0, x=1, y=5,
                 side="left", position=0)
    yield points("x,y,vx,vy\n0,5,1,0\n0,5,-1,0\n", box, time=0, a=0, b=1)
    yield tracks("t,id,x,y\n0,a,0,0\n1,b,0,0\n0,a,2,1.5\n", line=4, id="a", time=0, x=2, y=1.5, x2=0,
                 y2=0, first=2)
    yield tracks("1e300 a 0 0\n", "--format frames --fps 1e-300", line=1, frame="1e+300", fps="1e-300")
    yield tracks("t,id,x,y\n0,a,-1e308,0\n1,a,1e308,0\n", line=3, id="a", first=2)
    yield tracks("t,id,x,y\n0,a,0,0\n1,a,1,0\n2,a,2,0\n0,b,0,5\n1,b,1,0\n2,b,2,0\n", line=6, time=1,
                 a="a", b="b", first=3)


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


def checkpoint_cases():
    def resume(content, **values):
        return case("resume c --until 3", files={"c": content}, file="c", **values)

    good = checkpoint()
    body = good[: good.rindex("checksum")]
    first = "kinetri checkpoint 2"
    yield resume("")
    yield resume(ONE_FLIP, text="x,y,vx,vy")
    yield resume(good.replace(first, "kinetri checkpoint 9", 1), text="9")
    yield resume(good[: len(good) // 2])
    yield resume(good + "\n")
    yield resume(good.replace("linear", "lineal", 1))
    yield case("resume /proc/self/mem --until 3", file="/proc/self/mem")
    yield resume(signed(body[:-4] + "\n"))
    yield resume(signed(first + "\n[]\n"), member="state")
    yield resume(forged(lambda state: state.pop("motion")), member="state", key="motion")
    yield resume(forged(setter("points", 5)), member="state.points")
    yield resume(forged(setter("box", [1.0])), member="state.box", n=1, m=4)
    yield resume(forged(setter("radius", 1)), member="state.radius")
    yield resume(forged(setter("dimension", 3)), member="state.dimension", lowest=-1, highest=2)
    yield resume(forged(setter("max_contacts_per_instant", -1)), member="state.max_contacts_per_instant",
                 lowest=0, highest=18446744073709551615)
    yield resume(forged(setter("rim_touches", 0)), member="state.rim_touches")
    yield resume(forged(setter("response", 0)), member="state.response")
    root = {"root_of": ["1.5"], "between": ["0", "1"]}
    yield resume(forged(setter("time", root)), member="state.time.root_of[0]")
    yield resume(forged(setter("time", "1/0")), member="state.time")
    root = {"root_of": ["1", "0", "1"], "between": ["0", "1"]}
    yield resume(forged(setter("time", root)), member="state.time")
    yield resume(forged(setter("points", 2, [1.0])), member="state.points[2]", n=1)
    polynomial = setter("motion", "polynomial")
    yield resume(forged(polynomial), member="state.points[0]", n=5)
    change = [{"time": "3", "kind": "flip", "point": 0, "motion": None}]
    yield resume(forged(setter("scheduled", change)), member="state.scheduled[0].kind")
    yield resume(forged(setter("motion", "circular")), member="state.motion", text="circular")
    yield resume(forged(setter("response", "bump")), name="bump")
    yield resume(forged(setter("response", "log")), name="log")
    yield resume(forged(setter("infinite_vertex_face", 99)),
                 problem="the snapshot gives the infinite vertex the face 99, which does not have it")
    yield resume(forged(setter("points", 0, 0, 9.0)),
                 problem="the snapshot's triangle of points 2, 0 and 1 is not counterclockwise")


def chmod(name, mode):
    return lambda directory: (directory / name).chmod(mode)


def mounts():
    table = pathlib.Path("/proc/self/mounts")
    if not table.exists():
        return []
    return [line.split()[1] for line in table.read_text(encoding="utf-8").splitlines()]


def is_empty(path):
    """Whether another file system begins at the path, with nothing in it."""
    try:
        other = os.stat(path).st_dev != os.stat(os.path.dirname(path)).st_dev
        return path != "/" and other and os.path.isdir(path) and not os.listdir(path)
    except OSError:
        return False


def fake_gnuplot(directory):
    (directory / "bin").mkdir()
    program = directory / "bin" / "gnuplot"
    program.write_text("#!/bin/sh\n[ \"$1\" = --version ] || { echo no such terminal >&2; exit 1; }\n",
                       encoding="utf-8")
    program.chmod(0o755)


def output_cases():
    yield simulate("--edges ''")
    yield simulate("--edges old.csv --events .", path=".")
    yield simulate("--events p.csv/events.csv", path="p.csv/events.csv", reason="Not a directory")
    yield simulate("--events missing/events.csv", path="missing/events.csv", reason=NO_FILE)
    yield case("generate uniform --points 3 --output missing/p.csv", path="missing/p.csv",
               reason=NO_FILE)
    yield case("wave --html nowhere/x.html", path="nowhere/x.html", reason=NO_FILE)
    yield simulate("--events new.csv", path="new.csv", reason=DENIED, unprivileged=True,
                   prepare=lambda d: d.chmod(0o555))
    yield simulate("--events old.csv", path="old.csv", reason=DENIED, unprivileged=True,
                   prepare=chmod("old.csv", 0o444))
    yield simulate("--events pipe", path="pipe", reason=DENIED, unprivileged=True,
                   prepare=lambda d: os.mkfifo(d / "pipe", 0o444))
    for option in ("--events", "--edges", "--stats", "--checkpoint", "--html"):
        outputs = {"--edges": "old.csv", "--stats": "stats.json", option: "/dev/full"}
        yield simulate(" ".join(f"{name} {path}" for name, path in outputs.items()),
                       path="/dev/full", reason="No space left on device")
    yield simulate("--frames f --vtu v --stats /dev/full", path="/dev/full",
                   reason="No space left on device")
    yield simulate("--edges - --stats stats.json", output="/dev/full", path="standard output",
                   reason="No space left on device")
    yield case("generate uniform --points 3", output="/dev/full", path="standard output",
               reason="No space left on device")

    for arguments in ("simulate p.csv --until 1 --edges - --stats stats.json", "--version", "manual",
                      "generate uniform --points 3", "tracks t.csv --closest 1"):
        yield case(arguments, closes_output=True)

    def make_directory(directory, _):
        (directory / "edges").mkdir()

    def fill_directory(directory, _=None):
        (directory / "f").mkdir()
        (directory / "f" / "other").touch()

    yield simulate("--edges edges", meanwhile=make_directory, path="edges", reason="Is a directory")
    yield simulate("--frames f", meanwhile=fill_directory, path="f", reason="Directory not empty")
    for path in ("", "-"):
        yield simulate(f"--frames '{path}'", path=path)
    yield simulate("--frames f", path="f", prepare=lambda d: (d / "f").symlink_to("nothing"))
    yield simulate("--vtu old.csv", path="old.csv")
    yield simulate("--frames f", path="f", reason=DENIED, unprivileged=True,
                   prepare=lambda d: (d / "f").mkdir(0))
    for option in ("--frames", "--vtu"):
        yield simulate(f"{option} f", path="f", prepare=fill_directory)
    yield case("simulate ../p.csv --until 1 --frames .", below="empty", path=".")
    for mount in filter(is_empty, mounts()):
        yield simulate(f"--frames {mount}", path=mount)
        break
    yield simulate("--frames missing/f", path="missing/f", reason=NO_FILE)
    yield case("experiment --output old.csv/r --no-plots", path="old.csv/r", reason="Not a directory")
    yield simulate("--plot plot.svg", limit_files=4, reason="Too many open files")
    yield simulate("--plot plot.svg --edges old.csv", text="no such terminal", prepare=fake_gnuplot,
                   environment={"PATH": "bin:/bin:/usr/bin"})


def run_cases():
    def endless(content, options, most, until, **values):
        few = forged(setter("max_contacts_per_instant", most), content, f"--until 0.5 {options}")
        return case(f"resume c --until {until} --edges old.csv", files={"c": few}, most=most, **values)

    # The point comes to rest at the wall, and its jerk presses it on.
    pressed = "x,y,vx,vy,ax,ay,jx,jy\n2,1,0,-3,0,6,0,-6\n"
    yield endless(pressed, "--box 0,0,9,9", 10, 2, time=1, a=0)
    yield endless(DISCS, "--collisions swap", 0, 4, time=3, a=0, b=1)

    def fault(name, until=1, **options):
        return case(f"simulate p.csv --until {until} --audit events --edges old.csv", faulty=True,
                    environment={"KINETRI_TEST_FAULT": name}, **options)

    source = (ROOT / "test/apps/faults.cpp").read_text(encoding="utf-8").splitlines()
    line = {kind: 1 + next(i for i, text in enumerate(source) if f"KINETRI_{kind}(" in text)
            for kind in ("ASSERT", "PRECONDITION")}
    yield fault("memory")
    yield fault("internal", what="made on purpose", condition="false", file="faults.cpp",
                line=line["ASSERT"])
    yield fault("precondition", what="precondition violated: made on purpose (expected false; "
                f"faults.cpp:{line['PRECONDITION']})")
    yield fault("unexpected", what="an exception made on purpose")
    finding = "the edge 1-2 is wrong"
    yield fault("audit", time=0, finding=finding, writes=True)
    yield fault("audit", n=3, m=3, writes=True)
    many = "x,y,vx,vy\n" + "".join(f"{i},{i * i % 7},{i % 5},{i % 3}\n" for i in range(40))
    yield fault("audit", until=20, files={"p.csv": many}, writes=True)
    for number in (signal.SIGINT, signal.SIGTERM):
        yield simulate("--edges old.csv --stats stats.json",
                       meanwhile=lambda _, process, number=number: process.send_signal(number))


# ---- the list ----

@dataclasses.dataclass(frozen=True)
class Row:
    message: str
    exit_code: int
    is_usage: bool  # printed with the command's name, and a line about --help

    def filled(self, case):
        """What is printed if the row's placeholders are the case's values; None if they are not."""
        if {name[1:-1] for name in PLACEHOLDER.findall(self.message)} != set(case.values):
            return None
        text = PLACEHOLDER.sub(lambda match: case.values[match[0][1:-1]], self.message)
        if not self.is_usage:
            return text + "\n"
        name = command(case.arguments)
        return f"{name}: {text}\nRun '{name} --help' for what is possible.\n"


def command(arguments):
    """The full name of the command that the arguments choose."""
    name = "kinetri"
    commands = COMMANDS
    for word in arguments.split():
        if word in re.split(", | or ", commands):
            name += " " + word
            commands = SCENARIOS if word == "generate" else ""
    return name


def rows():
    found = []
    for line in LIST.read_text(encoding="utf-8").splitlines():
        if section := SECTION.fullmatch(line):
            exit_code, is_usage = int(section[1]), bool(section[2])
        elif line and not line.startswith("#"):
            found.append(Row(line, exit_code, is_usage))
    return found


# ---- running ----

def contents(directory):
    """What is in the directory: the text of each file, the kind of everything else."""
    found = {}
    for path in sorted(directory.rglob("*")):
        name = str(path.relative_to(directory))
        try:
            found[name] = path.read_bytes() if path.is_file() else path.is_dir()
        except PermissionError:
            found[name] = "unreadable"
    return found


def limits(case):
    """What is to be done in the new process."""
    def apply():
        if case.closes_output:
            os.close(1)
        if case.limit_files:
            resource.setrlimit(resource.RLIMIT_NOFILE, (case.limit_files, case.limit_files))
        if case.unprivileged and os.geteuid() == 0:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)

    return apply


def opened_pipe(path, process):
    """The pipe, when the process has opened it; None if the process ends without."""
    while process.poll() is None:
        try:
            return os.fdopen(os.open(path, os.O_WRONLY | os.O_NONBLOCK), "w")
        except OSError:
            time.sleep(0.001)
    return None


class Messages(unittest.TestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        # Where a user without permissions can run it.
        cls.copy = shutil.copy(PROGRAM, folder.name)
        pathlib.Path(folder.name).chmod(0o755)

    def run_case(self, case):
        """(exit code, standard output, standard error)."""
        with tempfile.TemporaryDirectory() as folder:
            directory = pathlib.Path(folder)
            directory.chmod(0o777)
            for name, text in {**FILES, **case.files}.items():
                (directory / name).write_text(text, encoding="utf-8")
            if case.below:
                (directory / case.below).mkdir()
            if case.meanwhile:
                (directory / "p.csv").unlink()
                os.mkfifo(directory / "p.csv")
            if case.prepare:
                case.prepare(directory)
            before = contents(directory)
            program = FAULTY_PROGRAM if case.faulty else self.copy if case.unprivileged else PROGRAM
            output = case.output if case.output == subprocess.PIPE else open(case.output, "wb")
            environment = {**os.environ, "LC_ALL": "C", **case.environment}
            process = subprocess.Popen(
                [program, *shlex.split(case.arguments)], cwd=directory / case.below, env=environment,
                stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.PIPE,
                preexec_fn=limits(case))
            if case.meanwhile:
                pipe = opened_pipe(directory / "p.csv", process)
                case.meanwhile(directory, process)
                before = {name: text for name, text in contents(directory).items()
                          if ".kinetri-" not in name}
                try:
                    pipe.write(ONE_FLIP)
                    pipe.close()
                except BrokenPipeError:
                    pass
            out, err = process.communicate(timeout=60)
            if case.output != subprocess.PIPE:
                output.close()
            if not case.writes:
                self.assertEqual(contents(directory), before)
            return process.returncode, out or b"", err.decode()

    def check(self, case, all_rows):
        """The row that the case brings about."""
        code, out, err = self.run_case(case)
        self.assertEqual(out, b"", err)
        is_right = (lambda text: text in err) if case.writes else (lambda text: text == err.removeprefix("\n"))
        found = [row for row in all_rows if (text := row.filled(case)) and is_right(text)]
        self.assertEqual(len(found), 1, f"not in {LIST.name} with these values: {err}")
        self.assertEqual(code, found[0].exit_code, err)
        return found[0]

    def test_every_message_is_as_listed(self):
        all_rows = rows()
        self.assertGreater(len(all_rows), 100)
        seen = set()
        for cases in (usage_cases, number_cases, meaning_cases, table_cases, checkpoint_cases,
                      output_cases, run_cases):
            for case in cases():
                with self.subTest(case.arguments, **case.values):
                    seen.add(self.check(case, all_rows))
        without = {message for messages in WITHOUT_CASE.values() for message in messages}
        missing = [row.message for row in all_rows if row not in seen and row.message not in without]
        self.assertEqual(missing, [], "no case brings these about")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
