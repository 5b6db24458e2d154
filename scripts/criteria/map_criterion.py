"""Figures 5 and 9: thresholds of stickiness by the paper's criterion, and by all criteria.

The map has the roughness at the threshold over range and adhesion length, and slopes.
"""

from dataclasses import replace
from functools import partial

import numpy as np
import xarray as xr
from scipy.optimize import elementwise

from common.conventions import logarithmic_grid
from common.job import start
from common.pairs import SHARES
from criteria.compare_criteria import write_comparison
from criteria.self_affine_a_v import find_a_v
from criteria.simulated_a_v import measure_a_v
from stickiness import criteria, datasets, remaining
from stickiness.criteria import equivalent_sphere
from stickiness.criteria.a_v_theory import RANGES
from stickiness.error_budget import with_budget
from stickiness.spectrum.kinds import SelfAffine
from stickiness.verdicts.limits import LIMIT_TEXT, LIMITS

LIMIT = "largest h_rms/range that sticks"
EDGES = f"{LIMIT}, by the edges of contact"
DMT = f"{LIMIT} by the DMT sum"
RULE = "c in h_rms^2 < c lambda_L w/E*, for many waves and a short range"
HURSTS = (0.5, 0.6, 0.7, 0.8, 0.9)
BROAD = 1e4  # magnification of this rule
SHORT = 1e-6  # its range over h_rms
MISSING = "none above 1, or none below 10^14"
MAP_VARIABLES = {  # units, description, and what NaN means
    "range_times_q0": ("1", "range times lowest wave number"),
    "adhesion_length_over_range": ("1", "adhesion length over range"),
    "limit": LIMIT_TEXT,
    "h_rms_threshold": ("1", f"{DMT}, a_V by theory with its limits", MISSING),
    "h_rms_threshold_edges": ("1", f"{EDGES}, with the limits of a_V and of the model", MISSING),
    "h_rms_threshold_constant": ("1", f"{DMT}, constant a_V of a broad spectrum"),
    "h_rms_threshold_printed": ("1", f"{DMT}, coefficient 9/4 as printed"),
    "weak_limit": ("1", "smallest h_rms/range at which the edges of contact are weak", MISSING),
    "jtb_limit": ("1", "smallest h_rms/range at which the DMT limit holds (JTB)"),
    "a_v": ("1", "constant a_V of a broad spectrum"),
    "slope_parameter": ("1", "range q0/(adhesion length/range)"),
    "h_rms_over_range": ("1", "rms height over range"),
    "slope_angle": ("degree", "angle of the area-load line against the load axis"),
    "hurst": ("1", "Hurst exponent"),
    "share": ("1", "share of the work of adhesion that is to remain"),
    "rule": ("1", RULE),
    "rule_full_contact": ("1", f"{RULE}, by Persson and Tosatti"),
    "rule_bearing_area": ("1", f"{RULE}, by Ciavarella's bearing area"),
}
BAM_REPULSION = 0.75  # factor in later forms of the bearing-area model, see `bearing_area`
SIGNS = {"low": -1, "value": 0, "high": 1}  # of the error of the model, by its limits
NARROWEST = 10.0  # magnification


def main(job):
    settings = job.params.map
    pressure = job.params.pressure
    a_v, parts = measure_a_v(job.input, pressure)
    dataset = find_limits(settings, a_v, MapSurfaces(settings, pressure))
    dataset = dataset.assign(find_slopes(settings["slope_parameter"], settings["slope_a_v"]))
    dataset = dataset.assign(find_rule())
    dataset = dataset.assign(a_v=a_v).assign_coords(limit=list(LIMITS))
    dataset = datasets.annotate(dataset, **MAP_VARIABLES)
    dataset = with_budget(dataset, "a_v", **parts)
    # In proportion to a_V^(3/5).
    scale = 3 / 5 * dataset.h_rms_threshold_constant / a_v
    parts = {name: replace(each, error=each.error * scale) for name, each in parts.items()}
    dataset = with_budget(dataset, "h_rms_threshold_constant", **parts)
    datasets.write(
        dataset,
        job.output.map,
        title="map of the stickiness criterion",
        parameters={**settings, "pressure": pressure},
    )
    write_comparison(job.params.compared, pressure, a_v, job.output.compared)


