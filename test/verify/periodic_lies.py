# SPDX-License-Identifier: GPL-3.0-or-later
"""Lies about runs in periodic boxes: each changes the run, and returns whether it has. LIES has them by name."""
import copy
import math
from fractions import Fraction

from periodic_runs import Row

LIES = {}
TWICE = set()  # lies that are told twice


def lie(function):
    """A function that changes a run, and returns whether it has."""
    LIES[function.__name__] = function
    return function


def lie_about_sizes(function):
    """A lie that is about runs with discs of several sizes and without contacts."""
    TWICE.add(function.__name__)
    return lie(function)


def lie_about_contacts(function):
    """A lie that is about runs with contacts only, and chooses one of them."""
    def told(run, generator):
        i = chosen(run, generator, lambda run, i: run.rows[i][1] == "collision")
        return i is not None and function(run, generator, i)

    LIES[function.__name__] = told
    TWICE.add(function.__name__)
    return function


def may_pass(run):
    """Whether discs may pass through each other. Then two that are not neighbors may overlap, and so have contacts
    that the log does not determine."""
    return run.response == "log" or (run.response == "stop" and (run.box[3] != 0 or run.rates))


def is_alone(run, i):
    """Whether the row is the only one of its instant."""
    return all(row[-3] != run.rows[i][-3] for row in run.rows[max(i - 1, 0):i] + run.rows[i + 1:i + 2])


def chosen(run, generator, condition=lambda run, i: True):
    return generator.choice([i for i in range(len(run.rows)) if condition(run, i)] or [None])


def shifted(field, by):
    x, y = map(int, field.split(" "))
    return f"{x + by[0]} {y + by[1]}"


@lie
def a_row_left_out(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][1] != "collision")
    if i is None:
        return False
    leave_out(run, i)
    return True


def leave_out(run, i):
    del run.rows[i]
    for row in run.rows[i:]:
        row[0] = str(int(row[0]) - 1)
        row[-3] = str(int(row[-3]) - 1) if int(row[-3]) > i else row[-3]


@lie
def a_row_doubled(run, generator):
    i = chosen(run, generator, is_alone)
    if i is None or (run.rows[i][1] == "collision" and run.response == "stop" and may_pass(run)):
        return False  # of a disc that is stopped the image may go on, and have more contacts of that time
    run.rows.insert(i, copy.deepcopy(run.rows[i]))
    run.number_anew()
    return True


@lie
def the_last_rows_left_out(run, generator):
    if not run.rows:
        return False
    i = generator.randrange(len(run.rows))
    if may_pass(run) and all(row[1] == "collision" for row in run.rows[i:]):
        return False
    del run.rows[i:]
    return True


@lie
def rows_swapped(run, generator):
    i = chosen(run, generator, lambda run, i: i > 0 and is_alone(run, i) and is_alone(run, i - 1))
    if i is None:
        return False
    first, second = run.rows[i - 1: i + 1]
    first[5:], second[5:] = second[5:-3] + first[-3:-2] + second[-2:], first[5:-3] + second[-3:-2] + first[-2:]
    return first[5:9] != second[5:9] or first[-2:] != second[-2:]


@lie
def a_time_that_is_another_number(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] == run.rows[i][4] and is_alone(run, i))
    if i is None:
        return False
    run.rows[i][2:5] = [repr(math.nextafter(float(run.rows[i][2]), generator.choice([-9, 9])))] * 3
    return True


