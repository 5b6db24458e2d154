"""Table of the adhesion that remains: every simulated value beside what the theories say of it."""

from pathlib import Path

import pandas as pd

from common import remaining_table
from common.job import start
from stickiness import datasets
from stickiness.remaining import theories
from stickiness.remaining.prediction import Roughness
from stickiness.spectrum.kinds import Shells

SIMULATED = (
    *("approach", "separation", "bound", "pull_off", "area_at_zero_load", "gap_at_zero_load"),
    *("jumps", "pixels_in_zone", "approach_grid_error", "separation_grid_error"),
    *("bound_grid_error", "pull_off_grid_error"),
)
DIGITS = 5
COMMENT = """\
# Adhesion that remains, simulated (target remaining_measured), with the theories beside it. To
# take a new measurement over, copy it here. approach, separation and bound are over the work of
# adhesion, lengths over h_rms, wave numbers over q0, stresses over E* q0 h_rms.
"""
HEAD = """\
Shares of the work of adhesion, means over simulations by w/U_full: at widths of the cohesive zone
q0 range^2/l_a up to 0.1, of surfaces of two by two waves and more.

"""


def main(job):
    rows = [row for path in job.input for row in list_rows(path)]
    frame = pd.DataFrame(rows)
    with datasets.whole_file(job.output.table) as path:
        path.write_text(COMMENT + round_numbers(frame).to_csv(index=False), encoding="utf-8")
    with datasets.whole_file(job.output.summary) as path:
        path.write_text(HEAD + remaining_table.summarise(frame), encoding="utf-8")


def list_rows(path):
    """Rows of one file: its points, in h_rms and q0, with the theories."""
    data = datasets.read(path, SIMULATED)
    made = datasets.parameters(data)
    spectrum = Shells(data.shell_q.values, data.shell_variance.values)
    local, _, finest = theories.local_threshold(spectrum)
    energy = float(data.full_contact_energy)
    rough = Roughness(h_rms=1.0, q0=made.get("rolloff", 1.0), elastic_energy=energy)
    along = next(name for name in ("zone", "range_over_h_rms") if name in data.dims)
    points = data.stack(point=("energy", along)).dropna("point", subset=["bound"])
    dmt = theories.dmt_share(spectrum, points.adhesion_length.values, points["range"].values)
    for index, of_dmt in enumerate(dmt):  # where the grid was fine enough
        point = points.isel(point=index)
        ratio, length, range_ = (float(point[n]) for n in ("energy", "adhesion_length", "range"))
        low, share, high = (float(rough.share(length, range_, sign)) for sign in (-1, 0, 1))
        yield {
            "set": Path(path).parent.name,
            "hurst": made["hurst"],
            "magnification": made["magnification"],
            "window": made["window"],
            "points": made["points"],
            "seed": made["seed"],
            "full_contact_energy": energy,
            "energy_ratio": ratio,
            "zone": rough.q0 * range_**2 / length,
            "range": range_,
            "adhesion_length": length,
            **{name: float(point[name]) for name in SIMULATED},
            "predicted": share,
            "predicted_low": low,
            "predicted_high": high,
            "predicted_pull_off": float(rough.pull_off(length, range_)[0]),
            "full_contact": theories.full_contact_share(ratio),
            "dmt": float(of_dmt),
            "local_margin": length / local,
            "finest_margin": length / finest,
        }


def round_numbers(frame):
    """Numbers with as many digits as mean something."""
    numbers = frame.select_dtypes("number").columns
    return frame.assign(
        **{name: frame[name].map(lambda x: float(f"{x:.{DIGITS}g}")) for name in numbers}
    )


if __name__ == "__main__":
    main(start(globals(), "tabulate_remaining"))
