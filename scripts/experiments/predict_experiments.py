"""Published experiments: works of approach and separation and pull-off, beside what was seen."""

import numpy as np
import xarray as xr

from pipeline.experiments import judgements, predictions
from pipeline.experiments.entries import GRADES, OBSERVED_UNITS, read_observations
from pipeline.experiments.markdown import write_markdown
from pipeline.job import start
from stickiness.core import datasets
from stickiness.core.budget import Part, absent, with_budget
from stickiness.criteria.registry import CRITERIA

QUOTED = {
    "remaining": ("1", "share of the work of adhesion that remains"),
    "relative_pull_off": ("1", "pull-off over that from a smooth surface"),
    "work_of_approach": ("J/m^2", "apparent work of adhesion on approach"),
    "work_of_separation": ("J/m^2", "apparent work of adhesion on separation"),
    "roughness_at_a_tenth": ("m", "rms height at which the pull-off falls to a tenth"),
}
NOT_OBSERVED = "not observed"


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
    middle = observation.middle
    known = {
        "quantity": observation.quantity,
        "outcome": np.int8(judgements.judge_prediction(observation, predicted)),
        "known": np.int8(max(GRADES.index(grade) for grade in observation.grades.values())),
        "observed_known": np.int8(GRADES.index(observation.grades[observation.quantity])),
        "energy_ratio": predicted.energy_ratio[middle],
        "waves_in_contact": predicted.waves_in_contact[middle],
        "work_of_adhesion": observation.inputs["work_of_adhesion"][middle],
        **describe_effects(judgements.find_effects(observation, predicted)),
        **describe_observed(observation, predicted),
    }
    for name, values in (predicted.values | {"roughness_at_a_tenth": predicted.tenth}).items():
        known |= quote(name, values, middle)
    along = {
        f"pull_off_curve{end}": ("roughness", predicted.curve[row, middle])
        for row, end in enumerate(("_low", "", "_high"))
    }
    along["pull_off_curve_lowest"] = "roughness", predicted.curve[0].min(axis=0)
    along["pull_off_curve_highest"] = "roughness", predicted.curve[2].max(axis=0)
    outcomes = judgements.judge_criteria(observation, predicted)
    middle_only = predictions.without_error(observation)
    roughness = predictions.find_roughness(middle_only)
    return xr.Dataset(
        known
        | along
        | {
            "criterion_outcome": ("criterion", np.array([outcomes[n] for n in CRITERIA], "i1")),
            "criterion_roughness": ("criterion", [float(roughness[n][0]) for n in CRITERIA]),
        }
    )


def quote(name, values, middle):
    """Value, limits of the model with every input in the middle, and limits over all inputs."""
    low, value, high = values
    return {
        name: value[middle],
        f"{name}_low": low[middle],
        f"{name}_high": high[middle],
        f"{name}_lowest": low.min(),
        f"{name}_highest": high.max(),
    }


def describe_effects(effects):
    """The input that matters most, by how much, and what the shortest wave does."""
    most = max(effects, key=effects.get, default="")
    return {
        "most_effective_input": most,
        "effect_of_input": effects.get(most, 1.0),
        "effect_of_shortest_wave": effects.get("shortest_wavelength", 1.0),
    }


def describe_observed(observation, predicted):
    """Limits of every quantity that may be observed; NaN for all but one."""
    low, high = judgements.observed_limits(observation, predicted)
    return {
        f"observed_{name}_{end}": float(value) if name == observation.quantity else np.nan
        for name in OBSERVED_UNITS
        for end, value in (("low", low.min()), ("high", high.max()))
    }


def describe(dataset):
    texts = {}
    for name, (unit, text) in QUOTED.items():
        texts[name] = unit, text
        texts[f"{name}_low"] = unit, f"{text}, low limit of the model"
        texts[f"{name}_high"] = unit, f"{text}, high limit of the model"
        texts[f"{name}_lowest"] = unit, f"{text}, lowest limit over all that is plausible"
        texts[f"{name}_highest"] = unit, f"{text}, highest limit over all that is plausible"
    for name in OBSERVED_UNITS:
        unit, text = QUOTED.get(name, ("1", "whether the pair sticks"))
        for end in ("low", "high"):
            texts[f"observed_{name}_{end}"] = unit, f"{text}, observed, {end} limit", NOT_OBSERVED
    for end in ("", "_low", "_high", "_lowest", "_highest"):
        texts[f"pull_off_curve{end}"] = "1", f"pull-off over that from a smooth surface{end}"
    outcomes = ", ".join(f"{code} {word}" for code, word in enumerate(judgements.OUTCOMES))
    grades = ", ".join(f"{code} {word}" for code, word in enumerate(GRADES))
    return datasets.annotate(
        dataset,
        case=("1", "experiment and case"),
        criterion=("1", "stickiness criterion"),
        roughness=("m", "rms height"),
        quantity=("1", "what was observed"),
        outcome=("1", outcomes),
        known=("1", f"how the least known input is known: {grades}"),
        observed_known=("1", f"how the observation is known: {grades}"),
        energy_ratio=("1", "work of adhesion over the elastic energy of full contact"),
        waves_in_contact=("1", "longest waves across what holds at pull-off", "flat on flat"),
        work_of_adhesion=("J/m^2", "work of adhesion"),
        most_effective_input=("1", "input within whose limits the prediction changes most"),
        effect_of_input=("1", "factor by which it does"),
        effect_of_shortest_wave=("1", "factor by which the shortest wave changes the prediction"),
        criterion_outcome=("1", f"-1 nothing decided, {outcomes}"),
        criterion_roughness=(
            "m",
            "rms height up to which a criterion says sticky",
            "looks at no roughness",
        ),
        **texts,
    )


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
