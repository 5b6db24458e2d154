"""All that a surface may be, a row each, with the error that the model may have there.

The first two rows are the smooth and the rough end of what is known. Criteria without limits are
evaluated at them.

- A spectrum or a drawing is known between both ends. Its value is that of the rough end. Its limits
  are the least and the greatest of both ends with the model at its low and its high limit.
- A measurement has draws: spectra that agree with it. Each draw has an error of the model of its
  own, so that quantiles over the draws contain both.

What a layer, a second rough solid or longer waves change, they change in every row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stickiness.remaining.roughness import Roughness
from stickiness.statistics import COVERS

END_ROWS = [0, 1]  #: the smooth and the rough end
_SEED = 2  # of the errors of the model
_SHUFFLE_SEED = 3  # of the order in which draws of a second surface meet those of the first
# Rows of a surface that is known between its ends: which end, and the error of the model. The
# weights of the limits are so large that 5 and 95 % quantiles are the least and the greatest, and
# so small that the median is the value of the rough end.
_WHICH_END = np.array([0, 1, 0, 1, 0, 1])
_END_DEVIATIONS = np.array([0.0, 0.0, -1.0, -1.0, 1.0, 1.0])
_END_WEIGHTS = np.array([0.0, 76.0, 6.0, 6.0, 6.0, 6.0])


@dataclass(frozen=True)
class Scenarios:
    """What a surface may be, `n` rows."""

    roughness: Roughness  #: of every row, arrays ``(n,)``
    weights: NDArray  #: of the rows, whole numbers, ``(n,)``
    #: error of the model in units of its limits, -1 and 1 at the low and the high one, ``(n,)``
    deviation: NDArray
    place: NDArray  #: between the smooth end, 0, and the rough end, 1; draws are at 1/2, ``(n,)``

    @classmethod
    def between_ends(cls, ends: Roughness) -> Scenarios:
        """All that a surface may be whose `ends` ``(2,)`` are known alone."""
        return cls(
            roughness=ends.take(_WHICH_END),
            weights=_END_WEIGHTS,
            deviation=_END_DEVIATIONS,
            place=_WHICH_END.astype(float),
        )

    @classmethod
    def of_draws(cls, roughness: Roughness) -> Scenarios:
        """All that a measured surface may be: `roughness` of both ends and of its draws."""
        (rows,) = roughness.shape_of_arrays
        count = rows - len(END_ROWS)
        errors = np.random.default_rng(_SEED).normal(size=count) / COVERS
        of_ends = np.zeros(len(END_ROWS))
        return cls(
            roughness=roughness,
            weights=np.append(of_ends, np.ones(count)),
            deviation=np.append(of_ends, errors),
            place=np.append([0.0, 1.0], np.full(count, 0.5)),
        )

    @property
    def is_drawn(self) -> bool:
        """Whether the rows are draws of a measured surface."""
        return bool((self.place == 0.5).any())

    @property
    def ends(self) -> Roughness:
        """Roughness of the smooth and the rough end, ``(2,)``."""
        return self.roughness.take(END_ROWS)

    @property
    def draws(self) -> Roughness | None:
        """Roughness of the draws; None of a surface that was not measured."""
        return self.roughness.take(slice(len(END_ROWS), None)) if self.is_drawn else None

    def between(self, at_ends: Sequence[float] | NDArray) -> NDArray:
        """A positive number of every row, by the numbers at both ends: of draws the geometric mean.

        It stands for what is known of spectra alone, which draws do not keep.
        """
        smooth, rough = at_ends
        return smooth ** (1 - self.place) * rough**self.place

    def with_roughness(self, **changed: Any) -> Scenarios:
        """The same with other columns of the roughness."""
        return replace(self, roughness=replace(self.roughness, **changed))

    def align(self, second: Scenarios, *, is_same: bool) -> tuple[Scenarios, Roughness]:
        """Rows in which this and a second surface meet, and the roughness of the second there.

        Draws meet draws, or both ends if these agree. They are shuffled, for measurements of two
        surfaces err independently, although their draws have one seed; not so if the second
        `is_same`. Otherwise only ends meet ends.
        """
        if not self.is_drawn:
            return self, second.ends.take(_WHICH_END)
        ends = second.ends
        if second.is_drawn:
            count = self.place.size - len(END_ROWS)
            order = np.resize(np.arange(len(END_ROWS), second.place.size), count)
            if not is_same:
                order = np.random.default_rng(_SHUFFLE_SEED).permutation(order)
            return self, second.roughness.take(np.append(END_ROWS, order))
        if np.ptp(ends.h_rms) == np.ptp(ends.elastic_energy) == 0:
            return self, ends.take(np.zeros(self.place.size, dtype=int))  # alike
        return Scenarios.between_ends(self.ends), ends.take(_WHICH_END)
