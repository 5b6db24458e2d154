"""Table of the adhesion that remains at zero load, simulated, and of what predicts it."""

import time
from dataclasses import replace
from itertools import product
from pathlib import Path

import pandas as pd

from common import heights_table
from common.conventions import Q0
from common.job import start
from common.model_surfaces import skewness_of
from stickiness import __version__, datasets
from stickiness.formatting import number, percent, table
from stickiness.remaining.height_shape import find_height_shape
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.trial_states import DEFAULT_SHARE
from stickiness.verdicts.simulated_surface import read_simulated

COMMENT = f"""\
# Adhesion that remains at zero load on heights of many shapes, simulated with version {__version__}
# (target heights_measured, config/campaigns/heights.yaml), with what predicts it. To take a new
# measurement over, copy it here. Shares are over the work of adhesion, lengths over h_rms, wave
# numbers over q0, energies over E* q0 h_rms^2. simulated: deepest state of four starts. bound:
# contacts without adhesion. theory: by the spectrum of these heights. shaped: the same with the
# law of the skewness. states: simulated on the heights, on half of the grid. seconds: processor
# time, of bound and states for all points of a surface, of theory for a share with both limits.
"""
HEAD = f"""\
Predicted over simulated shares, where 5 % and more remain; errors below are absolute. Limits decide
whether {100 * DEFAULT_SHARE:.0f} % remain.

"""
MEASURED = ("simulated", "bound", "adhesion_length", "range")
OF_SURFACE = ("full_contact_energy", "rms_slope", "skewness", "kurtosis", "lacking")
SECONDS = ("seconds_bound", "seconds_states")


def main(job):
    frame = pd.DataFrame([row for path in job.input for row in list_rows(path)])
    text = COMMENT + frame.to_csv(index=False, float_format="%.5g")
    summary = HEAD + summarise(heights_table.add_kind(frame))
    for output, content in zip(job.output, (text, summary), strict=True):
        with datasets.whole_file(output) as path:
            path.write_text(content, encoding="utf-8")


def list_rows(path):
    """Rows of one file: its points, with what predicts them."""
    data = datasets.read(path, (*MEASURED, *OF_SURFACE, *SECONDS))
    setting = datasets.parameters(data)
    of_surface = {name: float(data[name]) for name in OF_SURFACE}
    models = list_models(data, setting["law"])
    for energy_ratio, pixels in product(data.energy.values, data.pixels_in_zone.values):
        point = data.sel(energy=energy_ratio, pixels_in_zone=pixels)
        length = float(point.adhesion_length)
        range_ = float(point.range)
        began = time.process_time()
        predicted = {"theory": predict(models["theory"], length, range_)}
        seconds_theory = time.process_time() - began
        for name in ("shaped", "states"):
            predicted[name] = predict(models[name], length, range_)
        row = {
            "set": Path(path).parent.name,
            **{key: setting[key] for key in ("hurst", "magnification", "window", "points", "seed")},
            "transform": setting["transform"],
            "prescribed_skewness": skewness_of(setting),
            **of_surface,
            "energy_ratio": energy_ratio,
            "zone": Q0 * range_**2 / length,
            **{name: float(point[name]) for name in MEASURED},
        }
        for name, (share, low, high) in predicted.items():
            row |= {name: share, f"{name}_low": low, f"{name}_high": high}
        row |= {name: float(data[name]) for name in SECONDS}
        row["seconds_simulated"] = float(point.seconds_simulated)
        row["seconds_theory"] = seconds_theory
        yield row


def list_models(data, law):
    """`Roughness` by the name of what predicts: spectrum, shape of the heights, states."""
    theory = Roughness(
        h_rms=1.0,
        q0=Q0,
        elastic_energy=float(data.full_contact_energy),
        q1=Q0 * datasets.parameters(data)["magnification"],
        rms_slope=float(data.rms_slope),
        law=law,
    )
    shape = find_height_shape(float(data.skewness))
    return {
        "theory": theory,
        "shaped": replace(theory, shape=shape.shape, shape_error=shape.error),
        "states": replace(theory, simulated=read_simulated(data), lacking=float(data.lacking)),
    }


def predict(model, length, range_):
    """Share that remains, with its limits."""
    return list(map(float, model.limit_share(length, range_)))


def summarise(frame):
    """What predictions are worth, by the kind of heights, as a table in Markdown."""
    frame = frame.dropna(subset=["simulated"])
    rows = []
    for kind, group in frame.groupby("kind"):
        for name in (*heights_table.PREDICTED, "bound"):
            result = heights_table.compare(group, name, wanted_share=DEFAULT_SHARE)
            rows.append((kind, name, *describe(result)))
    columns = ("heights", "by", "points", "mean ratio", "rms of ratio - 1", "within 25 %")
    columns += ("mean error below", "rms error below", "inside limits", "decided")
    return table((*columns, "false: sticks", "false: does not stick"), rows)


def describe(result):
    """Texts of a comparison."""
    shares = [percent(result[name]) for name in ("within_quarter", "inside", "decided")]
    return (
        str(result["points"]),
        number(result["ratio"], 3),
        number(result["ratio_rms"], 2),
        shares[0],
        number(result["small_error"], 2),
        number(result["small_error_rms"], 2),
        *shares[1:],
        str(result["false_sticks"]),
        str(result["false_does_not_stick"]),
    )


if __name__ == "__main__":
    main(start(globals()))
