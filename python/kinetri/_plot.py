# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures with matplotlib."""
from __future__ import annotations

from typing import Any, Protocol

import numpy as np

from ._box import Box
from ._moving import MovingPoints
from ._types import Floats, Ids


class Drawn(Protocol):
    """The data to draw."""

    def positions(self) -> Floats: ...
    def radii(self) -> Floats: ...
    def edges(self) -> Ids: ...
    def coincident_points(self, id: int) -> Ids: ...


def _in_box(points: MovingPoints, box: Box) -> tuple[Floats, Floats]:
    """The positions of images in a periodic box, and the ends of edges: each begins at such an image."""
    places, wrapped = points.positions(), points.positions(wrapped=True)
    a, b = points.edges().T
    vectors = places[b] + points.edge_offsets() @ box.vectors_at(points.time) - places[a]
    return wrapped, np.stack([wrapped[a], wrapped[a] + vectors], axis=1)


def draw(points: Drawn, ax: Any, ids: bool, style: dict[str, Any]) -> Any:
    """Draws edges, discs and points on the axes, and returns these."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import EllipseCollection, LineCollection

    if ax is None:
        ax = plt.gca()
    style = {"color": "0.55", "linewidth": 0.8, "zorder": 1, **style}
    box = getattr(points, "box", None)
    if isinstance(points, MovingPoints) and isinstance(box, Box):
        places, lines = _in_box(points, box)
    else:
        places = points.positions()
        lines = places[points.edges()]
    there = ~np.isnan(places[:, 0])
    ax.add_collection(LineCollection(lines, **style))
    radii = np.abs(points.radii()[there])
    if np.any(radii > 0):
        ax.add_collection(EllipseCollection(
            2 * radii, 2 * radii, np.zeros_like(radii), offsets=places[there], units="xy",
            transOffset=ax.transData, facecolors="tab:blue", alpha=0.35, zorder=2))
    ax.scatter(places[there, 0], places[there, 1], s=8, color="tab:blue", zorder=3)
    if ids:
        for id in np.flatnonzero(there).tolist():
            group = [id, *points.coincident_points(id).tolist()]
            if id == min(group):  # one text, where others would be written over each other
                ax.annotate(", ".join(map(str, group)), places[id], textcoords="offset points", xytext=(3, 3),
                            fontsize="small")
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax
