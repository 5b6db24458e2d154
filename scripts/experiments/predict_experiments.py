"""Published experiments: works of approach and separation and pull-off, beside what was seen.

Everything that is not known is swept: each input between its plausible ends, the others in their
middle, and all corners. Corners matter where two unknown inputs move a prediction the same way.
"""

from dataclasses import dataclass
from functools import cache, cached_property
from itertools import product

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from common import experiment_outcomes as outcomes
from common.config.entries import CONDITIONS, OBSERVED_UNITS, conditions_of
from common.experiment_outcomes import COMPATIBLE, GRADES, MISSED, OUTCOMES, SILENT, SOME
from common.job import start
from common.templates import write_page
from stickiness import datasets
from stickiness.criteria.a_v_table import surface_a_v
from stickiness.criteria.pair import Pair
from stickiness.criteria.registry import CRITERIA
from stickiness.criteria.verdict import describe_surface
from stickiness.error_budget import ErrorComponent, not_applicable, with_budget
from stickiness.remaining import sphere
from stickiness.remaining.prediction import DEFAULT_SHARE, HYSTERESIS, LATE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.units import si

SHAPE = ("hurst", "longest_wavelength", "rolloff_wavelength", "shortest_wavelength")
MOMENTS = ("q0", "rms_slope", "rms_curvature", "elastic_energy")
MIDDLE = 0  # index of the combination with every input in the middle
SIGNS = (-1, 0, 1)  # low limit, value, high limit
ROUGHNESS = np.geomspace(1e-11, 1e-3, 121)  # rms heights [m] along which adhesion is followed
# Margins are nearly powers of the rms height: between points as far apart as these they are read
# off to better than 1 %.
COARSE = ROUGHNESS[::4]
FACTOR = 4.0  # between the adhesion that a criterion requires and the actual one, if it is right
LARGEST_EFFECT = 1e9  # of an input, instead of an infinite one

LIMITS = {
    "": "",
    "_low": ", low limit of the model",
    "_high": ", high limit of the model",
    "_lowest": ", lowest limit over all that is plausible",
    "_highest": ", highest limit over all that is plausible",
}
QUOTED = {
    "remaining": ("1", "share of the work of adhesion that remains"),
    "relative_pull_off": ("1", "pull-off over that from a smooth surface"),
    "work_of_approach": ("J/m^2", "apparent work of adhesion on approach"),
    "work_of_separation": ("J/m^2", "apparent work of adhesion on separation"),
    "limiting_roughness": ("m", "rms height at which adhesion falls to the level observed"),
}
BEYOND = {"limiting_roughness": ["beyond the heights followed"]}  # what NaN means
_OUTCOMES = ", ".join(f"{code} {word}" for code, word in enumerate(OUTCOMES))
_GRADES = ", ".join(f"{code} {word}" for code, word in enumerate(GRADES))
_CHANGES, _NOTHING = "changes the prediction, at most 1e9", "nothing is predicted"
VARIABLES = {
    **{
        f"{name}{end}": (unit, f"{text}{limit}", *BEYOND.get(name, []))
        for name, (unit, text) in (QUOTED | {"pull_off_curve": QUOTED["relative_pull_off"]}).items()
        for end, limit in LIMITS.items()
    },
    **{
        f"observed_{name}_{end}": (unit, f"{text}, observed, {end} limit", "not observed")
        for name, (unit, text) in (QUOTED | {"sticks": ("1", "whether the pair sticks")}).items()
        if name != "remaining"
        for end in ("low", "high")
    },
    "case": ("1", "experiment and case"),
    "criterion": ("1", "stickiness criterion"),
    "roughness": ("m", "rms height"),
    "quantity": ("1", "what was observed"),
    "outcome": ("1", f"outcome: {_OUTCOMES}"),
    "value_inside": ("1", "1 where the value itself agrees, every input in the middle"),
    "by_relation": ("1", "1 where a relation was observed, evaluated with the inputs"),
    "tests": ("1", "1 where a published number or answer is compared with the prediction"),
    "known": ("1", f"how the least known input is known: {_GRADES}"),
    "observed_known": ("1", f"how the observation is known: {_GRADES}"),
    "energy_ratio": ("1", "work of adhesion over the elastic energy of full contact"),
    "waves_in_contact": ("1", "longest waves across what holds at pull-off", "flat on flat"),
    "work_of_adhesion": ("J/m^2", "work of adhesion"),
    "h_rms": ("m", "rms height, given or limiting"),
    "most_effective_input": ("1", "input within whose limits the prediction changes most"),
    "effect_of_input": ("1", f"factor by which this input {_CHANGES}", _NOTHING),
    "effect_of_shortest_wave": ("1", f"factor by which the shortest wave {_CHANGES}", _NOTHING),
    "criterion_outcome": ("1", f"outcome by a criterion: -1 nothing decided, {_OUTCOMES}"),
    "criterion_roughness": (
        *("m", "rms height up to which a criterion says sticky"),
        "looks at no roughness, or beyond the heights followed",
    ),
}