@lie
def an_interval_moved(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    towards = generator.choice([-9, 9])
    for row in run.rows:
        if row[-3] == run.rows[i][-3] and row is not run.rows[i]:
            row[2:5] = [repr(math.nextafter(float(text), towards)) for text in row[2:5]]
    run.rows[i][2:5] = [repr(math.nextafter(float(text), towards)) for text in run.rows[i][2:5]]
    return True


@lie
def the_other_end_of_an_interval(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    row = run.rows[i]
    row[2] = row[4] if row[2] == row[3] else row[3]
    return True


@lie
def an_exact_time_for_a_root(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][3] != run.rows[i][4])
    if i is None:
        return False
    run.rows[i][3] = run.rows[i][4] = run.rows[i][2]
    return True


@lie
def an_offset_of_a_removed_edge(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-2] and run.rows[i][5] != run.rows[i][6])
    if i is None:
        return False
    run.rows[i][-2] = shifted(run.rows[i][-2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie
def an_offset_of_an_added_edge(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-1] and run.rows[i][7] != run.rows[i][8])
    if i is None:
        return False
    run.rows[i][-1] = shifted(run.rows[i][-1], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie
def an_offset_that_is_reversed(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][-1] not in ("", "0 0"))
    if i is None:
        return False
    run.rows[i][-1] = " ".join(str(-int(number)) for number in run.rows[i][-1].split(" "))
    return True


@lie
def an_offset_of_a_first_edge(run, generator):
    edge = generator.choice([edge for edge in run.initial if edge[0] != edge[1]] or [None])
    if edge is None:
        return False
    edge[2] = shifted(edge[2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    run.initial.sort(key=lambda e: (int(e[0]), int(e[1]), *map(int, e[2].split(" "))))
    return all(a != b for a, b in zip(run.initial, run.initial[1:]))


@lie
def an_offset_of_a_last_edge(run, generator):
    edge = generator.choice([edge for edge in run.final if edge[0] != edge[1]] or [None])
    if edge is None:
        return False
    edge[2] = shifted(edge[2], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    run.final.sort(key=lambda e: (int(e[0]), int(e[1]), *map(int, e[2].split(" "))))
    return all(a != b for a, b in zip(run.final, run.final[1:]))


@lie
def a_first_edge_left_out(run, generator):
    del run.initial[generator.randrange(len(run.initial))]
    return True


@lie
def a_last_edge_left_out(run, generator):
    if not run.final:  # all discs are removed
        return False
    del run.final[generator.randrange(len(run.final))]
    return True


@lie
def another_edge_flipped(run, generator):
    """The row tells of the flip of an edge of the first row of another time."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip" and is_alone(run, i))
    k = chosen(run, generator, lambda run, k: run.rows[k][1] == "flip")
    if i is None or run.rows[i][5:9] + run.rows[i][-2:] == run.rows[k][5:9] + run.rows[k][-2:]:
        return False
    run.rows[i][5:9], run.rows[i][-2:] = run.rows[k][5:9], run.rows[k][-2:]
    return True


@lie
def a_flip_of_the_hull(run, generator):
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip")
    if i is None:
        return False
    run.rows[i][1] = "hull_insert"
    run.rows[i][7] = run.rows[i][8] = run.rows[i][-1] = ""
    return True


@lie
def a_box_of_another_shear(run, generator):
    if not run.rows:
        return False
    if run.rates:
        run.rates[0][generator.choice([2, 3])] += generator.choice([-1, 1]) / 1024
    else:
        run.box = (*run.box[:3], run.box[3] + generator.choice([-1, 1]) / 1024)
    return any(row[1] != "rebuild" and row[3] != row[4] and int(offset.split(" ")[1]) != 0
               for row in run.rows for offset in row[-2:] if offset)


@lie_about_sizes
def a_hidden_point_for_another(run, generator):
    """The row hides or reveals another point."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] in ("hide", "reveal"))
    others = [] if i is None else [str(k) for k in range(len(run.points)) if str(k) not in run.rows[i][9:11]]
    if not others:
        return False
    run.rows[i][9] = generator.choice(others)
    return True


@lie_about_sizes
def a_point_hidden_for_one_revealed(run, generator):
    """Or the reverse."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] in ("hide", "reveal"))
    if i is None:
        return False
    run.rows[i][1] = "reveal" if run.rows[i][1] == "hide" else "hide"
    return True


@lie_about_sizes
def a_hidden_disc_that_is_the_largest(run, _):
    """And so hidden by none. No row tells of it."""
    told = {end for edge in run.initial for end in edge[:2]} | {row[9] for row in run.rows}
    hidden = [k for k in range(len(run.points)) if str(k) not in told]
    if not run.has_sizes() or not hidden:
        return False
    run.points[hidden[0]] = (*run.points[hidden[0]][:4], 9, 0)
    run.motions[hidden[0]][9:11] = ["9", "0"]
    return True


@lie_about_sizes
def another_size(run, generator):
    """The radius or the growth of an end of an edge that is flipped."""
    i = chosen(run, generator, lambda run, i: run.rows[i][1] == "flip" and run.rows[i][3] != run.rows[i][4]
               and len({*run.rows[i][5:9]}) > 1)
    if i is None or not run.has_sizes():
        return False
    point = int(generator.choice(run.rows[i][5:9]))
    k = generator.choice([4, 5])
    number = run.points[point][k] + 1 / 1024
    run.points[point] = (*run.points[point][:k], number, *run.points[point][k + 1:])
    run.motions[point][k + 5] = repr(number)
    return True


@lie
def a_run_that_ends_sooner(run, generator):
    """Than its last row."""
    if not run.rows or float(run.rows[-1][2]) <= run.start + 0.125:
        return False
    run.until = float(run.rows[-1][2]) - 0.0625
    return True


@lie
def a_run_that_begins_later(run, generator):
    if not run.rows or float(run.rows[0][4]) >= run.until or run.rows[0][1] == "collision":
        return False
    run.start = float(run.rows[0][4])
    return True


@lie_about_contacts
def a_contact_left_out(run, generator, i):
    if may_pass(run):  # only neighbors have the first one
        i = next(k for k, row in enumerate(run.rows) if row[1] == "collision")
    leave_out(run, i)
    return True


@lie_about_contacts
def an_offset_of_a_contact(run, generator, i):
    run.rows[i][-1] = shifted(run.rows[i][-1], generator.choice([(1, 0), (0, 1), (-1, 0), (0, -1)]))
    return True


@lie_about_contacts
def an_offset_of_a_contact_reversed(run, _, i):
    before = run.rows[i][-1]
    run.rows[i][-1] = " ".join(str(-int(number)) for number in before.split(" "))
    return before != run.rows[i][-1]


@lie_about_contacts
def a_contact_of_another_point(run, generator, i):
    """The offset is kept; the motions are those of the other points."""
    row = run.rows[i]
    others = [str(k) for k in range(len(run.points)) if str(k) not in row[9:11]]
    if not others:
        return False
    pair = sorted((generator.choice(row[9:11]), generator.choice(others)), key=int)
    row.motions = [[pair[row[9:11].index(motion[0])], *motion[1:]] for motion in row.motions]
    row[9:11] = pair
    return True


def move_contact(run, i, times):
    """The row and its motions at other times, `time`, `time_lo` and `time_hi`. The discs are in the places in which
    they would be then."""
    row = run.rows[i]
    row[2:5] = times
    row.motions = copy.deepcopy(row.motions)
    for motion in row.motions:
        if not motion[1]:
            continue
        before = [m for r in [*run.rows[:i]] for m in r.motions if m[0] == motion[0]]
        before = before[-1] if before else next(m for m in run.motions if m[0] == motion[0])
        since = Fraction(float(times[0])) - Fraction(float(before[11]))
        for k in (1, 2):
            motion[k] = repr(float(Fraction(float(before[k])) + Fraction(float(before[k + 2])) * since))
        motion[9] = repr(float(Fraction(float(before[9])) + Fraction(float(before[10])) * since))
        motion[11] = times[0]


def is_root(run, i):
    return run.rows[i][3] != run.rows[i][4]


@lie_about_contacts
def a_contact_beyond_its_interval(run, generator, i):
    if not is_alone(run, i):
        return False
    towards = generator.choice([-math.inf, math.inf])
    width = abs(float(run.rows[i][4]) - float(run.rows[i][3])) or math.ulp(float(run.rows[i][2]))
    move_contact(run, i, [repr(float(text) + math.copysign(width, towards)) for text in run.rows[i][2:5]])
    return True


@lie_about_contacts
def a_contact_much_later(run, generator, i):
    """In the middle between the row and the next one, or the end."""
    later = float(run.rows[i + 1][3]) if i + 1 < len(run.rows) else run.until
    middle = (float(run.rows[i][4]) + later) / 2
    if not is_alone(run, i) or not float(run.rows[i][4]) < middle < later:
        return False
    move_contact(run, i, [repr(middle)] * 3)
    return True


@lie_about_contacts
def a_contact_at_the_other_end_of_its_interval(run, _, i):
    if not is_root(run, i) or not is_alone(run, i):
        return False
    _, _, time, lo, hi = run.rows[i][:5]
    move_contact(run, i, [hi if time == lo else lo, lo, hi])
    return True


@lie_about_contacts
def a_contact_at_a_number_for_a_root(run, _, i):
    if not is_root(run, i) or not is_alone(run, i):
        return False
    move_contact(run, i, [run.rows[i][2]] * 3)
    return True


@lie_about_contacts
def a_contact_too_much(run, generator, i):
    """Of two images that are apart then; nothing changes."""
    pair = sorted(generator.sample(range(len(run.points)), 2))
    offset = f"{generator.randint(7, 9)} {generator.randint(7, 9)}"
    row = Row([*run.rows[i][:5], "", "", "", "", *map(str, pair), run.rows[i][-3], "", offset])
    run.rows.insert(i + 1, row)
    run.number_anew()
    return True


@lie_about_contacts
def another_response(run, generator, i):
    """Those that stop or remove all discs have motions, `log` has none, and `none` has no contacts."""
    told = ["none", "stop", "remove"] if run.response == "log" else ["none"]
    run.told = generator.choice(told)
    return True


@lie_about_contacts
def a_place_after_a_contact(run, generator, i):
    """In the last bit."""
    found = [motion for motion in run.rows[i].motions if motion[1]]
    if not found:
        return False
    motion = generator.choice(found)
    k = generator.choice([1, 2])
    motion[k] = repr(math.nextafter(float(motion[k]), generator.choice([-math.inf, math.inf])))
    return True


@lie_about_contacts
def a_radius_after_a_contact(run, generator, i):
    found = [motion for motion in run.rows[i].motions if motion[1]]
    if not found:
        return False
    motion = generator.choice(found)
    motion[9] = repr(float(motion[9]) + 0.125)
    return True


@lie_about_contacts
def a_motion_of_a_third_point(run, generator, i):
    others = [str(k) for k in range(len(run.points)) if str(k) not in run.rows[i][9:11]]
    if not others or not run.rows[i].motions:
        return False
    generator.choice(run.rows[i].motions)[0] = generator.choice(others)
    return True
