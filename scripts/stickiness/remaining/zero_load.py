"""Adhesion that remains at zero load, simulated without a path: the deepest state of contact."""

from __future__ import annotations

import logging
import warnings
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from stickiness.adhesive import solver as adhesive
from stickiness.arguments import check_length, grid
from stickiness.plausibility import PlausibilityWarning
from stickiness.repulsive.solver import ConvergenceError
from stickiness.solids import HALF_SPACE, Solid
from stickiness.traction_laws import TractionLaw

#: Mean planes over h_rms of rigid heights, whose gaps are starts of the descent in energy.
PLANES = (0.6, 1.4)
TOLERANCE = 1e-4
# A solid that is stiff to long waves stops far above its deepest state: at short ranges a grid
# holds the edges of contact. So contact is made at a long range, and the range shortened.
STIFF = 0.9  # compliance over that of a half-space, of the longest waves, below which a solid is so
STRONGER = (1.0, 1.3, 1.7)  # works of adhesion by which contact is made, over the one in question
LONGEST_RANGE = 2.0  # over h_rms
ROUGHLY = 1e-2  # residual of contact at longer ranges,
FEW = 300  # and its iterations, which need not suffice: descents go on from there


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
    the same energy in four digits. On layers that are stiff to long waves, three further descents
    start from contact that was made at longer ranges.

    Parameters
    ----------
    heights : (n0, n1) array
        Periodic heights of the rigid surface [length].
    length : float or pair of floats
        Sides of the cell [length].
    law : TractionLaw
        Attraction; its range may be as short as one pixel in the width of the cohesive zone.
    solid : solids.HalfSpace, solids.Layer or solids.Skin
        Elastic solid; a thickness is in the unit of `length`.
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
    sides = check_length(length, heights.shape)
    h_rms = float(np.std(heights))
    gaps = [np.maximum(plane * h_rms - (heights - heights.mean()), 0.0) for plane in PLANES]
    starts: list[str | NDArray] = [adhesive.APPROACH, adhesive.SEPARATION, *gaps]
    if solid.factor(2 * np.pi / max(sides)) < STIFF:
        starts += _make_contact(heights, sides, law, solid)
    energies = []
    stopped = []
    for start in starts:
        try:
            energies.append(descend(heights, sides, law, solid, start, tol).energy)
        except ConvergenceError as error:
            logging.info("%s: %s", law, error)
            if isinstance(error.contact, adhesive.Adhesion):
                stopped.append(error.contact.energy)
    # A descent that stopped would have gone deeper still.
    if not energies or min(stopped, default=np.inf) < min(energies):
        return np.nan
    return max(-min(energies), 0.0) / law.adhesion_length


def _make_contact(
    heights: NDArray, sides: tuple[float, float], law: TractionLaw, solid: Solid
) -> Iterator[NDArray]:
    """Gaps of contact that stronger adhesion makes at a long range, which is then shortened."""
    for stronger in STRONGER:
        gap = np.zeros(heights.shape)
        range_ = LONGEST_RANGE * float(np.std(heights))
        while range_ > law.range:
            longer = replace(law, adhesion_length=stronger * law.adhesion_length, range=range_)
            try:
                gap = descend(heights, sides, longer, solid, gap, ROUGHLY, FEW).gap
            except ConvergenceError as error:
                gap = error.contact.gap
            except ValueError as error:  # the grid would set the edges
                logging.info("%s: %s", longer, error)
                break
            range_ /= 2
        yield gap


def descend(
    heights: NDArray,
    sides: tuple[float, float],
    law: TractionLaw,
    solid: Solid,
    start: str | NDArray | adhesive.Adhesion,
    tol: float,
    max_iterations: int = 3000,
    mean_gap: float | None = None,
    mirrored: bool = False,
) -> adhesive.Adhesion:
    """State of zero load, or at a mean gap, in which a descent ends; errors as of `solve`."""
    with warnings.catch_warnings():
        # The cohesive zone may be as narrow as a pixel: energies need no more.
        warnings.simplefilter("ignore", PlausibilityWarning)
        return adhesive.solve(
            heights,
            sides,
            law,
            pressure=0.0 if mean_gap is None else None,
            mean_gap=mean_gap,
            start=start,
            tol=tol,
            max_iterations=max_iterations,
            solid=solid,
            mirrored=mirrored,
        )
