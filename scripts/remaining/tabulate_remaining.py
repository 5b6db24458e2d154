"""Table of the adhesion that remains: every simulated value beside what is predicted of it."""

from pathlib import Path

import pandas as pd

from common.job import start
from stickiness import datasets
from stickiness.remaining.prediction import Roughness

QUOTED = ("approach", "separation", "bound", "pull_off")
SIMULATED = (
    *(*QUOTED, "area_at_zero_load", "jumps", "pixels_in_zone"),
    *(f"{name}_grid_error" for name in QUOTED),
)
MADE = ("hurst", "magnification", "window", "points", "seed")
COMMENT = """\
# Adhesion that remains, simulated (target remaining_measured), with predictions beside it. To
# take a new measurement over, copy it here. approach, separation and bound are over the work of
# adhesion, lengths over h_rms, wave numbers over q0, stresses over E* q0 h_rms.
"""


def main(job):
    frame = pd.DataFrame([row for path in job.input for row in list_rows(path)])
    with datasets.whole_file(job.output[0]) as path:
        text = frame.to_csv(index=False, float_format="%.5g")
        path.write_text(COMMENT + text, encoding="utf-8")


def list_rows(path):
    """Rows of one file: its points, in h_rms and q0, with the prediction."""
    data = datasets.read(path, SIMULATED)
    made = datasets.parameters(data)
    energy = float(data.full_contact_energy)
    rough = Roughness(h_rms=1.0, q0=made.get("rolloff", 1.0), elastic_energy=energy)
    along = next(name for name in ("zone", "range_over_h_rms") if name in data.dims)
    points = data.stack(point=("energy", along)).dropna("point", subset=["bound"])
    for index in range(points.sizes["point"]):  # where the grid was fine enough
        point = points.isel(point=index)
        ratio, length, range_ = (float(point[n]) for n in ("energy", "adhesion_length", "range"))
        low, share, high = (float(rough.share(length, range_, sign)) for sign in (-1, 0, 1))
        yield {
            "set": Path(path).parent.name,
            **{name: made[name] for name in MADE},
            "full_contact_energy": energy,
            "energy_ratio": ratio,
            "zone": rough.q0 * range_**2 / length,
            "range": range_,
            "adhesion_length": length,
            **{name: float(point[name]) for name in SIMULATED},
            "predicted": share,
            "predicted_low": low,
            "predicted_high": high,
            "predicted_pull_off": float(rough.tension(length, range_)),
            "full_contact": max(1 - 1 / ratio, 0.0),
        }


if __name__ == "__main__":
    main(start(globals(), "tabulate_remaining"))
