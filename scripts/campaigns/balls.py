"""Pull-off of balls from rough heights: sums over rigid solids, boundary elements on elastic ones.

Lengths are over the radius of the zone of a smooth ball at pull-off: JKR's contact or, if that is
larger, Derjaguin's zone. Paraboloids stand for balls.
"""

import warnings
from itertools import product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from campaigns.columns import OF_SET, SEED
from stickiness import adhesive, surface
from stickiness.spectrum import SelfAffine
from stickiness.traction_laws import LAWS, TractionLaw, find_strength

RADIUS = 100.0  # of a ball, over that of its zone: slopes are small
RIGID = 0.01  # Tabor's parameter that stands for rigid solids
WAVES_ALONG = 4  # longest waves along a side of the heights, at least
PRESSED = 2.0  # load before separation, over JKR's pull-off force
STEP = 0.08  # of the mean gap, over the square of the contact radius over that of the ball
MOST_STEPS = 400
GONE = 0.02  # force over JKR's below which a ball without contact has pulled off
TOLERANCE = 1e-4
COLUMNS = OF_SET | {
    "tabor": "Tabor's parameter; 0 of rigid solids, whose tractions are summed",
    "law": "traction law",
    "hurst": "Hurst exponent",
    "skewness": "of the heights",
    "shortest": "shortest wave",
    "side": "of the cell",
    "points": "of the grid, along a side",
    **SEED,
    "waves": "longest waves across the zone of a smooth ball",
    "height": "rms height over w over the strength of the law",
    "place": "that the ball touches",
    "simulated": "pull-off force over that of a smooth ball; none where a ball did not pull off",
}


class Ball(NamedTuple):
    """A ball, and the attraction of smooth solids."""

    zone: float  # radius of the zone at pull-off
    radius: float
    law: TractionLaw
    reach: float  # w over the strength of the law

    def rough(self, waves: float, height: float, shortest: float, hurst: float) -> SelfAffine:
        """Spectrum with so many of the longest waves across the zone."""
        return SelfAffine(
            hurst=hurst,
            q0=np.pi * waves / self.zone,
            q1=2 * np.pi / (shortest * self.zone),
            h_rms=height * self.reach,
        )


def make_ball(law: str, tabor: float, zone: float = 1.0) -> Ball:
    """Ball of a Tabor parameter; 0 is a rigid one."""
    # The zone is JKR's contact unless Derjaguin's is wider.
    tabor = max(tabor, RIGID)
    radius = RADIUS * zone
    adhesion = 8 * zone**3 / (9 * np.pi * radius**2)
    reach = np.cbrt(radius * adhesion**2) / tabor
    if 2 * radius * reach > zone**2:
        reach = zone**2 / (2 * radius)
        adhesion = np.sqrt((tabor * reach) ** 3 / radius)
    return Ball(zone, radius, LAWS[law](adhesion, reach * find_strength(law)), reach)


def measure(setting, seed, _):
    """Rows of all numbers of waves, rms heights and places."""
    points = setting["points"]
    side = setting["side"]
    pixel = side / points
    is_rigid = setting["tabor"] == 0
    ball = make_ball(setting["law"], setting["tabor"])
    pull = touching_force if is_rigid else pull_off_force
    smooth = pull(curve(np.zeros((points, points)), pixel), side, ball.law)
    for waves in setting["waves"]:
        # A window around the place is cut from heights that hold several of the longest waves.
        number = max(int(np.ceil(WAVES_ALONG * 2 / waves / side)), 2)
        spectrum = ball.rough(waves, 1.0, setting["shortest"], setting["hurst"])
        heights = surface.synthesise(
            spectrum, number * points, number * side, seed, skewness=setting["skewness"]
        )
        places = np.random.default_rng(seed).integers(0, len(heights), (setting["places"], 2))
        for height, (place, centre) in product(setting["heights"], enumerate(places)):
            shape = cut(height * heights, centre, points, pixel)
            simulated = pull(shape, side, ball.law) / smooth
            yield {"waves": waves, "height": height, "place": place, "simulated": simulated}


def curve(heights: NDArray, pixel: float, radius: float = RADIUS) -> NDArray:
    """Heights less the paraboloid of the ball above their middle."""
    points = len(heights)
    square = ((np.arange(points) - points // 2) * pixel) ** 2
    return heights - np.add.outer(square, square) / (2 * radius)


def cut(
    heights: NDArray, centre: NDArray, points: int, pixel: float, radius: float = RADIUS
) -> NDArray:
    """Shape below a ball above a point of periodic heights, around where it first touches."""
    around = np.arange(-points, points)
    near = heights[np.ix_(*((each + around) % len(heights) for each in centre))]
    shape = curve(near, pixel, radius)
    inner = shape[points // 2 : -points // 2, points // 2 : -points // 2]
    first = np.unravel_index(inner.argmax(), inner.shape)
    return shape[tuple(slice(each, each + points) for each in first)]


def touching_force(shape: NDArray, side: float, law: TractionLaw) -> float:
    """Tension on a rigid ball at first touch, where it pulls off [E* length^2].

    Bradley, doi:10.1080/14786443209461990.
    """
    return float(law.traction(shape.max() - shape).mean()) * side**2


def pull_off_force(shape: NDArray, side: float, law: TractionLaw) -> float:
    """Largest tension on an elastic ball [E* length^2], by states at rising mean gaps."""
    jkr = 1.5 * np.pi * RADIUS * law.adhesion_length
    contact = np.cbrt(9 * np.pi / 8 * law.adhesion_length * RADIUS**2)
    step = STEP * max(contact**2 / RADIUS, 2 * law.range)
    pressure = PRESSED * jkr / side**2
    best = 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of coarse pixels
        state = adhesive.solve(shape, side, law, pressure=pressure, tol=TOLERANCE)
        gap = state.mean_gap
        for _ in range(MOST_STEPS):
            gap += step
            state = adhesive.solve(shape, side, law, mean_gap=gap, start=state, tol=TOLERANCE)
            force = -state.mean_pressure * side**2
            best = max(best, force)
            if state.repulsive_area_fraction == 0 and force < GONE * jkr:
                return best
    return np.nan
