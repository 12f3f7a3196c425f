# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers about a run, such as encounters and connectivity. Each is an observer of the engine."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _arrays, _kinetri
from ._arrays import NO_POINT
from ._kinetri import Time
from ._progress import progress_bar
from ._types import ArrayLike, Floats, Ids, Progress, TimeLike
from .errors import PreconditionError

if TYPE_CHECKING:
    import pandas as pd

# The questions, with the required and the optional parameters of each.
QUESTIONS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "closest": (("number",), ()),
    "encounters": (("range",), ()),
    "components": (("range",), ()),
    "connected": (("range", "between"), ()),
    "spanning_tree": ((), ()),
    "neighbor_lives": ((), ("ridge",)),
    "exchanges": ((), ("ridge",)),
    "nearest_neighbor_changes": ((), ()),
    "pressure": ((), ()),
    "certificates": ((), ()),
}


class Watch:
    """Observes a run, and answers a question about it at any time.

    Created by `MovingPoints.watch`. It observes the run from then on, as long as it exists; several can observe
    one run.
    """

    def __init__(self, engine: _kinetri.Engine, about: str, number: int | None, range: float | None,
                 ridge: float | None, between: ArrayLike | None = None) -> None:
        if about not in QUESTIONS:
            raise PreconditionError(f"about is {about!r}; expected one of {', '.join(map(repr, QUESTIONS))}")
        needed, allowed = QUESTIONS[about]
        given = {"number": number, "range": range, "ridge": ridge, "between": between}
        for name, value in given.items():
            if value is None and name in needed:
                raise PreconditionError(f"{name} is missing; expected {name} for {about!r}")
            if value is not None and name not in needed + allowed:
                expected = " and ".join(needed + allowed) or "nothing else"
                raise PreconditionError(f"{name} is given; expected {expected} for {about!r}")
        count = 0 if number is None else _arrays.count("number", number)
        if number is not None and count == 0:
            raise PreconditionError("number is 0; expected at least 1")
        distance = next((_arrays.one_number(name, given[name]) for name in ("range", "ridge")
                         if given[name] is not None), None)
        pairs = np.empty((0, 2), dtype=np.uint32) if between is None else _pairs(engine, between)
        self._about = about
        self._watch = _kinetri.Watch(engine, about, count, distance, pairs)

    def table(self) -> pd.DataFrame:
        """The answer from the creation of this object to the present time of the run.

        Returns
        -------
        pandas.DataFrame
            The same as from the method of that name, such as `MovingPoints.encounters`.
        """
        import pandas as pd

        return pd.DataFrame({name: _column(values) for name, values in self._watch.table().items()})

    def __repr__(self) -> str:
        return f"<kinetri.Watch of {self._about}>"


def _pairs(engine: _kinetri.Engine, between: ArrayLike) -> Ids:
    """Pairs of points that differ: an array of shape (k, 2)."""
    shape = np.shape(between)
    if len(shape) not in (1, 2) or shape[-1] != 2:
        raise PreconditionError(f"between has the shape {shape}; expected two ids, or (k, 2)")
    pairs = _arrays.id_array("between", np.ravel(between)).reshape(-1, 2)
    if np.any(pairs >= engine.next_id()):
        raise PreconditionError(f"there is no point {np.max(pairs)}; expected ids less than {engine.next_id()}")
    if np.any(pairs[:, 0] == pairs[:, 1]):
        raise PreconditionError("between has one point twice; expected two points")
    return pairs


def _column(values: Any) -> Any:
    """A column; ids and offsets that may be missing are nullable."""
    import pandas as pd

    if isinstance(values, np.ndarray) and values.dtype == np.uint8:
        return values.astype(bool)
    for kind, missing in ((np.uint32, NO_POINT), (np.int64, np.iinfo(np.int64).min)):
        if isinstance(values, np.ndarray) and values.dtype == kind and np.any(values == missing):
            return pd.arrays.IntegerArray(values.astype(np.int64), values == missing)
    return values


def cell_limits(engine: _kinetri.Engine, walkable: str | ArrayLike | None,
                cutoff: float | None) -> _kinetri.CellLimits:
    """The bounds of cells, as arguments of the engine."""
    text = walkable if isinstance(walkable, str) else None
    polygon = None if walkable is None or text is not None else _arrays.point_array("walkable", walkable)
    return _kinetri.CellLimits(text, polygon,
                               math.inf if cutoff is None else _arrays.one_number("cutoff", cutoff),
                               engine.box() is not None)