def main(job):
    experiments = job.params.experiments
    dataset = predict_all(experiments)
    datasets.write(
        dataset,
        job.output.dataset,
        title="published experiments, predicted",
        parameters={"experiments": experiments},
    )
    write_page(
        job.input.template,
        job.output.table,
        **outcomes.describe(dataset, experiments),
        wanted=DEFAULT_SHARE,
        factor=FACTOR,
        fewest_waves=outcomes.FEWEST_WAVES,
        criteria=[criterion.label for criterion in CRITERIA.values()],
        survivals=[
            (experiments[name]["label"], *(outcomes.MARKS[code] for code in codes))
            for name, codes in outcomes.find_survivals(dataset).items()
        ],
    )


@dataclass(frozen=True)
class Observation:
    """One observation, and the conditions it was made under.

    `inputs` has, by name, arrays of one value for every combination of what is plausible: first all
    inputs in the middle, then each at its low and high end, the others in the middle, then all
    corners. `swept` are the names of the inputs that are not known.
    """

    place: str  # experiment and case
    published: bool
    quantity: str
    observed: dict  # as the configuration states it
    low: float  # limits of what was observed, or of the factor of the relation; 0 or 1 of "sticks"
    high: float
    inputs: dict[str, NDArray]
    swept: tuple[str, ...]
    grades: dict[str, str]  # how the inputs are known

    @cached_property
    def shapes(self):
        """Moments of unit rms height and a_V for every combination, see `describe_shape`."""
        not_applicable = np.full(len(self.inputs["hurst"]), None)
        rows = zip(*(self.inputs.get(key, not_applicable) for key in SHAPE), strict=True)
        return [describe_shape(*row) for row in rows]

    def pair(self, h_rms: NDArray) -> Pair:
        """`Pair` at rms heights ``(combination, n)``, for as many of the first combinations."""
        some = slice(len(h_rms))
        moments, a_v = zip(*self.shapes[some], strict=True)
        q0, slope, curvature, energy = (values[:, None] for values in np.transpose(moments))
        modulus, work, reach = (
            self.inputs[name][some, None] for name in ("modulus", "work_of_adhesion", "range")
        )
        at = [found.at(ratios)[0] for found, ratios in zip(a_v, reach / h_rms, strict=True)]
        return Pair(
            h_rms=h_rms,
            q0=q0,
            rms_slope=slope * h_rms,
            rms_curvature=curvature * h_rms,
            elastic_energy=energy * h_rms**2,
            modulus=modulus,
            work_of_adhesion=work,
            range=reach,
            a_v=np.array(at),
        )

    def pull_off(self, pair: Pair) -> list[sphere.SpherePullOff]:
        """Pull-off of the sphere: low limit, value, high limit."""
        at = self.inputs["radius"][:, None], pair.adhesion_length, pair.range
        return [sphere.pull_off(pair, *at, sign) for sign in SIGNS]


@cache
def describe_shape(hurst, longest, rolloff, shortest):
    """`MOMENTS` of a self-affine spectrum of unit rms height, wavelengths in m, and its a_V."""
    spectrum = SelfAffine(
        hurst=hurst,
        q0=2 * np.pi / longest,
        q1=2 * np.pi / shortest,
        h_rms=1.0,
        q_rolloff=None if rolloff is None else 2 * np.pi / rolloff,
    )
    known = describe_surface(spectrum)
    return tuple(known[name] for name in MOMENTS), surface_a_v(spectrum, known)


