# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about a run: each changes its files, and returns the row at which that is to be noticed (-1
is the start, the number of rows is the end), or None if there is nothing that it could change."""
import math
from fractions import Fraction

PLAIN, BOX, RIM, WEIGHTS, TRACKS, LOG, NONE, TWINS = {}, {}, {}, {}, {}, {}, {}, {}


def lie(*tables):
    def enter(function):
        for table in tables:
            table[function.__name__] = function
        return function

    return enter


def chosen(run, generator, which=lambda row: True):
    found = [i for i, row in enumerate(run.rows) if which(row)]
    return generator.choice(found) if found else None


def interval(row):
    return float(row[3]), float(row[4])


def is_later(run, i):
    """Whether row i is after the row before it, for certain."""
    return i > 0 and interval(run.rows[i])[0] > interval(run.rows[i - 1])[1]


def is_alone(run, i):
    """Whether the row is the only one of its instant."""
    return all(row[11] != run.rows[i][11] for k, row in enumerate(run.rows) if k != i)


def kinds(*names):
    return lambda row: row[1] in names


def remove(run, i):
    if i is None:
        return None
    del run.rows[i]
    run.drop_motions(i)
    return i


def edit(name, which, change, *tables):
    """A lie that changes one row."""

    def function(run, generator):
        i = chosen(run, generator, which)
        return None if i is None or change(run.rows[i], generator) is False else i

    function.__name__ = name
    lie(*tables)(function)


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


def ulps(row, count):
    for i in (2, 3, 4):
        number = float(row[i])
        for _ in range(abs(count)):
            number = math.nextafter(number, math.inf if count > 0 else -math.inf)
        row[i] = repr(number)


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


def kind(name):
    def change(row, _):
        row[1] = name

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


# ---- contacts ----


@lie(BOX)
def a_wall_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("wall")))


@lie(BOX)
def a_collision_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("collision")))


def of_contact(run, generator, which=("wall", "collision")):
    """A row of motions of a contact."""
    found = [m for m in run.motions if m[0] and run.rows[int(m[0])][1] in which and m[2]]
    return generator.choice(found) if found else None


def edit_motion(name, columns, change, which=("wall", "collision"), tables=(BOX,)):
    def function(run, generator):
        motion = of_contact(run, generator, which)
        if motion is None:
            return None
        i = generator.choice(columns)
        new = change(float(motion[i]))
        if new == float(motion[i]):
            return None
        motion[i] = repr(new)
        return int(motion[0])

    function.__name__ = name
    lie(*tables)(function)


edit_motion("a_place_altered_in_the_last_bit", (2, 3), lambda x: math.nextafter(x, math.inf))
edit_motion("a_place_altered_downward", (2, 3), lambda x: math.nextafter(x, -math.inf))
edit_motion("an_epoch_altered_in_the_last_bit", (12,), lambda x: math.nextafter(x, math.inf))
edit_motion("a_radius_grown", (10,), lambda r: math.nextafter(r, math.inf))
edit_motion("a_growth_from_nothing", (11,), lambda g: g + 0.125)
edit_motion("an_acceleration_from_nothing", (6, 7), lambda a: a + 0.125)
edit_motion("a_jerk_from_nothing", (8, 9), lambda j: j + 0.125)
edit_motion("a_velocity_altered_at_a_wall", (4, 5), lambda v: v * 1.5 + 1, ("wall",))
edit_motion("a_velocity_altered_in_the_last_bit", (4, 5), lambda v: math.nextafter(v, math.inf), ("wall",), (BOX, RIM))
edit_motion("a_velocity_altered_downward", (4, 5), lambda v: math.nextafter(v, -math.inf), ("wall",), (BOX, RIM))


def motion_before(run, motion):
    number = int(motion[0])
    return [m for m in run.motions if m[1] == motion[1] and (not m[0] or int(m[0]) < number)][-1]


@lie(BOX, RIM)
def no_bounce(run, generator):
    motion = of_contact(run, generator, ("wall",))
    if motion is None:
        return None
    motion[4:6] = motion_before(run, motion)[4:6]
    return int(motion[0])


@lie(RIM)
def a_bounce_without_the_growth(run, generator):
    motion = of_contact(run, generator, ("wall",))
    if motion is None or float(motion[11]) == 0:
        return None
    before = motion_before(run, motion)
    i = 4 if motion[4] != before[4] else 5
    motion[i] = repr(-float(before[i]))
    return int(motion[0])


@lie(BOX)
def a_motion_left_out(run, generator):
    motion = of_contact(run, generator, ("wall",))
    if motion is None:
        return None
    run.motions.remove(motion)
    return int(motion[0])


@lie(BOX)
def the_motion_of_another_point(run, generator):
    motion = of_contact(run, generator)
    if motion is None:
        return None
    row = run.rows[int(motion[0])]
    motion[1] = str(next(i for i in range(len(run.points)) if str(i) not in row[9:11]))
    return int(motion[0])


@lie(BOX)
def the_contact_of_another_point(run, generator):
    i = chosen(run, generator, kinds("wall", "collision"))
    if i is None:
        return None
    row = run.rows[i]
    row[9] = str(next(k for k in range(len(run.points)) if str(k) not in row[9:11]))
    return i


def motion_of(run, point, number):
    """Its motion from a row on."""
    return [m for m in run.motions if m[1] == point and (not m[0] or int(m[0]) <= number)][-1]


def gap(a, b, t):
    """The squared distance of discs in straight motion, less the square of the sum of their radii."""
    def at(motion, i, k):
        return Fraction(float(motion[i])) + Fraction(float(motion[k])) * (t - Fraction(float(motion[12])))

    x, y = (at(a, i, i + 2) - at(b, i, i + 2) for i in (2, 3))
    return x * x + y * y - (at(a, 10, 11) + at(b, 10, 11)) ** 2


@lie(LOG)
def a_contact_moved_to_a_later_row(run, generator):
    """The discs overlap and approach then."""
    found = []
    for i, row in enumerate(run.rows):
        if row[1] != "collision":
            continue
        for k in range(i + 1, len(run.rows)):
            t = Fraction(float(run.rows[k][3]))
            a, b = (motion_of(run, point, k) for point in row[9:11])
            if a[0] or b[0] or not gap(a, b, t + Fraction(1, 2**20)) < gap(a, b, t) < 0:
                break
            if is_later(run, k):
                found.append((i, k))
    if not found:
        return None
    i, k = generator.choice(found)
    row = run.rows.pop(i)
    run.rows.insert(k, row[:2] + run.rows[k - 1][2:5] + row[5:11] + [run.rows[k - 1][11]])
    return i


@lie(LOG)
def a_contact_left_out(run, generator):
    return remove(run, chosen(run, generator, kinds("collision")))


@lie(NONE)
def a_collision_that_is_none(run, generator):
    """Discs pass through each other, in a run that does not look for contacts: at a row of that time."""
    i = chosen(run, generator)
    if i is None:
        return None
    pair = sorted(generator.sample(range(len(run.points)), 2))
    run.rows.insert(i + 1, ["", "collision", *run.rows[i][2:5], "", "", "", "", *map(str, pair), run.rows[i][11]])
    return i + 1


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
