# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about contacts with walls and of discs, and about the motions that follow them."""
import math
from fractions import Fraction

from lie_tables import BOX, LOG, NONE, RIM, chosen, is_later, kinds, lie, motion_of, remove


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
