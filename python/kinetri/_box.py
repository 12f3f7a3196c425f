# SPDX-License-Identifier: GPL-3.0-or-later
"""Periodic boxes, and what other libraries have for them."""
from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np

from . import _arrays
from ._kinetri import Time
from ._types import ArrayLike, Floats, Lattice, TimeLike
from .errors import PeriodicBoxError, PreconditionError
from .sturm import sturm_sequence

_EXPECTED = ("a kinetri.Box, two lengths (Lx, Ly), two lattice vectors of shape (2, 2), a cell of shape (3, 3) whose third "
             "vector is along z, a box of freud, or an Atoms of ASE")


class Box:
    """A periodic box: a parallelogram that is repeated all over the plane. It may shear, grow or shrink.

    It is spanned by two lattice vectors, each linear in time. A point in it stands for all its images: the point
    plus k times the first and l times the second vector. Objects do not change; they can be compared and pickled.

    Parameters
    ----------
    first : array_like of float, shape (2,), (2, 2) or (3, 3), or an object of another library
        The lengths (Lx, Ly) of a rectangle; or the lattice vectors, as rows; or a cell of ASE, whose third vector
        must be along z. Also taken are a box of freud (2-dimensional, attributes Lx, Ly, xy) and an Atoms of ASE
        (attributes cell and pbc) that are periodic along the first two vectors.
    second : array_like of float, shape (2,), optional
        The second lattice vector; then `first` is the first one, of shape (2,).
    rates : array_like of float, shape (2,) or (2, 2), optional
        By how much the lengths, or the vectors, change in a unit of time; by default nothing.
    epoch : float
        The time at which the vectors are those given.

    Raises
    ------
    PreconditionError
        If `first` is something else, a number is not finite or would be rounded, or the box is not periodic along
        both vectors.
    PeriodicBoxError
        If the second vector is not to the left of the first one at the epoch, so that the area is not positive.

    Notes
    -----
    Numbers are not rounded, except xy Ly of a box of freud. Only the lattice matters, not where the box is.

    Examples
    --------
    >>> import kinetri
    >>> box = kinetri.Box((4, 3), rates=(-1, 0))
    >>> box.vectors.tolist(), box.area(1), box.collapse_time
    ([[4.0, 0.0], [0.0, 3.0]], 9.0, Time(4.0))
    """

    def __init__(self, first: Any, second: ArrayLike | None = None, *, rates: ArrayLike | None = None,
                 epoch: float = 0.0) -> None:
        if second is None:
            vectors = _vectors("box", _lattice_of(first))
        else:
            vectors = np.stack([_arrays.float_array("first", first, (2,)), _arrays.float_array("second", second, (2,))])
        change = np.zeros((2, 2)) if rates is None else _vectors("rates", rates)
        (ax, ay), (bx, by) = vectors.tolist()
        (ax_rate, ay_rate), (bx_rate, by_rate) = change.tolist()
        self._numbers: Lattice = (ax, ay, bx, by, ax_rate, ay_rate, bx_rate, by_rate,
                                  _arrays.one_number("epoch", epoch))
        area = self._exact_area(Fraction(self.epoch))
        if area <= 0:
            raise PeriodicBoxError(
                f"the lattice vectors of the box are {self.vectors.tolist()} at its epoch, with the area {_nearest(area)}; "
                "expected a second vector to the left of the first one" + (": swap the two" if area < 0 else ""))

    @classmethod
    def shear(cls, Lx: float, Ly: float, rate: float, *, epoch: float = 0.0) -> Box:
        """A rectangle under simple shear, as by the boundary conditions of Lees and Edwards.

        The second lattice vector is (rate (t - epoch) Ly, Ly). A point at rest relative to the box has the velocity
        (rate y, 0).

        Parameters
        ----------
        Lx, Ly : float
            The lengths.
        rate : float
            The strain per unit of time. The product with `Ly` is rounded to float64.
        epoch : float
            The time at which the box is a rectangle.

        Returns
        -------
        Box

        Examples
        --------
        >>> import kinetri
        >>> kinetri.Box.shear(4, 2, 0.5).vectors_at(3).tolist()
        [[4.0, 0.0], [3.0, 2.0]]
        """
        lengths = _arrays.one_number("Lx", Lx), _arrays.one_number("Ly", Ly)
        return cls(lengths, rates=[[0.0, 0.0], [_arrays.one_number("rate", rate) * lengths[1], 0.0]], epoch=epoch)

    @property
    def vectors(self) -> Floats:
        """array of float64, shape (2, 2): the lattice vectors at the epoch, as rows."""
        return np.array(self._numbers[:4]).reshape(2, 2)

    @property
    def rates(self) -> Floats:
        """array of float64, shape (2, 2): by how much they change in a unit of time."""
        return np.array(self._numbers[4:8]).reshape(2, 2)

    @property
    def epoch(self) -> float:
        """float: the time at which the vectors are `vectors`."""
        return self._numbers[8]

    def vectors_at(self, time: TimeLike) -> Floats:
        """The lattice vectors at a time.

        An offset (k, l) stands for the vector ``offset @ box.vectors_at(time)``.

        Parameters
        ----------
        time : float, int, fractions.Fraction or Time
            Taken exactly; of an irrational `Time` the nearest float64.

        Returns
        -------
        array of float64, shape (2, 2)
            As rows, each number rounded to nearest.
        """
        return np.array([_nearest(number) for number in self._exact_vectors(_fraction_of(time))]).reshape(2, 2)

    def flow_at(self, positions: ArrayLike, time: TimeLike) -> Floats:
        """The flow of the box: the velocity of positions that keep their coordinates in the lattice vectors.

        Images of a point differ in velocity as the flow at their positions does. In a box at rest the flow is 0; in a
        sheared one it is (rate y, 0).

        Parameters
        ----------
        positions : array_like of float, shape (n, 2)
            Anywhere in the plane.
        time : float, int, fractions.Fraction or Time
            As in `vectors_at`; the area is positive then.

        Returns
        -------
        array of float64, shape (n, 2)
            Rounded.

        Examples
        --------
        >>> import kinetri
        >>> kinetri.Box.shear(4, 2, 0.5).flow_at([[1, 0], [1, 2]], 3).tolist()
        [[0.0, 0.0], [1.0, 0.0]]
        """
        return self._flow(_arrays.point_array("positions", positions), time)

    def _flow(self, positions: Floats, time: TimeLike) -> Floats:
        (ax, ay), (bx, by) = self.vectors_at(time)
        x, y = positions.T
        area = ax * by - ay * bx
        first, second = (x * by - y * bx) / area, (ax * y - ay * x) / area
        # Not by a product of matrices, which other processors round otherwise.
        return np.column_stack([first * a + second * b for a, b in self.rates.T])

    def area(self, time: TimeLike) -> float:
        """The area at a time; negative while the second vector is to the right of the first one.

        Parameters
        ----------
        time : float, int, fractions.Fraction or Time
            As in `vectors_at`.

        Returns
        -------
        float
            The exact area, rounded to nearest.
        """
        return _nearest(self._exact_area(_fraction_of(time)))

    @property
    def collapse_time(self) -> Time | None:
        """Time or None: the first time after the epoch at which the area is zero, exactly. The box cannot be used from
        then on."""
        a, b = ([Fraction(x) for x in self._numbers[i:i + 2]] for i in (0, 2))
        ra, rb = ([Fraction(x) for x in self._numbers[i:i + 2]] for i in (4, 6))
        at_0, at_1, at_2 = _cross(a, b), _cross(a, rb) + _cross(ra, b), _cross(ra, rb)
        e = Fraction(self.epoch)  # the polynomial in t - epoch becomes one in t
        area = sturm_sequence([at_0 - at_1 * e + at_2 * e * e, at_1 - 2 * at_2 * e, at_2])
        return next((root.value for root in area.roots() if root.value > e), None)

    def _exact_vectors(self, time: Fraction) -> list[Fraction]:
        since = time - Fraction(self.epoch)
        return [Fraction(x) + Fraction(rate) * since for x, rate in zip(self._numbers[:4], self._numbers[4:8])]

    def _exact_area(self, time: Fraction) -> Fraction:
        vectors = self._exact_vectors(time)
        return _cross(vectors[:2], vectors[2:])

    # ---- for the engine ----

    @classmethod
    def _of(cls, numbers: Lattice) -> Box:
        result = cls.__new__(cls)
        result._numbers = tuple(number + 0.0 for number in numbers)  # type: ignore[assignment]  # no -0
        return result

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Box):
            return NotImplemented
        return self._numbers == other._numbers

    def __hash__(self) -> int:
        return hash(self._numbers)

    def __repr__(self) -> str:
        rates = f", rates={self.rates.tolist()}" if self.rates.any() else ""
        epoch = f", epoch={self.epoch}" if rates and self.epoch != 0 else ""
        return f"Box({self.vectors.tolist()}{rates}{epoch})"


