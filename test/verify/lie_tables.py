# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of lies.py, and what lies need: rows of a run that may be changed, and changes of one row."""
import math

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
    return all(row[11] != run.rows[i][11] for row in run.rows[max(i - 1, 0):i] + run.rows[i + 1:i + 2])


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


def ulps(row, count):
    for i in (2, 3, 4):
        number = float(row[i])
        for _ in range(abs(count)):
            number = math.nextafter(number, math.inf if count > 0 else -math.inf)
        row[i] = repr(number)


def kind(name):
    def change(row, _):
        row[1] = name

    return change


def motion_of(run, point, number):
    """Its motion from a row on."""
    return [m for m in run.motions if m[1] == point and (not m[0] or int(m[0]) <= number)][-1]
