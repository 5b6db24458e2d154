"""Works of approach and separation, or energies at zero load, of one rough surface."""

import logging
import time
import warnings
from itertools import product

import numpy as np
import xarray as xr

from common.conventions import annotate
from common.job import start
from common.model_surfaces import cell_size, make_heights
from stickiness import datasets, surface
from stickiness.plausibility import PlausibilityWarning
from stickiness.remaining import measurement
from stickiness.remaining.zero_load import share_at_zero_load
from stickiness.traction_laws import LAWS

QUOTED = {
    "approach": "work of approach over the work of adhesion",
    "separation": "work of separation over the work of adhesion",
    "bound": "largest gain of energy over the work of adhesion",
    "pull_off": "largest mean tension on separation over E* q0 h_rms",
}
OTHERS = {
    "area_at_zero_load": "area at a gap of zero over nominal area, at zero load on approach",
    "gap_at_zero_load": "mean gap over h_rms at zero load on approach",
    "jumps": "jumps on the way there and back",
    "pixels_in_zone": "width of the cohesive zone in pixels",
    "fft_pairs": "convolutions",
    "residual": "largest residual of a state of the path",
}
COARSE = "no path, or the grid does not resolve the cohesive zone"
HALF = "half grid too coarse"
GRID_ERRORS = {
    f"{n}_grid_error": f"error by half the grid and the steps: {QUOTED[n]}" for n in QUOTED
}
REMAINING_VARIABLES = {
    **{name: ("1", text, COARSE) for name, text in (QUOTED | OTHERS).items()},
    **{name: ("1", text, HALF) for name, text in GRID_ERRORS.items()},
    **{n: ("1", OTHERS[n], f"never attracted, or {COARSE}") for n in OTHERS if "zero_load" in n},
    "zone": "q0 range^2 over adhesion length",
    "energy": "work of adhesion over elastic energy of full contact of this surface",
    "squeeze": "pressure before separation over E* q0 h_rms",
    "adhesion_length": "adhesion length over q0 h_rms^2",
    "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
    "shell_q": "wave number over q0",
    "shell_variance": "variance of the heights on a shell over h_rms^2",
    "seconds": ("s", "processor time"),
}
FEWEST_PIXELS = 1.0  # below, points of the grid snap one by one, and the path is endless


def main(job):
    setting = job.params.surface
    seed = int(job.wildcards.seed)
    length = cell_size(setting)
    heights = make_heights(setting, setting["points"], seed)
    spectrum = surface.realised_spectrum(heights, length)
    energy = spectrum.elastic_energy()
    # Ranges of attraction are given over h_rms, or by the width of the cohesive zone.
    along = "zone"
    values = setting["zones"]
    if values is None:
        along = "range_over_h_rms"
        values = setting["ranges"]
    squeezes = setting["squeezes"] or [job.params.squeeze]
    axes = {"energy": setting["energies"], along: values, "squeeze": squeezes}
    rows = []
    for ratio, value, squeeze in product(*axes.values()):
        began = time.process_time()
        adhesion_length = ratio * energy
        range_ = np.sqrt(value * adhesion_length) if along == "zone" else value
        law = LAWS[job.params.law](adhesion_length, range_)
        row = measure(heights, length, law, squeeze, path=setting["path"])
        rows.append(row | {"seconds": time.process_time() - began})
        logging.info("w/U %g, %s %g, squeeze %g: %s", ratio, along, value, squeeze, rows[-1])
    dims = tuple(axes)
    shape = [len(axis) for axis in axes.values()]
    dataset = xr.Dataset(
        {
            **{key: (dims, np.reshape([row[key] for row in rows], shape)) for key in rows[0]},
            "full_contact_energy": energy,
            "rms_slope": spectrum.rms_slope,
            "rms_curvature": spectrum.rms_curvature,
            "shell_q": ("shell", spectrum.q),
            "shell_variance": ("shell", spectrum.variance),
        },
        coords=axes,
    )
    title = "adhesion that remains on one rough surface"
    parameters = {**setting, "seed": seed, "law": job.params.law}
    dataset = annotate(dataset, **REMAINING_VARIABLES)
    datasets.write(dataset, job.output[0], title=title, parameters=parameters)


def measure(heights, length, law, squeeze, path=True):
    """Measure one law, with the change from half the grid; NaN if the grid is too coarse.

    Without a path only the energy at zero load is known.
    """
    pixels = law.range**2 / law.adhesion_length / (length / heights.shape[0])
    row = dict.fromkeys((*QUOTED, *OTHERS, *GRID_ERRORS), np.nan)
    row |= {"pixels_in_zone": pixels, "range": law.range, "adhesion_length": law.adhesion_length}
    if pixels < FEWEST_PIXELS:
        return row
    if not path:
        return row | {"bound": share_at_zero_load(heights, length, law)}
    with warnings.catch_warnings():
        # What a coarse grid does to the result is in the limits.
        warnings.simplefilter("ignore", PlausibilityWarning)
        half_grid = pixels >= 2 * measurement.RESOLVED
        measured = measurement.measure(heights, length, law, squeeze, half_grid=half_grid)
    row["residual"] = max(point.state.residual for point in measured.points)
    row |= {key: getattr(measured, key) for key in (*QUOTED, *OTHERS) if key != "residual"}
    for key in QUOTED:
        low, high = getattr(measured, f"{key}_limits")
        row[f"{key}_grid_error"] = (high - low) / 2
    return row


if __name__ == "__main__":
    main(start(globals()))
