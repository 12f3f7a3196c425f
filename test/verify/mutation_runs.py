# SPDX-License-Identifier: GPL-3.0-or-later
"""Small runs of all kinds, for mutations.py."""
import pathlib
import random
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORPUS = ("chain_through_one_place clusters_at_once cocircular_meet events_1e-18_apart events_2^-200_apart flat_for_an_instant "
          "flat_touch flat_twice flip_at_triple_root four_meet hull_events_at_start_and_end hull_touch_from_inside "
          "hull_vertex_is_hit lattice_half_moves lattice_row_across many_flips_at_irrational_time near_miss near_touch_inside "
          "rings_pass_through three_meet_in_line touch_double_root touches_and_flips_together turning_octagon_touch "
          "turning_ring_with_centre two_simple_roots_at_one_flip").split()


def make_runs(kinetri, folder):
    """Files of points, options that the checker needs too, and others."""
    folder.mkdir(exist_ok=True)

    def generated(kind, points, seed=1, *options):
        file = folder / f"{kind}-{points}-{seed}{len(options)}.csv"
        command = [kinetri, "generate", kind, "--points", str(points), "--seed", str(seed), *options, "--output", file]
        subprocess.run(command, check=True)
        return file

    def random_points(name, header, row, number=14):
        file, generator = folder / f"{name}.csv", random.Random(name)
        rows = [",".join(map(repr, row(generator.uniform, i))) for i in range(number)]
        file.write_text("\n".join([header, *rows, ""]), encoding="utf-8")
        return file

    for kind, points in (("uniform", 12), ("uniform", 30), ("uniform", 60), ("gaussian", 30), ("lattice", 16), ("lattice", 36),
                         ("lattice-jitter", 25), ("lattice-jitter", 49), ("one-mover", 40)):
        yield generated(kind, points), ["--until", "5"], []
    for kind, points in (("uniform", 20), ("lattice", 25), ("lattice-jitter", 16)):
        yield generated(kind, points, 2), ["--until", "5"], ["--exact-only"]
    for kind, points in (("uniform", 30), ("lattice", 16)):
        yield generated(kind, points, 3), ["--until", "8", "--box=-60,-60,90,90"], []
    discs = generated("uniform", 25, 4, "--side", "40")
    rim = ["--until", "6", "--box=-5,-5,45,45", "--rim", "--collisions"]
    for response, radius in (("elastic", "0.6"), ("swap", "0.6"), ("stop", "0.5"), ("remove", "0.5"), ("log", "0.5")):
        yield discs, [*rim, response], ["--radius", radius]
    yield discs, [*rim, "elastic"], ["--radius", "0.2", "--growth", "0.05"]
    yield discs, [*rim, "elastic"], ["--radius", "0.6", "--exact-only"]
    for name, growth in (("weights", 0), ("growing", 0.3), ("growing more", 1)):
        points = random_points(name, "x,y,vx,vy,radius,growth", lambda u, i, g=growth: (
            u(-9, 9), u(-9, 9), u(-2, 2), u(-2, 2), u(0.5, 4), u(0, g)), 24)
        yield points, ["--until", "6"], ["--regular"]
        yield points, ["--until", "3"], ["--regular", "--exact-only"]
    for name, jerk in (("accelerated", 0), ("with jerk", 1)):
        points = random_points(name, "x,y,vx,vy,ax,ay,jx,jy", lambda u, i, j=jerk: (
            u(0, 9), u(0, 9), u(-2, 2), u(-2, 2), u(-1, 1), u(-1, 1), u(-j, j), u(-j, j)))
        yield points, ["--until", "4"], []
        yield points, ["--until", "3", "--box=-1,-1,10,10", "--collisions", "elastic"], ["--radius", "0.05"]
    for name in CORPUS:
        file = ROOT / f"data/degenerate/{name}.csv"
        until = re.search("^# until: (.*)$", file.read_text(encoding="utf-8"), re.MULTILINE)
        yield file, ["--until", until[1] if until else "10"], []
