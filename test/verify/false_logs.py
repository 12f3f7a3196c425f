# SPDX-License-Identifier: GPL-3.0-or-later
"""Short logs made by hand, false ones beside true ones: what is wrong in them is in no run of the
program."""
import collections

LEAST_NUMBER = -1.7976931348623157e308

Log = collections.namedtuple("Log", "name where rows motions edges until options", defaults=((),))


def motion(point, x, y, vx=0.0, vy=0.0, radius=0.0, event="", epoch=0.0):
    numbers = (x, y, vx, vy, 0.0, 0.0, 0.0, 0.0, radius, 0.0, epoch)
    return [str(event), str(point), *map(repr, numbers)]


def gone(point, event):
    return [str(event), str(point), *[""] * 11]


def row(kind, time, removed="-", added="-", points="-"):
    """Edges and points as in 4-17, or a point as in 4-."""
    fields = (removed + "-" + added + "-" + points).split("-")
    return ["", kind, *[repr(time)] * 3, *fields[:6]]


def edges(*names):
    return [name.split("-") for name in names]


BOX = ("--box=-9,-9,9,9", "--collisions", "elastic")
DISCS = [motion(0, -2.0, 0.0, 1.0, radius=0.5), motion(1, 2.0, 0.0, -1.0, radius=0.5)]
HIT = row("collision", 1.5, points="0-1")
APART = [
    motion(0, -0.5, 0.0, -1.0, radius=0.5, event=0, epoch=1.5),
    motion(1, 0.5, 0.0, 1.0, radius=0.5, event=0, epoch=1.5),
]
NEAR = [motion(0, 0.0, 0.0, 1.0, radius=2.0), motion(1, 1.0, 0.0, radius=2.0), motion(2, 0.0, 2.0, vy=-1.0, radius=2.0)]
RESTING = motion(2, -4.0, 0.0, radius=0.5)
ASIDE = motion(2, -4.0, 0.125, radius=0.125)
TURN = row("trajectory", 1.75, points="2-")
TURNED = motion(2, -4.0, 0.125, radius=0.125, event=1)

TRIANGLE = [motion(0, 0.0, 0.0), motion(1, 4.0, 0.0), motion(2, 0.0, 4.0)]
SIDES = edges("0-1", "0-2", "1-2")
LEAVING = [row("erase", 1.0, points="0-"), row("erase", 1.0, points="1-")]
SIDES_GO = [row("rebuild", 1.0, removed=side) for side in ("0-1", "0-2", "1-2")]

RIDER = motion(3, 4.0, 0.0)  # coincides with 1
GOING = [motion(0, 0.0, 0.0), motion(1, 4.0, 0.0, 1.0), motion(2, 0.0, 4.0), motion(3, 4.0, 0.0, 1.0)]
TOLD = row("trajectory", 1.0, points="3-")
ON_A_LINE = [motion(0, 0.0, 0.0, radius=0.5), motion(1, 4.0, 0.0, radius=0.25), motion(2, 4.0, 0.0, radius=0.25)]
GROWING = [[*motion(k, 0.0, 0.0, radius=0.5)[:11], "0.25", "0.0"] for k in range(2)]

QUADRANGLE = [motion(0, -1.0, 0.0), motion(1, 1.0, 0.0), motion(2, 0.0, 1.0), motion(3, 0.0, -2.0, vy=1.0)]
DIAGONAL = edges("0-1", "0-2", "0-3", "1-2", "1-3")
FLIP = row("flip", 1.0, "0-1", "2-3")


def at_collision(name, where, changes, options=BOX):
    return Log(name, where, [HIT], [*DISCS, *changes], edges("0-1"), 3.0, options)