class RunAnswers:
    """The methods of `MovingPoints` that advance to a time and answer a question about that run."""

    _engine: _kinetri.Engine

    @property
    def time(self) -> Time:
        """As of `MovingPoints`."""
        raise NotImplementedError

    def _advance(self, until: TimeLike, observer: _kinetri.Observer | None, progress: Progress) -> int:
        raise NotImplementedError

    def _go(self, until: Time, observer: _kinetri.Observer | None, show: Callable[[float], object] | None) -> int:
        return self._engine.advance(until, observer, show)

    def watch(self, about: str, *, number: int | None = None, range: float | None = None,
              ridge: float | None = None, between: ArrayLike | None = None) -> Watch:
        """Observes the run from now on, to answer a question later.

        Parameters
        ----------
        about : str
            The question: 'closest', 'encounters', 'components', 'connected', 'spanning_tree',
            'neighbor_lives', 'exchanges', 'nearest_neighbor_changes', 'pressure' or 'certificates'. The method of
            that name answers it.
        number : int, optional
            The number of approaches; for 'closest' only.
        range : float, optional
            The distance up to which points are near; for 'encounters', 'components' and 'connected' only.
        ridge : float, optional
            The length below which a ridge is short; for 'neighbor_lives' and 'exchanges' only.
        between : array_like of int, shape (2,) or (k, 2), optional
            Two ids; for 'connected' only. With several pairs, the times at which any of them is connected.

        Returns
        -------
        Watch
            Its method `table` gives the answer at any time.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [4, 0], [8, 3]], [[1, 0], [0, 0], [0, 0]])
        >>> watch = kd.watch("encounters", range=1.0)
        >>> kd.advance_to(6)
        0
        >>> watch.table()[["a", "b", "begin", "end"]]
           a  b  begin  end
        0  0  1    3.0  5.0
        """
        return Watch(self._engine, about, number, range, ridge, between)

    def _answer(self, watch: Watch, until: TimeLike, progress: Progress) -> pd.DataFrame:
        self._advance(until, None, progress)
        return watch.table()

    def encounters(self, range: float, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns all encounters: which points were near each other, and when.

        Two points are near while their distance is at most `range`; discs, while the gap between them is. A
        single instant counts.

        Parameters
        ----------
        range : float
            At least 0.
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            One row for each time that a pair was near, by exact begin, then by a and b: a, b (ids, a < b);
            begin, end and closest, the time of the least distance, each with its bounds in columns that
            end in _lo and _hi; distance, the least one, of the centers; gap, if there are discs. Each number is
            the float64 nearest to the exact one. An encounter begins at the earliest now or when a point is
            inserted, and ends at the latest at the end or when a point is erased. In a periodic box also k and l,
            the offset of the image of b that a meets; a and b may be one point.
        """
        return self._answer(self.watch("encounters", range=range), until, progress)

    def components(self, range: float, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns each time at which components merge or split.

        Points at most `range` apart are linked. A component is a set of points connected by links.

        Parameters
        ----------
        range : float
            At least 0.
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            In order of time: time, time_lo, time_hi; kind, which is 'start' in the first row, then
            'merge' or 'split', and 'insert' or 'erase' of a point without links; a and b, the pair whose
            link begins or ends (of insert and erase a is the point); components, the number of components after
            that; largest, the number of points in the largest. In a periodic box also k and l, the offset of the
            image of b, and wrapping, the number of components that wrap around the box; kind may be 'wrap' or
            'unwrap', when one begins or ceases to.
        """
        return self._answer(self.watch("components", range=range), until, progress)

    def connected(self, a: int, b: int, range: float, *, until: TimeLike,
                  progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns the times at which two points are connected.

        Points at most `range` apart are linked; two are connected if a path of links joins them, in a periodic
        box one to any image of the second point.

        Parameters
        ----------
        a, b : int
            The points. They need not exist all of the time.
        range : float
            At least 0.
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            One row for each closed interval during which the two were connected, in order: a, b, begin and end,
            each time with its bounds in columns that end in _lo and _hi.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [8, 0], [4, -5]], [[0, 0], [0, 0], [0, 1]])
        >>> kd.connected(0, 1, 5, until=10)[["a", "b", "begin", "end"]]
           a  b  begin  end
        0  0  1    2.0  8.0
        """
        watch = self.watch("connected", range=range,
                           between=[_arrays.one_id("a", a), _arrays.one_id("b", b)])
        return self._answer(watch, until, progress)

    def spanning_tree(self, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns the Euclidean minimum spanning tree and its changes.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            time, time_lo, time_hi; kind; a and b (ids, a < b), an edge; length. Kinds are 'start' (an
            edge at the start); 'remove' and 'add', in order of time (an edge that leaves or enters the tree);
            'longest' (from then on this edge is the longest; the points are connected at ranges of at least its
            length); in the last two rows 'least' and 'greatest', the least and the greatest length of the
            longest edge, at the first such time. Lengths are those at the time, rounded to the nearest float64;
            NaN in rows 'remove' and 'add'. If lengths are equal during some time, the order of ids decides. In a
            periodic box the tree joins the points modulo the lattice, and there are also k and l, the offset of the
            image of b to which the edge leads.
        """
        return self._answer(self.watch("spanning_tree"), until, progress)

    def neighbor_lives(self, *, until: TimeLike, ridge: float | None = None,
                       progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns the lifetime of each edge: which points were neighbors, and when.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        ridge : float, optional
            The length below which the common side of two cells is short.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            One row for each lifetime of an edge, by exact begin, then by a and b: a, b (ids,
            a < b); begin and end, each with its bounds in columns that end in _lo and _hi; begins_by and
            ends_by: 'exchange' (by motion), 'point' (by inserting or erasing an end or a point nearby), or
            'run' (the observation begins or ends); with `ridge` also short: whether the side between the two
            cells was always shorter than that, decided exactly. In a periodic box also k and l, the offset of the
            image of b that is the neighbor of a; a and b may be one point.
        """
        return self._answer(self.watch("neighbor_lives", ridge=ridge), until, progress)

    def certificates(self, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns for each event the proof of its time.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            One row for each event, in order: event (its number), kind, and certificate: the line of JSON
            that the program writes with --certificates. It has the polynomial of the certificate that fails,
            and signs of its Sturm sequence that prove the time; or, if no certificate fails, the reason of the
            event. In a periodic box it also has the offsets of the images that the polynomial is about.

        Examples
        --------
        >>> import json
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [4, 0], [0, 4], [9, 9]], [[0, 0], [0, 0], [0, 0], [-3, -3]])
        >>> flip = json.loads(kd.certificates(until=2)["certificate"][0])
        >>> flip["points"], flip["polynomial"], flip["multiplicity"]
        ([1, 2, 0, 3], ['15', '-14', '3'], 1)
        """
        return self._answer(self.watch("certificates"), until, progress)

    def exchanges(self, *, until: TimeLike, ridge: float | None = None,
                  progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and counts the neighbor exchanges (T1) of each point.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        ridge : float, optional
            As in `neighbor_lives`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            One row for each point that existed: id; from and until, the time during which it existed, with
            bounds; gained and lost, the numbers of neighbors gained and lost by exchanges; with `ridge` also
            short, how many of these begin or end a short lifetime; rate, the others per unit of time, NaN if
            the point existed for no time.
        """
        return self._answer(self.watch("exchanges", ridge=ridge), until, progress)

    def nearest_neighbor_changes(self, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns each change of a point's nearest neighbor.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            In the exact order of time, then by id: time, time_lo, time_hi, id, before and after (ids;
            missing at the start, and if there is no other point). The first rows are those of the start. In a
            periodic box also before_k, before_l, after_k and after_l: which images these are.
        """
        return self._answer(self.watch("nearest_neighbor_changes"), until, progress)

    def areas(self, times: ArrayLike, *, walkable: str | ArrayLike | None = None,
              cutoff: float | None = None, progress: Progress = False) -> pd.DataFrame:
        """Advances to several times and returns the area of each point at each.

        Parameters
        ----------
        times : array_like of float, shape (k,)
            Ascending, not before `self.time`.
        walkable, cutoff
            As in `cell_areas`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            t, id, area, density: a row for each time and each point that exists just after it. The density is 1
            / area, NaN if the area is 0.
        """
        import pandas as pd

        limits = cell_limits(self._engine, walkable, cutoff)
        frames = _arrays.float_array("times", times, (None,))
        if np.any(np.diff(frames) < 0):
            i = int(np.argmax(np.diff(frames) < 0)) + 1
            raise PreconditionError(f"times[{i}] is {frames[i]}, before times[{i - 1}]; expected "
                                    "ascending times")
        ids: list[Ids] = []
        areas: list[Floats] = []
        end = float(frames[-1]) if len(frames) > 0 else float(self.time)
        with progress_bar(progress, float(self.time), end) as show:
            for time in frames:
                self._go(Time(time), None, show)
                frame_ids, frame_areas = self._engine.cell_areas(limits)
                ids.append(frame_ids)
                areas.append(frame_areas)
        sizes = [len(frame) for frame in ids]
        area = np.concatenate(areas) if areas else np.empty(0)
        with np.errstate(divide="ignore"):
            density = np.where(area > 0, 1 / area, np.nan)
        return pd.DataFrame({
            "t": np.repeat(frames, sizes),
            "id": np.concatenate(ids) if ids else np.empty(0, dtype=np.uint32),
            "area": area, "density": density})

    def mean_areas(self, *, until: TimeLike, walkable: str | ArrayLike | None = None,
                   cutoff: float | None = None, tolerance: float = 1e-6,
                   progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns the mean area of each point, exact in time.

        Between events the area of a cell is a smooth function of time, which is integrated.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        walkable, cutoff
            As in `cell_areas`.
        tolerance : float
            The approximate relative error of each integral.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            id, from, until, area, error: for each point, the interval during which it existed, the mean of its
            area over that interval, and an estimate of the error of the mean.
        """
        import pandas as pd

        watch = _kinetri.Watch(self._engine, "mean_areas", 0, None, np.empty((0, 2), dtype=np.uint32),
                               limits=cell_limits(self._engine, walkable, cutoff),
                               tolerance=_arrays.one_number("tolerance", tolerance))
        self._advance(until, None, progress)
        return pd.DataFrame(watch.table())
