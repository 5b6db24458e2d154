"""What averaging over directions costs the theory, and two independent rough solids against one.

Self-affine surfaces (H = 0.8, magnification 16) whose correlation lengths differ by a factor a.
Cells are square, of 4 by 4 longest waves of the norm that the spectrum is made of, whatever a is:
4 sqrt(a) across and 4/sqrt(a) along (1.4 at a = 8: the longest waves fit), so that cells hold
equally many modes. Pixels are square, 8 to the shortest wave across. The theory is Persson's on the
spectrum averaged over directions: `lattice` that which the window holds on average over seeds,
`own` that of each surface. Loads are over E* times the rms slope of the lattice.

Adhesion that remains is simulated in cells of 2 by 2 such waves at magnification 8, which hold
ratios up to 4, and compared with the prediction from each surface's own spectrum. Run the parts by
hand, one process each (2 to 4 min):

    python benchmarks/direction.py contact
    python benchmarks/direction.py adhesion
    python benchmarks/direction.py solids
"""

import argparse
import time

import numpy as np

from stickiness import adhesive, remaining, repulsive, spectrum, surface
from stickiness.persson import Persson
from stickiness.repulsive import subpixel

HURST, MAGNIFICATION, CELL = 0.8, 16.0, 4
RATIOS = {1: 512, 2: 720, 4: 1024, 8: 1440}  # points on a side
LOADS = np.array([0.02, 0.1, 0.3])  # over E* rms_slope
SEEDS = range(1, 7)
TENSE = {"magnification": 8.0, "cell": 2, "range": 0.4, "points": 160}
ENERGY_RATIOS = (0.7, 1.5)
SQUEEZE = 1.0  # over E* rms_slope


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("part", choices=["contact", "adhesion", "solids"])
    parser.add_argument("--ratios", type=int, nargs="*")
    parser.add_argument("--seeds", type=int)
    given = parser.parse_args()
    if given.part == "contact":
        for ratio in given.ratios or RATIOS:
            compare_contact(ratio, range(1, 1 + (given.seeds or len(SEEDS))))
    elif given.part == "adhesion":
        for ratio in given.ratios or (1, 2, 4):
            compare_adhesion(ratio, range(1, 1 + (given.seeds or 3)))
    else:
        compare_solids(range(1, 1 + (given.seeds or 6)))


def make_spectrum(ratio, magnification=MAGNIFICATION):
    return spectrum.SelfAffine(
        hurst=HURST, q0=1.0, q1=magnification, h_rms=1.0, anisotropy=float(ratio)
    )


def compare_contact(ratio, seeds):
    """Print area and mean gap of simulations over theory, with standard errors."""
    begin = time.process_time()
    rough, length = make_spectrum(ratio), 2 * np.pi * CELL
    lattice = surface.lattice_spectrum(rough, length)
    loads = LOADS * lattice.rms_slope
    found, own = [], []
    for seed in seeds:
        heights = surface.synthesise(rough, RATIOS[ratio], length, seed)
        own.append(by_theory(surface.realised_spectrum(heights, length), loads))
        found.append(simulate(heights, length, loads))
    found, own = np.array(found), np.array(own)
    print(f"a = {ratio}, {len(seeds)} seeds, {time.process_time() - begin:.0f} s")
    for name, ratios in (("lattice", found / by_theory(lattice, loads)), ("own", found / own)):
        mean, error = ratios.mean(0), ratios.std(0, ddof=1) / np.sqrt(len(seeds))
        for what, m, e in zip(("area", "mean gap"), mean, error, strict=True):
            cells = (f"{x:6.3f} ± {y:5.3f}" for x, y in zip(m, e, strict=True))
            print(f"  {what:8s} over theory, {name:8s}", *cells, flush=True)


def simulate(heights, length, loads):
    """Area, free of the strip of whole pixels, and mean gap by load."""
    rows = []
    for contact in repulsive.load_path(heights, length, loads, tol=1e-4):
        strip = subpixel.boundary_strip(contact.gap == 0)
        rows.append((contact.area_fraction - strip, contact.mean_gap))
    return np.transpose(rows)


def by_theory(known, loads):
    theory = Persson(known)
    return np.array([theory.area_fraction(loads), theory.mean_gap(loads)])


def compare_adhesion(ratio, seeds):
    """Print what remains of adhesion by simulation and by the prediction, with its limits."""
    rough = make_spectrum(ratio, TENSE["magnification"])
    length, range_ = 2 * np.pi * TENSE["cell"], TENSE["range"]
    points = round(TENSE["points"] * np.sqrt(ratio) / 16) * 16
    for energy_ratio in ENERGY_RATIOS:
        for seed in seeds:
            begin = time.process_time()
            heights = surface.synthesise(rough, points, length, seed)
            known = surface.realised_spectrum(heights, length)
            w = energy_ratio * known.elastic_energy()
            law = adhesive.Exponential(w, range_)
            squeeze = SQUEEZE * known.rms_slope
            found = remaining.measure(heights, length, law, squeeze, tol=1e-3, half_grid=False)
            said = remaining.predict(known, w, range_, q0=rough.q_longest)
            low, high = said.separation_limits
            print(
                f"a = {ratio}, w/U_full = {energy_ratio}, seed {seed}: approach "
                f"{found.approach:.3f}, bound {found.bound:.3f}, separation {found.separation:.3f},"
                f" pull-off {found.pull_off:.3f}; predicted {said.separation:.3f} ({low:.3f} to "
                f"{high:.3f}), pull-off {said.pull_off:.3f}; pixels in zone "
                f"{found.pixels_in_zone:.1f}, {time.process_time() - begin:.0f} s",
                flush=True,
            )


def compare_solids(seeds):
    """Print two independent surfaces of h_rms 1 on each other over one of the root of 2."""
    one, points, length = make_spectrum(1), 256, 2 * np.pi * CELL
    single = spectrum.SelfAffine(hurst=HURST, q0=1.0, q1=MAGNIFICATION, h_rms=np.sqrt(2))
    loads = LOADS * surface.lattice_spectrum(single, length).rms_slope
    both, alone = [], []
    for seed in seeds:
        first, second = (surface.synthesise(one, points, length, 100 * seed + k) for k in (1, 2))
        both.append(simulate(first + second, length, loads))
        alone.append(simulate(surface.synthesise(single, points, length, seed), length, loads))
    both, alone = np.array(both), np.array(alone)
    ratio = both.mean(0) / alone.mean(0)
    error = np.hypot(*(x.std(0, ddof=1) / x.mean(0) / np.sqrt(len(seeds)) for x in (both, alone)))
    for what, m, e in zip(("area", "mean gap"), ratio, error, strict=True):
        cells = (f"{x:6.3f} ± {y:5.3f}" for x, y in zip(m, e, strict=True))
        print(f"two over one, {what:8s}", *cells)


if __name__ == "__main__":
    main()
