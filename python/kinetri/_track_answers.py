# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers about recorded tracks, with labels and dates."""
from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _arrays
from ._types import ArrayLike, Floats, Ids, Progress
from .errors import PreconditionError

if TYPE_CHECKING:
    import pandas as pd

    from .tracks import TracksSimulation

# If times are dates: the column of dates for each column of times.
DATES = {"t": "date", "time": "date", "begin": "begin_date", "end": "end_date", "closest": "closest_date",
         "from": "from_date", "until": "until_date"}

# The columns of points.
POINTS = ("a", "b", "id", "before", "after")


class TrackAnswers:
    """The methods of `Tracks` that answer a question about all of the observed time."""

    labels: list[Any]
    origin: np.datetime64 | None
    walkable_area: str | None = None
    _times: Floats
    _offsets: npt.NDArray[np.uint64]
    _radii: Floats | None

    def simulation(self, *, start: float | None = None, until: float | None = None,
                   radius: float | None = None, collisions: Any = None) -> TracksSimulation:
        """As of `Tracks`."""
        raise NotImplementedError

    def dates(self, times: ArrayLike) -> npt.NDArray[np.datetime64]:
        """As of `Tracks`."""
        raise NotImplementedError

    def closest(self, number: int = 10, *, start: float | None = None, until: float | None = None,
                radius: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """The closest approaches of all things, `number` of them; see `Simulation.closest`.

        `start`, `until`, `radius`, `progress`, labels and dates: see `Tracks`.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 4, 0, 4], ["a", "a", "b", "b"], [0, 4, 4, 0], [0, 0, 3, 3])
        >>> tracks.closest(1)
           a  b  time  time_lo  time_hi  distance
        0  a  b   2.0      2.0      2.0       3.0
        """
        collisions = "log" if radius is not None or self._radii is not None else None
        simulation = self.simulation(start=start, until=until, radius=radius, collisions=collisions)
        return self._labeled(simulation.closest(number, until=simulation.end, progress=progress), simulation)

    def encounters(self, range: float, *, start: float | None = None, until: float | None = None,
                   radius: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """All encounters: which things were near each other, and when; see `Simulation.encounters`.

        `range` is a distance of points, or a gap between discs. `start`, `until`, `radius`,
        `progress`, labels and dates: see `Tracks`.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 4, 0, 4], ["a", "a", "b", "b"], [0, 4, 4, 0], [0, 0, 3, 3])
        >>> tracks.encounters(5)[["a", "b", "begin", "end", "distance"]]
           a  b  begin  end  distance
        0  a  b    0.0  4.0       3.0
        """
        simulation = self.simulation(start=start, until=until, radius=radius)
        return self._labeled(simulation.encounters(range, until=simulation.end, progress=progress), simulation)

    def components(self, range: float, *, start: float | None = None, until: float | None = None,
                   progress: Progress = False) -> pd.DataFrame:
        """Each time at which components merge or split; see `Simulation.components`.

        `start`, `until`, `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        return self._labeled(simulation.components(range, until=simulation.end, progress=progress), simulation)

    def connected(self, a: Any, b: Any, range: float, *, start: float | None = None,
                  until: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """The times at which two things are connected; see `Simulation.connected`.

        `a` and `b` are two of `labels`; all stays of a thing count. `start`, `until`,
        `progress` and dates: see `Tracks`.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 4, 0, 4], ["a", "a", "b", "b"], [0, 4, 4, 0], [0, 0, 0, 0])
        >>> tracks.connected("a", "b", 2)[["a", "b", "begin", "end"]]
           a  b  begin  end
        0  a  b    1.0  3.0
        """
        simulation = self.simulation(start=start, until=until)
        pairs = self._pairs(simulation, self._thing("a", a), self._thing("b", b))
        watch = simulation.watch("connected", range=range, between=pairs)
        table = simulation._answer(watch, simulation.end, progress)
        return self._dated(table.assign(a=[a] * len(table), b=[b] * len(table)))

    def spanning_tree(self, *, start: float | None = None, until: float | None = None,
                      progress: Progress = False) -> pd.DataFrame:
        """The Euclidean minimum spanning tree over time; see `Simulation.spanning_tree`.

        `start`, `until`, `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        return self._labeled(simulation.spanning_tree(until=simulation.end, progress=progress), simulation)

    def neighbor_lives(self, *, start: float | None = None, until: float | None = None,
                       ridge: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """Which things were neighbors, and when; see `Simulation.neighbor_lives`.

        `ridge`: see there. `start`, `until`, `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        table = simulation.neighbor_lives(until=simulation.end, ridge=ridge, progress=progress)
        return self._labeled(table, simulation)

    def exchanges(self, *, start: float | None = None, until: float | None = None,
                  ridge: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """The neighbor exchanges (T1) of each stay of a thing; see `Simulation.exchanges`.

        `ridge`: see there. `start`, `until`, `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        table = simulation.exchanges(until=simulation.end, ridge=ridge, progress=progress)
        return self._labeled(table, simulation)

    def nearest_neighbor_changes(self, *, start: float | None = None, until: float | None = None,
                                 progress: Progress = False) -> pd.DataFrame:
        """The nearest neighbor of each thing, and each change of it; see `Simulation.nearest_neighbor_changes`.

        `start`, `until`, `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        table = simulation.nearest_neighbor_changes(until=simulation.end, progress=progress)
        return self._labeled(table, simulation)

    def areas(self, times: ArrayLike | None = None, *, fps: float | None = None,
              walkable: str | ArrayLike | None = None, cutoff: float | None = None,
              start: float | None = None, until: float | None = None,
              progress: Progress = False) -> pd.DataFrame:
        """The area of each thing at frames; see `Simulation.areas`.

        The frames are at the ascending `times`; or with `fps` at k / fps, for integers k, from `start` to
        `until`. For `walkable` and `cutoff` see `cell_areas`; `walkable` is by default `walkable_area`, if the
        tracks have one. A thing exists from its first observation until just before its last one. `progress`,
        labels and dates: see `Tracks`.

        Examples
        --------
        >>> import kinetri
        >>> tracks = kinetri.Tracks.from_arrays([0, 4, 0, 4], ["a", "a", "b", "b"], [1, 1, 3, 3], [0, 4, 0, 4])
        >>> tracks.areas(fps=0.5, walkable=[[0, 0], [4, 0], [4, 4], [0, 4]])
             t id  area  density
        0  0.0  a   8.0    0.125
        1  0.0  b   8.0    0.125
        2  2.0  a   8.0    0.125
        3  2.0  b   8.0    0.125
        """
        simulation = self.simulation(start=start, until=until)
        if (times is None) == (fps is None):
            raise PreconditionError("expected times, or fps")
        if times is None:
            rate = _arrays.one_number("fps", fps)
            if rate <= 0:
                raise PreconditionError(f"fps is {fps}; expected a number greater than 0")
            begin, end = float(simulation.time), simulation.end
            frames = np.arange(math.floor(begin * rate) - 1, math.ceil(end * rate) + 2) / rate
            times = frames[(frames >= begin) & (frames <= end)]
        table = simulation.areas(times, walkable=self.walkable_area if walkable is None else walkable,
                                 cutoff=cutoff, progress=progress)
        return self._labeled(table, simulation)

    def mean_areas(self, *, walkable: str | ArrayLike | None = None, cutoff: float | None = None,
                   tolerance: float = 1e-6, start: float | None = None, until: float | None = None,
                   progress: Progress = False) -> pd.DataFrame:
        """The mean area of each stay of a thing, exact in time; see `Simulation.mean_areas`.

        `walkable` and `cutoff` are as in `areas` of tracks, and `tolerance` as there. `start`, `until`,
        `progress`, labels and dates: see `Tracks`.
        """
        simulation = self.simulation(start=start, until=until)
        table = simulation.mean_areas(until=simulation.end,
                                      walkable=self.walkable_area if walkable is None else walkable,
                                      cutoff=cutoff, tolerance=tolerance, progress=progress)
        return self._labeled(table, simulation)

    def _thing(self, parameter: str, label: Any) -> int:
        """The index of a thing in `labels`."""
        try:
            return self.labels.index(label)
        except ValueError:
            raise PreconditionError(f"{parameter} is {label!r}; expected one of labels") from None

    def _pairs(self, simulation: TracksSimulation, a: int, b: int) -> Ids:
        """Pairs of stays of the two things that exist at the same time."""
        if a == b:
            raise PreconditionError(f"a and b are both {self.labels[a]!r}; expected two things")
        things = simulation.stays[:, 0].astype(np.intp)
        first, last = (self._times[self._offsets[things] + simulation.stays[:, i]] for i in (1, 2))
        p, q = (side.ravel() for side in np.meshgrid(np.flatnonzero(things == a), np.flatnonzero(things == b)))
        meet = (first[p] <= last[q]) & (first[q] <= last[p])
        return np.column_stack((p[meet], q[meet])).astype(np.uint32)

    def _labeled(self, table: pd.DataFrame, simulation: TracksSimulation) -> pd.DataFrame:
        """The table with labels for ids, and with dates."""
        import pandas as pd

        for name in [name for name in POINTS if name in table.columns]:
            table[name] = [None if pd.isna(id) else simulation.label(id) for id in table[name]]
        return self._dated(table)

    def _dated(self, table: pd.DataFrame) -> pd.DataFrame:
        """The table with a column of dates for each column of times, if times are dates."""
        if self.origin is not None:
            for time in [time for time in DATES if time in table.columns]:
                table[DATES[time]] = self.dates(table[time])
        return table
