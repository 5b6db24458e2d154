"""Adhesion that remains on thin layers which cannot be compressed, beyond that of springs.

Long waves have to squeeze the material along the layer, so that its compliance falls with the third
power of their wave number. Full contact stores its energy in the longest waves. The surfaces need
not follow these: the layer rises to the heights in places that are as narrow as it is thick. More
remains than on springs of the same energy of full contact, the more the thinner the layer and the
weaker the adhesion.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.arguments import plain
from stickiness.solids import Solid

# ln of the factor on the energy ratio of springs: at S = 1 and x = 1, its rise with ln(1/S) and
# with ln(1/x). Fitted to one half of 120 simulated states of q0 d = 0.03 to 1.
FLOW_GAIN = -0.35
GAIN_BY_COMPLIANCE = 0.155
GAIN_BY_RATIO = 0.3


def find_flow(solid: Solid, q: ArrayLike) -> float | NDArray:
    """How far material has to flow along a layer under waves `q`, from 0 to 1.

    It is 1 where the compliance over that of a half-space falls with the third power of the wave
    number, and 0 where it falls with the first, as of springs, or less.
    """
    step = 0.01
    q = np.asarray(q, dtype=float)
    rise = np.log(solid.factor(q * np.exp(step)) / solid.factor(q * np.exp(-step))) / (2 * step)
    return plain(np.clip((rise - 1) / 2, 0.0, 1.0))


def find_gain(
    energy_ratio: ArrayLike,
    relative_compliance: ArrayLike,
    flow: ArrayLike,
) -> NDArray:
    """Factor on the energy ratio at which springs keep as much as a layer; at least 1.

    Parameters
    ----------
    energy_ratio : array
        x, work of adhesion over the elastic energy of full contact.
    relative_compliance : array
        S of the longest waves.
    flow : array
        As of `find_flow` for the longest waves; 0 leaves springs as they are.
    """
    log_gain = (
        FLOW_GAIN
        - GAIN_BY_COMPLIANCE * np.log(np.minimum(relative_compliance, 1.0))
        - GAIN_BY_RATIO * np.log(energy_ratio)
    )
    return np.maximum(np.exp(flow * log_gain), 1.0)
