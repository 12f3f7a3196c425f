# SPDX-License-Identifier: GPL-3.0-or-later
"""Snapshots."""
from __future__ import annotations

import hashlib
from typing import Any


class Snapshot:
    """The complete state of an object, to be restored later or elsewhere.

    A snapshot can be pickled, and sent to another process. The restored object behaves exactly like the
    original: the same events at the same exact times.

    Attributes
    ----------
    state : bytes
        The content of a checkpoint file.
    """

    def __init__(self, restorer: type[Any], state: bytes, attributes: dict[str, Any]) -> None:
        self._restorer = restorer
        self.state = state
        self._attributes = attributes  # responses that the engine does not have

    def restore(self) -> Any:
        """A new object with this state.

        Returns
        -------
        KineticDelaunay, KineticRegular or Simulation
            An object of the original class.
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