def read_observation(experiment, name, entry):
    """One case of an experiment of the configuration, in SI units."""
    case = entry["cases"][name]
    observed, conditions = case["observed"], conditions_of(entry, case)
    ends = {key: read_ends(given, CONDITIONS[key]) for key, given in conditions.items()}
    swept = tuple(key for key, found in ends.items() if len(found) > 1)
    inputs = combine_inputs(ends, swept)
    if "plane_strain_modulus" in inputs:
        inputs["modulus"] = inputs["plane_strain_modulus"]
    else:
        inputs["modulus"] = inputs["youngs_modulus"] / (1 - inputs["poisson_ratio"] ** 2)
    unit = OBSERVED_UNITS.get(observed["quantity"])
    limits = observed["factor"] if "relation" in observed else read_ends(observed, unit)
    return Observation(
        place=f"{experiment}/{name}",
        published=entry.get("published", True),
        quantity=observed["quantity"],
        observed=observed,
        low=float(limits[0]),
        high=float(limits[-1]),
        inputs=inputs,
        swept=swept,
        grades={key: given["known"] for key, given in conditions.items()},
    )


def read_ends(given, unit):
    """The value, or both limits."""
    values = given["between"] if "between" in given else [given["value"]]
    return np.array([float(value) if unit is None else si(value, unit) for value in values])


def combine_inputs(ends, swept):
    """Values of every input for all combinations; see `Observation`."""
    # Places of the swept inputs between their ends: 0 low, 1 middle, 2 high.
    places = [[1] * len(swept)]
    for axis in range(len(swept)):
        places += [[end if i == axis else 1 for i in range(len(swept))] for end in (0, 2)]
    places = np.array([*places, *map(list, product((0, 2), repeat=len(swept)))])
    inputs = {key: np.full(len(places), found[0]) for key, found in ends.items()}
    for axis, key in enumerate(swept):
        low, high = ends[key]
        middle = np.sqrt(low * high) if low > 0 else high / 2
        inputs[key] = np.array([low, middle, high])[places[:, axis]]
    return inputs


def predict(observation):
    """Predictions ``(sign, combination)`` by name, the pair, and waves in the contact.

    The curve, ``(sign, combination, roughness)``, is the pull-off of a sphere over that from a
    smooth surface, or the share of the work of adhesion that remains between flats. The pair is at
    the rms heights given or, if a limiting one was observed, at the predicted one.
    """
    count = len(observation.inputs["hurst"])
    rough = observation.pair(np.broadcast_to(ROUGHNESS, (count, len(ROUGHNESS))))
    if "radius" in observation.inputs:
        curve = np.array([found.relative for found in observation.pull_off(rough)])
    else:
        curve = np.array([rough.remaining(sign) for sign in SIGNS])
    level = observation.observed.get("level", DEFAULT_SHARE)
    limit = np.array([[find_fall(ROUGHNESS, row, level) for row in rows] for rows in curve])
    if observation.quantity == "limiting_roughness" and np.isnan(limit).any():
        raise ValueError(
            f"{observation.place.replace('/', '.cases.')}: adhesion falls to {level:g} at no "
            f"rms height from {ROUGHNESS[0]:g} to {ROUGHNESS[-1]:g} m; correct the level or inputs"
        )
    pair = observation.pair(observation.inputs.get("h_rms", limit[1])[:, None])
    share = np.array([pair.remaining(sign)[:, 0] for sign in SIGNS])
    if "radius" in observation.inputs:
        found = observation.pull_off(pair)
        relative = np.array([one.relative[:, 0] for one in found])
        separation = np.array([one.work[:, 0] for one in found])
        waves = float((2 * found[1].zone_radius * pair.q0 / (2 * np.pi))[MIDDLE, 0])
    else:
        length, reach = pair.adhesion_length, pair.range
        stress = np.array([pair.tension(length, reach, sign) for sign in SIGNS])
        relative = np.minimum(stress * reach / length, 1.0)[..., 0]
        separation = np.array([*share[:2], np.minimum(share[2] * HYSTERESIS, 1.0)])
        waves = np.nan
    work = pair.work_of_adhesion[:, 0]
    values = {
        "remaining": share,
        "relative_pull_off": relative,
        "work_of_approach": share / np.array([[LATE], [1], [1]]) * work,
        "work_of_separation": separation * work,
        "limiting_roughness": limit,
        "pull_off_curve": curve,
    }
    return values, pair, waves


