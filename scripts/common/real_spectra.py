"""Spectra of real surfaces: as configured by parameters, and as analysed from either source."""

import numpy as np

from stickiness.spectrum.kinds import SelfAffine, Tabulated
from stickiness.units import si


def configured_spectrum(asked, end):
    """Self-affine spectrum of one end of the configured range of h_rms or C0."""

    def bound(key, unit):
        value = asked[key]
        return si(value[end] if isinstance(value, list) else value, unit)

    hurst = asked["hurst"]
    size = {"h_rms": bound("h_rms", "m")} if "h_rms" in asked else {}
    if "C0" in asked:
        size["C0"] = bound("C0", f"m^{2 - 2 * hurst:g}")
    return SelfAffine(
        hurst=hurst,
        q0=wave_number(asked, "q0", "longest_wavelength"),
        q1=wave_number(asked, "q1", "shortest_wavelength"),
        q_rolloff=wave_number(asked, "", "rolloff_wavelength"),
        anisotropy=asked.get("anisotropy", 1.0),
        angle=np.radians(asked.get("angle", 0.0)),
        **size,
    )


def wave_number(asked, key, wavelength):
    """Wave number [1/m] that is given as such or as a wavelength; None if it is not given."""
    if key in asked:
        return si(asked[key], "1/m")
    return 2 * np.pi / si(asked[wavelength], "m") if wavelength in asked else None


def real_spectrum(surface, end="rough"):
    """Spectrum of one end of an analysed real surface, up to its q1."""
    inside = surface.wave_number <= float(surface.q1) * (1 + 1e-9)
    known = surface.sel(end=end).isel(wave_number=np.flatnonzero(inside))
    return Tabulated(known.wave_number.values, known.psd.values)
