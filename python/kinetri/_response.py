# SPDX-License-Identifier: GPL-3.0-or-later
"""Responses to contacts of discs."""
from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal, Union

import numpy as np

from . import _kinetri
from ._arrays import float_array
from ._types import ArrayLike, ResponseName
from .errors import PreconditionError

if TYPE_CHECKING:
    from ._kinetri import Contact, _Response


@dataclasses.dataclass(frozen=True)
class Response:
    """The result of a contact of two discs.

    Each disc gets a new velocity, stops, is erased, or keeps its motion. If both keep their motions, they pass
    through each other.

    Parameters
    ----------
    velocity_a, velocity_b : two floats, or None
        The new velocities.
    erases_a, erases_b : bool
        Whether the disc is erased.
    stops_a, stops_b : bool
        Whether the disc rests from now on.
    """

    velocity_a: ArrayLike | None = None
    velocity_b: ArrayLike | None = None
    erases_a: bool = False
    erases_b: bool = False
    stops_a: bool = False
    stops_b: bool = False


#: A response to a contact of two discs.
Collisions = Union[
    ResponseName, Literal["none"], Callable[["Contact"], Union[Response, tuple["ArrayLike | None", "ArrayLike | None"], None]], None]


def respond(name: ResponseName, contact: Contact) -> Response:
    """The result of a built-in response for a contact.

    For custom responses that handle only some contacts.

    Parameters
    ----------
    name : {'log', 'swap', 'elastic', 'stop', 'remove'}
        As `collisions` of `Simulation`.
    contact : Contact
        The contact with which the custom response is called.

    Returns
    -------
    Response
    """
    return Response(*_kinetri.respond(name, contact))


def _velocity(name: str, value: ArrayLike | None) -> list[float] | None:
    if value is None:
        return None
    x, y = float_array(name, np.asarray(value), (2,))
    return [float(x), float(y)]


def engine_response(collisions: Any) -> str | Callable[[Contact], _Response] | None:
    """The response as an argument of the engine: a name, None, or a function that returns a tuple."""
    if collisions is None or isinstance(collisions, str):
        return collisions
    if not callable(collisions):
        raise PreconditionError(
            f"collisions is {collisions!r}; expected a name such as 'elastic', None, or a function of a "
            "contact")

    def respond_to(contact: Contact) -> _Response:
        result: Any = collisions(contact)
        if result is None:
            result = Response()
        elif not isinstance(result, Response):
            try:
                velocity_a, velocity_b = result
            except (TypeError, ValueError):
                raise PreconditionError(
                    f"the response gave {result!r}; expected None, a kinetri.Response, or two "
                    "velocities") from None
            result = Response(velocity_a, velocity_b)
        return (_velocity("velocity_a", result.velocity_a), _velocity("velocity_b", result.velocity_b),
                bool(result.erases_a), bool(result.erases_b), bool(result.stops_a), bool(result.stops_b))

    return respond_to
