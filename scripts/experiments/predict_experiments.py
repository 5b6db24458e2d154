"""Published experiments: works of approach and separation and pull-off, beside what was seen."""

import numpy as np
import xarray as xr

from common.config.entries import OBSERVED_UNITS
from common.job import start
from experiments import judgements, predictions
from experiments.entries import GRADES, MIDDLE, read_observations
from experiments.experiment_markdown import write_markdown
from stickiness import datasets
from stickiness.criteria.registry import CRITERIA
from stickiness.error_budget import Part, absent, with_budget

QUOTED = {
    "remaining": ("1", "share of the work of adhesion that remains"),
    "relative_pull_off": ("1", "pull-off over that from a smooth surface"),
    "work_of_approach": ("J/m^2", "apparent work of adhesion on approach"),
    "work_of_separation": ("J/m^2", "apparent work of adhesion on separation"),
    "limiting_roughness": ("m", "rms height at which adhesion falls to the level observed"),
}
LIMITS = {
    "": "",
    "_low": ", low limit of the model",
    "_high": ", high limit of the model",
    "_lowest": ", lowest limit over all that is plausible",
    "_highest": ", highest limit over all that is plausible",
}
NOT_OBSERVED = "not observed"
LARGEST_EFFECT = 1e9  # of an input, in place of an infinite one


def main(job):
    observations = list(read_observations(job.params.experiments))
    dataset = predict_all(observations)
    datasets.write(
        dataset,
        job.output.dataset,
        title="published experiments, predicted",
        parameters={"experiments": job.params.experiments},
    )
    with datasets.whole_file(job.output.table) as path:
        path.write_text(write_markdown(dataset, job.params.experiments), encoding="utf-8")


def predict_all(observations):
    """Dataset of all observations, along `case`."""
    cases = [predict_case(observation) for observation in observations]
    dataset = xr.concat(
        cases,
        xr.DataArray([f"{o.experiment}/{o.name}" for o in observations], dims="case", name="case"),
    )
    dataset = dataset.assign_coords(criterion=list(CRITERIA), roughness=predictions.ROUGHNESS)
    return add_budgets(describe(dataset))


def predict_case(observation):
    """Prediction, observation and outcome of one case."""
    predicted = predictions.predict_observation(observation)
    known = {
        "quantity": observation.quantity,
        "outcome": np.int8(judgements.judge_prediction(observation, predicted)),
        "value_inside": np.int8(judgements.is_value_inside(observation, predicted)),
        "by_relation": np.int8(observation.relation is not None),
        "tests": np.int8(observation.published and observation.relation is None),
        "known": np.int8(max(GRADES.index(grade) for grade in observation.grades.values())),
        "observed_known": np.int8(GRADES.index(observation.grades[observation.quantity])),
        "energy_ratio": predicted.energy_ratio[MIDDLE],
        "waves_in_contact": predicted.waves_in_contact[MIDDLE],
        "work_of_adhesion": observation.inputs["work_of_adhesion"][MIDDLE],
        "h_rms": float(predictions.heights_of(observation, predicted.limit[1])[MIDDLE, 0]),
        **describe_effects(judgements.find_effects(observation, predicted)),
        **describe_observed(observation, predicted),
    }
    for name, values in (predicted.values | {"limiting_roughness": predicted.limit}).items():
        known |= quote(name, values)
    along = {
        f"pull_off_curve{end}": ("roughness", predicted.curve[row, MIDDLE])
        for row, end in enumerate(("_low", "", "_high"))
    }
    along["pull_off_curve_lowest"] = "roughness", predicted.curve[0].min(axis=0)
    along["pull_off_curve_highest"] = "roughness", predicted.curve[2].max(axis=0)
    outcomes = judgements.judge_criteria(observation, predicted)
    roughness = predictions.find_roughness(observation)
    return xr.Dataset(
        known
        | along
        | {
            "criterion_outcome": ("criterion", np.array([outcomes[n] for n in CRITERIA], "i1")),
            "criterion_roughness": ("criterion", [roughness[n] for n in CRITERIA]),
        }
    )


def quote(name, values):
    """Value, limits of the model with every input in the middle, and limits over all inputs."""
    low, value, high = values
    return {
        name: value[MIDDLE],
        f"{name}_low": low[MIDDLE],
        f"{name}_high": high[MIDDLE],
        f"{name}_lowest": np.fmin.reduce(low),  # leaves out what is not a number
        f"{name}_highest": np.fmax.reduce(high),
    }


