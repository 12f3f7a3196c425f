# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about points that hide, come and go, and that coincide for a while."""
import math
from fractions import Fraction

from lie_tables import TRACKS, TWINS, WEIGHTS, chosen, edit, interval, kind, kinds, lie, motion_of, remove

# ---- points that hide, come and go ----


@lie(WEIGHTS)
def a_hide_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("hide")))


@lie(WEIGHTS)
def a_reveal_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("reveal")))


edit("a_hide_called_reveal", kinds("hide"), kind("reveal"), WEIGHTS)
edit("a_reveal_called_hide", kinds("reveal"), kind("hide"), WEIGHTS)


def another_point(row, generator):
    row[9] = str(generator.choice(sorted(set(range(6)) - {int(row[9])})))


edit("another_point_hidden", kinds("hide"), another_point, WEIGHTS)
edit("another_point_revealed", kinds("reveal"), another_point, WEIGHTS)
edit("another_point_inserted", kinds("insert"), another_point, TRACKS)
edit("another_point_erased", kinds("erase"), another_point, TRACKS)
edit("another_point_turns", kinds("trajectory"), another_point, TRACKS)


@lie(TRACKS)
def an_insert_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("insert")))


@lie(TRACKS)
def an_erase_left_out(run, generator):
    def leaves_before_the_end(row):
        return row[1] == "erase" and float(row[3]) < run.until

    return remove(run, chosen(run, generator, leaves_before_the_end))


edit("an_insert_called_trajectory", kinds("insert"), kind("trajectory"), TRACKS)
edit("an_erase_called_trajectory", kinds("erase"), kind("trajectory"), TRACKS)


# ---- points that coincide for a while ----


def trajectory(motion):
    """Equal if straight motions, and the squares of radii, are equal at all times; None if the point is erased."""
    if not motion[2]:
        return None
    x, y, vx, vy = (Fraction(float(number)) for number in motion[2:6])
    radius, growth, epoch = (Fraction(float(number)) for number in motion[10:13])
    start = radius - growth * epoch
    return x - vx * epoch, y - vy * epoch, vx, vy, start * start, start * growth, growth * growth


def trajectories(run, point):
    return {trajectory(motion) for motion in run.motions if motion[1] == point} - {None}


def strangers(run, point):
    """Points that have never had a trajectory of the point."""
    own = trajectories(run, point)
    return [other for other in sorted({m[1] for m in run.motions}) if not own & trajectories(run, other)]


def by_a_point(name):
    return lambda row: row[1] == name and row[10] != ""


def start_groups(run):
    """Points that coincide at the start, of those groups with edges. None if something happens then, or all points
    are on one line."""
    groups = {}
    for motion in run.motions:
        if not motion[0]:
            groups.setdefault(trajectory(motion), []).append(motion[1])
    if (run.rows and interval(run.rows[0])[0] <= run.start) or len(run.initial) < len(groups):
        return []
    with_edges = {end for edge in run.initial for end in edge}
    return [group for group in groups.values() if len(group) > 1 and group[0] in with_edges]


@lie(TWINS)
def a_hide_by_a_point_left_out(run, generator):
    return remove(run, chosen(run, generator, by_a_point("hide")))


@lie(TWINS)
def a_reveal_by_a_point_left_out(run, generator):
    """Not of one that is erased in the same instant: a triangle may have hidden it until then."""
    erased = {(m[1], run.rows[int(m[0])][11]) for m in run.motions if m[0] and not m[2]}
    return remove(run, chosen(run, generator, lambda r: by_a_point("reveal")(r) and (r[9], r[11]) not in erased))


edit("a_hide_by_a_point_called_reveal", by_a_point("hide"), kind("reveal"), TWINS)
edit("a_reveal_by_a_point_called_hide", by_a_point("reveal"), kind("hide"), TWINS)
edit("a_hide_without_the_point_that_hides", by_a_point("hide"), lambda r, g: r.__setitem__(10, ""), TWINS)


@lie(TWINS)
def a_reveal_without_the_point_that_hid(run, generator):
    """Of a change of one point: of several ones, the others may have been made later, and a triangle have hidden the
    point in between."""
    of_changes = kinds("insert", "erase", "trajectory", "wall", "collision")

    def follows_one_change(i, row):
        last = max(k for k in range(i) if of_changes(run.rows[k]))
        return last == 0 or run.rows[last - 1][11] != row[11] or not of_changes(run.rows[last - 1])

    found = [i for i, row in enumerate(run.rows) if by_a_point("reveal")(row) and follows_one_change(i, row)]
    if not found:
        return None
    i = generator.choice(found)
    run.rows[i][10] = ""
    return i


