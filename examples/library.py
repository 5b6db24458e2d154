"""The library by itself, without Snakemake or files: from a rough surface to a verdict.

In the project's environment: ``PYTHONPATH=scripts python examples/library.py``.
"""

import numpy as np

from stickiness import criteria, dmt, repulsive, spectrum, surface
from stickiness.persson import Persson

# A self-affine surface, heights over h_rms, lengths over 1/q0; q1/q0 = 32 and four by four longest
# waves in the window, so that a single realisation is nearly a mean.
rough = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=32.0, h_rms=1.0)
length = 4 * 2 * np.pi
heights = surface.synthesise(rough, n=512, length=length, seed=7)

# Press it, without adhesion, to a mean pressure of 0.065 E* q0 h_rms.
pressure = 0.065
contact = repulsive.solve(heights, length=length, pressure=pressure)
print(f"contact area = {contact.area_fraction:.4f} of the nominal one")
print(f"mean gap = {contact.mean_gap:.3f} h_rms")

# Theory on the spectrum that this window holds.
theory = Persson(surface.lattice_spectrum(rough, length))
print(f"area by theory = {float(theory.area_fraction(pressure)):.4f}")

# What lies within the range of attraction, and the a_V that describes it:
# A_ad = (3/2) a_V p (range/h_rms)^(2/3).
ranges = np.geomspace(0.01, 0.1, 9)
area = dmt.attractive_area(contact.gap, ranges, subpixel=True)
fit = dmt.fit_a_v(ranges, area, pressure)
print(f"a_V = {fit.value:.2f} for ranges of 0.01 to 0.1 h_rms")

# Does silicone stick to a surface with waves of 0.1 mm to 10 nm and 1 um rms height? The range
# is far smaller than those of the fit, so that theory says what a_V is there.
modulus, work_of_adhesion, reach, h_rms = 0.93e6, 0.04, 0.3e-9, 1e-6  # E* [Pa], [J/m^2], [m], [m]
broad = Persson(spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=1e4, h_rms=1.0))
a_v = broad.gap_cumulative(reach / h_rms, pressure) / (1.5 * pressure * (reach / h_rms) ** (2 / 3))
pair = {
    "h_rms": h_rms,
    "q0": 2 * np.pi / 1e-4,
    "adhesion_length": work_of_adhesion / modulus,
    "range": reach,
}
verdict = criteria.violano(**pair, a_v=a_v)
print(f"a_V of the pair = {a_v:.2f}")
print(f"margin = {verdict.margin:.3g}: {'sticky' if verdict.sticky else 'not sticky'}")
if not criteria.dmt_validity(**pair).valid:
    print("but the gaps are those of contact without adhesion, which do not hold here")
