# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of the messages about checkpoints, about outputs, and of runs that end early."""
import os
import pathlib
import signal
import zlib

from message_case import (DENIED, DISCS, FILES, NO_FILE, ONE_FLIP, case, checkpoint, forged, setter, signed,
                          simulate)

ROOT = pathlib.Path(__file__).resolve().parents[2]


def checkpoint_cases():
    def resume(content, **values):
        return case("resume c --until 3", files={"c": content}, file="c", **values)

    good = checkpoint()
    body = good[: good.rindex("checksum")]
    first = "kinetri checkpoint 8"
    yield resume("")
    yield resume(ONE_FLIP, text="x,y,vx,vy")
    yield resume(good.replace(first, "kinetri checkpoint 9", 1), text="9")
    yield resume(good[: len(good) // 2])
    yield resume(good + "\n")
    yield resume(good.replace("linear", "lineal", 1))
    yield case("resume /proc/self/mem --until 3", file="/proc/self/mem")
    yield case("resume /dev/zero --until 3", file="/dev/zero", text="\\x00" * 40 + "...")
    yield resume(f"{first}\n{{\n" + "x" * ((1 << 24) + 1), line=3)
    yield resume(signed(body[:-4] + "\n"))
    yield resume(signed(first + "\n[]\n"), member="state")
    yield resume(forged(lambda state: state.pop("motion")), member="state", key="motion")
    yield resume(forged(setter("points", 5)), member="state.points")
    yield resume(forged(setter("box", [1.0])), member="state.box", n=1, m=4)
    yield resume(forged(setter("radius", 1)), member="state.radius")
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
    for motion in ("polynomial", "disc", "polynomial disc"):
        yield resume(forged(setter("motion", motion)), member="state.points[0]", n=5)
    change = [{"time": "3", "kind": "flip", "point": 0, "motion": None}]
    yield resume(forged(setter("scheduled", change)), member="state.scheduled[0].kind")
    yield resume(forged(setter("motion", "circular")), member="state.motion", text="circular")
    log = {"output": "events", "path": "old.csv", "bytes": 7, "crc32": "0123abcd"}
    yield resume(forged(setter("logs", [{**log, "crc32": "CBF43926"}])), member="state.logs[0].crc32")
    content = FILES["old.csv"].encode()
    yield case("resume c --until 3 --events e.csv", file="old.csv", option="--events", checkpoint="c",
               files={"c": forged(setter("logs", [log]))}, n=len(content), m=7, other="0123abcd",
               crc32=f"{zlib.crc32(content):08x}")
    yield resume(forged(setter("response", "bump")), name="bump")
    yield resume(forged(setter("response", "log")), name="log")
    yield resume(forged(lambda state: (state.update(refuses_coincident_points=True),
                                       state["points"].__setitem__(1, state["points"][0]))),
                 problem="the snapshot's points 0 and 1 have the same trajectory")
    yield from periodic_checkpoint_cases()


def periodic_checkpoint_cases():
    """Of runs in periodic boxes, and of options that these do not have."""
    run = ONE_FLIP, "--until 2 --periodic 9,9 --shear 0.5"

    def resume(content, more="", **values):
        return case(f"resume c --until 3 {more}", files={"c": content}, **values)

    yield resume(checkpoint(*run), "--areas n --walkable w", option="--walkable")
    shrinking = [[9.0, 0.0, -4.0, 0.0, 0.0], [0.0, 9.0, 0.0, 0.0, 0.0]]
    yield resume(forged(setter("periodic_box", shrinking), *run), time="2.25")
    flat = [[9.0, 0.0, 0.0, 0.0, 0.0], [0.0, 9.0, 0.0, -4.5, 0.0]]
    yield resume(forged(setter("periodic_box", flat), *run), file="c", member="state.periodic_box",
                 problem="the periodic box has no area at time 2; expected lattice vectors that are not parallel")
    discs = DISCS, "--until 2 --collisions elastic --growth 0.125"
    yield resume(forged(setter("points", 1, 7, 0.5), *discs), file="c", member="state.points[1]", weight="0.5")
    yield resume(forged(setter("motion", "polynomial"), *run), file="c", member="state.motion", text="polynomial")
    yield resume(forged(setter("points", 0, 0, 1e300), *run), file="c",
                 problem="point 0 is 2^31 or more lattice vectors away from the periodic box, or from other points; give "
                         "the position of an image that is closer")


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
    yield simulate("--edges old.csv --motions missing/m.csv", path="missing/m.csv", reason=NO_FILE)
    yield case("generate uniform --points 3 --output missing/p.csv", path="missing/p.csv",
               reason=NO_FILE)
    yield case("wave --html nowhere/x.html", path="nowhere/x.html", reason=NO_FILE)
    yield simulate("--events new.csv", path="new.csv", reason=DENIED, unprivileged=True,
                   prepare=lambda d: d.chmod(0o555))
    yield simulate("--events old.csv", path="old.csv", reason=DENIED, unprivileged=True,
                   prepare=chmod("old.csv", 0o444))
    yield simulate("--events pipe", path="pipe", reason=DENIED, unprivileged=True,
                   prepare=lambda d: os.mkfifo(d / "pipe", 0o444))
    for option in ("--events", "--motions", "--edges", "--stats", "--checkpoint", "--html"):
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
        return case(f"resume c --until {until} --edges old.csv --quiet", files={"c": few}, most=most, until=until,
                    writes=True, **values)

    yield endless("x,y,vx,vy\n2,1,0,-1\n", "--box 0,0,9,9", 0, 2, time=1, a=0)
    yield endless(DISCS, "--collisions swap", 0, 4, time=3, a=0, b=1)

    # The point comes to rest at the wall, and its jerk presses it on.
    at_wall = "x,y,vx,vy,ax,ay,jx,jy\n2,1,0,-3,0,6,0,-6\n"
    yield case("simulate d.csv --until 2 --box 0,0,9,9 --edges old.csv --quiet", files={"d.csv": at_wall},
               file="d.csv", line=2, a=0, side="lower", time=1, until=2, writes=True)
    for until, more in ((2, {"until": 2}), (1, {})):
        yield case(f"simulate d.csv --until {until} --periodic 16,3,7 --shear=-1 --collisions elastic --radius 2.5",
                   files={"d.csv": "x,y,vx,vy\n0,0,0,0\n"}, file="d.csv", line=2, id=0, x=0, y=1, time=1, writes=True,
                   **more)
    # Exchanges of velocities add energy.
    yield case("simulate d.csv --until 6 --periodic 6,3 --shear 1 --radius 1.49 --collisions swap --edges old.csv --quiet",
               files={"d.csv": "x,y,vx,vy\n3,0,0,2\n0,0,0,0\n"}, file="d.csv", line=2, a=0, b=1, until=6, writes=True,
               time="0.40351207345613627", end="0.40351472590225484", times=539234,
               began="0.403449301762565")
    yield case("simulate d.csv --until 2 --box 0,0,9,9 --verify --quiet", files={"d.csv": at_wall}, writes=True)
    at_disc = "x,y,vx,vy,ax,ay\n0,0,0,0,1,0\n2,0,0,0,-1,0\n"
    for response in ("swap", "elastic"):
        yield case(f"simulate d.csv --until 2 --collisions {response} --radius 1 --edges old.csv --quiet",
                   files={"d.csv": at_disc}, file="d.csv", line=2, a=0, b=1, time=0, until=2, writes=True)
    fast = "x,y,vx,vy\n0,0,1.7e308,-1.7e308\n1,1,-1.7e308,-1.7e308\n"
    yield case("simulate d.csv --until 2 --collisions elastic --radius 1 --edges old.csv",
               files={"d.csv": fast}, file="d.csv", line=2, a=0, time=0)
    shrinking = "x,y,vx,vy,radius,growth\n9,0,0,0,1,0\n0,0,1,0,1,-0.25\n"
    for response in ("stop", "remove"):  # nothing is written, at the start neither
        yield case(f"simulate d.csv --until 10 --collisions {response} --edges old.csv --events e.csv "
                   "--initial-edges i.csv --stats s.json --checkpoint c --html h.html --frames f --vtu v",
                   files={"d.csv": shrinking}, file="d.csv", line=3, a=1, time=4)
    yield case("resume c --until 10 --edges old.csv", a=1, time=4,
               files={"c": checkpoint(shrinking, "--until 3 --collisions log")})
    yield case("simulate d.csv --until 12 --box 0,0,9,9 --max-events 2 --edges e.csv "
               "--quiet", files={"d.csv": "x,y,vx,vy\n2,1,0,-2\n"}, most=2, time="9.5",
               until=12, writes=True)

    # A disc whose diameter would have to exceed the width of the box, for that share.
    yield case("simulate d.csv --until-share 0.6 --box 0,0,4,6 --rim --collisions elastic --edges e.csv "
               "--quiet", files={"d.csv": "x,y,vx,vy,growth\n1,3,1,0.5,1\n"}, ids="0",
               time="1.9999750605165867", until="2.1409489393833256", writes=True)
    yield case("generate packing --points 1 --share 0.8")
    yield case("generate packing --points 1 --share 0.8 --periodic")

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


def replay_cases():
    motions_header = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch"
    events_header = "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b,instant"
    start = ",0,0,0,1,0,0,0,0,0,1,0,0\n,1,9,0,0,0,0,0,0,0,1,0,0\n"
    row = "0,trajectory,1,1,1,,,,,0,,0\n"
    motion = "0,0,1,0,0,1,0,0,0,0,1,0,1\n"

    def replay(events=row, motions=start + motion, more="", **values):
        return case(f"simulate m --replay e --until 2 {more}", files={"m": f"{motions_header}\n{motions}",
                                                                    "e": f"{events_header}\n{events}"}, **values)

    for option in ("--radius 1", "--growth 1", "--mass area", "--checkpoint c"):
        rest = "--box 0,0,9,9 --collisions elastic" if option != "--checkpoint c" else ""
        yield replay(more=f"{option} {rest}", option="--replay", other=option.split()[0])
    yield case("simulate m --replay e --until-share 0.5 --box 0,0,9,9 --rim --collisions elastic", option="--replay",
               other="--until-share")
    yield case("simulate missing --replay e --until 1", file="missing", content="motions", reason=NO_FILE)
    yield case("simulate m --replay missing --until 1", files={"m": motions_header}, file="missing", content="events",
               reason=NO_FILE)
    yield case("simulate p.csv --replay e --until 1", files={"p.csv": "id,x,y,speed\n"}, file="p.csv", line=1,
               column="speed", columns=motions_header)
    yield replay(motions=",7,0,0,1,0,0,0,0,0,1,0,0\n", file="m", line=2, id=7, point=0)
    yield replay(motions=",-1,0,0,1,0,0,0,0,0,1,0,0\n", file="m", line=2, column="id", text="-1", highest=4294967294)
    yield replay("0,flap,1,1,1,,,,,0,,0\n", file="e", line=2, text="flap")
    for text in ("1", "1 0 0", "1 0x", "3000000000 0"):
        yield case("simulate m --replay e --until 2 --periodic 9,9", file="e", line=2, column="added_offset", text=text,
                   files={"m": f"{motions_header}\n{start}", "e": f"{events_header},removed_offset,added_offset\n"
                                                                 f"0,flip,1,1,1,0,1,0,1,,,0,0 0,{text}\n"})
    yield case("simulate m --replay e --until 2", file="e", line=2, n=0, kind="flip",
               files={"m": f"{motions_header}\n{start}", "e": f"{events_header},removed_offset,added_offset\n"
                                                             "0,flip,1,1,1,0,1,0,1,,,0,0 0,1 0\n"})
    yield replay(motions=start, file="e", line=2, n=0, kind="trajectory", other="m")
    yield replay("0,trajectory,1,0.5,1,,,,,0,,0\n", file="e", line=2, n=0, kind="trajectory", lower="0.5", upper=1,
                 **{"from": 0})
    yield replay("5,trajectory,1,1,1,,,,,0,,0\n", start + motion.replace("0", "5", 1), file="e", line=2, n=5,
                 kind="trajectory")
    yield replay("", start.replace(",0,0,0,1,", ",0,0,0,4,", 1), "--collisions elastic", file="e", a=0, b=1, time="1.75")
    yield replay(motions=start.replace(",0,0,0,1,0,0,", ",0,0,0,1,0,0.5,", 1) + motion, more="--periodic 9,9", file="m")
    yield replay(more="--box 0,0,9,0.5", motions=start + motion.replace("0,0,1,0", "0,0,1,7"), file="e", line=2, point=0,
                 time=1, x=1, y=7, side="upper", position="0.5")


def live_cases():
    yield case("live --rim")


def cases():
    for some in (checkpoint_cases, output_cases, run_cases, replay_cases, live_cases):
        yield from some()