def box_of(value: Any) -> Box:
    """The argument `box` of a class."""
    return value if isinstance(value, Box) else Box(value)


def is_walls(value: Any) -> bool:
    """Whether the argument `box` of a simulation is None or numbers, and not a periodic box."""
    return not (isinstance(value, Box) or hasattr(value, "Lx") or hasattr(value, "cell"))


def _lattice_of(value: Any) -> Any:
    """An array of the lattice of an object of another library, or the argument itself."""
    if isinstance(value, Box):
        return value.vectors if not value.rates.any() else _refused("a Box whose vectors change; expected it as `box`")
    if all(hasattr(value, name) for name in ("Lx", "Ly", "xy")):  # of freud
        is_2d = getattr(value, "is2D", None)
        if not (getattr(value, "dimensions", None) == 2 if is_2d is None else bool(is_2d() if callable(is_2d) else is_2d)):
            _refused(f"{value!r}, which is 3-dimensional; expected a box in the plane")
        _expect_periodic(value, getattr(value, "periodic", True))
        Ly = _arrays.one_number("Ly", value.Ly)
        return [[value.Lx, 0.0], [_arrays.one_number("xy", value.xy) * Ly, Ly]]
    if hasattr(value, "cell") and hasattr(value, "pbc"):  # of ASE
        _expect_periodic(value, value.pbc)
        return np.asarray(value.cell)
    return value