class MapSurfaces:
    """Self-affine surfaces of the map, with the range as unit of length."""

    def __init__(self, settings, pressure):
        self._pressure = pressure
        self._hurst = settings["hurst"]
        self._q1 = 2 * np.pi / settings["shortest_over_range"]
        self.largest = 1 / RANGES[0]  # h_rms/range at which a_V is still known

    def magnification(self, q0):
        """Highest over lowest wave number, at least `NARROWEST`."""
        return np.maximum(self._q1 / q0, NARROWEST)

    def slope(self, h, q0):
        """Root mean square gradient."""
        zeta = self.magnification(q0)
        every = np.unique(zeta)
        unit = [SelfAffine(hurst=self._hurst, q0=1.0, q1=z, h_rms=1.0).rms_slope for z in every]
        return h * q0 * np.interp(np.log(zeta), np.log(every), unit)

    def a_v(self, h, q0, which):
        """Value, low or high limit of a_V at the range over h."""
        value, low, high = find_a_v(self._hurst, self._pressure, 1 / h, self.magnification(q0))
        return {"low": low, "value": value, "high": high}[which]

    def attraction(self, h, q0, length, which):
        """Attraction over repulsion by the edges of contact."""
        slope = self.slope(h, q0)
        a_v = self.a_v(h, q0, which)
        return equivalent_sphere.attraction(h, q0, slope, length, 1.0, a_v)

    def over_weak(self, h, q0, length):
        """Strength of the edges over the largest at which they are weak."""
        return self.attraction(h, q0, length, "value").strength / equivalent_sphere.WEAK

    def by_dmt(self, h, q0, length, which):
        """Attraction over repulsion by the DMT sum."""
        return criteria.traction_ratio(h, q0, length, 1.0, self.a_v(h, q0, which))

    def by_edges(self, h, q0, length, which, sign):
        """Attraction over repulsion by the edges, or its limit by the model."""
        attraction = self.attraction(h, q0, length, which)
        return attraction.ratio * attraction.error_factor**sign


def find_limits(settings, constant_a_v, surfaces):
    """Largest h_rms/range that sticks by every form of the criterion, and where forms are valid."""
    dims = ("range_times_q0", "adhesion_length_over_range")
    axes = {dim: logarithmic_grid(settings[dim]) for dim in dims}
    q0, length = np.meshgrid(*axes.values(), indexing="ij")

    def find(ratio):
        return find_largest(ratio, q0, length, surfaces.largest)

    by_dmt = [partial(surfaces.by_dmt, which=which) for which in SIGNS]
    by_edges = [partial(surfaces.by_edges, which=which, sign=sign) for which, sign in SIGNS.items()]
    limited = {"h_rms_threshold": by_dmt, "h_rms_threshold_edges": by_edges}
    variables = {
        name: (("limit", *dims), [find(ratio) for ratio in ratios])
        for name, ratios in limited.items()
    }
    variables["weak_limit"] = dims, find(surfaces.over_weak)
    constant = criteria.h_rms_threshold(q0, length, 1.0, constant_a_v)
    printed = criteria.h_rms_threshold(q0, length, 1.0, criteria.PRINTED_A_V)
    variables["h_rms_threshold_constant"] = dims, constant
    variables["h_rms_threshold_printed"] = dims, printed
    variables["jtb_limit"] = dims, criteria.jtb_limit(q0, length, 1.0)
    return xr.Dataset(variables, coords=axes | {"limit": list(LIMITS)})


def find_largest(ratio, q0, length, end):
    """Find the h_rms at which a ratio that falls with it passes 1, from 1 to `end`; NaN if none."""
    root = elementwise.find_root(
        lambda log_h, q0, length: np.log(ratio(np.exp(log_h), q0, length)),
        (np.zeros_like(q0), np.full_like(q0, np.log(end))),
        args=(q0, length),
        tolerances={"xatol": 1e-6},
    )
    return np.where(root.success, np.exp(root.x), np.nan)


def find_slopes(parameters, a_v):
    """Angle of the area-load line against h_rms/range for range q0/(l_a/range) = parameter."""
    h = np.geomspace(0.1, 100, 301)
    inverse = criteria.inverse_kappa_ad(h, np.reshape(parameters, (-1, 1)), 1.0, 1.0, a_v)
    angles = np.degrees(criteria.slope_angle(criteria.inverse_kappa(inverse)))
    return {
        "slope_parameter": list(parameters),
        "h_rms_over_range": h,
        "slope_angle": (("slope_parameter", "h_rms_over_range"), angles),
    }


def find_rule():
    """Constants c of h_rms^2 < c lambda_L w/E*, by what remains and by two other criteria."""
    unit = {"q0": 1.0, "q1": BROAD, "h_rms": 1.0}
    energy = np.array([SelfAffine(hurst=hurst, **unit).elastic_energy() for hurst in HURSTS])
    rough = remaining.Roughness(h_rms=1.0, q0=1.0, elastic_energy=energy, q1=BROAD)
    lengths = {
        "rule": (
            ("limit", "share", "hurst"),
            [
                [rough.deviating(sign).threshold(SHORT, share) for share in SHARES]
                for sign in SIGNS.values()
            ],
        ),
        "rule_full_contact": ("hurst", energy),
        "rule_bearing_area": BAM_REPULSION / criteria.bearing_area(1, 1, 1, SHORT).margin,
    }
    coords = {"limit": list(LIMITS), "share": list(SHARES), "hurst": list(HURSTS)}
    dataset = xr.Dataset(lengths, coords=coords)
    return 1 / (2 * np.pi * dataset)  # lambda_L = 2 pi/q0, with h_rms = q0 = 1


if __name__ == "__main__":
    main(start(globals()))