def find_fall(heights, values, level):
    """Rms height [m] at which values fall to a level for good; NaN if that is not among them."""
    above = np.flatnonzero(values > level)
    if not above.size or above[-1] == values.size - 1:
        return float("nan")
    here = slice(above[-1], above[-1] + 2)
    ends = values[here]
    first, last = ends - level if ends.min() == 0 else np.log(ends / level)
    low, high = np.log(heights[here])
    return float(np.exp(low + first / (first - last) * (high - low)))


def find_observed(observation, pair):
    """Low and high limit ``(end, combination)`` of what was observed, by its relation if any."""
    factors = np.array([[observation.low], [observation.high]]) * np.ones(len(pair.h_rms))
    relation = observation.observed.get("relation")
    if relation is None:
        return factors
    work, energy = pair.work_of_adhesion[:, 0], (pair.elastic_energy * pair.modulus)[:, 0]
    if relation == "energy_ratio":
        return (pair.h_rms[:, 0] * np.sqrt(work / (factors * energy)))[::-1]
    found = (2 if relation == "cycle_loss" else 1) * factors * work - energy
    error = si(observation.observed.get("error", "0 J/m^2"), "J/m^2")
    return np.maximum(found + np.array([[-1], [1]]) * error, 0.0)


def agrees(observation, observed, least, most):
    """Whether limits of the prediction overlap with those observed, by combination."""
    if observation.quantity == "sticks":
        return most >= DEFAULT_SHARE if observation.low else least < DEFAULT_SHARE
    return (most >= observed[0]) & (least <= observed[1])


def summarise(right):
    """Place in `OUTCOMES` of what is right for all, some or no combination of the inputs."""
    return COMPATIBLE if np.all(right) else SOME if np.any(right) else MISSED


def judge_criteria(observation, observed, pair):
    """Place in `OUTCOMES` of every criterion, or `SILENT`.

    Where a limiting roughness was observed, a criterion is right if it requires there an adhesion
    within `FACTOR` of the actual one; elsewhere if it says whether the pair was seen to stick.
    """
    found = dict.fromkeys(CRITERIA, SILENT)
    if observation.quantity == "limiting_roughness":
        at_limits = observation.pair(observed.T)
        for name, criterion in CRITERIA.items():
            if criterion.has_length:
                length = criterion.adhesion_length_threshold(at_limits)
                ratio = length / at_limits.adhesion_length
                found[name] = summarise((ratio[:, 0] <= FACTOR) & (ratio[:, 1] >= 1 / FACTOR))
    else:
        low, high = observed
        if observation.quantity == "sticks":
            sticks, decided = low > 0, np.ones(len(low), dtype=bool)
        else:
            of_work = observation.quantity != "relative_pull_off"
            whole = observation.inputs["work_of_adhesion"] if of_work else 1.0
            sticks = low / whole >= DEFAULT_SHARE
            decided = sticks | (high / whole <= DEFAULT_SHARE)
        for name, criterion in CRITERIA.items():
            if decided.any():
                says = np.broadcast_to(criterion.margin(pair), pair.h_rms.shape)[:, 0] > 1
                found[name] = summarise((says == sticks)[decided])
    return found | dict.fromkeys(observation.observed.get("silent", ()), SILENT)


def find_roughness(observation):
    """Rms height [m] up to which every criterion says sticky; NaN if it looks at no roughness."""
    rough = observation.pair(COARSE[None])
    return [
        find_fall(COARSE, criterion.margin(rough)[0], 1.0) if criterion.has_length else np.nan
        for criterion in CRITERIA.values()
    ]


