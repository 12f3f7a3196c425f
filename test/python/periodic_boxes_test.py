# SPDX-License-Identifier: GPL-3.0-or-later
"""Periodic boxes: what is taken for one, what is refused, areas, and the end of the box's time."""
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest

import kinetri


class FreudBox:
    """With the attributes that a box of freud has."""

    def __init__(self, Lx, Ly, xy=0.0, is2D=True, periodic=(True, True, True)):
        self.Lx, self.Ly, self.xy, self.is2D, self.periodic = Lx, Ly, xy, is2D, np.array(periodic)
        self.dimensions = 2 if is2D else 3

    def __repr__(self):
        return "freud.box.Box(...)"


class Cell:
    """Like a cell of ASE: an array of three vectors."""

    def __init__(self, rows):
        self.rows = rows

    def __array__(self, dtype=None, copy=None):
        return np.array(self.rows, dtype=dtype or float)


class Atoms:
    def __init__(self, cell, pbc):
        self.cell, self.pbc = Cell(cell), np.array(pbc)

    def __repr__(self):
        return "Atoms(...)"


@pytest.mark.parametrize("given", [
    [[4, 0], [1, 3]], np.array([[4, 0], [1, 3]]), kinetri.Box([4, 0], [1, 3]), Cell([[4, 0, 0], [1, 3, 0], [0, 0, 9]]),
    [[4, 0, 0], [1, 3, 0], [0, 0, 0]], Atoms([[4, 0, 0], [1, 3, 0], [0, 0, 1]], [True, True, False]),
    FreudBox(4.0, 3.0, 1 / 3),
])
def test_what_others_have_is_taken_as_it_is(given):
    kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=given)
    assert kd.box.vectors.tolist() == [[4, 0], [1, 3]] and kd.box == kinetri.Box(given)
    assert not kd.box.rates.any() and kd.box.epoch == 0
    assert len({kd.box, kinetri.Box([[4, 0], [1, 3]])}) == 1


@pytest.mark.parametrize("make, message", [
    (lambda: kinetri.Box((1, 2, 3)), "box has the shape (3,); expected a kinetri.Box, two lengths (Lx, Ly), two "),
    (lambda: kinetri.Box((0, 0, 1, 1)), "walls (xmin, ymin, xmax, ymax) are for a Simulation"),
    (lambda: kinetri.Simulation([[0, 0]], [[0, 0]], box=(1, 1)),
     "expected (4,): (xmin, ymin, xmax, ymax), or a kinetri.Box, which is periodic"),
    (lambda: kinetri.Box(3.0), "box has the shape (); expected"),
    (lambda: kinetri.Box("ab"), "box is 'ab'; expected a kinetri.Box, two lengths"),
    (lambda: kinetri.Box({"Lx": 1}), "box is {'Lx': 1}; expected"),
    (lambda: kinetri.Box([[1, 2], [3]]), "box is [[1, 2], [3]]; expected"),
    (lambda: kinetri.Box((np.nan, 1)), "box[0] is nan; expected finite numbers"),
    (lambda: kinetri.Box((2**53 + 1, 1)), "which float64 rounds"),
    (lambda: kinetri.Box([1, 0], [0, 1, 0]), "second has the shape (3,); expected (2,)"),
    (lambda: kinetri.Box((1, 1), rates=(1, 2, 3)), "rates has the shape (3,); expected two numbers, or shape (2, 2)"),
    (lambda: kinetri.Box((1, 1), epoch=np.inf), "epoch[0] is inf"),
    (lambda: kinetri.Box([[1, 0, 0], [0, 1, 0.5], [0, 0, 1]]), "and whose third one is along z"),
    (lambda: kinetri.Box([[1, 0, 0], [0, 1, 0], [0, 1, 1]]), "and whose third one is along z"),
    (lambda: kinetri.Box(Atoms(np.eye(3), [True, False, True])), "Atoms(...), which is not periodic along both"),
    (lambda: kinetri.Box(Atoms(np.eye(3), False)), "which is not periodic"),
    (lambda: kinetri.Box(FreudBox(1, 1, periodic=(False, True, True))), "which is not periodic"),
    (lambda: kinetri.Box(FreudBox(1, 1, is2D=False)), "freud.box.Box(...), which is 3-dimensional; expected a box in"),
    (lambda: kinetri.Box(kinetri.Box.shear(1, 1, 1)), "box is a Box whose vectors change"),
    (lambda: kinetri.Tracks.from_arrays([0, 1], [0, 0], [0, 1], [0, 0]).simulation(box=kinetri.Box((1, 1))),
     "a periodic box, which is for a KineticDelaunay or a Simulation"),
])
def test_what_is_no_box_is_refused(make, message):
    with pytest.raises(kinetri.PreconditionError) as raised:
        make()
    assert message in str(raised.value)


def test_a_box_has_an_area():
    with pytest.raises(kinetri.PeriodicBoxError, match="with the area 0.0; expected a second vector to the left"):
        kinetri.Box([[1, 2], [2, 4]])
    with pytest.raises(kinetri.PeriodicBoxError, match="with the area -1.0; .*: swap the two"):
        kinetri.Box([[0, 1], [1, 0]])
    box = kinetri.Box([[2, 0], [0, 1]], rates=[[0, 1], [1, 0]], epoch=3)  # 2 - (t - 3)^2
    assert [box.area(t) for t in (3, 4, Fraction(7, 2), 5)] == [2, 1, 1.75, -2]
    assert float(box.collapse_time) == pytest.approx(3 + math.sqrt(2)) and box.collapse_time.fraction is None
    assert box.area(box.collapse_time) == pytest.approx(0, abs=1e-14)
    assert kinetri.Box((2, 2)).collapse_time is None and kinetri.Box.shear(1, 2, 3).area(9) == 2
    assert kinetri.Box((1e200, 1e200)).area(0) == math.inf
    assert repr(box) == "Box([[2.0, 0.0], [0.0, 1.0]], rates=[[0.0, 1.0], [1.0, 0.0]], epoch=3.0)"
    assert repr(kinetri.Box((2, 1))) == "Box([[2.0, 0.0], [0.0, 1.0]])"
    assert pickle.loads(pickle.dumps(box)) == box != kinetri.Box((2, 1)) and box != 3


def test_time_ends_before_a_box_has_no_area():
    kd = kinetri.KineticDelaunay([[1, 1], [2, 3]], [[3, 1], [-1, 2]], box=kinetri.Box((4, 4), rates=(-1, 0)))
    assert kd.advance_to(3) > 0
    before = kd.snapshot()
    with pytest.raises(kinetri.PeriodicBoxError, match="the periodic box has no area at time 4; stop before"):
        kd.advance_to(4)
    assert kd.snapshot() == before and kd.time == 3
    for _ in range(20):
        assert kd.step() > 0 and kd.time < 4
    with pytest.raises(kinetri.PeriodicBoxError, match="has no area at time 4"):
        kinetri.KineticDelaunay([[1, 1]], [[0, 0]], start=4, box=kinetri.Box((4, 4), rates=(-1, 0)))
