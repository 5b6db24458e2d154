"""A spectrum from a table, in the conventions of programs and papers."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from stickiness.measured.readers.columns import read_columns
from stickiness.spectrum.kinds import Tabulated
from stickiness.units import si_of_unit

_COLUMNS = {
    "waves": r"q|k|wave ?(?:number|vector)|(?:spatial )?frequency|f|wave ?length|1/lambda|lambda|λ",
    "spectrum": r"C|W|S|(?:2D |radial |power )*(?:PSDF?|spectrum|(?:power )?spectral density)",
}
_FREQUENCY = re.compile("(?i)(?:spatial )?frequency|f|1/")
_WAVELENGTH = re.compile("(?i)wave ?length|λ|lambda")


def read_spectrum(path: str | Path, convention: str) -> Tabulated:
    """Read an isotropic spectrum C(q) with h_rms^2 = 2 pi int q C dq.

    Parameters
    ----------
    path : path
        Text with columns named with their units: the wave number q = 2 pi/wavelength, the spatial
        frequency 1/wavelength or the wavelength, and the spectrum.
    convention : {"variance", "fourier", "radial"}
        What the table holds: a C as above, 4 pi^2 times it, as contact.engineering does, or
        2 pi q C, as Gwyddion does. Over spatial frequencies the first and the last are densities
        of these.

    Returns
    -------
    Tabulated

    Raises
    ------
    ValueError
        If the file has no such columns, or a unit is that of another convention.
    """
    columns = read_columns(Path(path), _COLUMNS)
    if len(columns) < 2 or not all(unit for _, unit, _ in columns.values()):
        raise ValueError(
            "needs columns of the waves and of their spectrum, named with their units, e.g. "
            "q [1/um], PSD [um^4]"
        )
    name, unit, waves = columns["waves"]
    _, spectrum_unit, values = columns["spectrum"]
    is_frequency = _FREQUENCY.match(name) is not None
    if _WAVELENGTH.match(name):
        q = 2 * np.pi / (waves * si_of_unit(unit, "m"))
    else:
        q = waves * si_of_unit(unit, "1/m") * (2 * np.pi if is_frequency else 1.0)
    density = values * si_of_unit(spectrum_unit, "m^3" if convention == "radial" else "m^4")
    if convention == "radial":
        psd = density / (2 * np.pi * q) / (2 * np.pi if is_frequency else 1.0)
    else:
        psd = density / (4 * np.pi**2 if is_frequency or convention == "fourier" else 1.0)
    is_known = np.isfinite(q) & np.isfinite(psd) & (q > 0)
    order = np.argsort(q[is_known])
    return Tabulated(q[is_known][order], psd[is_known][order])
