#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verifies degenerate runs of every kind that the program writes: whole coordinates and velocities on
small grids, so that many events have one time, or times that differ by less than the log prints.

usage: degenerate_runs.py KINETRI FOLDER [FIRST_SEED [KIND]]

100 runs, or as many times more as the environment variable KINETRI_TEST_MULTIPLIER says, of all kinds or of
one. None may be refuted. A seed and a kind give one run, whatever the number of runs.
"""
import collections
import os
import pathlib
import random
import subprocess
import sys

RUNS = 100
RESPONSES = ("log", "swap", "elastic", "stop", "remove")


def points(generator, most=12, extent=3, speed=2, columns=()):
    """Rows of a file of points, each with another motion. A column has the choices for its numbers."""
    number = generator.randint(3, most)
    found = {}
    for _ in range(4 * number):
        if len(found) < number:
            place = tuple(generator.randint(-extent, extent) for _ in range(2))
            motion = place + tuple(generator.randint(-speed, speed) for _ in range(2))
            found[motion] = motion + tuple(generator.choice(choices) for _, choices in columns)
    names = ["x", "y", "vx", "vy", *(name for name, _ in columns)]
    return "\n".join([",".join(names), *(",".join(map(str, row)) for row in found.values())]) + "\n"


def lattice(generator, columns=()):
    """Points that are apart at the start: on places of a grid, each of which has one point at most."""
    size = generator.randint(2, 4)
    places = [(3 * x, 3 * y) for x in range(size) for y in range(size)]
    rows = [
        place + (generator.randint(-2, 2), generator.randint(-2, 2))
        + tuple(generator.choice(choices) for _, choices in columns)
        for place in generator.sample(places, generator.randint(2, len(places)))
    ]
    names = ["x", "y", "vx", "vy", *(name for name, _ in columns)]
    return "\n".join([",".join(names), *(",".join(map(str, row)) for row in rows)]) + "\n"


def plain(generator):
    return points(generator), f"simulate FILE --until {generator.randint(2, 6)}"


def accelerated(generator):
    columns = [(name, (0, 0, 1, -1)) for name in ("ax", "ay")]
    return points(generator, most=7, columns=columns), f"simulate FILE --until {generator.randint(1, 3)}"


def in_box(generator):
    return points(generator), f"simulate FILE --until {generator.randint(2, 8)} --box=-4,-4,4,4"


def regular(generator):
    columns = [("radius", (0, 0, 1, 2, 0.5))]
    if generator.random() < 0.5:
        columns.append(("growth", (0, 0, 1, 0.5)))
    return points(generator, columns=columns), f"simulate FILE --until {generator.randint(2, 5)} --regular"


def walls(generator):
    """No box, or one around a lattice, at least as wide as the discs at its bounds."""
    side = generator.choice((4, 5, 6))
    bounds = f"--box={-side},{-side},{9 + side},{9 + side}"
    return generator.choice((bounds, bounds + " --rim", ""))


def discs(generator):
    """Discs of one size, whose contacts have one time."""
    radius = generator.choice((0.25, 0.5, 1))
    response = generator.choice(RESPONSES)
    return lattice(generator), (f"simulate FILE --until {generator.randint(2, 8)} --radius {radius} "
                                f"--collisions {response} {walls(generator)}")


def sizes(generator):
    """Discs of several sizes."""
    columns = [("radius", (0.25, 0.5, 1, 1.25))]
    response = generator.choice(RESPONSES)
    return lattice(generator, columns), (f"simulate FILE --until {generator.randint(2, 6)} --collisions {response} "
                                         f"{walls(generator)}")


def growing(generator):
    """Discs that grow, some of them from points."""
    columns = [("radius", (0, 0.25, 0.5)), ("growth", (0, 0.125, 0.0625))]
    response = generator.choice(RESPONSES)
    return lattice(generator, columns), (f"simulate FILE --until {generator.randint(1, 4)} --collisions {response} "
                                         f"{walls(generator)}")


def wave(generator):
    radius = generator.choice(("0.3", "0.5", "1", "2", "4"))
    return "", (f"wave --columns {generator.randint(1, 8)} --rows {generator.randint(1, 6)} --radius {radius} "
                f"--until {generator.randint(4, 20)}")


def tracks(generator):
    rows = ["t,id,x,y"]
    for thing in range(generator.randint(3, 9)):
        first, x, y = generator.randint(0, 5), generator.randint(0, 9), generator.randint(0, 9)
        for step in range(generator.randint(2, 6)):
            rows.append(f"{first + step},{thing},{x},{y}")
            x, y = x + generator.randint(-2, 2), y + generator.randint(-2, 2)
    more = generator.choice(("", "", "--collisions log --radius 0.5"))
    return "\n".join(rows) + "\n", f"tracks FILE {more}"


def copies(generator):
    """Points of another kind, some of them twice or more, so that they coincide from the start."""
    text, command = generator.choice((plain, accelerated, in_box, regular, discs, sizes, growing))(generator)
    header, *rows = text.splitlines()
    rows += [generator.choice(rows) for _ in range(generator.randint(1, 5))]
    generator.shuffle(rows)
    return "\n".join([header, *rows]) + "\n", command


def crowds(generator):
    """Things on the tracks of a tiny grid: many of them go the same way for a while."""
    rows = ["t,id,x,y"]
    size = generator.randint(1, 2)
    for thing in range(generator.randint(4, 12)):
        first = generator.choice((0, 0, 1, 2))
        for step in range(generator.randint(2, 7)):
            x, y = generator.randint(0, size), generator.randint(0, size)
            rows.append(f"{first + step},{thing},{x},{y}")
    more = generator.choice(("", "", "--collisions log --radius 0.125"))
    return "\n".join(rows) + "\n", f"tracks FILE {more}"


def periodic(generator):
    """Discs of one size on a grid in a periodic box, which is at rest or sheared. Some are given outside of the
    box, and some grids move with it."""
    columns, rows = generator.randint(1, 4), generator.randint(1, 4)
    width, height, tilt = 3 * columns, 3 * rows, generator.choice((0, 0, 1, -2))
    shear = generator.choice((0, 0, 0.5, -1, 1))
    drift = shear if generator.random() < 0.5 else 0
    # With little room these two have contacts without end, and sheared boxes make them faster and faster.
    response = generator.choice(RESPONSES)
    radius = generator.choice((0.25, 0.5) if response in ("swap", "elastic") else (0.25, 0.5, 1, 1.5))
    places = [(3 * x, 3 * y) for x in range(columns) for y in range(rows)]
    text = ["x,y,vx,vy"]
    for x, y in generator.sample(places, generator.randint(1, len(places))):
        k, l = generator.choice(((0, 0), (0, 0), (1, 0), (-1, 1)))
        x, y = x + k * width + l * tilt, y + l * height
        text.append(f"{x},{y},{generator.randint(-2, 2) + drift * y},{generator.randint(-2, 2)}")
    start = generator.choice((0, 0, 0.5, -1))
    return "\n".join(text) + "\n", (f"simulate FILE --from={start} --until {start + generator.randint(2, 5)} "
                                     f"--periodic {width},{height},{tilt} --shear={shear} --radius {radius} "
                                     f"--collisions {response}")


def atoms(generator):
    """Atoms on a tiny grid in a periodic box at rest, oblique or not, given as an XYZ or as a dump from which some are
    missing now and then: many go the same way for a while, or are images of each other."""
    number = generator.randint(1, 9)
    is_dump = generator.random() < 0.5
    width, height, tilt = generator.randint(3, 5), generator.randint(3, 5), generator.choice((0, 0, 1))
    rise = 0 if is_dump else generator.choice((0, 1, -1))
    places = [[generator.randint(0, 4), generator.randint(0, 4)] for _ in range(number)]
    lines = []
    for t in range(generator.randint(2, 6)):
        here = [i for i in range(number) if not is_dump or generator.random() < 0.85]
        if is_dump:
            lines += ["ITEM: TIMESTEP", str(t), "ITEM: NUMBER OF ATOMS", str(len(here)),
                      "ITEM: BOX BOUNDS xy xz yz pp pp pp", f"0 {width + tilt} {tilt}", f"0 {height} 0", "0 1 0",
                      "ITEM: ATOMS id xu yu", *(f"{i} {places[i][0]} {places[i][1]}" for i in here)]
        else:
            lines += [str(number), f'Lattice="{width} {rise} 0 {tilt} {height} 0 0 0 1" pbc="T T T"',
                      *(f"Ar {x} {y} 0" for x, y in places)]
        for place in places:
            place[0] += generator.randint(-1, 1)
            place[1] += generator.randint(-1, 1)
    return "\n".join(lines) + "\n", "tracks FILE --periodic"


def torus(generator):
    """Discs of several sizes in a periodic box at rest or sheared, which hide others or collide; some grow."""
    width, height, tilt = generator.randint(1, 4), generator.randint(1, 4), generator.choice((0, 0, 1, -1))
    shear = generator.choice((0, 0, 0.5, -1))
    until = generator.randint(1, 3)
    if generator.random() < 0.5:
        more = "--regular"
        places = [(generator.randint(-3, 4), generator.randint(-3, 4)) for _ in range(generator.randint(1, 14))]
        radii, growths = (0, 0, 0.5, 1, 2), (0, 0, 0.25)
    else:
        columns, rows = generator.randint(1, 3), generator.randint(1, 3)
        more = f"--collisions {generator.choice(RESPONSES)}"
        places = [(3 * x, 3 * y) for x in range(columns) for y in range(rows)]
        width, height = 3 * columns, 3 * rows
        radii, growths = (0.25, 0.5, 0.75), (0, 0.0625, -0.0625)
    text = ["x,y,vx,vy,radius,growth"]
    for x, y in places:
        text.append(f"{x},{y},{generator.randint(-1, 1)},{generator.randint(-1, 1)},{generator.choice(radii)},"
                    f"{generator.choice(growths)}")
    return "\n".join(text) + "\n", (f"simulate FILE --until {until} --periodic {width},{height},{tilt} --shear={shear} "
                                     f"{more}")


KINDS = (plain, accelerated, in_box, regular, discs, sizes, growing, wave, tracks, copies, crowds, periodic, torus, atoms)


def main():
    kinetri, folder = sys.argv[1:3]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    kinds = [kind for kind in KINDS if sys.argv[4:5] in ([], [kind.__name__])]
    runs = RUNS * int(os.environ.get("KINETRI_TEST_MULTIPLIER", "1"))
    verified, refused, events = collections.Counter(), collections.Counter(), 0
    faults = []
    while verified.total() + len(faults) < runs and refused.total() < runs:
        kind = kinds[seed % len(kinds)]
        text, command = kind(random.Random(seed))
        file = folder / f"{seed}.csv"
        file.write_text(text, encoding="utf-8")
        words = [str(file) if word == "FILE" else word for word in command.split()]
        command = [kinetri, *words, "--quiet", "--verify", "--max-events", "20000"]
        result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=600)
        answer = result.stdout + result.stderr
        if answer.startswith("verified"):
            verified[kind.__name__] += 1
            events += int(answer.split(" points, ")[1].split(" ")[0])
        elif result.returncode == 2:  # discs that overlap at the start, or what is not supported
            refused[kind.__name__] += 1
        else:
            faults.append(f"seed {seed}: {' '.join(command)}\n{answer[:400]}")
            print(faults[-1], flush=True)
        if result.returncode in (0, 2):
            file.unlink()
        seed += 1
        if verified.total() and verified.total() % 1000 == 0:
            print(f"{verified.total()} runs verified, up to seed {seed}", flush=True)
    print(f"{verified.total()} runs verified, {events} events; by kind: {dict(verified)}; refused: {dict(refused)}")
    assert not faults, f"{len(faults)} runs were not verified"
    assert len(verified) == len(kinds) and events > 10 * runs, (verified, events)


if __name__ == "__main__":
    main()
