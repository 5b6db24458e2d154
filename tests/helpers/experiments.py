"""Made-up experiments: entries of the configuration, observations, and a dataset of outcomes."""

import json

import numpy as np
import xarray as xr
from helpers.entries import complete

from common.config.experiments import Experiments
from experiments.predict_experiments import read_observation
from stickiness.criteria.registry import CRITERIA
from stickiness.units import write_quantities


def known(value, by="read"):
    """A value with its unit, or the limits of what is plausible."""
    return {"between" if isinstance(value, list) else "value": value, "known": by}


def seen(quantity, value=None, by="read", **more):
    """What was observed: a value, its limits, or a relation."""
    given = {} if value is None else known(value, by)
    return {"quantity": quantity, "known": by, **given, **more}


def complete_experiments(**entries):
    """Experiments as rules get them."""
    return complete(Experiments, experiments=entries)["experiments"]


CONDITIONS = {
    "plane_strain_modulus": known("1 MPa"),
    "work_of_adhesion": known("50 mJ/m^2", "recalled"),
    "range": known("0.3 nm", "assumed"),
    "hurst": known(0.8),
    "longest_wavelength": known("100 um"),
    "shortest_wavelength": known("1 um"),
}
BALL = {"label": "soft ball", "short": "Ball 1999", "citation": "Ball, J. Made Up 1, 2 (1999)"}
BALL |= {"not_found": ["the color of the ball"], "missed": "the ball was wet"}
BALL |= CONDITIONS | {"radius": known("5 mm")}
BALL |= {"longest_wavelength": known(["50 um", "100 um"], "assumed")}
LOST = seen("limiting_roughness", ["1 um", "4 um"], "recalled")
HELD = {"h_rms": known("1 um"), "observed": seen("work_of_separation", "30 mJ/m^2")}
PLATE = {"label": "hard plate", "citation": "no source"} | CONDITIONS
PLATE |= {"plane_strain_modulus": known(["100 GPa", "200 GPa"], "assumed")}
STEEL = {"h_rms": known("1 um"), "observed": seen("sticks", False, "recalled")}
EXPERIMENTS = complete_experiments(
    ball=BALL
    | {"cases": {"limit": {"label": "lost", "observed": LOST}, "work": {"label": "held"} | HELD}},
    plate=PLATE | {"cases": {"steel": {"label": "steel on steel"} | STEEL}},
)


def observe(observed, **conditions):
    """Observation of a case with other conditions than `CONDITIONS`; None: without."""
    entry = {key: given for key, given in (CONDITIONS | conditions).items() if given is not None}
    entry |= {"label": "mine", "citation": "none"}
    if observed["quantity"] != "limiting_roughness":
        entry.setdefault("h_rms", known("1 um"))
    entry["cases"] = {"one": {"label": "one", "observed": observed}}
    return read_observation("mine", "one", complete_experiments(mine=entry)["mine"])


def make_dataset(rows, experiments=EXPERIMENTS):
    """Dataset of cases as `predict_experiments` writes it, from what differs by case.

    `rows` has by case: `quantity`; `observed` and `predicted`, each (low, high) and (value, low,
    high); and any of `FLAGS`. `criteria` has outcomes, `limits` the roughness limits of criteria,
    by name; others have decided nothing and look at no roughness.
    """
    made = [make_row(**row) for row in rows.values()]
    dataset = xr.concat(made, xr.DataArray([*rows], dims="case", name="case"))
    return dataset.assign_attrs(
        parameters=json.dumps({"experiments": write_quantities(experiments)})
    )


FLAGS = {"outcome": 2, "value_inside": 0, "by_relation": 0, "tests": 1, "observed_known": 1}
FLAGS |= {"known": 3, "effect_of_input": 1.0, "waves_in_contact": np.nan}
FLAGS |= {"h_rms": 1e-6}


def make_row(
    quantity, observed, predicted, criteria=None, limits=None, most_effective_input="", **flags
):
    names = ("predicted", "predicted_lowest", "predicted_highest", "observed_low", "observed_high")
    values = FLAGS | flags | dict(zip(names, (*predicted, *observed), strict=True))
    values |= {"quantity": quantity, "most_effective_input": most_effective_input}
    outcomes, roughness = (
        {**dict.fromkeys(CRITERIA, nothing), **(given or {})}
        for nothing, given in ((-1, criteria), (np.nan, limits))
    )
    values["criterion_outcome"] = "criterion", np.array([*outcomes.values()], "i1")
    values["criterion_roughness"] = "criterion", [*roughness.values()]
    return xr.Dataset(values, coords={"criterion": [*CRITERIA]})
