# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about the rows of the triangulation, its edges and times, and about motions at the start."""
import math

from lie_tables import (BOX, PLAIN, TRACKS, WEIGHTS, chosen, edit, interval, is_alone, is_later, kind, kinds, lie, remove,
                        ulps)


@lie(PLAIN, BOX, WEIGHTS)
def a_row_left_out(run, generator):
    return remove(run, chosen(run, generator, lambda row: row[1] not in ("hide", "reveal")))


@lie(PLAIN)
def the_first_row_left_out(run, generator):
    return remove(run, 0 if run.rows else None)


@lie(PLAIN)
def the_last_row_left_out(run, generator):
    return remove(run, len(run.rows) - 1 if run.rows else None)


@lie(PLAIN, BOX)
def a_row_doubled(run, generator):
    i = chosen(run, generator)
    if i is None:
        return None
    run.insert(i + 1, list(run.rows[i]))
    return i + 1


@lie(PLAIN)
def a_row_again_at_the_end(run, generator):
    i = chosen(run, generator)
    if i is None:
        return None
    run.rows.append(list(run.rows[i]))
    return len(run.rows) - 1


@lie(PLAIN)
def neighbors_swapped(run, generator):
    i = generator.choice([i for i in range(len(run.rows)) if is_later(run, i)] or [None])
    if i is None:
        return None
    run.rows[i - 1], run.rows[i] = run.rows[i], run.rows[i - 1]
    return i - 1


@lie(PLAIN)
def edges_of_neighbors_swapped(run, generator):
    i = generator.choice([i for i in range(len(run.rows)) if is_later(run, i)] or [None])
    if i is None:
        return None
    a, b = run.rows[i - 1], run.rows[i]
    a[1], b[1], a[5:9], b[5:9] = b[1], a[1], b[5:9], a[5:9]
    return i - 1


@lie(PLAIN)
def cut_off(run, generator):
    i = chosen(run, generator)
    if i is not None:
        del run.rows[i:]
    return i


@lie(PLAIN)
def a_flip_that_is_none(run, generator):
    if not run.initial or len(run.points) < 4:
        return None
    time = [repr(generator.uniform(0, run.until))] * 3
    added = sorted(generator.sample(range(len(run.points)), 2))
    row = ["0", "flip", *time, *generator.choice(run.initial), *map(str, added), "", ""]
    at = sum(interval(other)[0] <= float(time[0]) for other in run.rows)
    run.rows.insert(at, row)
    return at


@lie(PLAIN)
def a_flip_and_back(run, generator):
    i = chosen(run, generator, kinds("flip"))
    if i is None:
        return None
    back = list(run.rows[i])
    back[5:9] = back[7:9] + back[5:7]
    run.rows.insert(i + 1, back)
    return i + 1


def widen(row, _):
    row[4] = repr(float(row[4]) + 1e-9 * max(1, abs(float(row[4]))))


def beyond(row, part):
    width = float(row[4]) - float(row[3])
    if width > 0:
        ulps(row, 2 * part)
    else:
        ulps(row, part)


def no_time(row, _):
    row[2] = repr(math.nextafter(float(row[4]), math.inf))


def time_at_the_other_end(row, _):
    if row[3] == row[4]:
        return False
    row[2] = row[4] if row[2] == row[3] else row[3]
    return True


def turned_around(row, _):
    if row[3] == row[4]:
        return False
    row[3], row[4] = row[4], row[3]
    return True


def ends_exchanged(row, generator):
    parts = [i for i in (5, 7) if row[i]]
    i = generator.choice(parts)
    row[i], row[i + 1] = row[i + 1], row[i]


def backward(row, _):
    row[5:9] = row[7:9] + row[5:7]


def other_end(first):
    def change(row, generator):
        i = first + generator.randint(0, 1)
        ends = {0, 1, 2, 3, 4, 5} - {int(e) for e in row[5:9] if e}
        row[i] = str(generator.choice(sorted(ends)))
        pair = sorted(map(int, row[first : first + 2]))
        row[first : first + 2] = map(str, pair)
        return True

    return change


def another_kind(row, generator):
    """Another one with the same columns, and whatever else there is."""
    row[1] = generator.choice(sorted({"flip", "hull_insert", "hull_remove", "hide", "reveal", "insert", "erase",
                                      "trajectory", "collision"} - {row[1]}))


