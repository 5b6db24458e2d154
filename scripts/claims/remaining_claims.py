"""Claims on what sticks, held against the adhesion that remains."""

from __future__ import annotations

import numpy as np
import pandas as pd
import xarray as xr
from scipy.optimize import brentq

from claims.criterion_claims import (
    CRYSTAL,
    EXAMPLES,
    PRINTED_LIMITS,
    PRINTED_MODULUS,
    RANGE,
    WORK_OF_ADHESION,
    join,
)
from claims.ledger import NOT, OPEN, Files, Finding, claim, grade
from common.formatting import change, percent
from stickiness import criteria, datasets
from stickiness.remaining import Roughness, predict
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.statistics import students_t

LITTLE = 0.1  # change of what remains that is none
COARSE, FINE = 4, 32  # magnifications of the same long waves
ZONE = 0.1  # q0 range^2/l_a, of both
BROAD, BROADEST = 1e3, 1e6  # magnifications that theory compares: the paper has up to 1e3 and more


@claim(
    19,
    "surfaces stick up to the roughness of claim 13 (its physics)",
    files=("map",),
)
def sticky_roughness(files: Files) -> Finding:
    shortest = datasets.parameters(files["map"])["shortest_over_range"]
    value, low, high = (
        np.array([find_roughness(q0, shortest, sign) for q0 in EXAMPLES]) for sign in (0, -1, 1)
    )
    inside = (low <= PRINTED_LIMITS) & (high >= PRINTED_LIMITS)
    jtb = criteria.jtb_limit(EXAMPLES, CRYSTAL, 1.0)
    return Finding(
        quantity=f"h_rms/range up to which {percent(DEFAULT_SHARE)} of the work of adhesion "
        "remains, at range q0 = 1e-9",
        value=float(value[1]),
        claimed=PRINTED_LIMITS[1],
        verdict=grade(False, bool(inside.all())),
        remark=(
            f"At H = 0.8 and roughness down to wavelengths of {shortest:g} ranges this is "
            f"{join(value)} ({join(low)} to {join(high)}) for the three values of range q0; the "
            f"paper's limits are {join(PRINTED_LIMITS / value)} times that. They follow from the "
            f"DMT limit, which holds for rougher surfaces only (JTB: {join(jtb)})."
        ),
        errors={"model": float(max(high[1] - value[1], value[1] - low[1]))},
        comment="model: of what remains, the larger side",
    )


def find_roughness(range_times_q0: float, shortest: float, sign: int) -> float:
    """h_rms/range at which the wanted share just remains, with roughness down to `shortest`.

    All in units of the range. `sign` -1 or +1: by the low or high limit of the share.
    """
    q1 = 2 * np.pi / shortest
    unit = SelfAffine(hurst=0.8, q0=range_times_q0, q1=q1, h_rms=1.0).elastic_energy()

    def excess(log_h: float) -> float:
        h = np.exp(log_h)
        rough = Roughness(h_rms=h, q0=range_times_q0, elastic_energy=unit * h**2)
        return float(np.log(rough.threshold(1.0, sign=sign) / CRYSTAL))

    return float(np.exp(brentq(excess, np.log(2.0), np.log(1e9))))


@claim(
    20,
    "asphalt sticks to a block of E* below 0.2 MPa (the physics of claim 14)",
    files=("asphalt",),
)
def sticky_asphalt(files: Files) -> Finding:
    ends = [files["asphalt"].sel(end=end) for end in ("rough", "smooth")]
    value, smooth = (find_modulus(end, 0) for end in ends)
    low, high = find_modulus(ends[0], -1), find_modulus(ends[1], 1)
    inside = low <= PRINTED_MODULUS <= high
    length = WORK_OF_ADHESION / (PRINTED_MODULUS * 1e6)
    h_rms, q0 = (float(ends[0][name]) for name in ("h_rms", "q0"))
    validity = criteria.dmt_validity(h_rms, q0, length, RANGE)
    return Finding(
        quantity=f"E* [MPa] below which {percent(DEFAULT_SHARE)} of the work of adhesion remains "
        "on asphalt, range 0.2 nm and work of adhesion 50 mJ/m^2",
        value=value,
        claimed=PRINTED_MODULUS,
        verdict=OPEN if inside else NOT,
        remark=(
            f"C0 = {float(ends[1].C0):g} in place of {float(ends[0].C0):g} m^0.4 gives "
            f"{smooth:.2g} MPa. With the errors of the model the threshold lies between {low:.2g} "
            f"and {high:.2g} MPa, whatever the shortest wavelength. The paper's value lies "
            f"{'within' if inside else 'outside'} that. It follows from the DMT limit, but h_rms "
            f"is {validity.margin:.1g} times the least that this limit requires (JTB)."
        ),
        errors={"model": max(value - low, find_modulus(ends[0], 1) - value)},
        comment="model: of what remains, the larger side",
    )


