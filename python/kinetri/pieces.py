# SPDX-License-Identifier: GPL-3.0-or-later
"""A long run in pieces of time that are computed alone.

Where motions are known in advance, the triangulation just after a time is that of the points as they
stand then. So each piece begins with a triangulation of its own. Only where points are cocircular or
collinear for a while can the triangulation depend on what was before: then the piece is computed again,
from the end of the one before it.
"""
from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _arrays
from ._moving import KineticDelaunay, MovingPoints, Simulation
from ._types import ArrayLike, Events, Floats, Ids
from .errors import HistoryWarning, PreconditionError
from .sweeps import map_tasks

# positions, velocities, acceleration, jerk and epoch
_Motions = tuple[Floats, Floats, "Floats | None", "Floats | None", float]


def _begin(motions: _Motions, start: float) -> KineticDelaunay:
    """The points at the time `start`, of motions whose epoch is the start of the run."""
    positions, velocities, acceleration, jerk, epoch = motions
    return KineticDelaunay._at(positions, velocities, acceleration, jerk, epoch, start)


def _recorded(kd: KineticDelaunay, until: float) -> tuple[Events, Ids, Ids]:
    """The events up to `until`, and the edges before and after."""
    before = kd.edges()
    return kd.record(until), before, kd.edges()


def run_piece(motions: _Motions, start: float, until: float) -> tuple[Events, Ids, Ids]:
    """The events after `start`, up to `until`, and the edges at both ends.

    Parameters
    ----------
    motions : tuple
        positions, velocities, acceleration, jerk and epoch.
    start, until : float
        The piece.

    Returns
    -------
    events, edges_before, edges_after : array
    """
    return _recorded(_begin(motions, start), until)


def _borders(start: float, until: float, pieces: int) -> Floats:
    """The times at which the pieces begin and end: distinct floats."""
    borders: Floats = np.linspace(start, until, pieces + 1)
    borders[0], borders[-1] = start, until
    distinct: Floats = np.unique(borders)
    return distinct


def _difference(a: Ids, b: Ids) -> list[Any]:
    """The edges that one of two sorted arrays has and the other has not."""
    if np.array_equal(a, b):
        return []
    first = {tuple(edge) for edge in a.tolist()}
    second = {tuple(edge) for edge in b.tolist()}
    return sorted(first ^ second)


def run_in_pieces(positions: ArrayLike, velocities: ArrayLike | None = None, until: float | None = None,
                  pieces: int = 2, client: Any = None, *, acceleration: ArrayLike | None = None,
                  jerk: ArrayLike | None = None, start: float = 0.0, workers: int | None = None) -> Events:
    """The events of one run, computed in pieces of time, each of them alone.

    Parameters
    ----------
    positions, velocities, acceleration, jerk : array_like of float, shape (n, 2)
        The motions, as of `KineticDelaunay`.
    until : float
        The end of the run.
    pieces : int
        How many spans of equal length.
    client : dask.distributed.Client, optional
        Where to run; by default on processes of this machine.
    start : float
        The time at which the run begins.
    workers : int, optional
        How many processes, without a client.

    Returns
    -------
    structured array of `event_dtype`
        What ``KineticDelaunay(positions, velocities).record(until)`` gives, byte for byte.

    Warns
    -----
    HistoryWarning
        Where points are cocircular or collinear for a while at a border of two pieces, so that edges
        depend on what was before. The message names the ids and the time. The later piece is computed
        again then, after the earlier one: the result is right, and takes longer.

    Raises
    ------
    PreconditionError
        If it is given a simulation: contacts change motions, so that no piece is known before those
        before it.
    """
    if isinstance(positions, MovingPoints):
        if isinstance(positions, Simulation):
            raise PreconditionError(
                "a simulation was given; expected motions: the contacts of a simulation change its "
                "motions, so that no piece of time can be computed before those before it")
        raise PreconditionError(
            f"a {type(positions).__name__} was given; expected positions and velocities")
    if velocities is None or until is None:
        raise PreconditionError("velocities and until are needed; expected positions, velocities, until")
    start = _arrays.one_number("start", start)
    until = _arrays.one_number("until", until)
    if until < start:
        raise PreconditionError(f"until is {until}; expected at least start, which is {start}")
    pieces = _arrays.count("pieces", pieces)
    if pieces < 1:
        raise PreconditionError(f"pieces is {pieces}; expected at least 1")
    positions = _arrays.point_array("positions", positions)
    size = len(positions)
    velocities = _arrays.point_array("velocities", velocities, size)
    acceleration = None if acceleration is None else _arrays.point_array(
        "acceleration", acceleration, size)
    jerk = None if jerk is None else _arrays.point_array("jerk", jerk, size)
    motions = (positions, velocities, acceleration, jerk, start)
    borders = _borders(start, until, pieces).tolist()
    if len(borders) < 2:
        borders = [start, until]
    spans = list(zip(borders[:-1], borders[1:]))
    results = map_tasks(run_piece, [{"motions": motions, "start": a, "until": b} for a, b in spans],
                        client, workers)
    previous = None  # the points at the end of the piece before, where that was computed here
    for i in range(1, len(results)):
        different = _difference(results[i - 1][2], results[i][1])
        if not different:
            previous = None
            continue
        ids = sorted({id for edge in different for id in edge})
        warnings.warn(
            f"at t = {spans[i][0]} points among {_shortened(ids)} are cocircular or collinear for a "
            f"while: the edges {_shortened(different)} depend on what was before; the piece up to "
            f"t = {spans[i][1]} is computed after the one before it", HistoryWarning, stacklevel=2)
        if previous is None:
            previous = _begin(motions, spans[i - 1][0])
            previous.advance_to(spans[i - 1][1])
        results[i] = _recorded(previous, spans[i][1])
    return np.concatenate([events for events, _, _ in results])


def _shortened(items: Sequence[Any], most: int = 12) -> str:
    text = ", ".join(str(item) for item in items[:most])
    return text if len(items) <= most else f"{text}, ... ({len(items)} in all)"
