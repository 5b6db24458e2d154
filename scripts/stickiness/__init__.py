"""Do two rough solids stick? Random rough surfaces, their contact, theory and criteria.

The library knows nothing of Snakemake. Lengths are in one unit of the caller's choice, pressures
in units of the plane-strain modulus E*; heights, gaps and pressures are ``(n, n)`` float64 arrays.

What a user needs:

- `spectrum`: power spectral densities of rough surfaces, their moments
- `surface`: heights with a given spectrum on a periodic square
- `solids`: elastic half-space, layers of finite thickness, skins
- `repulsive`: contact without adhesion, by boundary elements
- `adhesive`: adhesive contact by boundary elements, loading and unloading curves
- `dmt`: attraction over the gaps of a contact without adhesion
- `persson`: Persson's theory of contact area, mean gap and distribution of gaps
- `criteria`: stickiness criteria, closed forms
- `remaining`: how much adhesion remains on a rough surface, simulated or predicted
- `full_contact_energy`: what full contact with a spectrum or with heights stores
- `Surface`: what is known of a rough surface, from heights, a file, a spectrum or a drawing, in SI
- `Material`: the solid that touches it, and its adhesion, in SI
- `verdict`: whether a material sticks to a surface, with error limits
- `thresholds`: the modulus, rms height, thickness and rate at which it begins to stick
- `judge`: verdicts and thresholds of many materials on many surfaces

And what these rest on:

- `measured`: measured topographies, from the file to a spectrum with its errors
- `verdicts`: how surface and material become a verdict
- `accuracy`: errors and costs of simulations, and the settings that an accuracy needs
- `traction_laws`: attraction as a function of the gap
- `arguments`, `units`, `datasets`, `error_budget`, `plausibility`: what all parts share

Names are loaded when they are first used.

Examples
--------
>>> from stickiness import persson, repulsive, spectrum, surface
>>> rough = spectrum.SelfAffine(hurst=0.8, q0=1.0, q1=16.0, h_rms=1.0)
>>> heights = surface.synthesise(rough, n=128, length=25.13, seed=7)
>>> contact = repulsive.solve(heights, length=25.13, pressure=0.1)
>>> theory = persson.Persson(surface.lattice_spectrum(rough, 25.13))
>>> print(f"{contact.area_fraction:.2f} simulated, {theory.area_fraction(0.1):.2f} predicted")
0.09 simulated, 0.08 predicted
"""

from importlib import import_module

__version__ = "0.4.0"

_MODULES = (
    *("spectrum", "surface", "solids", "repulsive", "adhesive", "dmt", "persson"),
    *("criteria", "remaining"),
)
_PACKAGES = ("measured", "accuracy", "datasets")
_FUNCTIONS = {
    "Surface": "stickiness.verdicts.rough_surface",
    "Material": "stickiness.entries.material",
    "verdict": "stickiness.verdicts.verdict",
    "thresholds": "stickiness.verdicts.verdict",
    "judge": "stickiness.verdicts.judgement",
    "full_contact_energy": "stickiness.remaining.full_contact",
}

__all__ = [*_MODULES, *_FUNCTIONS, *_PACKAGES, "__version__"]  # noqa: PLE0604


def __getattr__(name: str):
    if name in _FUNCTIONS:
        return getattr(import_module(_FUNCTIONS[name]), name)
    if name in _MODULES or name in _PACKAGES:
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
