"""Theory's a_V over Hurst exponent, load, range and magnification, up to an infinite one."""

import logging
from itertools import product

import numpy as np
import xarray as xr

from common.conventions import VARIANT, annotate, logarithmic_grid
from common.error_budgets import BY_THEORY, theory_parts
from common.job import start
from common.model_surfaces import make_spectrum
from common.theory_variants import theories
from stickiness import criteria, datasets
from stickiness.accuracy.error_models import read_models
from stickiness.criteria.a_v_table import edge_range, local_a_v
from stickiness.error_budget import ErrorComponent, not_applicable, unknown_error, with_budget
from stickiness.persson.theory import Persson

AXES = ("hurst", "magnification", "pressure")
# There the area within the smallest range of contact, the contact included, has converged to 1e-5
# for H from 0.3 to 1; contact itself vanishes, be it as slowly as 1/sqrt(ln zeta) for H = 1.
INFINITE = 1e36
NODES = 0.5  # of the quadrature, in units of the library's; `quadrature_error` says what it costs
THEORY_A_V_VARIABLES = {
    "a_v": "a_V = A_ad/((3/2) p (range/h_rms)^(2/3)); of no meaning below edge_range",
    "a_v_limit": "a_V in the limit of infinite magnification",
    "edge_range": "range over h_rms below which theory does not resolve edges of contact",
    "edge_a_v": "a_V below the edge range by Pastewka and Robbins' attractive area",
    "quadrature_error": "largest relative error of a_V by the quadrature",
}


def main(job):
    table = job.params.table
    gamma = job.params.gamma
    ranges = logarithmic_grid(table["range"])
    axes = {name: np.array(table[name], dtype=float) for name in AXES}
    dataset = tabulate(axes, ranges, gamma)
    dataset["quadrature_error"] = quadrature_error(axes, ranges, gamma)
    title = "a_V by Persson's theory on self-affine spectra"
    parameters = {**table, "gamma": gamma, "quoted": VARIANT}
    dataset = add_budgets(annotate(dataset, **THEORY_A_V_VARIABLES), read_models(job.input.laws))
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def tabulate(axes, ranges, gamma):
    """Tabulate a_V, the edge range and the estimate of Pastewka and Robbins.

    At infinite magnification the contact vanishes and lies within the range of attraction: the
    attractive area together with the contact then converges far sooner.
    """
    a_v = []
    a_v_limit = []
    edge_ranges = []
    edge_a_v = []
    names_of_variants = (VARIANT, "almqvist2011")
    for hurst, magnification in product(axes["hurst"], (*axes["magnification"], INFINITE)):
        spectrum = make_spectrum(hurst, magnification)
        variants = theories(spectrum, names_of_variants, gamma, NODES)
        if magnification == INFINITE:
            a_v_limit.append(a_v_of(variants.values(), axes["pressure"], ranges, contact=True))
            continue
        values = a_v_of(variants.values(), axes["pressure"], ranges)
        a_v.append(values)
        # P(0) is infinite by the first variant and finite by the second.
        pairs = zip(values[0], values[1], strict=True)
        edge_ranges.append([edge_range(ranges, infinite, finite) for infinite, finite in pairs])
        edge_a_v.append(
            criteria.pastewka_robbins_a_v(1.0, 1.0, spectrum.rms_slope, spectrum.rms_curvature)
        )
        logging.info("H = %g, zeta = %g", hurst, magnification)
    shape = [len(points) for points in axes.values()]
    a_v = np.stack(a_v, axis=1).reshape(len(variants), *shape, len(ranges))
    data = {
        "a_v": (("variant", *axes, "range"), a_v),
        "edge_range": (tuple(axes), np.reshape(edge_ranges, shape)),
        "edge_a_v": (("hurst", "magnification"), np.reshape(edge_a_v, shape[:2])),
        "a_v_limit": (("variant", "hurst", "pressure", "range"), np.stack(a_v_limit, axis=1)),
    }
    return xr.Dataset(data, coords={**axes, "variant": list(variants), "range": ranges})


def a_v_of(theories, pressures, ranges, contact=False):
    """Compute a_V, (theory, pressure, range), from areas with or without the contact itself."""
    rows = []
    for theory in theories:
        area = theory.gap_cumulative(ranges, pressures)
        if contact:
            area = area + theory.area_fraction(pressures)[:, None]
        rows.append(local_a_v(area, pressures[:, None], ranges))
    return np.array(rows)


def quadrature_error(axes, ranges, gamma):
    """Largest relative change by more nodes, at the ends of the table and infinite zeta."""
    hursts = axes["hurst"][[0, -1]]
    magnifications = [*axes["magnification"][[0, -1]], INFINITE]
    pressures = axes["pressure"][[0, -1]]
    changes = []
    reference_nodes = 1.0
    for hurst, magnification in product(hursts, magnifications):
        spectrum = make_spectrum(hurst, magnification)
        both = [Persson(spectrum, VARIANT, gamma, nodes) for nodes in (NODES, reference_nodes)]
        few, many = a_v_of(both, pressures, ranges)
        changes.append(np.abs(few / many - 1).max())
    return max(changes)


def add_budgets(dataset, models):
    """Add the errors of a_V, which are those of the attractive area, and of the edges' estimate."""
    limit = dataset.a_v_limit.assign_coords(magnification=np.inf)
    for name, value in {"a_v": dataset.a_v, "a_v_limit": limit}.items():
        error = dataset.quadrature_error * value
        quadrature = ErrorComponent(error, "of the quadrature, the largest")
        parts = theory_parts(models, "attractive_area", value) | {"discretisation": quadrature}
        dataset = with_budget(dataset, name, **parts)
    parts = dict.fromkeys(("discretisation", "solver", "sampling"), not_applicable("a closed form"))
    parts |= {"bandwidth": BY_THEORY["bandwidth"]}
    unmeasured = unknown_error("another estimate of what edges give")
    return with_budget(dataset, "edge_a_v", **parts, model=unmeasured)


if __name__ == "__main__":
    main(start(globals()))
