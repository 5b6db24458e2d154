"""The library without Snakemake or files: from a rough surface and a material to a verdict.

In the project's environment: ``PYTHONPATH=scripts python examples/library.py``.
"""

import stickiness
from stickiness import repulsive, spectrum, surface
from stickiness.persson import Persson

# A self-affine surface with wavelengths of 0.1 mm to 10 nm and an rms height of 1 um, and silicone.
# Instead of the spectrum, the same call takes measured heights [m] and their length.
Q0 = 6.283 / 1e-4
rough = spectrum.SelfAffine(hurst=0.8, q0=Q0, q1=1e4 * Q0, h_rms=1e-6)
silicone = {"youngs_modulus": 0.7e6, "work_of_adhesion": 0.04, "range": 0.3e-9}
print(stickiness.verdict(rough, **silicone))

# Contact without adhesion, for a narrower spectrum, in simulation and theory. Lengths are in units
# of 1/q0 and heights in units of h_rms; the mean pressure is 0.065 E* q0 h_rms.
narrow = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=32.0, h_rms=1.0)
length, pressure = 4 * 6.283, 0.065
heights = surface.synthesise(narrow, n=256, length=length, seed=7)
contact = repulsive.solve(heights, length=length, pressure=pressure)
theory = Persson(surface.lattice_spectrum(narrow, length))
print(f"contact area = {contact.area_fraction:.4f} of the nominal area")
print(f"predicted area = {float(theory.area_fraction(pressure)):.4f}")
print(f"mean gap = {contact.mean_gap:.3f} h_rms")
