"""Error models whose answers are known."""

import itertools
import math

from stickiness.accuracy.error_laws import QUANTITIES, Law, Surface

SMOOTH = Surface(hurst=0.8, magnification=32.0)


def made_up():
    """Error 2/pixels^2 of the grid, scatter 0.2; controls leave a tenth and a half of it."""
    laws = {}
    for column in itertools.chain(*QUANTITIES.values()):
        laws |= {
            ("discretisation", column): Law(math.log(2.0), pixels=-2.0),
            ("solver", column): Law(0.0, tolerance=1.0),
            ("scatter", column): Law(math.log(0.2)),
            ("fine_share", column): Law(math.log(0.1)),
            ("coarse_share", column): Law(math.log(0.5)),
            ("theory", column): Law(math.log(0.1)),
            ("carrying", column): Law(math.log(0.1)),
        }
    costs = {"fine_cost": Law(0.0, pixels=2.0), "coarse_cost": Law(math.log(4.0))}
    costs |= {"described_cost": Law(math.log(0.001)), "tolerance_cost": Law(0.0, tolerance=-0.02)}
    return laws | {(name, ""): law for name, law in costs.items()}