def find_modulus(surface: xr.Dataset, sign: int) -> float:
    """Modulus [MPa] below which the wanted share of the paper's example remains on a surface."""
    names = ("h_rms", "q0", "elastic_energy")
    rough = Roughness(**{name: float(surface[name]) for name in names})
    return float(WORK_OF_ADHESION / rough.threshold(RANGE, sign=sign) / 1e6)


@claim(
    21,
    "the truncation of the spectrum does not matter: rms height and longest wave decide (abstract)",
    files=("remaining",),
)
def truncation(files: Files) -> Finding:
    table = files["remaining"]
    ratios = {hurst: compare(table, hurst) for hurst in (0.8, 0.5)}
    smooth, rough = (float(np.mean(ratios[hurst])) for hurst in (0.8, 0.5))
    changes = [abs(1 - ratio) for ratio in (smooth, rough)]
    late = {hurst: extend(hurst) for hurst in (0.8, 0.5)}
    settled = abs(1 - late[0.8]) < LITTLE
    return Finding(
        quantity=(
            f"energy gained with waves up to zeta = {FINE} over that up to {COARSE}, same work of "
            "adhesion, H = 0.8"
        ),
        value=smooth,
        claimed=1.0,
        verdict=grade(max(changes) < LITTLE, settled),
        remark=(
            "Simulation of tough contact at equal rms height and longest wave, at the work of "
            f"adhesion that is the energy of full contact up to zeta = {COARSE}. For H = 0.5 it is "
            f"{rough:.2f}. On all {len(ratios) * len(ratios[0.8])} surfaces finer roughness "
            "weakens adhesion, by the energy that it takes to conform. For "
            "H > 1/2 this energy converges, as 1 - zeta^(1 - 2H): by the theory of the verdicts, "
            f"waves from zeta = {BROAD:g} to {BROADEST:g} change what remains by "
            f"{change(late[0.8] - 1)} at H = 0.8, but by {change(late[0.5] - 1)} at H = 0.5, where "
            "the energy grows without limit. The onset of contact at the finest wave depends on "
            "the truncation at any H."
        ),
        errors={"sampling": scatter(ratios[0.8])},
        comment="sampling: Student's t of a few surfaces",
    )


def scatter(values: list[float]) -> float:
    """Error of a mean that covers 90 %."""
    return float(students_t(len(values)) * np.std(values, ddof=1) / np.sqrt(len(values)))


def extend(hurst: float) -> float:
    """Predicted share with all waves up to `BROADEST` over that up to `BROAD`, range to nothing.

    The work of adhesion is the energy of full contact up to `BROAD`. Both spectra have one C0.
    """
    broad = SelfAffine(hurst=hurst, q0=1.0, q1=BROADEST, h_rms=1.0)
    narrow = broad.truncated(BROAD)
    work = narrow.elastic_energy()
    shares = [
        predict(spectrum, adhesion_length=work, range=1e-6).separation
        for spectrum in (narrow, broad)
    ]
    return shares[1] / shares[0]


def compare(table: pd.DataFrame, hurst: float) -> list[float]:
    """Energy gained with finer waves over that without, at one work of adhesion, by surface."""
    rows = table[(table.hurst == hurst) & (table.window == 2) & np.isclose(table.zone, ZONE)]
    ratios = []
    for _, surface in rows[rows.magnification.isin([COARSE, FINE])].groupby("seed"):
        coarse, fine = (surface[surface.magnification == zeta] for zeta in (COARSE, FINE))
        work = float(coarse.full_contact_energy.iloc[0])
        gained = [np.interp(work, one.adhesion_length, one.bound) for one in (coarse, fine)]
        ratios.append(float(gained[1] / gained[0]))
    return ratios
