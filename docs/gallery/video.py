#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of video in the gallery: a frame with its mesh, and curves of bits, quality and time.

usage: video.py PROGRAMS OUTPUT_DIR

PROGRAMS is the folder of kinetri-video. Needs POV-Ray, which renders the clip, NumPy and matplotlib; ffmpeg, where
it is installed, adds x264 to the curves.
"""
import base64
import json
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import matplotlib
import numpy as np

matplotlib.use("Agg")  # files, no windows
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

SCENE = pathlib.Path(__file__).resolve().with_name("video_scene.pov")
WIDTH, HEIGHT, FRAMES, SHOWN = 320, 240, 50, 24
POINTS = (250, 500, 1000, 2000, 4000)


def run(*command):
    """(output, seconds of the processor)"""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(f"{command[0]}: {done.stderr.strip()}")
    return done.stdout, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def numbers(text, kind):
    return np.frombuffer(base64.b64decode(text), dtype=kind)


def triangles_at(page, time):
    """(corners of all triangles, their colors) at a time, from the page that `kinetri-video play` writes."""
    text = page.read_text(encoding="utf-8")
    stream = json.loads(re.search(r'id="stream">(.*?)</script>', text, re.DOTALL)[1])
    segment = max((s for s in stream["segments"] if s["begin"] <= time), key=lambda s: s["begin"])
    triangles = {tuple(t) for t in numbers(segment["initial"], "<i4").reshape(-1, 3).tolist()}
    changes = iter(numbers(segment["changes"], "<i4").reshape(-1, 3).tolist())
    counts = numbers(segment["counts"], "<i4").reshape(-1, 2)
    for when, (removed, added) in zip(numbers(segment["times"], "<f8"), counts):
        if when > time:
            break
        triangles -= {tuple(next(changes)) for _ in range(removed)}
        triangles |= {tuple(next(changes)) for _ in range(added)}
    group = [g for g in segment["groups"] if g["begin"] <= time][-1]
    share = (time - group["begin"]) / max(group["end"] - group["begin"], 1)
    ids = numbers(group["ids"], "<i4")

    def now(text, kind, each):
        values = numbers(text, kind).reshape(-1, 2, each).astype(float)
        return values[:, 0] + share * (values[:, 1] - values[:, 0])

    index = {id: i for i, id in enumerate(ids.tolist())}
    corners = np.array([[index[id] for id in triangle] for triangle in sorted(triangles)])
    places = now(group["places"], "<i4", 2) * stream["unit"]
    colors = np.clip(now(group["colors"], "<i2", 3) / 255, 0, 1)
    return places[corners], colors[corners].mean(axis=1)


def draw_frame(programs, folder, output):
    run(programs / "kinetri-video", "encode", folder / "clip", folder / "clip.kvd", "--points", 2000)
    run(programs / "kinetri-video", "play", folder / "clip.kvd", "--html", folder / "clip.html")
    run(programs / "kinetri-video", "decode", folder / "clip.kvd", f"{folder}/decoded/")
    figure, axes = pyplot.subplots(1, 3, figsize=(11, 2.9), layout="constrained")
    axes[0].imshow(pyplot.imread(sorted((folder / "clip").iterdir())[SHOWN]))
    axes[0].set_title("source")
    axes[1].imshow(pyplot.imread(folder / "decoded" / f"{SHOWN:05d}.png"))
    axes[1].set_title("2000 moving points")
    corners, colors = triangles_at(folder / "clip.html", SHOWN)
    axes[2].add_collection(PolyCollection(corners, facecolors=colors, edgecolors="white", linewidths=0.25))
    axes[2].set(title="their triangles", xlim=(0, WIDTH), ylim=(HEIGHT, 0), aspect="equal")
    for axis in axes:
        axis.axis("off")
    figure.savefig(output / "video.png", dpi=100)


def draw_curves(programs, folder, output):
    bits, psnr, rival_bits, rival_psnr, encode, decode = ([] for _ in range(6))
    for points in POINTS:
        stream = folder / f"{points}.kvd"
        encode.append(1000 * run(programs / "kinetri-video", "encode", folder / "clip", stream, "--points",
                                 points)[1] / FRAMES)
        decode.append(1000 * run(programs / "kinetri-video", "decode", stream,
                                 folder / "decoded.y4m")[1] / FRAMES)
        text, _ = run(programs / "kinetri-video", "compare", folder / "clip", stream)
        found_bits = [float(b) for b in re.findall(r"bits +(\S+)", text)]
        found = [float(p) for p in re.findall(r"y +PSNR (\S+)", text)]
        bits.append(found_bits[0])
        psnr.append(found[0])
        rival_bits += found_bits[1:]
        rival_psnr += found[1:]
        print(points, found_bits, found, encode[-1], decode[-1])
    figure, (quality, time) = pyplot.subplots(1, 2, figsize=(9, 3), layout="constrained")
    quality.plot(bits, psnr, "o-", label="moving points, 250 to 4000")
    if rival_bits:
        quality.plot(rival_bits, rival_psnr, "s--", label="x264, two passes")
    quality.set(xscale="log", xlabel="bits per pixel", ylabel="PSNR of brightness, dB")
    quality.legend()
    time.plot(POINTS, encode, "o-", label="encode")
    time.plot(POINTS, decode, "s-", label="decode")
    time.set(xscale="log", yscale="log", xlabel="points", ylabel="ms for a frame")
    time.legend()
    for axis in (quality, time):
        axis.grid(alpha=0.3)
    figure.savefig(output / "video_curves.svg", metadata={"Date": None})


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    programs, output = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "clip").mkdir()
        run("povray", f"+I{SCENE}", f"+O{folder}/clip/f.png", f"+W{WIDTH}", f"+H{HEIGHT}", "+A0.1", "-D", "-GA",
            f"+KFF{FRAMES}", "+KI0", "+KF1")
        draw_frame(programs, folder, output)
        draw_curves(programs, folder, output)


if __name__ == "__main__":
    main()
