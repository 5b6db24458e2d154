"""Adhesion that remains at zero load, simulated without a path: the deepest state of contact."""

from __future__ import annotations

import logging
import warnings

import numpy as np
from numpy.typing import ArrayLike

from stickiness.adhesive import solver as adhesive
from stickiness.arguments import grid
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import TractionLaw

#: Mean planes over h_rms of rigid heights, whose gaps are starts of the descent in energy.
PLANES = (0.6, 1.4)
TOLERANCE = 1e-4


def share_at_zero_load(
    heights: ArrayLike,
    length: float | tuple[float, float],
    law: TractionLaw,
    solid: Solid = HALF_SPACE,
    tol: float = TOLERANCE,
) -> float:
    """Largest gain of energy at zero load over the work of adhesion.

    The states of four descents in energy are compared: from contact without adhesion, from full
    contact, and from the gaps under two planes that cut the heights. An independent minimiser finds
    the same energy in four digits.

    Parameters
    ----------
    heights : (n0, n1) array
        Periodic heights of the rigid surface [length].
    length : float or pair of floats
        Sides of the cell [length].
    law : TractionLaw
        Attraction; its range may be as short as one pixel in the width of the cohesive zone.
    solid : solids.HalfSpace or solids.Layer
        Elastic solid; the thickness of a layer is in the unit of `length`.
    tol : float
        Residual of every state, see `adhesive.solve`.

    Returns
    -------
    float
        0 to 1; NaN if no descent converges, or if the deepest of them stopped before.

    Examples
    --------
    >>> from stickiness.traction_laws import Exponential
    >>> x = 2 * np.pi * np.arange(32) / 32
    >>> egg_box = np.cos(x)[:, None] * np.cos(x)
    >>> law = Exponential(adhesion_length=0.2, range=0.2)
    >>> print(f"{share_at_zero_load(egg_box, length=2 * np.pi, law=law):.2f}")
    0.56
    """
    heights = grid("heights", heights)
    h_rms = float(np.std(heights))
    gaps = [np.maximum(plane * h_rms - (heights - heights.mean()), 0.0) for plane in PLANES]
    energies = []
    stopped = []
    for start in (adhesive.APPROACH, adhesive.SEPARATION, *gaps):
        try:
            with warnings.catch_warnings():
                # The cohesive zone may be as narrow as a pixel: energies need no more.
                warnings.simplefilter("ignore", PlausibilityWarning)
                state = adhesive.solve(
                    heights, length, law, pressure=0.0, start=start, tol=tol, solid=solid
                )
        except ConvergenceError as error:
            logging.info("%s: %s", law, error)
            if isinstance(error.contact, adhesive.Adhesion):
                stopped.append(error.contact.energy)
            continue
        energies.append(state.energy)
    # A descent that stopped would have gone deeper still.
    if not energies or min(stopped, default=np.inf) < min(energies):
        return np.nan
    return max(-min(energies), 0.0) / law.adhesion_length