def predict_case(observation):
    """Prediction, observation and outcome of one case."""
    values, pair, waves = predict(observation)
    quantity = observation.quantity
    observed = find_observed(observation, pair)
    low, value, high = values["remaining" if quantity == "sticks" else quantity]
    # Factor by which each swept input changes the prediction, the others in the middle: infinite
    # where the prediction vanishes at one end, NaN where it vanishes everywhere.
    effects = {}
    for place, name in enumerate(observation.swept):
        along = value[[1 + 2 * place, MIDDLE, 2 + 2 * place]]
        with np.errstate(divide="ignore", invalid="ignore"):
            effects[name] = float(along.max() / along.min())
    known = {name: effect for name, effect in effects.items() if not np.isnan(effect)}
    most = max(known, key=known.get, default="")
    by_criterion = list(judge_criteria(observation, observed, pair).values())
    grade = observation.observed["known"]
    by_relation = "relation" in observation.observed
    data = {
        "quantity": quantity,
        "outcome": np.int8(summarise(agrees(observation, observed, low, high))),
        "value_inside": np.int8(agrees(observation, observed, value, value)[MIDDLE]),
        "by_relation": np.int8(by_relation),
        "tests": np.int8(observation.published and not by_relation),
        "known": np.int8(max(map(GRADES.index, [grade, *observation.grades.values()]))),
        "observed_known": np.int8(GRADES.index(grade)),
        "energy_ratio": (pair.adhesion_length / pair.elastic_energy)[MIDDLE, 0],
        "waves_in_contact": waves,
        "work_of_adhesion": observation.inputs["work_of_adhesion"][MIDDLE],
        "h_rms": float(pair.h_rms[MIDDLE, 0]),
        "most_effective_input": most,
        "effect_of_input": min(known.get(most, np.nan if effects else 1.0), LARGEST_EFFECT),
        "effect_of_shortest_wave": min(effects.get("shortest_wavelength", 1.0), LARGEST_EFFECT),
        "criterion_outcome": ("criterion", np.array(by_criterion, "i1")),
        "criterion_roughness": ("criterion", find_roughness(observation)),
    }
    for name in (*OBSERVED_UNITS, "sticks"):
        limits = observed[:, MIDDLE] if name == quantity else (np.nan, np.nan)
        data |= {f"observed_{name}_low": limits[0], f"observed_{name}_high": limits[1]}
    for name, (low, value, high) in values.items():
        # fmin and fmax leave out what is not a number.
        lowest, highest = np.fmin.reduce(low), np.fmax.reduce(high)
        ends = value[MIDDLE], low[MIDDLE], high[MIDDLE], lowest, highest
        dims = ["roughness"] if name == "pull_off_curve" else []
        data |= {f"{name}{end}": (dims, x) for end, x in zip(LIMITS, ends, strict=True)}
    return xr.Dataset(data)


def predict_all(experiments):
    observations = [
        read_observation(name, case, entry)
        for name, entry in experiments.items()
        for case in entry["cases"]
    ]
    dataset = xr.concat(
        [predict_case(observation) for observation in observations],
        xr.DataArray([one.place for one in observations], dims="case", name="case"),
    )
    dataset = dataset.assign_coords(criterion=list(CRITERIA), roughness=ROUGHNESS)
    dataset = datasets.annotate(dataset, **VARIABLES)
    dataset.outcome.attrs |= datasets.flags(OUTCOMES)
    dataset.criterion_outcome.attrs |= datasets.flags(("nothing decided", *OUTCOMES), first=SILENT)
    for name in ("known", "observed_known"):
        dataset[name].attrs |= datasets.flags(GRADES)
    for name in QUOTED:
        value = dataset[name]
        model = np.maximum(dataset[f"{name}_high"] - value, value - dataset[f"{name}_low"])
        reach = np.maximum(dataset[f"{name}_highest"] - value, value - dataset[f"{name}_lowest"])
        inputs = np.sqrt(np.maximum(reach**2 - model**2, 0.0))
        dataset = with_budget(
            dataset,
            name,
            discretisation=not_applicable("closed form"),
            solver=not_applicable("closed form"),
            sampling=ErrorComponent(inputs, "of all that is plausible of the inputs"),
            bandwidth=not_applicable("the spectrum is swept with the inputs"),
            model=ErrorComponent(model, "larger side of its limits"),
        )
    return dataset


if __name__ == "__main__":
    main(start(globals(), "predict_experiments"))