def _refused(what: str) -> Any:
    raise PreconditionError(f"box is {what}")


def _expect_periodic(value: Any, periodic: Any) -> None:
    if not np.all(np.broadcast_to(np.asarray(periodic, dtype=bool), 3)[:2]):
        _refused(f"{value!r}, which is not periodic along both of its first two vectors; expected one that is")


def _vectors(name: str, value: Any) -> Floats:
    """Two vectors: those of lengths, or of a matrix of shape (2, 2) or (3, 3)."""
    try:
        array = np.asarray(value)
    except (ValueError, TypeError):
        array = np.asarray(None)
    expected = _EXPECTED if name == "box" else "two numbers, or shape (2, 2)"
    if array.dtype.kind not in "iuf":
        raise PreconditionError(f"{name} is {value!r}; expected {expected}")
    if array.shape == (2,):
        return np.diag(_arrays.float_array(name, value, (2,)))
    if array.shape == (3, 3) and name == "box":
        if np.any(array[:2, 2] != 0) or np.any(array[2, :2] != 0):
            raise PreconditionError(f"box is the cell {array.tolist()}; expected one whose first two vectors are in the "
                                    "plane, with z = 0, and whose third one is along z")
        return _arrays.float_array(name, array[:2, :2], (2, 2))
    if array.shape == (2, 2):
        return _arrays.float_array(name, value, (2, 2))
    walls = "; walls (xmin, ymin, xmax, ymax) are for a Simulation" if array.shape == (4,) else ""
    raise PreconditionError(f"{name} has the shape {array.shape}; expected {expected}{walls}")


def _fraction_of(time: TimeLike) -> Fraction:
    exact = Time(time)
    fraction = exact.fraction
    return Fraction(float(exact)) if fraction is None else fraction


def _cross(a: list[Fraction], b: list[Fraction]) -> Fraction:
    return a[0] * b[1] - a[1] * b[0]


def _nearest(value: Fraction) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf
