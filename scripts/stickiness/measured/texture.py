"""Surfaces by the parameters of profiles that drawings specify: Ra or Rq, and RSm.

They fix neither the exponent nor the ends of a spectrum. But the elastic energy of full contact
over E* Rq^2/RSm was between 2.1 and 11 for 45 isotropic Gaussian surfaces, whose profiles were
evaluated by ISO 21920-2 (H = 0.6 to 1, roll-offs at 0.03 to 1 times the cut-off, shortest waves of
1 nm to 1 um). The spectra of a smooth and of a rough end have about these energies.
"""

import numpy as np

RQ_OVER_RA = float(np.sqrt(np.pi / 2))  #: of Gaussian heights
# Pairs: of the smooth and of the rough end; the spacing RSm over the cut-off where it is not known.
HURST = (1.0, 0.6)
RSM_OVER_ROLLOFF = (1.0, 1.5)  #: the wavelength of the roll-off
HEIGHT_OVER_RQ = (1.0, 1.1)  #: rms height of the surface
RSM_OVER_CUTOFF = (0.5, 0.04)
MIDDLE_HURST = 0.8
RZ_OVER_RQ = 3.5, 6.5  #: limits; medians of the surfaces above are 3.8 to 6.1


def standard_cutoff(ra: float, rsm: float = 0.0) -> float:
    """Cut-off of the profile filter [m] by ISO 4288 for Ra [m] and, if it is known, RSm [m]."""
    # Cut-off, the largest Ra and the largest RSm that it is for, all in m (1996, tables 1 and 3).
    table = (
        (0.08e-3, 0.02e-6, 0.04e-3),
        (0.25e-3, 0.1e-6, 0.13e-3),
        (0.8e-3, 2e-6, 0.4e-3),
        (2.5e-3, 10e-6, 1.3e-3),
        (8e-3, np.inf, np.inf),
    )
    return next(cutoff for cutoff, most_ra, most_rsm in table if ra <= most_ra and rsm <= most_rsm)
