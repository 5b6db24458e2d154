"""Claim that the shortest wavelength does not matter, by simulated works of adhesion."""

from __future__ import annotations

import numpy as np
import pandas as pd

from pipeline.claims.ledger import NOT, QUALIFIED, REPRODUCED, Files, Finding, claim

LITTLE = 0.1  # change of what remains that is none
COARSE, FINE = 4, 32  # magnifications of the same long waves
ZONE = 0.1  # q0 range^2/l_a, of both


@claim(
    21,
    "the truncation of the spectrum does not matter: rms height and longest wave decide (abstract)",
    files=("remaining",),
)
def truncation(files: Files) -> Finding:
    table = files["remaining"]
    ratios = {hurst: compare(table, hurst) for hurst in (0.8, 0.5)}
    smooth, rough = (np.mean(ratios[hurst]) for hurst in (0.8, 0.5))
    changes = abs(1 - smooth), abs(1 - rough)
    verdict = REPRODUCED if max(changes) < LITTLE else QUALIFIED if smooth > 0.5 else NOT
    spread = float(np.ptp(ratios[0.8])) / 2
    return Finding(
        quantity=(
            f"energy gained with waves up to zeta = {FINE} over that up to {COARSE}, same work of "
            "adhesion, H = 0.8"
        ),
        value=float(smooth),
        claimed=1.0,
        verdict=verdict,
        remark=(
            f"Simulation of the same long waves, tough contact, at the work of adhesion that is "
            f"the energy of full contact up to zeta = {COARSE}. For H = 0.5 it is {rough:.2f}. "
            "Finer roughness always weakens adhesion, by the energy that it takes to conform: "
            "U_full converges for H > 1/2, and what remains follows from rms height and longest "
            "wave alone in the end, but slowly: U_full up to zeta over the limit is 1 - "
            "zeta^(1 - 2H). For H <= 1/2 it grows without limit. At the onset of contact the "
            "finest wave decides, and the claim does not hold."
        ),
        errors={"sampling": spread},
        comment="half the difference between two surfaces",
    )


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
