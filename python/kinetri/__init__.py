# SPDX-License-Identifier: GPL-3.0-or-later
"""Kinetri: the Delaunay triangulation of moving points, exactly right at every time.

Arrays in, arrays out::

    import numpy as np, kinetri
    rng = np.random.default_rng(1)
    kd = kinetri.KineticDelaunay(rng.uniform(0, 100, (1000, 2)), rng.uniform(-5, 5, (1000, 2)))
    events = kd.record(until=1.0)
    kd.edges(), kd.triangles(), kd.nearest_neighbors()

- `KineticDelaunay`: points on straight lines, or with acceleration and jerk
- `Box`: a periodic box for these points, which may shear or grow
- `KineticRegular`: discs of any size, growing ones too, and points with weights
- `Simulation`: walls, and discs that collide
- `Tracks`: recorded tracks
- `sweep`, `run_in_pieces`: many runs, and long ones, on several processes or machines
- `scenario`, `packing`, `read_points`: initial points
- `to_dataframe`: events as a table of pandas
- `sturm_sequence`: the roots of a polynomial, counted exactly

Positions and times are not rounded, and every decision is exact. Returned arrays are rounded to nearest; a
`Time` is exact.
"""
from ._answers import Watch
from ._arrays import NO_POINT
from ._box import Box
from ._kinetri import Contact, Event, Time, __version__
from ._moving import (AuditReport, KineticDelaunay, KineticRegular, Location, MovingPoints,
                      NearestNeighbors, Simulation, VoronoiCell)
from ._page import Page
from ._response import Response, respond
from ._snapshot import Snapshot
from ._types import ResponseName
from .errors import (CoincidentTrajectoriesError, ContactError, ContactOverflowError, EndlessContactsError,
                     Error, InputError, InternalError, NegativeRadiusError, OutputError,
                     OutsideBoxError, OverlappingDiscsError, OwnImageError, PackingError, PeriodicBoxError,
                     PeriodicOffsetError, PreconditionError, SnapshotError, WorkerError)
from .events import event_colors, event_dtype, event_kinds, periodic_event_dtype, to_dataframe
from .pieces import run_in_pieces
from .scenarios import packing, read_points, scenario
from .sturm import RealRoot, SturmSequence, sturm_sequence
from .sweeps import parameter_list, result_table, sweep
from .tracks import Tracks

__all__ = [
    "AuditReport", "Box", "CoincidentTrajectoriesError", "Contact", "ContactError", "ContactOverflowError",
    "EndlessContactsError", "Error", "Event", "InputError", "InternalError", "KineticDelaunay",
    "KineticRegular", "Location", "MovingPoints", "NO_POINT", "NearestNeighbors", "NegativeRadiusError", "OutputError",
    "OutsideBoxError", "OverlappingDiscsError", "OwnImageError", "PackingError", "Page", "PeriodicBoxError",
    "PeriodicOffsetError", "PreconditionError", "RealRoot", "Response",
    "ResponseName", "Simulation", "Snapshot", "SnapshotError", "SturmSequence", "Time", "Tracks", "VoronoiCell",
    "Watch", "WorkerError", "__version__", "event_colors", "event_dtype", "event_kinds", "packing", "parameter_list",
    "periodic_event_dtype", "read_points", "respond", "result_table", "run_in_pieces", "scenario", "sturm_sequence", "sweep", "to_dataframe",
]
