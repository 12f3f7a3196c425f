# SPDX-License-Identifier: GPL-3.0-or-later
"""Sequences of changes of all kinds, on input that is as degenerate as can be: each state passes its audit,
and answers what it is asked."""
import numpy as np
from hypothesis import given, settings, strategies as st
from support import few, trajectory

import kinetri

RESPONSES = ["log", "swap", "elastic", "stop", "remove"]


class Run:
    """An object on a small grid of integers, and changes at random."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)
        self.size = int(self.random.integers(2, 7))
        self.make = [self.delaunay, self.accelerated, self.regular, self.equal_discs, self.discs][seed % 5]
        self.response = RESPONSES[seed // 5 % 5]
        self.coincident = "hide" if seed // 25 % 3 > 0 else "refuse"
        self.points = self.make(*self.motions(int(self.random.integers(0, 8))))

    def motions(self, n):
        return self.random.integers(0, self.size, (n, 2)), self.random.integers(-1, 2, (n, 2))

    def delaunay(self, positions, velocities):
        return kinetri.KineticDelaunay(positions, velocities, coincident=self.coincident)

    def accelerated(self, positions, velocities):
        return kinetri.KineticDelaunay(positions, velocities, coincident=self.coincident,
                                       acceleration=self.random.integers(-1, 2, positions.shape))

    def regular(self, positions, velocities):
        n = len(positions)
        return kinetri.KineticRegular(positions, velocities, radius=self.random.integers(0, 3, n),
                                      growth=self.random.integers(-1, 2, n), coincident=self.coincident)

    def equal_discs(self, positions, velocities):
        return kinetri.Simulation(positions, velocities, radius=0.25, box=(-1, -1, 8, 8),
                                  collisions=self.response, coincident=self.coincident)

    def discs(self, positions, velocities):
        return kinetri.Simulation(positions, velocities, box=(-1, -1, 8, 8), collisions=self.response,
                                  radius=self.random.uniform(0.1, 0.4, len(positions)),
                                  refuse_overlaps=False, coincident=self.coincident)

    def change(self):
        points, random = self.points, self.random
        some = random.permutation(points.ids)[:2]
        kind = int(random.integers(0, 9))
        if kind == 0:
            points.insert(*self.motions(int(random.integers(1, 3))))
        elif kind == 1:
            points.erase(some[:1])
        elif kind == 2:
            points.set_velocities(some, random.integers(-1, 2, 2))
        elif kind <= 4:
            points.set_motions(some, *self.motions(len(some)))
        elif kind == 5:
            self.points = points.snapshot().restore()
        elif kind == 6 and hasattr(points, "reverse"):
            points.reverse()
        elif kind == 7:
            points.step(until=points.time.upper + 5)
        else:
            points.advance_to(points.time.upper + float(random.integers(0, 5)) / 2)

    def check(self):
        points = self.points
        report = points.audit()
        assert report, report
        ids = points.ids.tolist()
        assert len(ids) == len(points) and np.isfinite(points.positions()[ids]).all()
        hidden = set(points.hidden_points().tolist())
        assert set(points.edges().ravel().tolist()) <= set(ids) - hidden
        assert set(points.hull().tolist()) <= set(ids) - hidden
        groups = {}
        for id in ids:
            groups.setdefault(str(trajectory(points.motion(id))), []).append(id)
        for group in groups.values():
            assert hidden >= set(group[1:]) and (self.coincident == "hide" or len(group) == 1)
            for id in group:
                assert points.coincident_points(id).tolist() == [other for other in group if other != id]
        if self.make != self.regular and self.make != self.discs:
            assert len(hidden) == len(ids) - len(groups)
        assert np.isclose(points.voronoi_areas((-3, -3, 9, 9)).sum(), 144 if ids else 0)
        for id in ids[:3]:
            assert set(points.neighbors(id).tolist()) <= set(ids) - {id}
            points.voronoi_cell(id)
        points.locate([1, 1])
        assert (points.nearest_vertex([2, 2]) in points) if ids else points.nearest_vertex([2, 2]) is None


@settings(few, max_examples=250)
@given(st.integers(0, 2**20))
def test_every_state_passes_its_audit(seed):
    try:
        run = Run(seed)
    except kinetri.CoincidentTrajectoriesError:
        return
    for _ in range(12):
        try:
            run.change()
        except (kinetri.CoincidentTrajectoriesError, kinetri.OutsideBoxError, kinetri.NegativeRadiusError,
                kinetri.OverlappingDiscsError):
            pass  # and nothing has changed
        except kinetri.ContactError:
            return
        run.check()


def test_of_two_discs_that_jump_one_hides_a_point_in_its_place():
    kr = kinetri.KineticRegular([[1, 1], [0, 1], [0, 0], [1, 1], [1, 0]],
                                [[0, 1], [-1, 1], [-1, -1], [1, -1], [-1, 0]], radius=[0, 1, 0, 1, 2])
    kr.set_motions([3, 4], [[1, 1], [0, 1]], [[-1, 0], [-1, 1]])
    assert kr.audit() and 1 in kr.hidden_points()
