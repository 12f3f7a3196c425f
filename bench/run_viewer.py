#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures the page of --html in a headless chromium: how long it takes to open, and how long a frame takes
while the run plays, while its time is dragged, while the picture is dragged, and while it is zoomed.

A frame is the time from one drawing to the next; its script is the time of the page's own code in it. Chromium
draws without a graphics card, as on a slow machine.
"""
import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "viewer" / "test"))
from chromium import Chromium  # noqa: E402

EXAMPLES = """examples:
  bench/run_viewer.py build/release/bin/kinetri
  bench/run_viewer.py build/release/bin/kinetri --points 20000 --show voronoi --size 1920x1080
"""
FRAMES = 40

# Plays FRAMES frames. The result is a list of their times.
PLAYING = """new Promise((done) => {
  const frames = [];
  let last = 0;
  document.getElementById('button-play').click();
  const next = (now) => {
    if (last > 0) frames.push(now - last);
    last = now;
    if (frames.length < FRAMES) return requestAnimationFrame(next);
    document.getElementById('button-play').click();
    done(frames);
  };
  requestAnimationFrame(next);
})"""
# Draws FRAMES times, each time after CHANGE. The result is a list of the times of frames and scripts.
FRAME_TIMES = """new Promise((done) => {
  const frames = [], scripts = [];
  let last = 0, count = 0;
  const next = (now) => {
    if (count > 2) frames.push(now - last);
    last = now;
    if (++count > FRAMES) return done([frames, scripts]);
    CHANGE;
    scripts.push(kinetri.drawNow());
    requestAnimationFrame(next);
  };
  requestAnimationFrame(next);
})"""
CHANGES = {
    "scrubs": "kinetri.goTo(kinetri.span[0] + (kinetri.span[1] - kinetri.span[0]) * count / FRAMES)",
    "pans": "kinetri.pan(count % 2 ? 6 : -6, 3)",
    "zooms": "kinetri.zoom(count < FRAMES / 2 ? 1.15 : 1 / 1.15)",
}


def page_of(program, folder, points):
    """A run in which each point moves about its distance to the next."""
    csv = folder / f"{points}.csv"
    page = csv.with_suffix(".html")
    subprocess.run([program, "generate", "uniform", "--points", str(points), "--seed", "3",
                    "--output", csv], check=True)
    subprocess.run([program, "simulate", csv, "--until", "1" if points <= 20000 else "0.3", "--html", page,
                    "--quiet"], check=True)
    return page


def script_seconds(window):
    """How long scripts of the page have run so far."""
    metrics = window.call("Performance.getMetrics")["metrics"]
    return next(metric["value"] for metric in metrics if metric["name"] == "ScriptDuration")


def measure(page, options):
    width, height = map(int, options.size.split("x"))
    with Chromium(width, height, [("prefers-reduced-motion", "reduce")]) as window:
        fragment = f"#show={options.show}" if options.show else ""
        if options.words:
            fragment += ("&" if fragment else "#") + options.words
        window.open(page, fragment)
        opening = window.evaluate("performance.getEntriesByType('paint').map((e) => e.startTime)[0]")
        opened = window.evaluate("performance.timing.loadEventEnd - performance.timing.navigationStart")
        print(f"  opens                 {max(opened, opening or 0):8.0f} ms")
        window.call("Performance.enable")
        before = script_seconds(window)
        frames = window.evaluate(PLAYING.replace("FRAMES", str(FRAMES)))
        script = 1000 * (script_seconds(window) - before) / len(frames)
        print(f"  plays   a frame      {statistics.median(frames):8.1f} ms, its script {script:6.1f} ms on average "
              f"(the slowest {max(frames):.0f} ms)", flush=True)
        for name, change in CHANGES.items():
            script = FRAME_TIMES.replace("CHANGE", change).replace("FRAMES", str(FRAMES))
            frames, scripts = window.evaluate(script)
            print(f"  {name:6}  a frame      {statistics.median(frames):8.1f} ms, its script "
                  f"{statistics.median(scripts):6.1f} ms (the slowest {max(frames):.0f} and "
                  f"{max(scripts):.1f} ms)", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="the program kinetri, or a page that it has written")
    parser.add_argument("--points", type=int, nargs="*", default=[60, 1000, 20000, 100000])
    parser.add_argument("--size", default="1280x800", help="of the window, in pixels")
    parser.add_argument("--show", default="", help="switches that are turned on, such as voronoi,trails")
    parser.add_argument("--words", default="", help="further words of the address, such as draw=webgl")
    options = parser.parse_args()
    if options.program.endswith(".html"):
        print(options.program)
        measure(pathlib.Path(options.program), options)
        return
    with tempfile.TemporaryDirectory(prefix="kinetri-bench-") as folder:
        for points in options.points:
            page = page_of(options.program, pathlib.Path(folder), points)
            print(f"{points} points, {page.stat().st_size / 1e6:.1f} MB")
            measure(page, options)


if __name__ == "__main__":
    main()
