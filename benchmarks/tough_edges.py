"""Strong attraction at edges of contact: full simulation against its equivalent sphere.

Finer grids and fewer waves than in the workflow resolve edges up to a strength of about 5.
Every state is held against the contact without adhesion of the same area. Run it by hand:

    python benchmarks/tough_edges.py
"""

import numpy as np

from stickiness import adhesive, equivalent_sphere, repulsive, spectrum, surface
from stickiness.adhesive import edge_zone

LENGTH, POINTS = 2 * np.pi, 768
LOADS = np.array([0.02, 0.04, 0.065, 0.1, 0.15, 0.22, 0.3])  # over E* q0 h_rms, at h_rms = 1
START = 1  # index of the load whose mean gap is kept
CASES = ((8, 0.1), (8, 0.05), (16, 0.1))  # magnification, range over h_rms
STRENGTHS = (0.1, 0.5, 1.0, 2.0, 4.0)
SEEDS = (1, 2)


def main():
    print("zeta  seed  range      t    tau    rho  effect  model  ratio")
    for zeta, reach in CASES:
        for seed in SEEDS:
            for row in states(zeta, seed, reach):
                t, tau, rho, effect, model = row
                print(
                    f"{zeta:4d}  {seed:4d}  {reach:5.2f}  {t:5.2f}  {tau:5.2f}  {rho:5.2f}"
                    f"  {effect:6.3f}  {model:5.3f}  {effect / model:5.3f}",
                    flush=True,
                )


def states(zeta, seed, reach):
    """t, tau, attraction over repulsion, effect and its model, for ever stronger attraction."""
    s = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=float(zeta), h_rms=1.0)
    heights = surface.synthesise(s, POINTS, LENGTH, seed=seed)
    alone = list(repulsive.load_path(heights, LENGTH, LOADS, tol=1e-7))
    area = np.array([contact.area_fraction for contact in alone])
    shape = adhesive.Exponential(adhesion_length=reach, range=reach)  # of unit strength
    attractive = np.array([np.mean(shape.traction(c.gap) * (c.gap > 0)) for c in alone])
    pressed = LOADS[START] / area[START]
    state = alone[START]
    for tau in STRENGTHS:
        strength = tau * np.sqrt(attractive[START] / area[START]) / 0.75 * pressed
        law = adhesive.Exponential(adhesion_length=strength * reach, range=reach)
        bent = edge_zone.resolution(LENGTH / POINTS, reach, law.adhesion_length)
        if bent > edge_zone.COARSEST:
            return
        gap = alone[START].mean_gap
        state = adhesive.solve(heights, LENGTH, law, mean_gap=gap, start=state, tol=1e-6)
        held = state.repulsive_area_fraction
        if held > area[-1]:
            return
        load = np.exp(np.interp(np.log(held), np.log(area), np.log(LOADS)))
        there = np.exp(np.interp(np.log(load), np.log(LOADS), np.log(attractive)))
        t = there / held
        found = equivalent_sphere.edge_strength(t, strength * held / load)
        rho = 1 - state.mean_pressure / load
        model = equivalent_sphere.effect(t, found)
        yield t, found, rho, rho / (strength * there / load), model


if __name__ == "__main__":
    main()
