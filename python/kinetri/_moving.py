# SPDX-License-Identifier: GPL-3.0-or-later
"""The classes of moving points. Each holds an engine of `_kinetri` and checks its arguments."""
from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from types import EllipsisType
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar, overload

import numpy as np
import numpy.typing as npt

from . import _arrays, _coincidence, _kinetri
from ._answers import RunAnswers, cell_limits
from ._arrays import NO_POINT
from ._box import Box, box_of, is_walls
from ._kinetri import Time
from ._page import Page
from ._progress import progress_bar
from ._response import Collisions, engine_response
from ._snapshot import Snapshot
from ._types import ArrayLike, Events, Floats, Ids, IdsLike, Lattice, Offsets, Path, Progress, TimeLike, Walls
from .errors import PreconditionError, SnapshotError
from .events import table_of, take

if TYPE_CHECKING:
    import pandas as pd

_Points = TypeVar("_Points", bound="MovingPoints")
_Delaunay = TypeVar("_Delaunay", bound="KineticDelaunay")
_Simulation = TypeVar("_Simulation", bound="Simulation")


class _VoronoiCell(NamedTuple):
    neighbors: Ids
    vertices: Floats
    rays: Floats | None
    is_empty: bool


class VoronoiCell(_VoronoiCell):
    """The region of all positions at least as near to a point as to any other.

    It is the tuple of the first four attributes.

    Attributes
    ----------
    neighbors : array of uint32, shape (k,)
        The neighbor across each side, counterclockwise.
    vertices : array of float64, shape (k, 2) or (k - 1, 2)
        The end of each side. An unbounded cell has one fewer than sides.
    rays : array of float64, shape (2, 2), or None
        The directions of the first and last sides of an unbounded cell.
    is_empty : bool
        Whether the cell is empty; only with weights.
    offsets : array of int32, shape (k, 2), or None
        In a periodic box, the offset of the image of each neighbor. Cells are bounded there.
    """

    offsets: Offsets | None = None


class _NearestNeighbors(NamedTuple):
    ids: Ids
    distances: Floats


class NearestNeighbors(_NearestNeighbors):
    """The nearest neighbor of each point, or the k nearest.

    It is the tuple of the first two attributes: ``ids, distances = kd.nearest_neighbors()``.

    Attributes
    ----------
    ids : array of uint32, shape (n,) or (n, k)
        By id: the nearest neighbor, exactly; `NO_POINT` if there is none. With k, the k nearest in the exact
        order of their distances. Ties are broken by the smaller id, then by the smaller offset.
    distances : array of float64, shape (n,) or (n, k)
        The distance of the rounded positions; NaN if there is no neighbor.
    offsets : array of int32, shape (n, 2) or (n, k, 2), or None
        In a periodic box, the offset of the image of each neighbor; (0, 0) if there is none.
    """

    offsets: Offsets | None = None


class _Location(NamedTuple):
    kind: str
    points: tuple[int, ...]


class Location(_Location):
    """The vertex, edge or face at a position.

    It is the tuple of the first two attributes.

    Attributes
    ----------
    kind : {'vertex', 'edge', 'face', 'outside_convex_hull'}
        What contains the position, decided exactly.
    points : tuple of int
        The point; or the ends of the edge; or the corners of the triangle, counterclockwise.
    offsets : tuple of (int, int), or None
        In a periodic box, the offset of the image of each of these points.
    """

    offsets: tuple[tuple[int, int], ...] | None = None


class AuditReport:
    """The result of an audit. True if there are no failures.

    Attributes
    ----------
    failures : list of str
        One line for each failure, with the ids.
    """

    def __init__(self, failures: list[str]) -> None:
        self.failures = failures

    @property
    def passed(self) -> bool:
        """bool: whether there are no failures."""
        return not self.failures

    def __bool__(self) -> bool:
        return self.passed

    def __repr__(self) -> str:
        return "<AuditReport passed>" if self.passed else "<AuditReport\n  " + "\n  ".join(
            self.failures) + ">"


def _columns(size: int, **values: tuple[ArrayLike | None, bool]) -> dict[str, Floats | None]:
    """The optional columns as arguments of the engine; None stays None."""
    result: dict[str, Floats | None] = {}
    for name, (value, is_vector) in values.items():
        if value is None:
            result[name] = None
        elif is_vector:
            result[name] = _arrays.point_array(name, value, size)
        else:
            result[name] = _arrays.column(name, value, size)
    _arrays.check_not_negative("radius", result["radius"])
    return result


def _vectors(positions: ArrayLike, velocities: ArrayLike | None, acceleration: ArrayLike | None,
             jerk: ArrayLike | None, size: int | None = None) -> tuple[Floats, Any, Any, Any]:
    """The columns of some points; for one point, two numbers each are enough."""
    places = _arrays.rows("positions", positions, size)

    def column(name: str, vectors: ArrayLike | None) -> Floats | None:
        return None if vectors is None else _arrays.rows(name, vectors, len(places))

    return (places, column("velocities", velocities), column("acceleration", acceleration),
            column("jerk", jerk))


def _motions(positions: ArrayLike, velocities: ArrayLike | None, acceleration: ArrayLike | None,
             jerk: ArrayLike | None, radius: ArrayLike | None, growth: ArrayLike | None,
             weight: ArrayLike | None, epoch: float) -> tuple[_kinetri.Motions, int]:
    positions = _arrays.point_array("positions", positions)
    size = len(positions)
    if size >= NO_POINT:
        raise PreconditionError(f"there are {size} points; expected fewer than {NO_POINT}")
    columns = _columns(size, velocities=(velocities, True), acceleration=(acceleration, True),
                       jerk=(jerk, True), radius=(radius, False), growth=(growth, False),
                       weight=(weight, False))
    return _kinetri.Motions(positions, columns["velocities"], columns["acceleration"], columns["jerk"],
                            columns["radius"], columns["growth"], columns["weight"], epoch), size


def _triangulation(positions: ArrayLike, velocities: ArrayLike | None, acceleration: ArrayLike | None,
                   jerk: ArrayLike | None, start: TimeLike, epoch: float | None = None,
                   sizes: tuple[ArrayLike | None, ArrayLike | None, ArrayLike | None] | None = None,
                   *, coincident: str, lattice: Lattice | None = None) -> _kinetri.Engine:
    """The engine of a triangulation: a regular one if there are sizes (radius, growth, weight).

    The epoch of the motions is the start by default.
    """
    start = Time(start)
    refuses_coincident = _coincidence.are_refused(coincident)
    motions, _ = _motions(positions, velocities, acceleration, jerk, *(sizes or (None, None, None)),
                          float(start) if epoch is None else epoch)
    is_polynomial = acceleration is not None or jerk is not None
    return _kinetri.make_triangulation(motions, is_polynomial, sizes is not None, start, refuses_coincident,
                                       lattice)


