# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions that Kinetri raises: all are `kinetri.Error`. They are named as in C++."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._kinetri import Time
    from ._types import Events


class Error(Exception):
    """Base of every exception that Kinetri raises on purpose."""


class PreconditionError(Error, ValueError):
    """An argument is not what the function expects. The message says what is."""


class InternalError(Error):
    """An internal check failed: a bug in Kinetri."""


class InputError(Error, ValueError):
    """A file, or the content of a table, cannot be used. The message begins with file and line."""


class OutputError(Error, OSError):
    """A file cannot be written."""


class SnapshotError(Error, ValueError):
    """A snapshot is damaged, or not the state of such an object."""


class CoincidentTrajectoriesError(Error, ValueError):
    """Two points would be at one place at all times.

    Attributes
    ----------
    ids : tuple of two int
        The points.
    """

    ids: tuple[int, int]


class ContactError(Error):
    """A contact that no response can deal with.

    Attributes
    ----------
    id : int
        The point; of two, the one with the smaller id.
    """

    id: int


class EndlessContactsError(ContactError):
    """Contacts do not end: too many at one time, or a point that is pressed against another.

    The simulation is as it was before the contact, which is still to come at that time: other
    motions of its points may let it go on. Its `time` is that of the contact, and its `positions`
    are those of that time.

    Attributes
    ----------
    events : structured array of `event_dtype`
        Of an error that `record` raises: the events before it.
    """

    events: Events


class ContactOverflowError(ContactError):
    """After a contact a place, velocity or acceleration is beyond the range of float64."""


class OverlappingDiscsError(Error, ValueError):
    """Discs overlap where they must not.

    Attributes
    ----------
    pairs : list of [int, int]
        All pairs that overlap, sorted.
    """

    pairs: list[list[int]]


class NegativeRadiusError(Error, ValueError):
    """The radius of a disc is, or would become, negative.

    Attributes
    ----------
    id : int
        The disc.
    time : Time
        At or just after it the radius is negative.
    """

    id: int
    time: Time


class OutsideBoxError(Error, ValueError):
    """A point is outside of the box. The message names it.

    Attributes
    ----------
    id : int
        The point: the id that it has, or would have got.
    """

    id: int


class PackingError(Error):
    """A packing does not reach the share that was asked for."""


class WorkerError(Error):
    """Worker processes of a sweep ended again and again without a result."""