def by_a_stranger(name):
    def function(run, generator):
        i = chosen(run, generator, by_a_point(name))
        others = [] if i is None else strangers(run, run.rows[i][9])
        if not others:
            return None
        run.rows[i][10] = generator.choice(others)
        return i

    function.__name__ = f"a_{name}_by_another_point"
    lie(TWINS)(function)


for told in ("hide", "reveal"):
    by_a_stranger(told)
edit("a_point_that_hides_itself", lambda row: row[10] and row[1] in ("hide", "reveal"),
     lambda r, g: r.__setitem__(10, r[9]), TWINS)
edit("a_point_that_is_hidden_by_one_it_hides", by_a_point("hide"),
     lambda r, g: r.__setitem__(slice(9, 11), [r[10], r[9]]), TWINS)


@lie(TWINS)
def a_point_hidden_by_a_stranger(run, generator):
    """A row of an instant in which motions change."""
    i = chosen(run, generator, kinds("trajectory", "insert"))
    others = [] if i is None else strangers(run, run.rows[i][9])
    if not others:
        return None
    run.insert(i + 1, ["", "hide", *run.rows[i][2:5], "", "", "", "", run.rows[i][9], generator.choice(others),
                       run.rows[i][11]])
    run.motions = [m for m in run.motions if m[0] != str(i + 1)]
    return i + 1


@lie(TWINS)
def a_hide_told_again(run, generator):
    i = chosen(run, generator, by_a_point("hide"))
    if i is None:
        return None
    run.insert(i + 1, list(run.rows[i]))
    return i + 1


@lie(TWINS)
def a_hidden_point_with_an_edge(run, generator):
    """A row of the same instant, after the hide."""
    i = chosen(run, generator, by_a_point("hide"))
    if i is None:
        return None
    row = run.rows[i]
    others = sorted({end for r in run.rows for end in r[5:9] if end and end not in row[9:11]}, key=int)
    added = sorted([row[9], generator.choice(others or ["0"])], key=int)
    run.insert(i + 1, ["", "rebuild", *row[2:5], "", "", *added, "", "", row[11]])
    return i + 1


def with_edges(name, replace):
    def function(run, generator):
        """Before the first row, and only there."""
        groups = start_groups(run)
        if not groups:
            return None
        shown, *others = generator.choice(groups)
        there = {tuple(sorted(edge, key=int)) for edge in replace(run.initial, shown, generator.choice(others))}
        run.initial = [list(edge) for edge in sorted(there, key=lambda edge: tuple(map(int, edge)))]
        return -1

    function.__name__ = name
    lie(TWINS)(function)


def in_place_of(edges, shown, other):
    return [[other if end == shown else end for end in edge] for edge in edges]


with_edges("the_edges_of_one_that_is_hidden", in_place_of)
with_edges("the_same_edges_of_both", lambda edges, shown, other: edges + in_place_of(edges, shown, other))
with_edges("an_edge_between_both", lambda edges, shown, other: edges + [[shown, other]])


@lie(TWINS)
def a_motion_that_is_almost_the_same(run, generator):
    """Of a hidden point at the start, without weights."""
    if any(motion[2] and float(motion[10]) for motion in run.motions):
        return None
    hidden = [point for group in start_groups(run) for point in group[1:]]
    if not hidden:
        return None
    point = generator.choice(hidden)
    motion = next(m for m in run.motions if m[1] == point and not m[0])
    i = generator.randint(2, 5)
    motion[i] = repr(math.nextafter(float(motion[i]), math.inf))
    return -1


@lie(TWINS)
def a_motion_that_becomes_almost_the_same(run, generator):
    """Of a point that a row says is hidden from then on, without weights."""
    if any(motion[2] and float(motion[10]) for motion in run.motions):
        return None
    found = []
    for i, row in enumerate(run.rows):
        if by_a_point("hide")(row):
            found += [(i, m) for m in run.motions if m[1] == row[9] and m[0] and m[2] and int(m[0]) < i
                      and run.rows[int(m[0])][11] == row[11]][-1:]
    if not found:
        return None
    i, motion = generator.choice(found)
    k = generator.randint(2, 5)
    motion[k] = repr(math.nextafter(float(motion[k]), math.inf))
    return i


@lie(TWINS)
def a_contact_of_one_that_coincides_left_out(run, generator):
    """Another one of the same instant stays, of two discs with the same trajectories; their motions do not change."""
    def both(k):
        return {trajectory(motion_of(run, point, k)) for point in run.rows[k][9:11]}

    changed = {run.rows[int(motion[0])][11] for motion in run.motions if motion[0]}
    contacts = [k for k, row in enumerate(run.rows) if row[1] == "collision" and row[11] not in changed]
    found = [i for i in contacts for k in contacts
             if i != k and run.rows[i][11] == run.rows[k][11] and len(both(i)) == 2 and both(i) == both(k)]
    return remove(run, generator.choice(found)) if found else None