EDGES = kinds("flip", "hull_insert", "hull_remove", "rebuild")
FLIPS = kinds("flip", "hull_insert", "hull_remove")
edit("an_interval_an_ulp_late", FLIPS, lambda r, g: beyond(r, 1), PLAIN)
edit("an_interval_an_ulp_early", FLIPS, lambda r, g: beyond(r, -1), PLAIN)
edit("a_time_moved_on", EDGES, lambda r, g: ulps(r, 2 ** g.randint(4, 12)), PLAIN)
edit("a_time_moved_back", EDGES, lambda r, g: ulps(r, -(2 ** g.randint(4, 12))), PLAIN)
edit("an_interval_too_wide", lambda r: True, widen, PLAIN, BOX)
edit("a_time_outside_its_interval", lambda r: True, no_time, PLAIN, BOX)
edit("an_interval_turned_around", lambda r: True, turned_around, PLAIN)
edit("a_time_at_the_other_end", lambda r: True, time_at_the_other_end, PLAIN, BOX, WEIGHTS)
edit("another_kind", lambda r: r[1] != "rebuild", another_kind, PLAIN, BOX, WEIGHTS, TRACKS)
edit("a_time_moved_on_at_a_contact", kinds("wall", "collision"), lambda r, g: ulps(r, 2 ** g.randint(4, 12)), BOX)
edit("a_time_moved_back_at_a_contact", kinds("wall", "collision"), lambda r, g: ulps(r, -(2 ** g.randint(4, 12))), BOX)
edit("ends_of_an_edge_exchanged", EDGES, ends_exchanged, PLAIN)
edit("a_row_backward", FLIPS, backward, PLAIN)
edit("another_edge_removed", kinds("flip", "hull_insert"), other_end(5), PLAIN)
edit("another_edge_added", kinds("flip", "hull_remove"), other_end(7), PLAIN)
edit("another_edge_removed_by_a_rebuild", lambda r: r[1] == "rebuild" and r[5], other_end(5), PLAIN, WEIGHTS)
edit("another_edge_added_by_a_rebuild", lambda r: r[1] == "rebuild" and r[7], other_end(7), PLAIN, WEIGHTS)
edit("a_flip_called_hull_insert", kinds("flip"), kind("hull_insert"), PLAIN)
edit("a_flip_called_rebuild", kinds("flip"), kind("rebuild"), PLAIN)
edit("a_hull_insert_called_flip", kinds("hull_insert"), kind("flip"), PLAIN)
edit("a_hull_insert_called_hull_remove", kinds("hull_insert"), kind("hull_remove"), PLAIN)
edit("an_edge_without_an_end", EDGES, lambda r, g: r.__setitem__(slice(5, 9), [""] * 4), PLAIN)
edit("a_wall_called_collision", kinds("wall"), kind("collision"), BOX)
edit("a_wall_called_trajectory", kinds("wall"), kind("trajectory"), BOX)


@lie(PLAIN, BOX, WEIGHTS)
def an_instant_divided(run, generator):
    """Rows of one exact time are said to be of two."""
    i = generator.choice([i for i, row in enumerate(run.rows) if i and row[11] == run.rows[i - 1][11]] or [None])
    if i is None:
        return None
    whole = run.rows[i][11]
    for row in run.rows[i:]:
        if row[11] == whole:
            row[11] = "later"
    return i


@lie(PLAIN, BOX, WEIGHTS)
def two_instants_joined(run, generator):
    i = generator.choice([i for i, row in enumerate(run.rows) if i and row[11] != run.rows[i - 1][11]] or [None])
    if i is None:
        return None
    second = run.rows[i][11]
    for row in run.rows[i:]:
        if row[11] == second:
            row[11] = run.rows[i - 1][11]
    return i


def called_rebuild(which):
    def function(run, generator):
        """Where nothing else happens."""
        found = [i for i, row in enumerate(run.rows) if row[1] == which and is_alone(run, i)]
        if not found or isinstance(run.points[0][0], int) or len(run.points) < 5:
            return None
        i = generator.choice(found)
        row = run.rows[i]
        row[1] = "rebuild"
        if which == "flip":
            run.rows.insert(i + 1, row[:5] + ["", ""] + row[7:])
            row[7:9] = ["", ""]
        return i

    function.__name__ = f"a_{which}_alone_called_rebuild"
    lie(PLAIN)(function)


for flipped in ("flip", "hull_insert", "hull_remove"):
    called_rebuild(flipped)


@lie(PLAIN)
def an_initial_edge_left_out(run, generator):
    if not run.initial:
        return None
    del run.initial[generator.randrange(len(run.initial))]
    return -1


def replace_edge(run, edges, generator, diagonal):
    there = {tuple(map(int, edge)) for edge in edges}
    neighbors = {i: set() for i in range(len(run.points))}
    for a, b in there:
        neighbors[a].add(b)
        neighbors[b].add(a)
    choices = []
    for a, b in sorted(there):
        common = sorted(neighbors[a] & neighbors[b])
        others = [(c, d) for i, c in enumerate(common) for d in common[i + 1 :]] if diagonal else [
            (c, d) for c in range(len(run.points)) for d in range(c + 1, len(run.points))
        ]
        choices += [((a, b), other) for other in others if other not in there]
    if not choices:
        return False
    old, new = generator.choice(choices)
    edges[:] = [list(map(str, e)) for e in sorted((there - {old}) | {new})]
    return True


@lie(PLAIN)
def another_initial_edge(run, generator):
    return -1 if replace_edge(run, run.initial, generator, False) else None


@lie(PLAIN)
def the_other_initial_diagonal(run, generator):
    return -1 if replace_edge(run, run.initial, generator, True) else None


@lie(PLAIN)
def a_final_edge_left_out(run, generator):
    if not run.final:
        return None
    del run.final[generator.randrange(len(run.final))]
    return len(run.rows)


@lie(PLAIN)
def another_final_edge(run, generator):
    return len(run.rows) if replace_edge(run, run.final, generator, False) else None


@lie(PLAIN)
def an_earlier_end(run, generator):
    i = chosen(run, generator, lambda row: float(row[3]) > run.start + 0.01)
    if i is None:
        return None
    run.until = math.nextafter(float(run.rows[i][3]), -math.inf)
    return next(k for k, row in enumerate(run.rows) if float(row[4]) > run.until)


@lie(PLAIN)
def a_motion_at_the_start_altered(run, generator):
    motion = generator.choice([m for m in run.motions if not m[0]])
    i = generator.randint(2, 5)
    motion[i] = repr(math.nextafter(float(motion[i]), math.inf))
    return -1


@lie(PLAIN, BOX, WEIGHTS)
def a_disc_at_the_start_altered(run, generator):
    if len(run.points) < 2:
        return None  # its disc may be any
    motion = generator.choice([m for m in run.motions if not m[0]])
    i = generator.randint(10, 11)
    motion[i] = repr(math.nextafter(float(motion[i]), math.inf))
    return -1
