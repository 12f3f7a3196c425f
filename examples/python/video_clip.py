#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a clip in the format Y4M: a wheel with spokes turns and rolls to the right.

usage: video_clip.py OUT.y4m
"""
import math
import sys

WIDTH, HEIGHT, FRAMES = 160, 120, 40


def brightness(x, y, t):
    """Of the wheel, its spokes, or the ground behind it, from 0 to 255."""
    dx, dy = x - 40 - 2 * t, y - 60
    distance = math.hypot(dx, dy)
    if distance > 34:
        return 90 + 40 * math.sin(x / 9) * math.sin(y / 7)
    return 150 + 80 * math.sin(5 * (math.atan2(dy, dx) - 2 * t / 34)) * distance / 34


def main():
    with open(sys.argv[1], "wb") as out:
        out.write(f"YUV4MPEG2 W{WIDTH} H{HEIGHT} F25:1 Cmono XCOLORRANGE=FULL\n".encode())
        for t in range(FRAMES):
            out.write(b"FRAME\n")
            for row in range(HEIGHT):
                out.write(bytes(round(brightness(x + 0.5, row + 0.5, t)) for x in range(WIDTH)))
    print(f"{FRAMES} frames of {WIDTH} x {HEIGHT}")


if __name__ == "__main__":
    main()
