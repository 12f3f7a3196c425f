#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures a live page in a headless chromium: how long it takes until the first picture; how long points take to
advance by a sixtieth of a unit of time, and to give their positions and their edges; and how long the module takes
for a run, beside the program.

Chromium draws without a graphics card, as on a slow machine.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "viewer" / "test"))
from chromium import Chromium  # noqa: E402

EXAMPLES = """examples:
  bench/run_live.py build/release/bin/kinetri
  bench/run_live.py build/release/bin/kinetri --page my.html --points 2000
"""
# Milliseconds from the request of the page to its first picture.
FIRST_PICTURE = """new Promise((done) => {
  const wait = () => {
    if (window.live?.points === undefined) return setTimeout(wait, 1);
    requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now())));
  };
  wait();
})"""
# Milliseconds of each of FRAMES steps of the points TEXT, [advance, positions, edges], of which the first are left
# out, until the browser has compiled what they need; and the mean number of events of a step.
STEPS = """(() => {
  const points = live.points.constructor.read(TEXT), times = [];
  for (let i = 1; i <= FRAMES; ++i) {
    const at = [performance.now()];
    for (const call of [() => points.advanceTo(i / 60), () => points.positions(), () => points.edges()]) {
      call();
      at.push(performance.now());
    }
    times.push([at[1] - at[0], at[2] - at[1], at[3] - at[2]]);
  }
  return [times.slice(FRAMES / 4), points.statistics().events / FRAMES];
})()"""
# Milliseconds of a run of the points TEXT until UNTIL.
RUN = """(() => {
  const points = live.points.constructor.read(TEXT), begin = performance.now();
  points.advanceTo(UNTIL);
  return performance.now() - begin;
})()"""
PAUSED = "void (live.isPlaying() && live.togglePlaying(1))"


def opened(window, page):
    """Opens the page. The milliseconds until its first picture."""
    window.url = page.resolve().as_uri()
    window.go_to(window.url)
    return window.evaluate(FIRST_PICTURE)


def write_points(program, number, path):
    """As many points in a square as make for the same distances. The text of the file, for a script."""
    subprocess.run([program, "generate", "uniform", "--points", str(number), "--side", str(10 * number**0.5), "--speed", "5",
                    "--seed", "1", "--output", path], check=True)
    return json.dumps(path.read_text(encoding="utf-8"))


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program kinetri")
    parser.add_argument("--page", type=pathlib.Path, default=ROOT / "docs" / "gallery" / "live.html",
                        help="the live page (default: that of the gallery)")
    parser.add_argument("--points", type=int, default=10000, help="of the steps (default: 10000)")
    parser.add_argument("--repeat", type=int, default=5, help="how often each is measured (default: 5)")
    options = parser.parse_args()
    if Chromium.executable() is None:
        sys.exit("run_live.py: chromium is not there; expected scripts/setup.sh browser to have installed it")
    print(f"page: {options.page.stat().st_size / 1e6:.2f} MB")
    with Chromium(1280, 800) as window:
        first = [opened(window, options.page) for _ in range(options.repeat)]
        print(f"first picture: {statistics.median(first):.0f} ms")
        window.evaluate(PAUSED)
        with tempfile.TemporaryDirectory() as folder:
            points, stats = pathlib.Path(folder, "points.csv"), pathlib.Path(folder, "stats.json")
            text = write_points(options.program, options.points, points)
            times, events = window.evaluate(STEPS.replace("TEXT", text).replace("FRAMES", "80"))
            advance, positions, edges = (statistics.median(column) for column in zip(*times))
            print(f"{options.points} points, a step of 1/60 with {events:.0f} events: {advance:.2f} ms; positions "
                  f"{positions:.2f} ms; edges {edges:.2f} ms")
            text = write_points(options.program, 1000, points)
            module, program = [], []
            for _ in range(options.repeat):
                module.append(window.evaluate(RUN.replace("TEXT", text).replace("UNTIL", "300")) / 1000)
                subprocess.run([options.program, "simulate", points, "--until", "300", "--threads", "1", "--stats", stats,
                                "--quiet"], check=True)
                program.append(json.loads(stats.read_text(encoding="utf-8"))["seconds"]["run"])
            ratio = statistics.median(module) / statistics.median(program)
            print(f"1000 points until 300: the module takes {ratio:.2f} of the program's time")


if __name__ == "__main__":
    main()
