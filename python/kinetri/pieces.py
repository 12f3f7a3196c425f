# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a long simulation of free motion in independent pieces of time.

If motions are known in advance, the triangulation just after a time depends only on the motions, so each piece
can construct its own.
"""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _arrays, _coincidence
from ._moving import KineticDelaunay, MovingPoints, Simulation
from ._types import ArrayLike, Events, Floats
from .errors import PreconditionError
from .sweeps import map_tasks

# positions, velocities, acceleration, jerk and epoch
_Motions = tuple[Floats, Floats, "Floats | None", "Floats | None", float]


def run_piece(motions: _Motions, start: float, until: float, coincident: str = "hide") -> Events:
    """The events after `start`, up to `until`.

    Parameters
    ----------
    motions : tuple
        positions, velocities, acceleration, jerk and epoch, which is the start of the run.
    start, until : float
        The piece.
    coincident : {'hide', 'refuse'}
        As of `KineticDelaunay`.

    Returns
    -------
    structured array of `event_dtype`
    """
    positions, velocities, acceleration, jerk, epoch = motions
    return KineticDelaunay._at(positions, velocities, acceleration, jerk, epoch, start, coincident).record(until)


def _borders(start: float, until: float, pieces: int) -> Floats:
    """The times at which the pieces begin and end: distinct floats."""
    borders: Floats = np.linspace(start, until, pieces + 1)
    borders[0], borders[-1] = start, until
    distinct: Floats = np.unique(borders)
    return distinct


def run_in_pieces(positions: ArrayLike, velocities: ArrayLike | None = None, until: float | None = None,
                  pieces: int = 2, client: Any = None, *, acceleration: ArrayLike | None = None,
                  jerk: ArrayLike | None = None, start: float = 0.0, coincident: str = "hide",
                  workers: int | None = None) -> Events:
    """The events of one run, computed in independent pieces of time.

    Parameters
    ----------
    positions, velocities, acceleration, jerk : array_like of float, shape (n, 2)
        The motions, as of `KineticDelaunay`.
    until : float
        The end of the run.
    pieces : int
        The number of intervals of equal length.
    client : dask.distributed.Client, optional
        Where to run; by default on processes of this machine.
    start : float
        The time at which the run begins.
    coincident : {'hide', 'refuse'}
        As of `KineticDelaunay`.
    workers : int, optional
        The number of processes, without a client.

    Returns
    -------
    structured array of `event_dtype`
        What ``KineticDelaunay(positions, velocities).record(until)`` gives, byte for byte.

    Raises
    ------
    PreconditionError
        If a simulation is given: contacts change motions, so that a piece depends on the earlier ones.
    CoincidentTrajectoriesError
        If two points coincide for a while, and `coincident` is 'refuse'.
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
    _coincidence.are_refused(coincident)
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
    tasks = [{"motions": motions, "start": a, "until": b, "coincident": coincident} for a, b in spans]
    return np.concatenate(map_tasks(run_piece, tasks, client, workers))
