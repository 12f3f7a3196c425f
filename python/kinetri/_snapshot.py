# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots."""
from __future__ import annotations

import hashlib
from typing import Any


class Snapshot:
    """The whole state of an object, to be restored later or elsewhere.

    A snapshot can be pickled, and sent to another process. What is restored of it goes on as the
    object would have: the same events at the same exact times.

    Attributes
    ----------
    state : bytes
        The content of a checkpoint file.
    """

    def __init__(self, restorer: type[Any], state: bytes, attributes: dict[str, Any]) -> None:
        self._restorer = restorer
        self.state = state
        self._attributes = attributes  # those that the engine does not have

    def restore(self) -> Any:
        """A new object with this state.

        Returns
        -------
        KineticDelaunay, KineticRegular or Simulation
            Of the class that the snapshot was taken of.
        """
        return self._restorer._restored(self.state, self._attributes)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Snapshot):
            return NotImplemented
        return self.state == other.state and self._restorer is other._restorer

    def __hash__(self) -> int:
        return hash(self.state)

    def __repr__(self) -> str:
        digest = hashlib.sha256(self.state).hexdigest()[:8]
        return f"<Snapshot {self._restorer.__name__} {digest}, {len(self.state)} bytes>"
