"""Pull-off of closed contact, simulated on given heights for several works of adhesion.

Contact that full contact has left may hold where it is no longer the state of least energy. So it
is followed to weaker adhesion until it is lost, and pulled off on the way.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

#: Range over that simulated, below which pull-offs were not measured: there they stay
SHORTEST_RATIO = 0.36
# Fitted to simulations at shorter ranges: powers of the ratio of ranges with which summits hold
# less, contact of all of the area holds more, and is closed by less adhesion.
SUMMITS_HOLD = 0.5
CONTACT_HOLDS = 1.2
CONTACT_CLOSES = 0.4
NEARLY_LOST = 0.05  #: of the area in contact


@dataclass(frozen=True, eq=False)
class PullOffs:
    """Largest mean tensions that closed contact withstood, by rising adhesion, ``(pull,)`` each."""

    length: NDArray  #: adhesion length
    range: NDArray  #: of the attraction [length]
    tension: NDArray  #: over E*
    area: NDArray  #: share of the nominal area in contact at zero load

    def scaled(self, height_unit: float, length_unit: float) -> Self:
        """Return the same in other units, as `TrialStates.scaled`."""
        return type(self)(
            length=self.length * height_unit**2 / length_unit,
            range=self.range * height_unit,
            tension=self.tension * height_unit / length_unit,
            area=self.area,
        )

    @property
    def lost_length(self) -> float:
        """Adhesion length at which contact is nearly lost."""
        area = np.maximum.accumulate(self.area)
        return float(np.exp(np.interp(NEARLY_LOST, area, np.log(self.length))))

    def find_held(self, adhesion_length: NDArray, range: NDArray) -> NDArray:
        """Largest mean tension on separation over the work of adhesion [1/length], ``(n,)``.

        At a shorter range contact holds more, as the strength of the attraction rises, and closes
        at weaker adhesion. A few summits hold less, since fewer gaps are attracted.

        Parameters
        ----------
        adhesion_length, range : (n,) array
            Of the pairs; the range is that of a law of equal strength, `find_strength`.
        """
        held = np.empty(adhesion_length.shape)
        for one_range in np.unique(range):
            log_ratio = np.log(np.maximum(one_range / self.range, SHORTEST_RATIO))
            log_held = np.log(self.tension / self.length)
            log_held += (SUMMITS_HOLD - CONTACT_HOLDS * self.area) * log_ratio
            log_nodes = np.log(self.length) + CONTACT_CLOSES * self.area * log_ratio
            # Stronger adhesion holds no less of its work, and closes what weaker adhesion does. At
            # shorter ranges than those simulated the more that is held counts, at longer ones the
            # less: there tensions were not measured.
            is_shorter = one_range <= self.range
            log_held[is_shorter] = np.maximum.accumulate(log_held[is_shorter])
            log_held, log_nodes = (
                np.minimum.accumulate(each[::-1])[::-1] for each in (log_held, log_nodes)
            )
            rows = range == one_range
            held[rows] = np.exp(np.interp(np.log(adhesion_length[rows]), log_nodes, log_held))
        return held
