# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases of messages of kinetri render: what is asked for, the page that is read, the tools."""
import base64
import functools
import json
import pathlib
import struct
import subprocess
import tempfile

from message_case import FILES, NO_FILE, PROGRAM, case

BEGIN = '<script type="application/json" id="recording">'


@functools.lru_cache(maxsize=None)
def page():
    """The page of a run from t = 0 to 2 with one flip."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder)
        (path / "p.csv").write_text(FILES["p.csv"], encoding="utf-8")
        subprocess.run([PROGRAM, "simulate", "p.csv", "--until", "2", "--html", "run.html", "--quiet"], cwd=path,
                       check=True)
        return (path / "run.html").read_text(encoding="utf-8")


def render(more, content=None, **options):
    return case(f"render run.html {more}", files={"run.html": page() if content is None else content}, **options)


def damaged(change, **options):
    """A page whose recording is changed."""
    text = page()
    first = text.index(BEGIN) + len(BEGIN)
    last = text.index("</script>", first)
    recording = json.loads(text[first:last])
    change(recording)
    return render("-o a.svg", text[:first] + json.dumps(recording) + text[last:], file="run.html", **options)


def tool(name, script):
    """Puts a program of that name into the folder bin."""
    def prepare(directory):
        (directory / "bin").mkdir(exist_ok=True)
        path = directory / "bin" / name
        path.write_text("#!/bin/sh\n" + script + "\n", encoding="utf-8")
        path.chmod(0o755)
    return prepare


def both(*preparations):
    def prepare(directory):
        for one in preparations:
            one(directory)
    return prepare


def cases():
    yield render("")
    yield render("-o a.jpg", option="--output", path="a.jpg", endings=".svg or .png")
    yield render("--animate a.avi", option="--animate", path="a.avi", endings=".gif, .webp, .webm or .mp4")
    yield render("-o a.svg --at 2.5", option="--at", time="2.5", **{"from": 0}, until=2)
    yield render("-o a.svg --view t=2.5", option="--view", word="t", value="2.5",
                 what="a time of the run, from 0 to 2")
    yield render("-o a.svg --view color=red", option="--view", word="color", value="red",
                 what="one of none, area, density, speed, degree, changes, size, component, members, kind")
    yield render("-o a.svg --view show", option="--view", word="show")
    yield render("-o a.svg --width 15", option="--width", number=15, lowest=16, highest=16384)

    tools = {"environment": {"PATH": "bin:/bin:/usr/bin"}}
    have_both = both(tool("rsvg-convert", "cat"), tool("ffmpeg", "exit 0"))
    yield render("--animate a.gif --from 1.5 --until 1", until=1, **{"from": "1.5"}, prepare=have_both, **tools)
    yield render("--animate a.mp4 --height 99", option="--height", side=99, prepare=have_both, **tools)
    yield render("--animate a.gif --fps 1e-300", option="--fps", number="1e-300", lowest=0.01, highest=1000,
                 prepare=have_both, **tools)
    yield render("--animate a.gif --fps 1000 --speed 0.01", fps=1000, **{"from": 0}, until=2, prepare=have_both,
                 **tools)
    yield render("-o a.png", otherwise="an --output that ends with .svg", environment={"PATH": "/nowhere"})
    yield render("--animate a.gif", environment={"PATH": "bin"}, prepare=tool("rsvg-convert", "exit 0"))
    broken = '[ "$1" = --version ] || [ "$1" = -version ] || { echo no room >&2; exit 1; }'
    yield render("-o a.png", text="no room", prepare=tool("rsvg-convert", broken), **tools)
    yield render("--animate a.gif --fps 1", said="no room", **tools,
                 prepare=both(tool("rsvg-convert", "cat"), tool("ffmpeg", broken)))

    yield case("render none.html -o a.svg", file="none.html", reason=NO_FILE,
               content="a run, as --html writes it")
    yield render("-o a.svg", "a page without it", file="run.html")
    yield render("-o a.svg", page()[: page().index(BEGIN) + 500], file="run.html")
    yield render("-o a.svg", f"<!doctype html>{BEGIN}[</script>", file="run.html")
    yield damaged(lambda r: r.update(format=1), n=2)
    yield damaged(lambda r: r.update(periodic=[0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0]), n=3)
    yield damaged(lambda r: r.update(format=3, periodic=[0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, -4.0, 0.0, 0.0]),
                  member="recording.periodic", problem="has no area at a time of the run")
    yield damaged(lambda r: r.update(until=-1.0))
    yield damaged(lambda r: r.update(points=5), n=5, m=4)
    yield damaged(lambda r: r.update(radius=-1.0), member="recording.radius")
    yield damaged(lambda r: r.update(wave={"height": 1.0, "width": 0.0}), member="recording.wave.width")
    gone = base64.b64encode(bytes((1, 0, 1, 1))).decode()
    yield damaged(lambda r: r["motions"].update(there=gone), member="recording.motions.there",
                  problem="lacks the motion 1 of the start")
    late = base64.b64encode(struct.pack("<d", float("inf"))).decode()
    yield damaged(lambda r: r["events"].update(time=late), member="recording.events.time",
                  problem="has a number that is not finite")
    yield damaged(lambda r: r["events"].update(ids=base64.b64encode(struct.pack("<4H", 0, 1, 1, 2)).decode()),
                  member="recording", problem="event 0 adds an edge that is not the other diagonal of the triangles "
                  "at the removed one")
