#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures kinetri-video: on clips whose motion is known, and on any other clip.

Each clip is encoded with moving points and, at no more bits, with as many points at rest on a grid, and with
fewer points that are placed anew in each frame. The figures of x264 are those of `kinetri-video compare`.
Needs NumPy.
"""
import argparse
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

CLIPS = ("translation", "rotation", "layers", "cut", "fade")

EXAMPLES = """examples:
  bench/run_video.py --quick                          # 128 x 96, 17 frames, 500 points
  bench/run_video.py                                  # 320 x 240, 50 frames, 2000 points
  bench/run_video.py --clip clip.y4m --curve
"""


class Programs:
    """kinetri-video and kinetri_video_clips of a build, working in a folder."""

    def __init__(self, build, folder):
        self.bin = pathlib.Path(build).resolve() / "bin"
        self.folder = folder

    def run(self, name, *arguments):
        """(output, seconds of the processor)"""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run([self.bin / name, *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"{name} {' '.join(map(str, arguments))}: {done.stderr.strip()}")
        return done.stdout, (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)

    def encode(self, clip, stream, *options):
        """(bytes, events, seconds)"""
        text, seconds = self.run("kinetri-video", "encode", clip, stream, *options)
        events = int(re.search(r"(\d+) events?", text)[1])
        return (self.folder / stream).stat().st_size, events, seconds

    def psnr(self, clip, stream):
        """The numbers that compare shows: (PSNR of brightness, that of x264 or None, its bytes per ours)"""
        text, _ = self.run("kinetri-video", "compare", clip, stream)
        own = re.search(r"^y +PSNR (\S+)", text, re.MULTILINE)[1]
        baseline = re.search(r"^x264 y +PSNR (\S+)", text, re.MULTILINE)
        bits = re.findall(r"bits +(\S+)", text)
        return (float(own), float(baseline[1]) if baseline else None,
                float(bits[1]) / float(bits[0]) if baseline else None)


def frames_of(path):
    """(frames of brightness as an array, frames a second) of a file in the format Y4M"""
    import numpy as np

    data = path.read_bytes()
    header, rest = data.split(b"\n", 1)
    tags = {word[:1]: word[1:] for word in header.decode().split()[1:]}
    width, height = int(tags["W"]), int(tags["H"])
    color = {"mono": 0, "444": 2 * width * height, "422": 2 * ((width + 1) // 2) * height}.get(
        tags.get("C", "420"), 2 * ((width + 1) // 2) * ((height + 1) // 2))
    size = len(b"FRAME\n") + width * height + color
    all_bytes = np.frombuffer(rest, dtype=np.uint8).reshape(-1, size)
    luma = all_bytes[:, 6:6 + width * height].reshape(-1, height, width)
    numerator, denominator = tags["F"].split(":")
    return luma, (int(numerator), int(denominator)), header, all_bytes


def psnr_of(source, other):
    import numpy as np

    square = np.mean((source.astype(float) - other) ** 2)
    return 10 * np.log10(255 ** 2 / square)


def best_within(programs, clip, size, choices, encode):
    """The PSNR of the first of `choices`, whose bytes become fewer, that takes no more than `size` bytes; None if
    none does. `encode` gives the bytes of a choice, in the file some.kvd."""
    low, high = 0, len(choices)
    while low < high:
        middle = (low + high) // 2
        low, high = (low, middle) if encode(choices[middle]) <= size else (middle + 1, high)
    if low == len(choices):
        return None
    encode(choices[low])
    return psnr_between(programs, clip, "some.kvd")


def best_grid(programs, clip, points, size):
    """The greatest PSNR of points at rest on a grid, with no more than `size` bytes; None if there is none."""
    steps = sorted({min(255, round(4 * 1.2 ** i)) / 8 for i in range(24)})

    def psnr(turn):
        return best_within(programs, clip, size, steps, lambda step: programs.encode(
            clip, "some.kvd", "--points", points, "--placement", "grid", "--no-motion", "--turn-every", turn,
            "--color-step", step)[0])

    return max((psnr(turn) or 0 for turn in (2, 4, 8)), default=0) or None


def best_keys(programs, clip, size, second):
    """The PSNR of points that are placed anew in each frame, with no more than `size` bytes."""
    return best_within(programs, clip, size, [round(600 / 1.15 ** i) for i in range(30)],
                       lambda points: programs.encode(clip, "some.kvd", "--points", points, "--key-every",
                                                      second, "--color-step", 4)[0])


def number(value, digits=1):
    return "none" if value is None else f"{value:.{digits}f}"


def measure_motion(programs, clip, name, settings, known):
    """A row: how far points are off, events, bits, and the PSNR of all ways."""
    luma, rate, _, _ = frames_of(programs.folder / clip)
    size, events, _ = programs.encode(clip, "clip.kvd", "--points", settings.points, "--scene-cut",
                                      "--color-step", 2)
    info, _ = programs.run("kinetri-video", "info", "clip.kvd")
    if int(re.search(r"events +(\d+)", info)[1]) != events:
        sys.exit(f"{name}: info counts other events than encode")
    errors = ("", "")
    if known:
        text, _ = programs.run("kinetri_video_clips", "errors", name, *settings.size, settings.frames,
                               "clip.kvd")
        errors = text.split()[1:]
    own, baseline, share = programs.psnr(clip, "clip.kvd")
    second = rate[1] / rate[0]
    anew, _, _ = programs.encode(clip, "anew.kvd", "--points", settings.points, "--key-every", second)
    anew_psnr = psnr_between(programs, clip, "anew.kvd")
    pixels = luma.size
    print(f"| {name} | {' | '.join(errors)} | {events} | {8 * size / pixels:.3f} | {own:.1f} | "
          f"{number(best_grid(programs, clip, settings.points, size))} | "
          f"{number(best_keys(programs, clip, size, second))} | {anew_psnr:.1f} at {8 * anew / pixels:.2f} | "
          f"{number(baseline)} at {number(share, 2)} |", flush=True)


def psnr_between(programs, clip, stream):
    programs.run("kinetri-video", "decode", stream, "decoded.y4m")
    return psnr_of(frames_of(programs.folder / clip)[0], frames_of(programs.folder / "decoded.y4m")[0])


def measure_in_between(programs, clip, name, points, kept):
    """A row: of `kept` frames one is encoded; the PSNR of that one, and of what is shown for the others."""
    import numpy as np

    luma, rate, header, all_bytes = frames_of(programs.folder / clip)
    slower = header.replace(b" F%d:%d" % rate, b" F%d:%d" % (rate[0], kept * rate[1]))
    (programs.folder / "some.y4m").write_bytes(slower + b"\n" + all_bytes[::kept].tobytes())
    programs.encode("some.y4m", "some.kvd", "--points", points, "--scene-cut", "--turn-every", 4)
    programs.run("kinetri-video", "decode", "some.kvd", "full.y4m", "--fps", f"{rate[0]}:{rate[1]}")
    full = frames_of(programs.folder / "full.y4m")[0]
    last = (len(luma) - 1) // kept * kept
    left_out = np.array([i for i in range(last) if i % kept])
    before = luma[left_out // kept * kept]
    after = luma[left_out // kept * kept + kept]
    share = (left_out % kept / kept)[:, None, None]
    print(f"| {name} | {kept} | {psnr_of(luma[:last:kept], full[:last:kept]):.1f} | "
          f"{psnr_of(luma[left_out], full[left_out]):.1f} | {psnr_of(luma[left_out], before):.1f} | "
          f"{psnr_of(luma[left_out], (1 - share) * before + share * after):.1f} |", flush=True)


def measure_speed(programs, clip, name, points):
    """A row: frames in a second of the processor."""
    frames = len(frames_of(programs.folder / clip)[0])
    _, _, seconds = programs.encode(clip, "clip.kvd", "--points", points)
    row = [frames / seconds]
    for style in ("linear", "flat", "smooth"):
        row.append(max(frames / programs.run("kinetri-video", "decode", "clip.kvd", "decoded.y4m", "--style",
                                             style)[1] for _ in range(3)))
    print(f"| {name} | " + " | ".join(f"{value:.0f}" for value in row) + " |", flush=True)


def measure_curve(programs, clip):
    """Rows of CSV: points, turns, bits per pixel, PSNR, and seconds of the processor for a frame."""
    luma, _, _, _ = frames_of(programs.folder / clip)
    print("points,turn_every,bits_per_pixel,psnr,x264_bits_per_pixel,x264_psnr,encode_s,decode_s")
    for points in (250, 500, 1000, 2000, 4000):
        for turn in (8, 16):
            size, _, encode = programs.encode(clip, "clip.kvd", "--points", points, "--turn-every", turn,
                                              "--scene-cut")
            psnr, baseline, share = programs.psnr(clip, "clip.kvd")
            _, decode = programs.run("kinetri-video", "decode", "clip.kvd", "decoded.y4m")
            bits = 8 * size / luma.size
            x264 = ("", "") if baseline is None else (f"{bits * share:.4f}", f"{baseline:.2f}")
            print(f"{points},{turn},{bits:.4f},{psnr:.2f},{x264[0]},{x264[1]},{encode / len(luma):.4f},"
                  f"{decode / len(luma):.4f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default="build/test", help="folder of the build (default build/test)")
    parser.add_argument("--clip", help="a file in the format Y4M instead of the clips with known motion")
    parser.add_argument("--curve", action="store_true", help="rows of CSV for numbers of points, of --clip")
    parser.add_argument("--points", type=int, default=2000)
    parser.add_argument("--quick", action="store_true", help="small clips")
    settings = parser.parse_args()
    settings.size, settings.frames = (128, 96) if settings.quick else (320, 240), 17 if settings.quick else 50
    if settings.quick:
        settings.points = 500
    with tempfile.TemporaryDirectory(prefix="kinetri-video-") as name:
        programs = Programs(settings.build, pathlib.Path(name))
        if settings.clip:
            clips = [(pathlib.Path(settings.clip).stem, pathlib.Path(settings.clip).resolve())]
            clips = [(name, path.name, path) for name, path in clips]
            for _, file, path in clips:
                (programs.folder / file).write_bytes(path.read_bytes())
        else:
            clips = [(name, name + ".y4m", None) for name in CLIPS]
            for name, file, _ in clips:
                programs.run("kinetri_video_clips", "write", name, *settings.size, settings.frames, file)
        if settings.curve:
            measure_curve(programs, clips[0][1])
            return
        print("| clip | encode | linear | flat | smooth |")
        for name, file, _ in clips:
            measure_speed(programs, file, name, settings.points)
        print("| clip | one of | that one | in between | repeated | blended |")
        for name, file, _ in clips:
            for kept in (2, 4):
                measure_in_between(programs, file, name, settings.points, kept)
        print("| clip | off, median | nine in ten | events | bits | PSNR | grid | anew, as many bits | "
              "anew, as many points | x264 |")
        for name, file, _ in clips:
            measure_motion(programs, file, name, settings, settings.clip is None)


if __name__ == "__main__":
    main()
