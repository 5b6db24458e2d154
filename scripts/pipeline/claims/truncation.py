"""Claim that the shortest wavelength does not matter, by simulated works of adhesion."""

from __future__ import annotations

import numpy as np
import pandas as pd

from pipeline.claims.ledger import Files, Finding, claim, grade
from stickiness.remaining import predict
from stickiness.surfaces.spectrum import SelfAffine

LITTLE = 0.1  # change of what remains that is none
COARSE, FINE = 4, 32  # magnifications of the same long waves
ZONE = 0.1  # q0 range^2/l_a, of both
BROAD, BROADEST = 1e3, 1e6  # magnifications that theory compares: the paper has up to 1e3 and more


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
            "Simulation of the same long waves in tough contact, at the work of adhesion that is "
            f"the energy of full contact up to zeta = {COARSE}. For H = 0.5 it is {rough:.2f}. "
            "Finer roughness always weakens adhesion, by the energy that it takes to conform. For "
            "H > 1/2 this energy converges, as 1 - zeta^(1 - 2H): by the theory of the verdicts, "
            f"waves from zeta = {BROAD:g} to {BROADEST:g} change what remains by "
            f"{late[0.8] - 1:+.0%} at H = 0.8, but by {late[0.5] - 1:+.0%} at H = 0.5, where the "
            "energy grows without limit. The onset of contact at the finest wave depends on the "
            "truncation at any H."
        ),
        errors={"sampling": float(np.ptp(ratios[0.8])) / 2},
        comment="half the difference between two surfaces",
    )


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
