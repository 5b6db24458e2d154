"""Figure 5: roughness at the threshold of stickiness over range and adhesion length, and slopes."""

from functools import partial

import numpy as np
import xarray as xr
from scipy.optimize import elementwise

from common.conventions import logarithmic_grid
from common.job import start
from criteria.budgets import CLOSED, between_limits
from criteria.simulated_a_v import measure_a_v
from stickiness import criteria, datasets
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.a_v_table import NEEDED, AvTable
from stickiness.error_budget import with_budget
from stickiness.spectrum.kinds import SelfAffine

LIMIT = "largest h_rms/range that sticks"
EDGES = f"{LIMIT}, by the edges of contact"
MISSING = "none for which a_V is tabulated, or none above 1"
VARIABLES = {  # units, description, and what NaN means
    "range_times_q0": ("1", "range times lowest wave number"),
    "adhesion_length_over_range": ("1", "adhesion length over range"),
    "h_rms_limit": ("1", f"{LIMIT} in the DMT limit, a_V as tabulated", MISSING),
    "h_rms_limit_low": ("1", f"{LIMIT} in the DMT limit, a_V at its low end", MISSING),
    "h_rms_limit_high": ("1", f"{LIMIT} in the DMT limit, a_V at its high end", MISSING),
    "h_rms_limit_edges": ("1", EDGES, MISSING),
    "h_rms_limit_edges_low": ("1", f"{EDGES}, a_V and model at their low end", MISSING),
    "h_rms_limit_edges_high": ("1", f"{EDGES}, a_V and model at their high end", MISSING),
    "h_rms_limit_constant": ("1", f"{LIMIT} in the DMT limit, constant a_V of a broad spectrum"),
    "h_rms_limit_printed": ("1", f"{LIMIT} in the DMT limit, coefficient 9/4 as printed"),
    "weak_limit": ("1", "smallest h_rms/range at which the edges of contact are weak", MISSING),
    "jtb_limit": ("1", "smallest h_rms/range at which the DMT limit holds (JTB)"),
    "a_v": ("1", "constant a_V of a broad spectrum"),
    "a_v_low": ("1", "a_V less its error"),
    "a_v_high": ("1", "a_V plus its error"),
    "slope_parameter": ("1", "range q0/(adhesion length/range)"),
    "h_rms_over_range": ("1", "rms height over range"),
    "slope_angle": ("degree", "angle of the area-load line against the load axis"),
}


def main(job):
    asked = job.params.map
    constant = measure_a_v(job.input, job.params.pressure)
    table = AvTable(datasets.read(job.input.a_v_table, NEEDED))
    dataset = find_limits(asked, constant, Roughness(table, asked, job.params.pressure))
    dataset = dataset.merge(find_slopes(asked["slope_parameter"], asked["slope_a_v"]))
    datasets.write(
        add_budgets(datasets.annotate(dataset, **VARIABLES), constant),
        job.output[0],
        title="map of the stickiness criterion",
        parameters={**asked, "pressure": job.params.pressure},
    )


class Roughness:
    """Self-affine surfaces of the map, with the range as unit of length."""

    def __init__(self, table, asked, pressure):
        self._table, self._pressure = table, pressure
        self._hurst = asked["hurst"]
        self._q1 = 2 * np.pi / asked["shortest_over_range"]
        self._narrowest, self._broadest = table.bounds["magnification"]
        self.largest = 1 / table.bounds["range"][0]  # h_rms/range at which a_V is still known

    def magnification(self, q0):
        """q1/q0, at least the smallest in the table of a_V."""
        return np.maximum(self._q1 / q0, self._narrowest)

    def slope(self, h, q0):
        """Root mean square gradient."""
        zeta = self.magnification(q0)
        unit = [
            SelfAffine(hurst=self._hurst, q0=1.0, q1=z, h_rms=1.0).rms_slope
            for z in np.unique(zeta)
        ]
        return h * q0 * np.interp(np.log(zeta), np.log(np.unique(zeta)), unit)

    def a_v(self, h, q0, which):
        """Value, low or high limit of a_V at the range over h.

        Beyond the magnifications of the table only the height of the finest waves over the range
        matters. a_V is then that of the largest magnification in the table, at a range as large
        compared with its finest waves, times the change of a_V at infinite magnification between
        the two ranges.
        """
        range_, zeta = 1 / h, self.magnification(q0)
        held = np.minimum(zeta, self._broadest)
        moved = np.minimum(range_ * (zeta / held) ** self._hurst, 1)
        between = self._at(range_, np.inf).value / self._at(moved, np.inf).value
        return getattr(self._at(moved, held), which) * between

    def _at(self, range_, zeta):
        return self._table.a_v_at(self._hurst, self._pressure, range_, zeta)


