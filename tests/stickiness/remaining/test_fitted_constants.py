"""Constants of the theory, fitted again to resampled surfaces: how well they are known.

The table of fitted constants in docs/theory/symbols.md gives the intervals that are found here.
"""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy import interpolate, optimize

from common import remaining_table
from stickiness.remaining import share, thin_layers
from stickiness.remaining.share import (
    count_scales,
    find_exponent,
    find_first_touch,
    find_narrowest_wave,
    find_onset,
    remaining_share,
    tough_share,
    weak_share,
)

pytestmark = pytest.mark.slow

SYMBOLS = Path("docs/theory/symbols.md")
RESAMPLES = 100
TOUGH = ("HALF_ONSET", "SPREAD", "SHARP")
FLOW = ("FLOW_GAIN", "GAIN_BY_COMPLIANCE", "GAIN_BY_RATIO")


def read_intervals(names):
    """Ends of the intervals that the table of the guide gives for some constants."""
    text = SYMBOLS.read_text(encoding="utf-8").replace("−", "-")
    found = []
    for name in names:
        (row,) = (line for line in text.splitlines() if line.endswith(f"`{name}` |"))
        (ends,) = re.findall(r"\| (-?[\d.]+) to (-?[\d.]+)", row)
        found.append([float(end) for end in ends])
    return np.array(found)


def add_scales(rows, compliance=1.0):
    """What the onset follows from by the theory, with lengths over 1/q0 and heights over h_rms."""
    exponent = find_exponent(rows.magnification.to_numpy(), 4 * rows.half_space_energy.to_numpy())
    zone = np.square(rows.range) / (rows.adhesion_length * compliance)
    return rows.assign(zone=zone, exponent=exponent)


def find_onset_of(rows):
    """Onset by the theory, of a table with these scales or of its records."""
    narrowest = find_narrowest_wave(rows["zone"], rows["magnification"])
    return find_onset(count_scales(narrowest, rows["exponent"]))


def find_load_scale(rows):
    return np.minimum(rows.half_space_energy / rows.rms_slope, 0.25)


def refit(monkeypatch, module, names, rows, evaluate):
    """Constants of a module that shares are fitted with, on resampled surfaces.

    5 and 95 % of what is found, ``(constant, end)``; `evaluate` gives the shares of all rows.
    """
    start = np.array([getattr(module, name) for name in names])
    simulated = rows.simulated.to_numpy()
    surface, _ = pd.factorize(rows.surface)
    count = surface.max() + 1

    def misfit(constants, weight):
        if np.any(constants * start <= 0):  # no change of sign
            return np.inf
        for name, value in zip(names, constants, strict=True):
            monkeypatch.setattr(module, name, value)
        return np.sum(weight * np.square(evaluate() - simulated))

    rng = np.random.default_rng(1)
    fits = []
    for _ in range(RESAMPLES):
        weight = np.bincount(rng.integers(count, size=count), minlength=count)[surface]
        options = {"xatol": 3e-3, "fatol": 1e-8, "maxiter": 200}
        fits.append(optimize.minimize(misfit, start, (weight,), "Nelder-Mead", options=options).x)
    return np.quantile(fits, [0.05, 0.95], axis=0).T


def test_constants_of_tough_contact(monkeypatch):
    """Fitted to paths of making and breaking contact in cells of two waves a side and more."""
    table = remaining_table.read("config/remaining.csv")
    at_rest = table["set"].str.contains("rest")
    rows = table[~table.held & table.wide & ~table.weak & ~at_rest].assign(
        half_space_energy=lambda rows: rows.full_contact_energy,
        simulated=lambda rows: rows.bound,
        surface=lambda rows: rows.groupby(["hurst", "magnification", "window", "seed"]).ngroup(),
    )
    assert len(rows) > 150
    known = [getattr(share, name) for name in TOUGH]
    weak = weak_share(rows.energy_ratio, rows.range, find_load_scale(rows))
    records = add_scales(rows).to_records()

    def evaluate():
        return np.maximum(tough_share(records.energy_ratio, find_onset_of(records)), weak)

    found = refit(monkeypatch, share, TOUGH, rows, evaluate)
    assert found == pytest.approx(read_intervals(TOUGH), abs=0.02)
    assert np.all((found[:, 0] < known) & (known < found[:, 1]))


def test_constants_of_flow_along_thin_layers(monkeypatch):
    """Of the rise with ln(1/x) the code has a little more than shares alone would give."""
    solids = pd.read_csv("config/solids.csv", comment="#")
    rows = (
        solids[solids.kind == "thin"]
        .dropna(subset="simulated")
        .assign(surface=lambda rows: rows["set"])
    )
    assert len(rows) >= 100
    known = np.array([getattr(thin_layers, name) for name in FLOW])

    # Shares of all rows by the factor on their energy ratio, between which is interpolated.
    factors = np.geomspace(1.0, 30.0, 60)
    onset = find_onset_of(add_scales(rows, rows.relative_compliance))
    shares = [
        remaining_share(
            rows.energy_ratio,
            rows.range,
            onset,
            rows.relative_compliance,
            find_load_scale(rows),
            gain=factor,
        )
        for factor in factors
    ]
    of_rows = interpolate.CubicSpline(np.log(factors), shares)
    given = (rows[name].to_numpy() for name in ("energy_ratio", "relative_compliance", "flow"))
    given, each = tuple(given), np.arange(len(rows))

    def evaluate():
        gain = thin_layers.find_gain(*given)
        log_gain = np.log(np.minimum(gain, factors[-1]))
        piece = np.clip(np.searchsorted(of_rows.x, log_gain) - 1, 0, None)
        return np.polyval(of_rows.c[:, piece, each], log_gain - of_rows.x[piece])

    found = refit(monkeypatch, thin_layers, FLOW, rows, evaluate)
    assert found == pytest.approx(read_intervals(FLOW), abs=0.01)
    is_inside = (found[:, 0] < known) & (known < found[:, 1])
    assert is_inside.tolist() == [True, True, False]


def test_independent_heights_of_a_wave():
    """With their number the highest summit has the median of simulated surfaces."""
    rows = pd.read_csv("config/long_ranges.csv", comment="#").drop_duplicates(["set", "seed"])

    def fit(rows):
        highest, waves = rows.highest.to_numpy(), rows.waves.to_numpy()

        def excess(heights):
            return np.median(highest - find_first_touch(waves, heights))

        return optimize.brentq(excess, 1.0, 500.0)

    rng = np.random.default_rng(1)
    fits = [fit(rows.sample(len(rows), replace=True, random_state=rng)) for _ in range(200)]
    found = np.quantile(fits, [0.05, 0.95])
    (expected,) = read_intervals(["INDEPENDENT_HEIGHTS"])
    assert found == pytest.approx(expected, abs=1.0)
    assert found[0] < share.INDEPENDENT_HEIGHTS < found[1]