# `where` is what the answer names, or empty if the log is true.
LOGS = (
    at_collision("discs collide", "", APART),
    at_collision(
        "a disc appears at a wall", "row 0", [APART[0], motion(1, 9.0, 0.0, radius=0.5, event=0, epoch=1.5)]
    ),
    at_collision(
        "the least number", "row 0", [motion(0, LEAST_NUMBER, 0.0, radius=0.5, event=0, epoch=1.5), APART[1]]
    ),
    at_collision("both vanish", "", [gone(0, 0), gone(1, 0)], ("--collisions", "remove"))._replace(
        rows=[HIT, row("rebuild", 1.5, removed="0-1")]
    ),
    at_collision("a disc that vanishes goes on", "row 0", [gone(0, 0), APART[0]]),
    at_collision("both stop, without a change", "row 0", [], ("--collisions", "stop")),
    at_collision("discs pass through each other", "", [], ("--collisions", "log")),
    Log("the next contact is left out, without --collisions", "the end", [HIT],
        [*DISCS, RESTING, *APART], edges("0-1", "0-2"), 4.5),
    Log("a contact while another disc turns", "", [HIT, TURN], [*DISCS, ASIDE, TURNED], SIDES, 1.875,
        ("--collisions", "log")),
    Log("a contact of discs that overlap since the one before", "row 2", [HIT, TURN, row("collision", 1.75, points="0-1")],
        [*DISCS, ASIDE, TURNED], SIDES, 1.875, ("--collisions", "log")),
    Log("a contact told twice, with the discs exchanged", "row 1", [HIT, row("collision", 1.5, points="1-0")],
        DISCS, edges("0-1"), 1.875, ("--collisions", "log")),
    Log("a disc touches itself", "row 1", [HIT, row("collision", 1.5, points="0-0")], DISCS, edges("0-1"),
        1.875, ("--collisions", "log")),
    Log("discs that overlap and approach", "", [row("collision", 0.0, points=pair) for pair in ("0-1", "0-2", "1-2")],
        NEAR, SIDES, 0.25),
    Log("a false collision in a log of --regular", "row 0", [row("collision", 0.0, points="0-1")], NEAR, SIDES, 0.25),
    Log("a collision in a run without any", "row 0", [row("collision", 0.0, points="0-1")], NEAR, SIDES, 0.25,
        ("--collisions", "none")),
    Log("a point turns at a wall, at the time of a contact", "row 0", [row("trajectory", 1.0, points="0-")],
        [motion(0, 8.0, 0.0, 1.0), motion(0, 9.0, 0.0, -1.0, event=0, epoch=1.0)], [], 2.0, BOX),
    Log("three points at rest", "", [], TRIANGLE, SIDES, 1.0),
    Log("a vertex is hidden", "row 0", [row("hide", 0.5, points="1-")], TRIANGLE, SIDES, 1.0),
    Log("two points leave, before all would be on a line", "", [*LEAVING, *SIDES_GO],
        [*TRIANGLE[:2], motion(2, 0.0, 4.0, vy=-1.0), gone(0, 0), gone(1, 1)], SIDES, 6.0),
    Log("two points at one place", "the start", [], [motion(0, 1.0, 1.0), motion(1, 1.0, 1.0)], edges("0-1"), 1.0),
    Log("a point coincides with another", "", [], [*TRIANGLE, RIDER], SIDES, 1.0),
    Log("the greater one has the edges", "the start", [], [*TRIANGLE, RIDER], edges("0-2", "0-3", "2-3"), 1.0),
    Log("both have edges", "the start", [], [*TRIANGLE, RIDER], edges("0-1", "0-2", "0-3", "1-2", "2-3"), 1.0),
    Log("a point that almost coincides with another", "the start", [], [*TRIANGLE, motion(3, 4.0, 5e-324)], SIDES, 1.0),
    Log("a motion in other numbers", "", [TOLD], [*GOING, motion(3, 5.0, 0.0, 1.0, event=0, epoch=1.0)], SIDES, 2.0),
    Log("a motion told in other numbers, as a separation", "row 1", [TOLD, row("reveal", 1.0, points="3-1")],
        [*GOING, motion(3, 5.0, 0.0, 1.0, event=0, epoch=1.0)], SIDES, 2.0),
    Log("a separation that is not told", "row 0", [TOLD],
        [*GOING, motion(3, 5.0, 0.0, 1.0 + 2**-52, event=0, epoch=1.0)], SIDES, 2.0),
    Log("the last of those that coincide", "", [row("erase", 1.0, points="1-"), row("reveal", 1.0, points="3-1"),
        *(row("rebuild", 1.0, removed=side) for side in ("0-1", "1-2")),
        *(row("rebuild", 1.0, added=side) for side in ("0-3", "2-3"))], [*TRIANGLE, RIDER, gone(1, 0)], SIDES, 2.0),
    Log("one is erased, and no other one takes its place", "row 2", [row("erase", 1.0, points="1-"),
        *(row("rebuild", 1.0, removed=side) for side in ("0-1", "1-2"))], [*TRIANGLE, RIDER, gone(1, 0)], SIDES, 2.0),
    Log("discs of two radii on a line, two of which coincide", "", [], ON_A_LINE, edges("0-1"), 1.0),
    Log("discs that coincide and do not grow", "", [], ON_A_LINE, edges("0-1"), 1.0,
        ("--collisions", "log")),
    Log("discs that coincide and grow", "", [row("collision", 0.0, points="0-1")], GROWING, [], 1.0,
        ("--collisions", "log")),
    Log("the contact of discs that coincide and grow is left out", "row 4",
        [row("trajectory", 0.5, points="1-"), row("hide", 0.5, points="1-0"),
         *(row("rebuild", 0.5, removed=side) for side in ("0-1", "1-2")), row("rebuild", 0.5, added="0-2")],
        [*GROWING[:1], motion(1, 4.0, 0.0, radius=0.5), motion(2, 8.0, 0.0, radius=0.5),
         [*motion(1, 0.0, 0.0, radius=0.5, event=0)[:11], "0.25", "0.0"]], edges("0-1", "1-2"), 1.0, ("--collisions", "log")),
    Log("a contact of discs that coincide and do not grow", "row 0", [row("collision", 0.0, points="1-2")], ON_A_LINE,
        edges("0-1"), 1.0, ("--collisions", "log")),
    Log("a diagonal is flipped", "", [FLIP], QUADRANGLE, DIAGONAL, 1.5),
    Log("a point turns at a flip", "row 0", [FLIP], [*QUADRANGLE, motion(2, 0.0, 1.0, 1.0, 1.0, event=0)],
        DIAGONAL, 1.5),
    Log("an edge of a point that has gone is flipped", "row 1", [row("erase", 1.0, points="0-"), FLIP],
        [*QUADRANGLE, gone(0, 0)], DIAGONAL, 1.5),
)