def describe_effects(effects):
    """The input that matters most, by how much, and what the shortest wave does."""
    known = {name: effect for name, effect in effects.items() if not np.isnan(effect)}
    most = max(known, key=known.get, default="")
    return {
        "most_effective_input": most,
        "effect_of_input": min(known.get(most, np.nan if effects else 1.0), LARGEST_EFFECT),
        "effect_of_shortest_wave": min(effects.get("shortest_wavelength", 1.0), LARGEST_EFFECT),
    }


def describe_observed(observation, predicted):
    """Limits of every quantity that may be observed, inputs in the middle; NaN for all but one."""
    limits = [limit[MIDDLE] for limit in judgements.observed_limits(observation, predicted)]
    return {
        f"observed_{name}_{end}": float(value) if name == observation.quantity else np.nan
        for name in (*OBSERVED_UNITS, "sticks")
        for end, value in zip(("low", "high"), limits, strict=True)
    }


def describe(dataset):
    texts = {}
    quoted = QUOTED | {"pull_off_curve": QUOTED["relative_pull_off"]}
    for name, (unit, text) in quoted.items():
        texts |= {f"{name}{end}": (unit, f"{text}{limit}") for end, limit in LIMITS.items()}
    for name in (*OBSERVED_UNITS, "sticks"):
        unit, text = QUOTED.get(name, ("1", "whether the pair sticks"))
        for end in ("low", "high"):
            texts[f"observed_{name}_{end}"] = unit, f"{text}, observed, {end} limit", NOT_OBSERVED
    outcomes = ", ".join(f"{code} {word}" for code, word in enumerate(judgements.OUTCOMES))
    grades = ", ".join(f"{code} {word}" for code, word in enumerate(GRADES))
    beyond = "beyond the heights followed"
    for end in LIMITS:
        name = f"limiting_roughness{end}"
        texts[name] = (*texts[name], beyond)
    dataset = datasets.annotate(
        dataset,
        case=("1", "experiment and case"),
        criterion=("1", "stickiness criterion"),
        roughness=("m", "rms height"),
        quantity=("1", "what was observed"),
        outcome=("1", f"outcome: {outcomes}"),
        value_inside=("1", "1 where the value itself agrees, every input in the middle"),
        by_relation=("1", "1 where a relation was observed, evaluated with the inputs"),
        tests=("1", "1 where a published number or answer is held against the prediction"),
        known=("1", f"how the least known input is known: {grades}"),
        observed_known=("1", f"how the observation is known: {grades}"),
        energy_ratio=("1", "work of adhesion over the elastic energy of full contact"),
        waves_in_contact=("1", "longest waves across what holds at pull-off", "flat on flat"),
        work_of_adhesion=("J/m^2", "work of adhesion"),
        h_rms=("m", "rms height, given or limiting"),
        most_effective_input=("1", "input within whose limits the prediction changes most"),
        effect_of_input=(
            "1",
            "factor by which this input changes the prediction, at most 1e9",
            "nothing is predicted",
        ),
        effect_of_shortest_wave=(
            "1",
            "factor by which the shortest wave changes the prediction, at most 1e9",
            "nothing is predicted",
        ),
        criterion_outcome=("1", f"outcome by a criterion: -1 nothing decided, {outcomes}"),
        criterion_roughness=(
            "m",
            "rms height up to which a criterion says sticky",
            "looks at no roughness, or beyond the heights followed",
        ),
        **texts,
    )
    dataset.outcome.attrs |= datasets.flags(judgements.OUTCOMES)
    silent = ("nothing decided", *judgements.OUTCOMES)
    dataset.criterion_outcome.attrs |= datasets.flags(silent, first=judgements.SILENT)
    for name in ("known", "observed_known"):
        dataset[name].attrs |= datasets.flags(GRADES)
    return dataset


def add_budgets(dataset):
    """The model's limits, and what is not known of the inputs."""
    for name in QUOTED:
        value = dataset[name]
        model = np.maximum(dataset[f"{name}_high"] - value, value - dataset[f"{name}_low"])
        reach = np.maximum(dataset[f"{name}_highest"] - value, value - dataset[f"{name}_lowest"])
        inputs = np.sqrt(np.maximum(reach**2 - model**2, 0.0))
        dataset = with_budget(
            dataset,
            name,
            discretisation=absent("closed form"),
            solver=absent("closed form"),
            sampling=Part(inputs, "of all that is plausible of the inputs"),
            bandwidth=absent("the spectrum is swept with the inputs"),
            model=Part(model, "larger side of its limits"),
        )
    return dataset


if __name__ == "__main__":
    main(start(globals(), "predict_experiments"))