def find_limits(asked, constant, roughness):
    """Largest h_rms/range that sticks by every form of the criterion, and where the forms hold.

    With the range as unit of length only range q0, l_a/range and the shortest wavelength remain.
    """
    q0 = logarithmic_grid(asked["range_times_q0"])
    length = logarithmic_grid(asked["adhesion_length_over_range"])
    dims = ("range_times_q0", "adhesion_length_over_range")
    at = np.meshgrid(q0, length, indexing="ij")

    def by_dmt(h, q0, length, which):
        return criteria.traction_ratio(h, q0, length, 1.0, roughness.a_v(h, q0, which))

    def attraction(h, q0, length, which):
        slope, a_v = roughness.slope(h, q0), roughness.a_v(h, q0, which)
        return equivalent_sphere.attraction(h, q0, slope, length, 1.0, a_v)

    def by_edges(h, q0, length, which):
        found = attraction(h, q0, length, which)
        return found.ratio * found.error_factor ** {"low": -1, "value": 0, "high": 1}[which]

    def over_weak(h, q0, length):
        return attraction(h, q0, length, "value").strength / equivalent_sphere.WEAK

    ends = {"": "value", "_low": "low", "_high": "high"}
    implicit = {
        f"{name}{end}": partial(ratio, which=which)
        for name, ratio in (("h_rms_limit", by_dmt), ("h_rms_limit_edges", by_edges))
        for end, which in ends.items()
    } | {"weak_limit": over_weak}
    data = {
        name: (dims, find_largest(ratio, *at, roughness.largest))
        for name, ratio in implicit.items()
    }
    for name, value in (("constant", constant.value), ("printed", criteria.PRINTED_A_V)):
        data[f"h_rms_limit_{name}"] = dims, criteria.h_rms_limit(*at, 1.0, value)
    data["jtb_limit"] = dims, criteria.jtb_limit(*at, 1.0)
    scalars = {"a_v": constant.value, "a_v_low": constant.low, "a_v_high": constant.high}
    return xr.Dataset(data | scalars, coords=dict(zip(dims, (q0, length), strict=True)))


def find_largest(ratio, q0, length, end):
    """Find the h_rms at which a ratio that falls with it passes 1, from 1 to `end`; NaN if none."""
    ends = np.zeros_like(q0), np.full_like(q0, np.log(end))
    found = elementwise.find_root(
        lambda log_h, q0, length: np.log(ratio(np.exp(log_h), q0, length)),
        ends,
        args=(q0, length),
        tolerances={"xatol": 1e-6},
    )
    return np.where(found.success, np.exp(found.x), np.nan)


def find_slopes(parameters, a_v):
    """Angle of the area-load line against h_rms/range for range q0/(l_a/range) = parameter."""
    roughness = np.geomspace(0.1, 100, 301)
    angles = [
        criteria.slope_angle(
            criteria.inverse_kappa(criteria.inverse_kappa_ad(roughness, parameter, 1.0, 1.0, a_v))
        )
        for parameter in parameters
    ]
    return xr.Dataset(
        {"slope_angle": (("slope_parameter", "h_rms_over_range"), np.degrees(angles))},
        coords={"slope_parameter": list(parameters), "h_rms_over_range": roughness},
    )


def add_budgets(dataset, constant):
    """Add error budgets to the limits and the constant a_V."""
    for name in ("h_rms_limit", "h_rms_limit_edges"):
        dataset = with_budget(dataset, name, model=between_limits(dataset, name), **CLOSED)
    dataset = with_budget(dataset, "a_v", **constant.parts(constant.value))
    # In proportion to a_V^(3/5).
    parts = constant.parts(3 / 5 * dataset.h_rms_limit_constant)
    return with_budget(dataset, "h_rms_limit_constant", **parts)


if __name__ == "__main__":
    main(start(globals(), "map_criterion"))
