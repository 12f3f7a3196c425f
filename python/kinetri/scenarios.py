# SPDX-License-Identifier: GPL-3.0-or-later
"""Initial points: from files, or generated."""
from __future__ import annotations

from typing import Any

from . import _kinetri
from ._arrays import count, one_number
from ._box import Box
from ._types import Floats, Path


def read_points(path: Path) -> dict[str, Any]:
    """The points of a file, as arguments of the classes.

    Parameters
    ----------
    path : str or path
        A table as the program reads it: comma separated, columns x, y, vx, vy and perhaps ax, ay, jx,
        jy, radius, growth, mass, id.

    Returns
    -------
    dict
        positions, velocities, and what of acceleration, jerk, radius, growth, mass the file has; the
        texts of the column id as `label`.

    Raises
    ------
    InputError
        The message names file and line.
    """
    return _kinetri.read_points(str(path))


def scenario(kind: str, points: int = 100, *, seed: int = 1, side: float | None = None,
             speed: float = 5.0, spacing: float = 10.0, jitter: float = 0.1,
             movers: str = "all") -> tuple[Floats, Floats]:
    """Points and velocities, as ``kinetri generate`` makes them: the same numbers everywhere.

    Parameters
    ----------
    kind : {'uniform', 'gaussian', 'constant-speed', 'one-mover', 'lattice', 'lattice-jitter'}
        The random distribution.
    points : int
        How many.
    seed : int
        Of the random numbers.
    side : float, optional
        Of the square; by default 10 sqrt(points).
    speed : float
        Bound of the velocity components, or the speed of all points.
    spacing, jitter : float
        Of lattices: distance of neighbors, and the greatest offset from the lattice.
    movers : {'none', 'one', 'columns', 'all'}
        Of lattices: which points move.

    Returns
    -------
    positions, velocities : array of float64, shape (points, 2)

    Examples
    --------
    >>> import kinetri
    >>> kd = kinetri.KineticDelaunay(*kinetri.scenario("uniform", 1000, seed=7))
    >>> len(kd)
    1000
    """
    return _kinetri.scenario(kind, count("points", points), count("seed", seed),
                             None if side is None else one_number("side", side),
                             one_number("speed", speed), one_number("spacing", spacing),
                             one_number("jitter", jitter), movers)


def packing(points: int = 1000, *, share: float = 0.8, sizes: float = 1.0, seed: int = 1,
            side: float | None = None, speed: float = 5.0, periodic: bool = False) -> dict[str, Any]:
    """Discs in a square box that cover a given share of it, and do not overlap, exactly.

    Small discs grow and collide elastically until they cover that share (Lubachevsky and Stillinger).

    Parameters
    ----------
    points : int
        How many.
    share : float
        The share of the box that the discs cover.
    sizes : float
        The radius of every second disc over that of the others.
    seed : int
        Seed of the random positions and velocities.
    side : float, optional
        Of the box; by default 10 sqrt(points).
    speed : float
        Bound of the velocity components of the result.
    periodic : bool
        Whether the box is periodic, a `Box`; then no two images of discs overlap. Else it has walls.

    Returns
    -------
    dict
        positions, velocities, radius and box: arguments of `Simulation`.

    Raises
    ------
    PackingError
        If the discs jam before they cover that share, or one meets its own image.

    Examples
    --------
    >>> import kinetri
    >>> sim = kinetri.Simulation(**kinetri.packing(50, share=0.5), collisions="elastic", rim=True)
    >>> sim.advance_to(0.1) > 0
    True
    """
    made = _kinetri.packing(count("points", points), one_number("share", share),
                            one_number("sizes", sizes), count("seed", seed),
                            None if side is None else one_number("side", side),
                            one_number("speed", speed), bool(periodic))
    if periodic:
        made["box"] = Box(made["box"][2:])
    return made
