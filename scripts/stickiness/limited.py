"""A number with limits, in the one form that all of the project uses."""

from __future__ import annotations

from typing import Generic, NamedTuple, TypeVar

Number = TypeVar("Number")  #: float, or an array


class Limited(NamedTuple, Generic[Number]):
    """A number, or an array of numbers, with the limits of all that is unknown; they cover 90 %.

    0 or infinity in a limit of a threshold means that no value sticks, or every one.
    """

    value: Number
    low: Number
    high: Number