class MovingPoints(RunAnswers):
    """Base class of `KineticDelaunay`, `KineticRegular` and `Simulation`.

    Points have ids: 0, 1, 2, ... in the order in which they are given. The id of an erased point is not used
    again; arrays by id have NaN (or 0, or `NO_POINT`) in its row.

    Points that have the same motion (and size) from some time on coincide until the motion of one of them changes.
    The one with the least id hides the others meanwhile: only it is a vertex of edges, triangles and the hull, and
    `hide` and `reveal` are the events. All of them keep their rows in arrays by id. In `neighbors`, and in answers
    about distances such as `nearest_neighbors` and `encounters`, a hidden one is a neighbor of the one that hides
    it, at the distance 0. Points that only meet and part hide nothing. The parameter `coincident` can refuse such points.

    Objects can be copied and pickled. An object may be used by one thread at a time. Calls that advance time
    release the GIL, so different objects can advance in parallel.
    """

    _engine: _kinetri.Engine

    def __init__(self, *args: Any, **named: Any) -> None:
        raise TypeError("expected a KineticDelaunay, a KineticRegular or a Simulation")

    # ---- the present ----

    @property
    def time(self) -> _kinetri.Time:
        """Time: the present time, exact. The triangulation is that just after it."""
        return self._engine.current_time()

    def __len__(self) -> int:
        """The number of points."""
        return self._engine.number_of_points()

    def __contains__(self, id: int) -> bool:
        """Whether the point exists."""
        return self._engine.contains(_arrays.one_id("id", id))

    @property
    def next_id(self) -> int:
        """int: the next id; also the length of arrays by id."""
        return self._engine.next_id()

    @property
    def ids(self) -> Ids:
        """array of uint32: the ids of all points, ascending."""
        return np.flatnonzero(self._is_there()).astype(np.uint32)

    def positions(self, *, wrapped: bool = False) -> Floats:
        """The positions now; in a periodic box also those of the images in the box.

        Parameters
        ----------
        wrapped : bool
            Whether to give, for each point, the position of its image in the parallelogram of the box: the sum of
            multiples of the two lattice vectors of the present time, each from 0 to less than 1. Only in a box.

        Returns
        -------
        array of float64, shape (n, 2)
            By id, each coordinate rounded to the nearest float64; NaN if there is no point. Which image is in the
            box is decided exactly, before rounding. By default points are where their motions have taken them:
            offsets are against these positions.

        Raises
        ------
        PreconditionError
            If there is no box.
        PeriodicBoxError
            If a point is 2^31 or more lattice vectors away from the box.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[9, 1], [2, -1]], [[0, 0], [0, 0]], box=(4, 4))
        >>> kd.positions(wrapped=True).tolist()
        [[1.0, 1.0], [2.0, 3.0]]
        """
        return self._engine.wrapped_positions() if wrapped else self._engine.positions()

    def velocities(self) -> Floats:
        """The velocities now.

        Returns
        -------
        array of float64, shape (n, 2)
            By id; exact if points do not accelerate, else rounded. NaN if there is no point.
        """
        return self._engine.velocities()

    def radii(self) -> Floats:
        """The radii of the discs now.

        Returns
        -------
        array of float64, shape (n,)
            By id; exact if nothing grows, else rounded. 0 for points without discs, NaN if there is no point.
            In a `KineticRegular`, negative if a radius has shrunk below 0.
        """
        return self._engine.radii()

    def motion(self, id: int) -> dict[str, Any]:
        """The present motion of a point.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        dict
            position, velocity, acceleration, jerk (pairs of floats at the epoch), radius, growth,
            weight, epoch. With s = t - epoch the point is at position + velocity s + acceleration s^2/2
            + jerk s^3/6, and its radius is radius + growth s.

        Raises
        ------
        PreconditionError
            If there is no such point.
        """
        return self._engine.motion(_arrays.one_id("id", id))

    def edges(self) -> Ids:
        """The edges of the triangulation; hidden points have none.

        Returns
        -------
        array of uint32, shape (m, 2)
            The ids of the ends, the smaller first; sorted. In a periodic box a pair has a row for each of its edges,
            and an edge may go from a point to its own image: see `edge_offsets`.
        """
        return self._engine.edges()

    def triangles(self) -> Ids:
        """The triangles.

        Returns
        -------
        array of uint32, shape (k, 3)
            The ids of the corners, counterclockwise, the least first; sorted. Empty if all points are
            collinear. In a periodic box ids may repeat: see `triangle_offsets`.
        """
        return self._engine.triangles()

    def hull(self) -> Ids:
        """The convex hull.

        Returns
        -------
        array of uint32, shape (h,)
            Its vertices counterclockwise, the least id first. If all points are collinear, all that are not
            hidden, in their order along the line.
        """
        return self._engine.hull()

    def hidden_points(self) -> Ids:
        """The points that have no edges: they coincide with another for a while, or have an empty power cell.

        Returns
        -------
        array of uint32
            Their ids, ascending. Power cells are empty only with weights, as of discs that differ in size.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[4, 1], [0, 0], [0, 0]], [[0, 0], [1, 0], [1, 0]])
        >>> kd.hidden_points().tolist(), kd.edges().tolist()
        ([2], [[0, 1]])
        """
        return self._engine.hidden_points()

    def coincident_points(self, id: int) -> Ids:
        """The points that coincide with a point for a while: they have its motion and weight.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        array of uint32
            The ids of the others, ascending. Of all of them and `id`, the least hides the others.

        Raises
        ------
        PreconditionError
            If there is no such point.
        """
        return self._engine.coincident_points(_arrays.one_id("id", id))

    # ---- time ----

    @property
    def threads(self) -> int:
        """int: the maximum number of threads while time advances; 0, the default: as many as are available.

        The results are the same for any number, up to 1024. Several threads are used if there are about 50 000
        points or more, of which at most one in 1000 is hidden, many events are due, and `collisions` is neither
        a function nor "log" nor "remove". Copies, and objects that are loaded or restored, begin with 0.
        """
        return self._engine.threads()

    @threads.setter
    def threads(self, number: int) -> None:
        number = _arrays.count("threads", number)
        if number > 1024:
            raise PreconditionError(f"threads is {number}; expected a whole number from 0 to 1024")
        self._engine.set_threads(number)

    def advance_to(self, time: TimeLike, *, progress: Progress = False) -> int:
        """Advances to a time, and executes all events up to it, events at that time included.

        Parameters
        ----------
        time : float, int, fractions.Fraction or Time
            Not before `self.time`.
        progress : bool or callable
            Whether to show a progress bar; or a function that is called with the present time repeatedly.

        Returns
        -------
        int
            The number of events.

        Raises
        ------
        PreconditionError
            If the time is in the past.
        KeyboardInterrupt
            After Ctrl-C: time has stopped at an event, and the object remains usable.
        """
        return self._advance(time, None, progress)

    def step(self, until: TimeLike | None = None) -> int:
        """Advances to the time of the next event, and executes all events of that time.

        Parameters
        ----------
        until : time, optional
            If the next event is after it, nothing happens.

        Returns
        -------
        int
            The number of events; 0 if there is no event.
        """
        return self._step(until, None)

    def next_event_time(self) -> _kinetri.Time | None:
        """The exact time of the next event; executes nothing.

        For a simulation also that of the next contact or scheduled change, or at which a shrinking radius reaches
        0. There may be no event then: if points meet, or if another triangle hides a point.

        Returns
        -------
        Time or None
            None if nothing changes any more.
        """
        return self._engine.next_event_time()

    def record(self, until: TimeLike, *, kinds: str | Iterable[str] | None = None,
               progress: Progress = False) -> Events:
        """Advances to a time and returns the events up to it.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        kinds : str or iterable of str, optional
            Only events of these kinds are kept; by default all. Each is one of `event_kinds`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        structured array of `event_dtype`, shape (events,)
            With the fields kind, time, time_lo, time_hi, removed, added, points. In a periodic box of
            `periodic_event_dtype`, also with removed_offset and added_offset. An exception has the events
            before it as its attribute `events`.

        Raises
        ------
        PreconditionError
            If a kind is unknown, or the time is in the past. Nothing has happened then.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [2, 0], [1, 2], [1, -3]], [[0, 0], [0, 0], [0, 0], [0, 1]])
        >>> events = kd.record(until=2.75)
        >>> events["kind"], events["time"], events["removed"], events["added"]
        (array(['flip'], dtype='<U12'), array([2.5]), array([[0, 1]], dtype=uint32), array([[2, 3]], dtype=uint32))
        """
        table = table_of(kinds, self._engine.box() is not None)
        try:
            self._advance(until, table, progress)
        except BaseException as error:
            error.events = take(table)  # type: ignore[attr-defined]
            raise
        return take(table)

    def events(self, until: TimeLike | None = None) -> Iterator[_kinetri.Event]:
        """Advances time, and yields the events.

        When an event is yielded, the triangulation is that just after its time, with all events of that time
        executed.

        Parameters
        ----------
        until : time, optional
            The time at which the iteration ends; by default, after the last event.

        Yields
        ------
        Event
            With an exact time.
        """
        seen = _kinetri.EventList()
        while self._step(until, seen) > 0:
            yield from seen.take()
        if until is not None:
            self.advance_to(until)

    def _advance(self, until: TimeLike, observer: _kinetri.Observer | None, progress: Progress) -> int:
        until = Time(until)
        if not progress:
            return self._go(until, observer, None)
        with progress_bar(progress, float(self.time), float(until)) as show:
            return self._go(until, observer, show)

    def _step(self, until: TimeLike | None, observer: _kinetri.Observer | None) -> int:
        return self._engine.step(until, observer)

    # ---- changes ----

    def _epoch(self) -> float:
        return float(self.time)

    def _kept(self, ids: Ids, values: dict[str, ArrayLike | None]) -> dict[str, ArrayLike | None]:
        """Fills in sizes that are not given with the present ones of the points."""
        if not self._engine.kind()[1]:
            return values
        kept = dict(values)
        now = self._epoch()
        motions = [self._engine.motion(id) for id in ids.tolist() if self._engine.contains(id)]
        if len(motions) < len(ids):
            return values
        radii = [m["radius"] if m["growth"] == 0 else m["radius"] + m["growth"] * (now - m["epoch"])
                 for m in motions]
        # The weight is the square of the radius, so it need not be negative.
        signs = [-1 if radius < 0 and isinstance(self, KineticRegular) else 1 for radius in radii]
        if values["radius"] is None:
            kept["radius"] = [abs(radius) for radius in radii]
        if values["growth"] is None:
            kept["growth"] = [sign * m["growth"] for sign, m in zip(signs, motions)]
        if values["weight"] is None:
            kept["weight"] = [m["weight"] for m in motions]
        return kept

    def _ids(self, ids: IdsLike) -> Ids:
        """The ids of the points that a caller has named."""
        if not isinstance(ids, slice):
            return _arrays.id_array("ids", ids, self.next_id)
        chosen = _arrays.id_slice("ids", ids, self.next_id)
        there: Ids = chosen[self._is_there()[chosen]].astype(np.uint32)
        return there

    def _is_there(self) -> npt.NDArray[np.bool_]:
        """By id, whether there is a point."""
        return ~np.isnan(self.radii())

    @overload
    def set_velocities(self, velocities: ArrayLike, /) -> None: ...
    @overload
    def set_velocities(self, *, velocities: ArrayLike) -> None: ...
    @overload
    def set_velocities(self, ids: IdsLike, velocities: ArrayLike) -> None: ...
    def set_velocities(self, *arguments: Any, **named: Any) -> None:
        """Sets the velocities of points from now on, all at once.

        The arguments are ``(velocities)`` for all points, or ``(ids, velocities)`` for some; they may be named.
        Each point continues from its position at `float(self.time)`, rounded to float64, and keeps its
        acceleration and radius there.

        Parameters
        ----------
        ids : int, array of ids of shape (n,), slice, or array of bool, optional
            The points, each once; by default all. A slice selects from all ids up to `next_id`; ids without a
            point are skipped. An array of bool has one for each id.
        velocities : array_like of float, shape (n, 2) or (2,)
            Two numbers for each point, in the order of `ids`; shape (2,) is one velocity for all. Without
            `ids`, two numbers for each id, NaN if there is no point, as in `velocities()`.

        Raises
        ------
        PreconditionError
            If there is no such point, one is given twice, or a shape is wrong.
        CoincidentTrajectoriesError
            If two points would coincide for a while, with ``coincident="refuse"``. Nothing is changed then.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9]], [[1, 2], [0, 1], [1, 1]])
        >>> kd.set_velocities(-0.5 * kd.velocities())
        >>> kd.set_velocities(slice(1, None), [0, 2])
        >>> kd.velocities().tolist()
        [[-0.5, -1.0], [0.0, 2.0], [0.0, 2.0]]
        """
        self._engine.set_velocities(*self._ids_and_rows("velocities", arguments, named))

    @overload
    def set_positions(self, positions: ArrayLike, /) -> None: ...
    @overload
    def set_positions(self, *, positions: ArrayLike) -> None: ...
    @overload
    def set_positions(self, ids: IdsLike, positions: ArrayLike) -> None: ...
    def set_positions(self, *arguments: Any, **named: Any) -> None:
        """Moves points to positions at which they stay at rest, now and all at once.

        The arguments are ``(positions)`` for all points, or ``(ids, positions)`` for some; they may be named.
        Radii, their growth, and weights stay. If all points move less than about a third of the distance of
        neighbors, that costs less than a new triangulation; what time brings is computed only when it is to go
        on, or is asked for (`next_event_time`).

        Parameters
        ----------
        ids : int, array of ids of shape (n,), slice, or array of bool, optional
            The points, each once, as in `set_velocities`; by default all.
        positions : array_like of float, shape (n, 2) or (2,)
            Two numbers for each point, in the order of `ids`; shape (2,) is one position for all. Without
            `ids`, two numbers for each id, NaN if there is no point, as in `positions()`.

        Raises
        ------
        PreconditionError
            If there is no such point, one is given twice, or a shape is wrong.
        CoincidentTrajectoriesError
            If two points would coincide for a while, with ``coincident="refuse"``. Nothing is changed then.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], 4 * [[0, 0]])
        >>> kd.set_positions(kd.positions() + [1, 2])
        >>> kd.set_positions([3], [2, 3])
        >>> kd.positions().tolist()
        [[1.0, 2.0], [10.0, 2.0], [1.0, 11.0], [2.0, 3.0]]
        """
        self._engine.set_positions(*self._ids_and_rows("positions", arguments, named))

    def advance_through(self, positions: ArrayLike, duration: float, *, ids: IdsLike | None = None,
                        progress: Progress = False) -> int:
        """Moves points on straight lines to positions, and executes all events on the way.

        For simulations in steps that need what happens between the steps: each call begins at the present
        positions, rounded to float64, and ends at `float(self.time) + duration`, with the points exactly at
        `positions`. Velocities are rounded, so that in the end each point jumps to its position, as far as
        rounding has missed it; it stays there at rest. Radii, their growth, and weights stay.

        Parameters
        ----------
        positions : array_like of float, shape (n, 2) or (2,)
            As in `set_positions`.
        duration : float
            How long the points take.
        ids : int, array of ids of shape (n,), slice, or array of bool, optional
            The points, each once, as in `set_velocities`; by default all. The others go on.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        int
            The number of events on the way.

        Raises
        ------
        PreconditionError
            If there is no such point, one is given twice, a shape is wrong, or the end is not a finite time
            after the present. Nothing is changed then.
        PeriodicBoxError
            If a periodic box has no area in the end, or before it. Nothing is changed then.
        CoincidentTrajectoriesError
            If two points would coincide for a while, with ``coincident="refuse"``: on the way, and then nothing
            is changed; or in the end: the time is the end then, and the points still have the velocities of the way.
        KeyboardInterrupt
            After Ctrl-C: time has stopped at an event, and the points are on the way, where `advance_to` goes on. So do
            errors of `progress` leave it, and those of a `Simulation` on the way as `advance_to` does.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [9, 0], [0, 9], [5, 5]], 4 * [[0, 0]])
        >>> kd.advance_through([[0, 0], [9, 0], [0, 9], [3, 3]], 0.5)
        1
        >>> float(kd.time), kd.positions()[3].tolist()
        (0.5, [3.0, 3.0])
        """
        chosen, ends = self._ids_and_rows(
            "positions", (positions,) if ids is None else (ids, positions), {})
        now = float(self.time)
        end = now + _arrays.one_number("duration", duration)
        if not (np.isfinite(end) and end > self.time):
            raise PreconditionError(
                f"a duration of {duration} from time {now}; expected one that ends later, at a finite time")
        self._engine.check_can_advance_to(end)
        here = self.positions()[chosen]
        with np.errstate(over="ignore"):  # which is refused
            velocities = (ends - here) / (end - now)
        self._set_motions(chosen, here, velocities, None, None)
        events = self.advance_to(end, progress=progress)
        self._engine.set_positions(chosen, ends)
        return events

    def _ids_and_rows(self, name: str, arguments: tuple[Any, ...],
                      named: dict[str, Any]) -> tuple[Ids, Floats]:
        """The ids, and two numbers for each, of arguments ``(rows)`` or ``(ids, rows)``."""
        names = (name,) if len(arguments) + len(named) == 1 else ("ids", name)
        given = {**dict(zip(names, arguments)), **named}
        if set(given) != set(names) or len(arguments) + len(named) != len(names):
            raise TypeError(f"set_{name}() takes {name}, or ids and {name}")
        values = given[name]
        if values is None:
            raise PreconditionError(f"{name} is None; expected two numbers for each point")
        if "ids" in given:
            ids = self._ids(given["ids"])
            return ids, _arrays.rows(name, values, len(ids), copies=len(ids))
        size = self.next_id
        if len(self) == size:
            return np.arange(size, dtype=np.uint32), _arrays.rows(name, values, size, copies=size)
        is_there = self._is_there()
        return np.flatnonzero(is_there).astype(np.uint32), _arrays.rows_by_id(name, values, is_there)

    def _set_motions(self, ids: IdsLike, positions: ArrayLike, velocities: ArrayLike,
                     acceleration: ArrayLike | None, jerk: ArrayLike | None,
                     **sizes: ArrayLike | None) -> None:
        ids = self._ids(ids)
        sizes = {"radius": None, "growth": None, "weight": None, **sizes}
        positions, velocities, acceleration, jerk = _vectors(
            positions, velocities, acceleration, jerk, len(ids))
        motions, _ = _motions(positions, velocities, acceleration, jerk,
                              **self._kept(ids, sizes), epoch=self._epoch())
        self._engine.set_motions(ids, motions)

    def _insert(self, positions: ArrayLike, velocities: ArrayLike | None, acceleration: ArrayLike | None,
                jerk: ArrayLike | None, masses: ArrayLike | None = None,
                **sizes: ArrayLike | None) -> Ids:
        sizes = {"radius": None, "growth": None, "weight": None, **sizes}
        positions, velocities, acceleration, jerk = _vectors(
            positions, velocities, acceleration, jerk)
        motions, size = _motions(positions, velocities, acceleration, jerk, **sizes,
                                 epoch=self._epoch())
        if masses is not None:
            masses = _arrays.column("mass", masses, size)
        first = self._engine.insert(motions, masses)
        return np.arange(first, first + size, dtype=np.uint32)

    def erase(self, ids: IdsLike) -> None:
        """Erases points, now.

        Parameters
        ----------
        ids : int, array of ids of shape (n,), slice, or array of bool
            The points, each once, as in `set_velocities`.

        Raises
        ------
        PreconditionError
            If there is no such point, or one is given twice. Nothing is changed then.
        """
        self._engine.erase(self._ids(ids))

    # ---- answers ----

    def neighbors(self, id: int) -> Ids:
        """The points with an edge to a point.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        array of uint32, shape (degree,)
            Counterclockwise: for an inner point from the smallest id on, for a hull point from one hull
            neighbor to the other. In a periodic box one for each end of an edge at the point: ids may repeat, and may
            be that of the point itself (`neighbor_offsets`). Of a point that coincides with others
            for a while: if it is hidden, the point that hides it; else at the end also those that it hides, ascending.

        Raises
        ------
        PreconditionError
            If there is no such point.
        """
        return self._engine.neighbors(_arrays.one_id("id", id))

    def nearest_vertex(self, place: ArrayLike) -> int | None:
        """The point nearest to a position, exactly; with weights, the one with the least power there.

        Parameters
        ----------
        place : array_like of float, shape (2,)
            Taken exactly.

        Returns
        -------
        int or None
            The id, the smallest one of equally near points. None if there are no points. In a periodic box the point
            with the nearest image: see `KineticDelaunay.nearest_vertex_offset`.
        """
        return self._engine.nearest_vertex(*_arrays.float_array("place", place, (2,)).tolist())

    def locate(self, place: ArrayLike) -> Location:
        """The triangle, edge or point at a position, exactly.

        Parameters
        ----------
        place : array_like of float, shape (2,)
            Taken exactly.

        Returns
        -------
        Location
            In a periodic box with offsets.
        """
        kind, points, offsets = self._engine.locate(*_arrays.float_array("place", place, (2,)).tolist())
        location = Location(kind, points)
        location.offsets = offsets
        return location

    def voronoi_cell(self, id: int) -> VoronoiCell:
        """The Voronoi cell of a point; with weights, its power cell.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        VoronoiCell
            Its sides are decided exactly, and each coordinate is rounded to the nearest float64. In a periodic box it
            is around the position as `positions()` gives it, and has offsets.

        Raises
        ------
        PreconditionError
            If there is no such point.
        """
        neighbors, vertices, rays, is_empty, offsets = self._engine.voronoi_cell(_arrays.one_id("id", id))
        cell = VoronoiCell(neighbors, vertices, rays, is_empty)
        cell.offsets = offsets
        return cell

    def voronoi_areas(self, clip: ArrayLike | None = None) -> Floats:
        """The area of each point's Voronoi cell within a polygon; with weights, of its power cell.

        Parameters
        ----------
        clip : (xmin, ymin, xmax, ymax), or array_like of float, shape (m, 2)
            A box, or the vertices of a simple polygon in either order. It need not be convex. Required, except in a
            periodic box, in which cells are whole: there it must be left out.

        Returns
        -------
        array of float64, shape (n,)
            By id; they sum to the area of the polygon, or of the periodic box. Computed in float64 from the sides of the exact
            cells. Points that coincide for a while share the area of their cell equally. Of points that only meet
            the smallest id has the area, the others have 0, as do ids without a point.

        Raises
        ------
        PreconditionError
            If the polygon crosses itself or has no area; if there is none, or one in a periodic box.
        """
        if clip is None:
            if self._engine.box() is None:
                raise PreconditionError("voronoi_areas has no clip; expected a box or a polygon, since the cells of points "
                                        "at the border have no end")
            polygon = np.empty((0, 2))
        elif np.ndim(clip) == 1:
            xmin, ymin, xmax, ymax = _arrays.box_tuple("clip", clip)  # type: ignore[misc]
            polygon = np.array([[xmin, ymin], [xmax, ymin], [xmax, ymax], [xmin, ymax]])
        else:
            polygon = _arrays.point_array("clip", clip)
        return self._engine.voronoi_areas(polygon)

    def cell_areas(self, walkable: str | ArrayLike | None = None, cutoff: float | None = None) -> Floats:
        """The area of each point: that of its cell within walls, and within a distance.

        Parameters
        ----------
        walkable : str, or array_like of float, shape (m, 2), optional
            Where points can be: polygons with holes as Well-Known Text (POLYGON, MULTIPOLYGON, or a
            GEOMETRYCOLLECTION of these), or the vertices of one polygon in either order.
        cutoff : float, optional
            The greatest distance of a cell's positions from its point. `walkable` or `cutoff` must be given; in a
            periodic box, where all cells are bounded, neither need be, and `walkable` is refused.

        Returns
        -------
        array of float64, shape (n,)
            By id. If walls divide a cell, only the part that contains the point counts (in `voronoi_areas` all
            parts count). Points that coincide for a while share the area of their cell equally. 0 for a point
            outside of the walkable area (decided exactly; walls belong to it), for points that only meet except the
            one with the smallest id, for a point without a cell, and for an id without a point. The density at a
            point is 1 / area.

        Raises
        ------
        PreconditionError
            If nothing bounds the cells, or the polygon crosses itself.
        InputError
            If the text is not valid; the message says where.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[1, 2], [3, 2]], [[0, 0], [0, 0]])
        >>> kd.cell_areas("POLYGON((0 0, 4 0, 4 4, 0 4, 0 0))")
        array([8., 8.])
        """
        ids, areas = self._engine.cell_areas(cell_limits(self._engine, walkable, cutoff))
        result = np.zeros(self.next_id)
        result[ids] = areas
        return result

    def nearest_neighbors(self, k: int | None = None) -> NearestNeighbors:
        """The nearest neighbor of each point, or the k nearest in the exact order of their distances.

        Parameters
        ----------
        k : int, optional
            The number of neighbors of each point, at least 1; with k = 1 the arrays have one column.

        Returns
        -------
        NearestNeighbors
            `ids` and `distances`, by id: of shape (n,), with k of shape (n, k). If there are fewer than k other
            points, rows end with `NO_POINT` and NaN; rows of ids without a point consist of these. In a periodic box
            neighbors are images, with offsets, and there is no end of them: images of other points, and those of the
            point itself except the one in its own place.

        Raises
        ------
        PreconditionError
            If discs have radii of their own: nearest points need not be neighbors in a regular triangulation.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [3, 0], [3, 4]], [[0, 0], [0, 0], [0, 0]])
        >>> ids, distances = kd.nearest_neighbors()
        >>> ids.tolist(), distances.tolist()
        ([1, 0, 1], [3.0, 3.0, 4.0])
        >>> kd.nearest_neighbors(k=2).ids.tolist()
        [[1, 2], [0, 2], [1, 0]]
        """
        if k is not None:
            k = _arrays.count("k", k)
            if not 1 <= k <= NO_POINT:
                raise PreconditionError(f"k is {k}; expected a whole number from 1 to {NO_POINT}")
        ids, offsets = self._engine.nearest_neighbors(k)
        distances = np.full(ids.shape, np.nan)
        there = ids != NO_POINT
        places = self.positions()
        if offsets is None:
            neighbors = places[ids[there]]
        else:
            offsets = offsets.reshape(*ids.shape, 2)
            neighbors = self._engine.positions_of(ids[there], offsets[there])
        difference = neighbors - places[np.nonzero(there)[0]]
        distances[there] = np.hypot(difference[:, 0], difference[:, 1])
        nearest = NearestNeighbors(ids, distances)
        nearest.offsets = offsets
        return nearest

    def gabriel_edges(self) -> Ids:
        """The edges of the Gabriel graph, exactly, just after the present time.

        No other point is inside or on the circle with such an edge as its diameter. Of points that coincide for a
        while, the one that hides the others stands for all; each of the others has one edge, with it.

        Returns
        -------
        array of uint32, shape (k, 2)
            The ids of the ends, the smaller first; sorted.

        Raises
        ------
        PreconditionError
            If discs have radii of their own: nearest points need not be neighbors in a regular triangulation.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [6, 0], [3, 2]], [[0, 0], [0, 0], [0, 0]])
        >>> kd.gabriel_edges().tolist()
        [[0, 2], [1, 2]]
        """
        return self._engine.gabriel_edges()

    def relative_neighbor_edges(self) -> Ids:
        """The edges of the relative neighborhood graph, exactly, just after the present time.

        No other point is nearer to both ends of such an edge than these are to each other. Points that coincide for a
        while are treated as by `gabriel_edges`.

        Returns
        -------
        array of uint32, shape (k, 2)
            The ids of the ends, the smaller first; sorted. All of them are `gabriel_edges`.

        Raises
        ------
        PreconditionError
            If discs have radii of their own: nearest points need not be neighbors in a regular triangulation.
        """
        return self._engine.relative_neighbor_edges()

    def closest_pair(self) -> tuple[int, int] | None:
        """The two points nearest to each other, exactly.

        Returns
        -------
        tuple of two int, or None
            The smaller id first. None if there are fewer than two points. In a periodic box images of two points, or
            of one: see `KineticDelaunay.closest_pair_offset`. None if there are no points, there.
        """
        return self._engine.closest_pair()

    # ---- state ----

    def audit(self, level: str = "certificates") -> AuditReport:
        """Checks the object against exact static geometry.

        Parameters
        ----------
        level : {'links', 'embedding', 'delaunay', 'reference', 'certificates'}
            What is checked; each level includes the previous ones. 'reference' compares the edges with
            a static exact triangulation, 'certificates' computes every failure time anew.

        Returns
        -------
        AuditReport
            True if nothing is wrong.
        """
        return AuditReport(self._engine.audit(str(level)))

    def statistics(self) -> dict[str, Any]:
        """Counters since the start.

        Returns
        -------
        dict
            events (by kind), certificates (created, root_solves, filter_decided, exact_decided),
            instants (distinct times of events) and reconstructions.
        """
        return self._engine.statistics()

    def snapshot(self) -> Snapshot:
        """The whole state.

        Returns
        -------
        Snapshot
            It can be pickled; `restore()` makes an object that behaves from here on exactly like this one.
        """
        return self._snapshot("none")

    def _snapshot(self, response: str) -> Snapshot:
        attributes = {name: value for name, value in vars(self).items() if name != "_engine"}
        return Snapshot(type(self), self._engine.snapshot(response), attributes)

    def save(self, path: Path) -> None:
        """Writes the state to a checkpoint file atomically.

        The program reads it: ``kinetri resume PATH --until T``.

        Parameters
        ----------
        path : str or path
            The file. An existing file is replaced.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        self._engine.save(str(path), "none")

    @classmethod
    def load(cls: type[_Points], path: Path) -> _Points:
        """Restores an object from a checkpoint file.

        Parameters
        ----------
        path : str or path
            A file written by `save`, or by the program.

        Raises
        ------
        InputError
            If it is not such a file.
        SnapshotError
            If the state is that of another class.
        """
        engine = _kinetri.load(str(path), False, None)[0]
        kind = KineticRegular if engine.kind()[1] else KineticDelaunay
        if issubclass(cls, KineticRegular) != issubclass(kind, KineticRegular):
            raise SnapshotError(f"{path}: the state is that of a {kind.__name__}; expected that of a "
                                f"{cls.__name__}")
        return cls._around(engine)

    @classmethod
    def _around(cls: type[_Points], engine: _kinetri.Engine, **attributes: Any) -> _Points:
        result = cls.__new__(cls)
        result._engine = engine
        vars(result).update(attributes)
        return result

    @classmethod
    def _restored(cls: type[_Points], state: bytes, attributes: dict[str, Any]) -> _Points:
        raise NotImplementedError

    def __reduce__(self) -> tuple[Any, ...]:
        return Snapshot.restore, (self.snapshot(),)

    def __repr__(self) -> str:
        name = type(self).__name__
        try:
            return f"<{name} of {len(self)} points at t = {float(self.time):.6g}>"
        except PreconditionError as error:  # in use, or interrupted within an instant
            return f"<{name}: {error}>"

    # ---- pictures ----

    def play(self, until: TimeLike, *, title: str | None = None, names: Sequence[str] | None = None,
             most_events: int = 200_000, height: int = 640, progress: Progress = False) -> Page:
        """Advances to a time and returns the viewer's page of the run, which a notebook shows.

        Parameters
        ----------
        until : time
            As in `advance_to`.
        title : str, optional
            Of the page.
        names : sequence of str, optional
            Of the points, by id.
        most_events : int
            A run with more events is thinned to that many rows.
        height : int
            Of the frame in a notebook, in pixels.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        Page
            `save(path)` writes it to a file that any browser opens.
        """
        until = Time(until)
        recorder = self._engine.recorder(float(until), _arrays.count("most_events", most_events))
        self._advance(until, recorder, progress)
        content = self._engine.page(recorder, title or repr(self)[1:-1], list(names or []),
                                    *self._engine.box_and_radius())
        return Page(content, height)

    def plot(self, ax: Any = None, *, ids: bool = False, **style: Any) -> Any:
        """Draws the present triangulation with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            The axes; by default the current ones.
        ids : bool
            Whether to write the ids.
        **style
            For the lines of the edges: color, linewidth, ...

        Returns
        -------
        matplotlib.axes.Axes
        """
        from ._plot import draw

        return draw(self, ax, ids, style)

    # ---- periodic boxes ----

    def edge_offsets(self) -> Offsets:
        """In a periodic box, which image of the second end of each edge is meant.

        Returns
        -------
        array of int32, shape (m, 2)
            In the order of `edges()`: how often each lattice vector is added to the position of the second end, as
            `positions()` gives it. An edge from a point to its own image has the greater of its two offsets.

        Raises
        ------
        PreconditionError
            If there is no box.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [3, 1]], [[0, 0], [0, 0]], box=(4, 4))
        >>> (a, b), offsets, places = kd.edges().T, kd.edge_offsets(), kd.positions()
        >>> vectors = places[b] + offsets @ kd.box.vectors_at(kd.time) - places[a]
        >>> len(vectors), vectors[0].tolist()
        (6, [0.0, 4.0])
        """
        return self._engine.edge_offsets()

    def triangle_offsets(self) -> Offsets:
        """In a periodic box, which images the corners of each triangle are.

        Returns
        -------
        array of int32, shape (k, 3, 2)
            In the order of `triangles()`: the offset of each corner against the first one, (0, 0) for that, as in
            `edge_offsets`.

        Raises
        ------
        PreconditionError
            If there is no box.
        """
        return self._engine.triangle_offsets().reshape(-1, 3, 2)

    def neighbor_offsets(self, id: int) -> Offsets:
        """In a periodic box, which images of its neighbors have an edge to a point.

        Parameters
        ----------
        id : int
            The point.

        Returns
        -------
        array of int32, shape (degree, 2)
            In the order of `neighbors(id)`, as in `edge_offsets`. That of a point that coincides with it for a while
            is the offset of the image in the same place.

        Raises
        ------
        PreconditionError
            If there is no box, or no such point.
        """
        return self._engine.neighbor_offsets(_arrays.one_id("id", id))

    def nearest_vertex_offset(self, place: ArrayLike) -> tuple[int, int] | None:
        """In a periodic box, which image of the point `nearest_vertex(place)` is nearest to a position.

        Parameters
        ----------
        place : array_like of float, shape (2,)
            Taken exactly. It may be anywhere, less than 2^31 lattice vectors away from the points.

        Returns
        -------
        tuple of two int, or None
            How often each lattice vector is added to the position of the point, as `positions()` gives it. Of equally
            near images the one of the smallest id, then the smallest offset. None if there are no points.

        Raises
        ------
        PreconditionError
            If there is no box.
        PeriodicBoxError
            If the position is too far away.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [3, 1]], [[0, 0], [0, 0]], box=(4, 4))
        >>> kd.nearest_vertex([8.5, 0]), kd.nearest_vertex_offset([8.5, 0])
        (0, (2, 0))
        >>> kd.locate([8.5, 0]).offsets
        ((2, 0), (2, -1), (2, 0))
        """
        return self._engine.nearest_vertex_offset(*_arrays.float_array("place", place, (2,)).tolist())

    def closest_pair_offset(self) -> tuple[int, int] | None:
        """In a periodic box, which image of the second point of `closest_pair()` is meant.

        Returns
        -------
        tuple of two int, or None
            As in `edge_offsets`. Of equally near pairs that with the smallest ids, then the smallest offset. None if
            there are no points.

        Raises
        ------
        PreconditionError
            If there is no box.

        Examples
        --------
        >>> import kinetri
        >>> kd = kinetri.KineticDelaunay([[0, 0], [3, 1]], [[0, 0], [0, 0]], box=(4, 4))
        >>> kd.closest_pair(), kd.closest_pair_offset()
        ((0, 1), (-1, 0))
        >>> kd.nearest_neighbors(k=3).offsets[0].tolist()
        [[-1, 0], [-1, -1], [0, 0]]
        """
        return self._engine.closest_pair_offset()


class KineticDelaunay(MovingPoints):
    """The Delaunay triangulation of moving points, exact at every time.

    Parameters
    ----------
    positions : array_like of float, shape (n, 2)
        Positions at `start`, not rounded. Input may be degenerate: collinear, cocircular, or coinciding.
    velocities : array_like of float, shape (n, 2)
        Their velocities there.
    acceleration, jerk : array_like of float, shape (n, 2), optional
        The second and third derivatives at `start`.
    start : float or Time
        The time at which the run begins. Positions are those at `float(start)`.
    coincident : {'hide', 'refuse'}
        What happens to points that coincide for a while, now or after a change: the one with the least id hides the
        others (see `MovingPoints`), or they are an error. Copies, snapshots and files keep it.
    box : Box, optional
        A periodic box; or what `Box` takes as its first argument: two lengths, two lattice vectors, a box of freud, a
        cell or an Atoms of ASE. Points may be, and go, anywhere: only their positions modulo the lattice matter. There
        is no hull, and n points have 3n edges and 2n triangles, from one point on. What is not possible in a
        periodic box raises a PreconditionError that says so: acceleration, hulls, walkable areas,
        proximity graphs, `spanning_tree`, `certificates`, pages.

    Raises
    ------
    PreconditionError
        If a number is not finite, a shape is wrong, `box` is something else, or `coincident` is another word.
    PeriodicBoxError
        If the area of the box is not positive at `start`. `advance_to` raises it, and nothing happens, if the area
        would become zero before the time or at it; `step` executes only events before that.
    CoincidentTrajectoriesError
        If two points coincide for a while, and `coincident` is 'refuse'.

    Examples
    --------
    >>> import numpy as np, kinetri
    >>> rng = np.random.default_rng(1)
    >>> kd = kinetri.KineticDelaunay(rng.uniform(0, 100, (1000, 2)), rng.uniform(-5, 5, (1000, 2)))
    >>> events = kd.record(until=0.1)
    >>> kd.time == 0.1, kd.positions().shape, kd.triangles().shape[1], bool(kd.audit("delaunay"))
    (True, (1000, 2), 3, True)

    One point in a periodic box under shear:

    >>> kd = kinetri.KineticDelaunay([[0, 0]], [[0, 0]], box=kinetri.Box.shear(1, 1, 1))
    >>> kd.edges().tolist(), kd.edge_offsets().tolist()
    ([[0, 0], [0, 0], [0, 0]], [[0, 1], [1, -1], [1, 0]])
    """

    def __init__(self, positions: ArrayLike, velocities: ArrayLike, *, acceleration: ArrayLike | None = None,
                 jerk: ArrayLike | None = None, start: TimeLike = 0.0, coincident: str = "hide",
                 box: Any = None) -> None:
        self._engine = _triangulation(positions, velocities, acceleration, jerk, start, coincident=coincident,
                                      lattice=None if box is None else box_of(box)._numbers)

    @classmethod
    def _at(cls, positions: Floats, velocities: Floats, acceleration: Floats | None, jerk: Floats | None,
            epoch: float, start: TimeLike, coincident: str) -> KineticDelaunay:
        """A triangulation of the points at the time `start`, with motions of another epoch."""
        return cls._around(
            _triangulation(positions, velocities, acceleration, jerk, start, epoch, coincident=coincident))

    @property
    def box(self) -> Box | None:
        """Box or None: the periodic box. After `reverse` it is the mirrored one."""
        lattice = self._engine.box()
        return None if lattice is None else Box._of(lattice)

    # ---- time ----

    def reverse(self) -> int:
        """Reverses time: from now on the time t is called -t.

        Past events come again in reverse order, at mirrored times. Motions that were replaced do not
        come back.

        Returns
        -------
        int
            The number of events of the present time, which are reversed at once.
        """
        return self._engine.reverse()

    # ---- state ----

    @classmethod
    def _restored(cls: type[_Delaunay], state: bytes, attributes: dict[str, Any]) -> _Delaunay:
        return cls._around(_kinetri.restore(state, False, None), **attributes)

    # ---- changes ----

    def set_motions(self, ids: IdsLike, positions: ArrayLike, velocities: ArrayLike, *,
                    acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None) -> None:
        """Sets the motions of points from now on, all at once. Positions may jump.

        Parameters
        ----------
        ids : int, array of ids of shape (n,), slice, or array of bool
            The points, each once, as in `set_velocities`.
        positions : array_like of float, shape (n, 2)
            Positions at `float(self.time)`. For one point, the shape (2,) is enough, here and below.
        velocities : array_like of float, shape (n, 2)
            Their velocities there.
        acceleration, jerk : array_like of float, shape (n, 2), optional
            Only if the object was made with one of them; 0 by default.

        Raises
        ------
        PreconditionError
            If there is no such point, one is given twice, or a shape is wrong.
        CoincidentTrajectoriesError
            If two points would coincide for a while, with ``coincident="refuse"``. Nothing is changed then.
        """
        self._set_motions(ids, positions, velocities, acceleration, jerk)

    def insert(self, positions: ArrayLike, velocities: ArrayLike, *, acceleration: ArrayLike | None = None,
               jerk: ArrayLike | None = None) -> Ids:
        """Inserts points, now.

        Parameters
        ----------
        positions, velocities, acceleration, jerk
            As in `set_motions`; (2,) is one point.

        Returns
        -------
        array of uint32, shape (n,)
            The ids of the new points.

        Raises
        ------
        CoincidentTrajectoriesError
            If two points would coincide for a while, with ``coincident="refuse"``. Nothing is changed then.
        """
        return self._insert(positions, velocities, acceleration, jerk)


class KineticRegular(KineticDelaunay):
    """The regular triangulation of moving discs, or of moving points with weights, exact at every time.

    Its dual is the power diagram. A point without a power cell of its own is hidden: it has no edges.

    Parameters
    ----------
    positions, velocities, acceleration, jerk, start, coincident
        As in `KineticDelaunay`; points coincide for a while only if their weights are equal, too.
    radius : float or array_like of float, shape (n,), optional
        Of the discs at `start`; the weight is its square.
    growth : float or array_like of float, shape (n,), optional
        Of the radius, per unit of time. A shrinking radius becomes negative after 0; the weight is its square.
    weight : float or array_like of float, shape (n,), optional
        Added to the square of the radius; of either sign.

    Raises
    ------
    PreconditionError, CoincidentTrajectoriesError
        As in `KineticDelaunay`.

    Examples
    --------
    >>> import kinetri
    >>> kr = kinetri.KineticRegular([[0, 0], [4, 0], [0, 4], [1, 0.5]], [[0, 0]] * 4, radius=[3, 1, 1, 0.5])
    >>> kr.hidden_points().tolist()
    [3]
    """

    def __init__(self, positions: ArrayLike, velocities: ArrayLike, *, radius: ArrayLike | None = None,
                 growth: ArrayLike | None = None, weight: ArrayLike | None = None,
                 acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None,
                 start: TimeLike = 0.0, coincident: str = "hide") -> None:
        self._engine = _triangulation(positions, velocities, acceleration, jerk, start,
                                      sizes=(radius, growth, weight), coincident=coincident)

    def set_motions(self, ids: IdsLike, positions: ArrayLike, velocities: ArrayLike, *,
                    acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None,
                    radius: ArrayLike | None = None, growth: ArrayLike | None = None,
                    weight: ArrayLike | None = None) -> None:
        """Sets the motions and sizes of points from now on, all at once.

        Parameters
        ----------
        ids, positions, velocities, acceleration, jerk
            As in `KineticDelaunay.set_motions`.
        radius, growth, weight : float or array_like of float, shape (n,), optional
            By default unchanged; a growing radius is rounded.
        """
        self._set_motions(ids, positions, velocities, acceleration, jerk, radius=radius, growth=growth,
                          weight=weight)

    def insert(self, positions: ArrayLike, velocities: ArrayLike, *, acceleration: ArrayLike | None = None,
               jerk: ArrayLike | None = None, radius: ArrayLike | None = None,
               growth: ArrayLike | None = None, weight: ArrayLike | None = None) -> Ids:
        """Inserts points, now.

        Parameters
        ----------
        positions, velocities, acceleration, jerk, radius, growth, weight
            As in `set_motions`; 0 by default.

        Returns
        -------
        array of uint32, shape (n,)
            The ids of the new points.
        """
        return self._insert(positions, velocities, acceleration, jerk, radius=radius, growth=growth,
                            weight=weight)


class Simulation(MovingPoints):
    """Moving points or discs in a box, with collisions; every contact is exact.

    Parameters
    ----------
    positions, velocities, acceleration, jerk, start, coincident
        As in `KineticDelaunay`; discs coincide for a while only if their radii are equal, too.
    radius : float or array_like of float, shape (n,), optional
        Of the discs at `start`.
    growth : float or array_like of float, shape (n,), optional
        Of the radii, per unit of time.
    mass : float, array_like of float, shape (n,), or 'area', optional
        Greater than 0; 1 by default; 'area' is the square of the radius.
    box : (xmin, ymin, xmax, ymax) or Box, optional
        Walls that reflect; or a periodic box: a `Box`, a box of freud or an Atoms of ASE. In it discs collide with images
        of others: an event has the offset of the image of the second point in `added_offset`. With collisions points must
        not coincide for a while, whatever `coincident` says. What is not possible there raises a PreconditionError that
        says so: what `KineticDelaunay` lists and, if radii differ or grow, queries.
    rim : bool
        Whether walls reflect the boundary of a disc, instead of its center.
    collisions : {None, 'log', 'swap', 'elastic', 'stop', 'remove'} or callable
        What happens when two discs touch. A function is called with a `Contact` and returns None (they pass
        through each other), two velocities, or a `Response`. It must not use the simulation. In a periodic box the
        contact has the velocity of the image, and the new velocity is one of the image.
    refuse_overlaps : bool, optional
        Whether discs that overlap at the start are an error; by default if radii differ or grow, and
        `collisions` is neither None nor 'log'.

    Raises
    ------
    PreconditionError
        If a number is not finite or a size is not valid.
    OutsideBoxError, OverlappingDiscsError, NegativeRadiusError, CoincidentTrajectoriesError
        If the start is impossible.
    OwnImageError
        If a disc overlaps its own image; `advance_to` raises it when a disc would meet its own image, since the box
        moves or the disc grows.

    Examples
    --------
    >>> import kinetri
    >>> sim = kinetri.Simulation([[0, 0], [10, 0]], [[1, 0], [-1, 0]], radius=1, collisions="elastic")
    >>> events = sim.record(until=6.0)
    >>> events["kind"][-1], float(events["time"][-1]), sim.velocities().tolist(), sim.energy()
    ('collision', 4.0, [[-1.0, 0.0], [1.0, 0.0]], 1.0)

    In a periodic box the second disc meets the image of the first one:

    >>> sim = kinetri.Simulation([[0, 0], [4, 0]], [[0, 0], [1, 0]], radius=1, collisions="elastic", box=kinetri.Box((8, 8)))
    >>> event = sim.record(until=3.0, kinds="collision")[0]
    >>> float(event["time"]), event["points"].tolist(), event["added_offset"].tolist(), sim.velocities().tolist()
    (2.0, [0, 1], [-1, 0], [[1.0, 0.0], [0.0, 0.0]])
    """

    def __init__(self, positions: ArrayLike, velocities: ArrayLike, *, radius: ArrayLike | None = None,
                 growth: ArrayLike | None = None, mass: ArrayLike | str | None = None,
                 box: Any = None, rim: bool = False, collisions: Collisions = None,
                 refuse_overlaps: bool | None = None, acceleration: ArrayLike | None = None,
                 jerk: ArrayLike | None = None, start: TimeLike = 0.0, coincident: str = "hide") -> None:
        start = Time(start)
        refuses_coincident = _coincidence.are_refused(coincident)
        size = len(_arrays.point_array("positions", positions))
        given: Any = (radius, growth)
        if radius is not None:
            radius = _arrays.column("radius", radius, size)
        if growth is not None:
            growth = _arrays.column("growth", growth, size)
        if isinstance(mass, str):
            mass = self._masses_by_name(mass, radius)
        masses = None if mass is None else _arrays.column("mass", mass, size)
        # Also if there are no points yet.
        grows = growth is not None and bool(np.any(np.asarray(given[1]) != 0))
        differs = grows or (radius is not None and (
            bool(np.any(radius != radius[:1])) or np.shape(given[0]) == (0,)))
        common_radius = 0.0
        if not differs:
            if radius is not None:
                common_radius = float(np.ravel(given[0])[0])
            radius = growth = None
        motions, _ = _motions(positions, velocities, acceleration, jerk,
                              radius if differs else None, growth, None, float(start))
        walls = _arrays.box_tuple("box", box, ", or a kinetri.Box, which is periodic") if is_walls(box) else None
        lattice = None if is_walls(box) else box_of(box)
        if lattice is not None and rim:
            raise PreconditionError("rim is True, but a periodic box has no walls; expected rim=False")
        if differs and radius is None:
            raise PreconditionError("growth without radius; expected the radii at the start")
        if refuse_overlaps is None:
            refuse_overlaps = differs and collisions not in (None, "log", "none")
        self.collisions = collisions
        self._engine = _kinetri.make_simulation(
            motions, acceleration is not None or jerk is not None, differs, start,
            walls, bool(rim), common_radius, engine_response(collisions), bool(refuse_overlaps),
            refuses_coincident, masses, None if lattice is None else lattice._numbers)

    @staticmethod
    def _masses_by_name(mass: str, radius: Floats | None) -> Floats:
        if mass != "area":
            raise PreconditionError(f"mass is {mass!r}; expected numbers, or 'area'")
        if radius is None:
            raise PreconditionError("mass='area' without radius; expected radii")
        return radius * radius

    @property
    def box(self) -> Walls | Box | None:
        """(xmin, ymin, xmax, ymax), Box or None: the walls, or the periodic box."""
        lattice = self._engine.box()
        return self._engine.box_and_radius()[0] if lattice is None else Box._of(lattice)

    def masses(self) -> Floats:
        """The masses.

        Returns
        -------
        array of float64, shape (n,)
            By id; 1 if there is no point.
        """
        return self._engine.masses()

    def energy(self) -> float:
        """The kinetic energy now: half the sum of mass times squared speed.

        In a periodic box speeds are relative to its flow (`Box.flow_at`), so it does not matter which image of a point is
        meant.

        Returns
        -------
        float
            Computed in float64.
        """
        ids = self.ids
        x, y = self._velocities_in_flow()[ids].T
        with np.errstate(over="ignore"):  # then it is infinite
            return float(0.5 * np.sum(self.masses()[ids] * (x * x + y * y)))

    def _velocities_in_flow(self) -> Floats:
        velocities = self.velocities()
        box = self.box
        return velocities - box._flow(self.positions(), self.time) if isinstance(box, Box) else velocities

    def set_energy(self, energy: float) -> None:
        """A thermostat: multiplies all velocities by one factor such that `energy()` is this one, up to rounding.

        In a periodic box velocities relative to its flow are multiplied. In a box that shears, shrinks or grows, and if
        discs grow, the energy changes without end: in a long run call this now and then.

        Parameters
        ----------
        energy : float
            At least 0.

        Raises
        ------
        PreconditionError
            If the energy is negative or not finite; or if that before is 0 or not finite, so that no point moves, or
            numbers are too large or small.
        """
        wanted = _arrays.one_number("energy", energy)
        before = self.energy()
        if wanted < 0:
            raise PreconditionError(f"energy is {wanted}; expected 0 or more")
        if not (before > 0 and math.isfinite(before)):
            raise PreconditionError(f"the energy is {before}, so that no factor makes it {wanted}; expected points that move, "
                                    "and numbers near 1, in other units perhaps")
        change = math.sqrt(wanted / before) - 1
        if change == 0:
            return
        ids = self.ids
        velocities = self.velocities() + change * self._velocities_in_flow()
        self.set_velocities(ids, velocities[ids])

    def pressure(self, times: ArrayLike, *, progress: Progress = False) -> pd.DataFrame:
        """Advances to several times and returns the mean pressure between them, by the virial theorem.

        For discs that collide in a periodic box, which has no wall to measure the pressure at. In the flow of the box, u
        is the velocity of a disc and m its mass; at a collision, q is the momentum that the second disc gets, and r the
        vector to the center of the image that the first one touches. The pressure tensor is the mean over time of the sum
        of m u u^T over the discs and, per unit of time, of q r^T over the collisions, divided by the area.

        Parameters
        ----------
        times : array_like of float, shape (k,)
            Ascending, after `self.time`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            from, until, collisions, energy, pressure, xx, xy, yy: a row for each interval, the first from now; the number
            of contacts in it, `energy()` at its end, and the means of the pressure and of the components of its tensor.
            Computed in float64.

        Raises
        ------
        PreconditionError
            If the box is not periodic, or the times are not ascending.

        Examples
        --------
        Without collisions it is the energy, divided by the area:

        >>> import kinetri
        >>> gas = kinetri.Simulation([[1, 1], [3, 2]], [[1, 0], [0, -1]], box=kinetri.Box((4, 4)))
        >>> gas.pressure([2.0])[["until", "collisions", "energy", "pressure"]].round(4).values.tolist()
        [[2.0, 0.0, 1.0, 0.0625]]
        """
        import pandas as pd

        ends = _arrays.float_array("times", times, (None,))
        steps = np.diff(ends, prepend=float(self.time))
        if np.any(steps <= 0):
            i = int(np.argmax(steps <= 0))
            before = f"times[{i - 1}]" if i > 0 else f"the time now, {float(self.time)}"
            raise PreconditionError(f"times[{i}] is {ends[i]}, not after {before}; expected ascending times")
        watch = self.watch("pressure")
        rows = []
        with progress_bar(progress, float(self.time), float(ends[-1]) if len(ends) > 0 else float(self.time)) as show:
            for end in ends:
                self._go(Time(end), None, show)
                rows.append(pd.DataFrame(watch.table()))
        return pd.concat(rows, ignore_index=True) if rows else pd.DataFrame(
            columns=["from", "until", "collisions", "energy", "pressure", "xx", "xy", "yy"])

    def set_motions(self, ids: IdsLike, positions: ArrayLike, velocities: ArrayLike, *,
                    acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None,
                    radius: ArrayLike | None = None, growth: ArrayLike | None = None) -> None:
        """Sets the motions of points from now on, all at once. Positions may jump.

        Parameters
        ----------
        ids, positions, velocities, acceleration, jerk
            As in `KineticDelaunay.set_motions`.
        radius, growth : float or array_like of float, shape (n,), optional
            Only if discs have radii of their own. By default unchanged.

        Raises
        ------
        OutsideBoxError, CoincidentTrajectoriesError, NegativeRadiusError, OwnImageError
            Nothing is changed then.
        """
        self._set_motions(ids, positions, velocities, acceleration, jerk, radius=radius, growth=growth)

    def closest(self, number: int = 10, *, until: TimeLike, progress: Progress = False) -> pd.DataFrame:
        """Advances to a time and returns the closest approaches.

        Parameters
        ----------
        number : int
            How many.
        until : time
            As in `advance_to`.
        progress : bool or callable
            As in `advance_to`.

        Returns
        -------
        pandas.DataFrame
            a, b (ids), time, time_lo, time_hi, distance, and gap if there are discs: the pairs with the least
            gaps (for points, distances) while they were neighbors, in the exact order of the gaps, with the
            first time at which each pair was nearest. Each number is the float64 nearest to the exact one. The
            first pair is the closest of all pairs. A point erased and one inserted at the same time both exist
            at that time. In a periodic box also k and l, the offset of the image of b that a approaches; a and b
            may be one point.

        Raises
        ------
        PreconditionError
            If points accelerate.
        """
        return self._answer(self.watch("closest", number=number), until, progress)

    def set_masses(self, ids: IdsLike, masses: ArrayLike) -> None:
        """Sets the masses of points from now on.

        Parameters
        ----------
        ids : int, array of ids of shape (n,), slice, or array of bool
            The points, as in `set_velocities`.
        masses : float or array_like of float, shape (n,)
            Greater than 0.
        """
        ids = self._ids(ids)
        self._engine.set_masses(ids, _arrays.column("masses", masses, len(ids)))

    def insert(self, positions: ArrayLike, velocities: ArrayLike, *, acceleration: ArrayLike | None = None,
               jerk: ArrayLike | None = None, radius: ArrayLike | None = None,
               growth: ArrayLike | None = None, mass: ArrayLike | None = None) -> Ids:
        """Inserts points, now.

        Parameters
        ----------
        positions, velocities, acceleration, jerk
            As in `KineticDelaunay.insert`.
        radius, growth : float or array_like of float, shape (n,), optional
            Only if discs have radii of their own; 0 by default.
        mass : float or array_like of float, shape (n,), optional
            1 by default.

        Returns
        -------
        array of uint32, shape (n,)
            The ids of the new points.

        Raises
        ------
        OutsideBoxError, OverlappingDiscsError, CoincidentTrajectoriesError
            No point is inserted then; their ids are not used again.
        """
        return self._insert(positions, velocities, acceleration, jerk, masses=mass, radius=radius,
                            growth=growth)

    def _scheduled(self, time: TimeLike, position: ArrayLike, velocity: ArrayLike,
                   acceleration: ArrayLike | None, jerk: ArrayLike | None, radius: float | None,
                   growth: float | None) -> _kinetri.Motions:
        time = Time(time)
        one = {"positions": position, "velocities": velocity, "acceleration": acceleration, "jerk": jerk}
        vectors: Any = {name: None if value is None else
                        _arrays.float_array(name, value, (2,)).reshape(1, 2) for name, value in one.items()}
        motions, _ = _motions(**vectors, radius=radius, growth=growth, weight=None, epoch=float(time))
        return motions

    def schedule_insert(self, time: TimeLike, position: ArrayLike, velocity: ArrayLike, *,
                        acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None,
                        radius: float | None = None, growth: float | None = None,
                        mass: float = 1.0) -> int:
        """Schedules the insertion of a point.

        Changes of one time are made after its other events: first erasures, then motions, then insertions. A
        change that is impossible then (outside of the box, or to the motion of another point if such points are
        refused) is dropped, and the call that reaches its time raises the error.

        Parameters
        ----------
        time : time
            The time of the change; not before `self.time`.
        position, velocity, acceleration, jerk : array_like of float, shape (2,)
            The motion at `float(time)`.
        radius, growth, mass : float, optional
            As in `insert`.

        Returns
        -------
        int
            The id of the point.
        """
        return self._engine.schedule_insert(
            time, self._scheduled(time, position, velocity, acceleration, jerk, radius, growth),
            _arrays.one_number("mass", mass))

    def schedule_motion(self, time: TimeLike, id: int, position: ArrayLike, velocity: ArrayLike, *,
                        acceleration: ArrayLike | None = None, jerk: ArrayLike | None = None,
                        radius: float | None = None, growth: float | None = None) -> None:
        """Schedules another motion of a point; see `schedule_insert`.

        Parameters
        ----------
        time : time
            The time of the change; not before `self.time`.
        id : int
            The point; the change is dropped if it does not exist then.
        position, velocity, acceleration, jerk, radius, growth
            As in `schedule_insert`.
        """
        self._engine.schedule_motion(
            time, _arrays.one_id("id", id),
            self._scheduled(time, position, velocity, acceleration, jerk, radius, growth))

    def schedule_erase(self, time: TimeLike, id: int) -> None:
        """Schedules the erasure of a point; see `schedule_insert`.

        Parameters
        ----------
        time : time
            The time of the change; not before `self.time`.
        id : int
            The point; the change is dropped if it does not exist then.
        """
        self._engine.schedule_erase(time, _arrays.one_id("id", id))

    # ---- state ----

    def _response_name(self) -> str:
        return self.collisions if isinstance(self.collisions, str) else "none"

    def snapshot(self) -> Snapshot:
        """The whole state, with the response; see `MovingPoints.snapshot`."""
        return self._snapshot(self._response_name())

    def save(self, path: Path) -> None:
        """Writes the state to a checkpoint file; see `MovingPoints.save`.

        A response that is a function is not saved.
        """
        self._engine.save(str(path), self._response_name())

    @classmethod
    def load(cls: type[_Simulation], path: Path,
             collisions: Collisions | EllipsisType = ...) -> _Simulation:
        """Restores a simulation from a checkpoint file.

        Parameters
        ----------
        path : str or path
            A file written by `save`, or by the program.
        collisions : optional
            The response, as in `Simulation`; by default the one named in the file.

        Raises
        ------
        InputError
            If it is not such a file.
        """
        response = ... if collisions is ... else engine_response(collisions)
        engine, name = _kinetri.load(str(path), True, response)
        return cls._around(engine, collisions=name if collisions is ... else collisions)

    @classmethod
    def _restored(cls: type[_Simulation], state: bytes, attributes: dict[str, Any]) -> _Simulation:
        response = engine_response(attributes["collisions"])
        return cls._around(_kinetri.restore(state, True, response), **attributes)
