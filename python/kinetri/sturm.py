# SPDX-License-Identifier: GPL-3.0-or-later
"""Sturm sequences: the exact number of real roots of a polynomial in an interval."""
from __future__ import annotations

from collections.abc import Iterable, Mapping, Set
from fractions import Fraction
from typing import Any, Literal, NamedTuple

from . import _kinetri
from ._kinetri import Time
from ._types import TimeLike
from .errors import PreconditionError

# Which ends belong to an interval, by the names in pandas.
_CLOSED = {"right": (False, True), "left": (True, False), "both": (True, True), "neither": (False, False)}


class RealRoot(NamedTuple):
    """A real root of a polynomial."""

    value: Time  #: the root, exact
    multiplicity: int  #: as a root of the polynomial; at least 1


class SturmSequence:
    """The Sturm sequence of a polynomial f: f, f', and the negated remainders that follow.

    Made by `sturm_sequence`. It does not change. Two are equal if their polynomials are positive multiples of
    one another.

    V(t), the number of sign changes of the terms at t, falls by one at each distinct real root of f, and
    nowhere else. So V(a) - V(b) is the number of roots in (a, b]. Every answer is exact.
    """

    def __init__(self, sequence: _kinetri.Sturm) -> None:
        self._sequence = sequence
        self._terms = sequence.terms()

    @property
    def terms(self) -> tuple[tuple[int, ...], ...]:
        """tuple of tuple of int: the terms, each by its coefficients, by ascending power.

        Each is the term of the sequence times a positive number, such that its coefficients are integers without
        a common divisor. None is zero. The last one is gcd(f, f') up to a constant: its roots are the multiple
        roots of f, with multiplicities less by one.
        """
        return self._terms

    def signs(self, t: TimeLike) -> tuple[int, ...]:
        """The sign of each term at t.

        Parameters
        ----------
        t : float, int, fractions.Fraction or Time
            Taken exactly. It may be infinite, for all sufficiently small or large numbers.

        Returns
        -------
        tuple of int
            -1, 0 or 1 for each term. At a multiple root of f all of them are 0.

        Examples
        --------
        >>> import kinetri, math
        >>> sequence = kinetri.sturm_sequence([-2, 0, 1])
        >>> sequence.signs(0), sequence.signs(math.inf)
        ((-1, 0, 1), (1, 1, 1))
        """
        return self._sequence.signs(t)

    def sign_changes(self, t: TimeLike) -> int:
        """V(t), the number of sign changes of the terms at t; zeros are left out.

        Terms are first divided by the last one, so that V is correct also at a multiple root of f, at which all
        terms are zero. At a root V has the value just after it.

        Parameters
        ----------
        t : float, int, fractions.Fraction or Time
            Taken exactly. It may be infinite, for all sufficiently small or large numbers.

        Returns
        -------
        int

        Examples
        --------
        >>> import kinetri, math
        >>> sequence = kinetri.sturm_sequence([-2, 0, 1])
        >>> [sequence.sign_changes(t) for t in (-math.inf, 0, 2)]
        [2, 1, 0]
        """
        return self._sequence.sign_changes(t)

    def count(self, lower: TimeLike | None = None, upper: TimeLike | None = None, *,
              closed: Literal["right", "left", "both", "neither"] = "right") -> int:
        """The number of distinct real roots of the polynomial in an interval.

        Correct for any ends, also at simple and multiple roots.

        Parameters
        ----------
        lower, upper : float, int, fractions.Fraction or Time, optional
            The ends, taken exactly. None, or an infinity, is no end on that side.
        closed : {'right', 'left', 'both', 'neither'}
            Which ends belong to the interval, as in pandas: (lower, upper] by default. An interval with equal
            ends contains that number with 'both', and is empty otherwise.

        Returns
        -------
        int

        Raises
        ------
        PreconditionError
            If lower is greater than upper, or an end is not a number.

        Examples
        --------
        A double root at 1, and a root at 2:

        >>> import kinetri
        >>> sequence = kinetri.sturm_sequence([-2, 5, -4, 1])
        >>> sequence.count(), sequence.count(1, 2), sequence.count(1, 2, closed="both")
        (2, 1, 2)
        """
        if not isinstance(closed, str) or closed not in _CLOSED:
            raise PreconditionError(f"closed is {closed!r}; expected one of {', '.join(map(repr, _CLOSED))}")
        includes_lower, includes_upper = _CLOSED[closed]
        return self._sequence.count(lower, includes_lower, upper, includes_upper)

    def roots(self) -> list[RealRoot]:
        """The distinct real roots of the polynomial, in ascending order, each with its multiplicity.

        Returns
        -------
        list of RealRoot
            (value, multiplicity). The values are exact.

        Examples
        --------
        >>> import kinetri
        >>> kinetri.sturm_sequence([-2, 5, -4, 1]).roots()
        [RealRoot(value=Time(1.0), multiplicity=2), RealRoot(value=Time(2.0), multiplicity=1)]
        """
        return [RealRoot(value, multiplicity) for value, multiplicity in self._sequence.roots()]

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, SturmSequence):
            return NotImplemented
        return self._terms[0] == other._terms[0]

    def __hash__(self) -> int:
        return hash(self._terms[0])

    def __repr__(self) -> str:
        return f"sturm_sequence({list(self._terms[0])})"

    def __reduce__(self) -> tuple[Any, ...]:
        return sturm_sequence, (self._terms[0],)


def sturm_sequence(coefficients: Iterable[float | Fraction]) -> SturmSequence:
    """The Sturm sequence of a polynomial, which counts its real roots in any interval.

    Parameters
    ----------
    coefficients : iterable of int, float or fractions.Fraction
        By ascending power: ``[c0, c1, c2]`` is c0 + c1 t + c2 t^2. Taken exactly. Zeros at the end do not matter.

    Returns
    -------
    SturmSequence

    Raises
    ------
    PreconditionError
        If there are no coefficients, all are zero, or one of them is not finite.

    Notes
    -----
    For degree d it takes O(d^2) operations on integers; up to degree 4 the terms have a closed form.

    Examples
    --------
    >>> import kinetri
    >>> sequence = kinetri.sturm_sequence([-2, 0, 1])
    >>> sequence.terms
    ((-2, 0, 1), (0, 1), (1,))
    >>> sequence.count(0, 2)
    1
    """
    expected = "expected numbers by ascending power: ints, floats or fractions.Fraction"
    # A set has no order of powers.
    if not isinstance(coefficients, Iterable) or isinstance(coefficients, (str, bytes, Set, Mapping)):
        raise PreconditionError(f"coefficients are {coefficients!r}; {expected}")
    try:
        values = list(coefficients)
    except TypeError:  # an array without dimensions
        raise PreconditionError(f"coefficients are {coefficients!r}; {expected}") from None
    if not values:
        raise PreconditionError(f"there are no coefficients; {expected}")
    return SturmSequence(_kinetri.Sturm(values))
