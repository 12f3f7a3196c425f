# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of Kinetri, all derived from `kinetri.Error`, with the names of C++."""
from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._kinetri import Time
    from ._types import Events


class Error(Exception):
    """Base class of all exceptions of Kinetri."""


class PreconditionError(Error, ValueError):
    """An argument is not valid. The message says what is expected."""


class InternalError(Error):
    """An internal check failed: a bug in Kinetri."""


class InputError(Error, ValueError):
    """A file, or the content of a table, cannot be used. The message begins with file and line."""


class OutputError(Error, OSError):
    """A file cannot be written."""


class SnapshotError(Error, ValueError):
    """A snapshot is damaged, or not the state of an object of this class."""


class CoincidentTrajectoriesError(Error, ValueError):
    """Two points would coincide for a while, and such points are refused: `coincident="refuse"`.

    Attributes
    ----------
    ids : tuple of two int
        The points.
    """

    ids: tuple[int, int]


class ContactError(Error):
    """A contact that no response can resolve.

    Attributes
    ----------
    id : int
        The point; of two, the one with the smaller id.
    """

    id: int


class EndlessContactsError(ContactError):
    """Endless contacts: too many at one time, or ever more within less time, or points pressed together.

    Ever more contacts are those of discs without free area, or of a response that adds energy: their rate has
    increased again and again, and they seem to be infinitely many before the end of the call. A second call
    continues. Points pressed together accelerate against a wall or each other, without any speed.

    The simulation is in the state before the contact, which is still due: changing the motions of its points
    may let it continue. Its `time` and `positions` are those of the contact.

    Attributes
    ----------
    events : structured array of `event_dtype`
        The events before the error, if `record` raised it.
    """

    events: Events


class OwnImageError(ContactError):
    """A disc in a periodic box overlaps an image of itself, or would meet one, since the box moves.

    In the second case the simulation is in the state before that contact, which is still due.

    Attributes
    ----------
    offset : tuple of two int
        Of the image.
    time : Time
        When, exactly.
    events : structured array of `periodic_event_dtype`
        The events before the error, if `record` raised it.
    """

    offset: tuple[int, int]
    time: Time
    events: Events


class ContactOverflowError(ContactError):
    """After a contact a position, velocity or acceleration is beyond the range of float64."""


class OverlappingDiscsError(Error, ValueError):
    """Discs overlap, but must not.

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
        The time at or just after which the radius is negative.
    """

    id: int
    time: Time


class OutsideBoxError(Error, ValueError):
    """A point is outside of the box. The message names it.

    Attributes
    ----------
    id : int
        The id of the point, or the id that it would have got.
    """

    id: int


class PeriodicBoxError(Error, ValueError):
    """The area of a periodic box is not positive, or not at a time; or an image is too many lattice vectors away."""


class PeriodicOffsetError(Error):
    """An edge in a periodic box would get an offset of 2^31 or more: points or the box have moved too far.

    An object that was to advance, or to change its points, is then within an event: it can only be looked at. Make
    another one, from a snapshot, or with positions that are closer to each other.

    Attributes
    ----------
    ids : tuple of two int
        The ends of the edge; twice the same for an edge from a point to its own image.
    time : Time
        The time at which it would be added.
    """

    ids: tuple[int, int]
    time: Time


class PackingError(Error):
    """A packing does not reach the requested share."""


class WorkerError(Error):
    """Worker processes of a sweep ended repeatedly without a result."""
