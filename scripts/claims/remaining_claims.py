"""Claims on what sticks, compared with the adhesion that remains and with experiments."""

import numpy as np
from scipy.optimize import brentq

from claims.criterion_claims import (
    CRYSTAL,
    EXAMPLES,
    PRINTED_LIMITS,
    PRINTED_MODULUS,
    RANGE,
    WORK_OF_ADHESION,
)
from claims.ledger import NOT, OPEN, QUALIFIED, REPRODUCED, Finding, claim, grade
from common.experiment_outcomes import COMPATIBLE, GRADES, MISSED, SILENT, SOME
from stickiness import criteria, datasets
from stickiness.remaining import Roughness, predict
from stickiness.remaining.prediction import DEFAULT_SHARE
from stickiness.spectrum.kinds import SelfAffine
from stickiness.statistics import students_t

NEGLIGIBLE = 0.1  # relative change of the remaining share that does not count
COARSE, FINE = 4, 32  # magnifications of the same long waves
ZONE = 0.1  # q0 range^2/l_a, of both
BROAD, BROADEST = 1e3, 1e6  # magnifications that theory compares: the paper has up to 1e3 and more
PAPER = "violano"  # the paper's criterion
RUBBER = "fuller_tabor/one_MPa"


@claim(19, "map")
def sticky_roughness(files):
    shortest = datasets.parameters(files["map"])["shortest_over_range"]
    value, low, high = (
        np.array([find_roughness(q0, shortest, sign) for q0 in EXAMPLES]) for sign in (0, -1, 1)
    )
    inside = (low <= PRINTED_LIMITS) & (high >= PRINTED_LIMITS)
    return Finding(
        value=float(value[1]),
        claimed=PRINTED_LIMITS[1],
        verdict=grade(False, bool(inside.all())),
        errors={"model": float(max(high[1] - value[1], value[1] - low[1]))},
        facts={
            "wanted": DEFAULT_SHARE,
            "shortest": shortest,
            "limits": {"value": value, "low": low, "high": high},
            "times": PRINTED_LIMITS / value,
            "jtb": criteria.jtb_limit(EXAMPLES, CRYSTAL, 1.0),
        },
    )


def find_roughness(range_times_q0, shortest, sign):
    """h_rms/range at which the wanted share, or its low or high limit by `sign`, just remains."""
    q1 = 2 * np.pi / shortest
    unit = SelfAffine(hurst=0.8, q0=range_times_q0, q1=q1, h_rms=1.0).elastic_energy()

    def excess(log_h):
        h = np.exp(log_h)
        rough = Roughness(h_rms=h, q0=range_times_q0, elastic_energy=unit * h**2)
        return float(np.log(rough.threshold(1.0, sign=sign) / CRYSTAL))

    return float(np.exp(brentq(excess, np.log(2.0), np.log(1e9))))


@claim(20, "asphalt")
def sticky_asphalt(files):
    ends = [files["asphalt"].sel(end=end) for end in ("rough", "smooth")]
    value, smooth = (find_modulus(end, 0) for end in ends)
    low, high = find_modulus(ends[0], -1), find_modulus(ends[1], 1)
    inside = low <= PRINTED_MODULUS <= high
    length = WORK_OF_ADHESION / (PRINTED_MODULUS * 1e6)
    h_rms, q0 = (float(ends[0][name]) for name in ("h_rms", "q0"))
    return Finding(
        value=value,
        claimed=PRINTED_MODULUS,
        verdict=OPEN if inside else NOT,
        errors={"model": max(value - low, find_modulus(ends[0], 1) - value)},
        facts={
            "wanted": DEFAULT_SHARE,
            "c0": [end.C0 for end in ends],
            "smooth": smooth,
            "limits": (low, high),
            "inside": inside,
            "jtb": h_rms / criteria.jtb_limit(q0, length, RANGE),
        },
    )


def find_modulus(surface, sign):
    """Modulus [MPa] below which the wanted share of the paper's example remains on a surface."""
    names = ("h_rms", "q0", "elastic_energy")
    rough = Roughness(**{name: float(surface[name]) for name in names})
    return float(WORK_OF_ADHESION / rough.threshold(RANGE, sign=sign) / 1e6)


@claim(21, "remaining")
def truncation(files):
    table = files["remaining"]
    ratios = {hurst: compare(table, hurst) for hurst in (0.8, 0.5)}
    smooth, rough = (float(np.mean(ratios[hurst])) for hurst in (0.8, 0.5))
    changes = [abs(1 - ratio) for ratio in (smooth, rough)]
    late = {hurst: extend(hurst) for hurst in (0.8, 0.5)}
    settled = abs(1 - late[0.8]) < NEGLIGIBLE
    scatter = np.std(ratios[0.8], ddof=1) / np.sqrt(len(ratios[0.8]))
    return Finding(
        value=smooth,
        claimed=1.0,
        verdict=grade(max(changes) < NEGLIGIBLE, settled),
        errors={"sampling": float(students_t(len(ratios[0.8])) * scatter)},
        facts={
            "coarse": COARSE,
            "fine": FINE,
            "rough": rough,
            "surfaces": sum(map(len, ratios.values())),
            "broad": (BROAD, BROADEST),
            "late": [late[0.8] - 1, late[0.5] - 1],
        },
    )


def extend(hurst):
    """Predicted share with all waves up to `BROADEST` over that up to `BROAD`, range to nothing."""
    broad = SelfAffine(hurst=hurst, q0=1.0, q1=BROADEST, h_rms=1.0)
    narrow = broad.truncated(BROAD)
    given = {"adhesion_length": narrow.elastic_energy(), "range": 1e-6}
    return predict(broad, **given).separation / predict(narrow, **given).separation


def compare(table, hurst):
    """Energy gained with finer waves over that without, at one work of adhesion, by surface."""
    rows = table[(table.hurst == hurst) & (table.window == 2) & np.isclose(table.zone, ZONE)]
    ratios = []
    for _, surface in rows[rows.magnification.isin([COARSE, FINE])].groupby("seed"):
        coarse, fine = (surface[surface.magnification == zeta] for zeta in (COARSE, FINE))
        work = float(coarse.full_contact_energy.iloc[0])
        gained = [np.interp(work, one.adhesion_length, one.bound) for one in (coarse, fine)]
        ratios.append(float(gained[1] / gained[0]))
    return ratios


@claim(22, "experiments")
def stickiness_of_experiments(files):
    dataset = files["experiments"]
    entries = datasets.parameters(dataset)["experiments"]
    rubber = dataset.sel(case=RUBBER)
    limit = float(rubber.criterion_roughness.sel(criterion=PAPER))
    read = (dataset.tests == 1) & (dataset.observed_known == GRADES.index("read"))
    codes = dataset.criterion_outcome.sel(criterion=PAPER).where(read, SILENT)
    named = {
        code: [name_case(str(c), entries) for c in codes.case.values[codes.values == code]]
        for code in (COMPATIBLE, SOME, MISSED)
    }
    verdicts = {MISSED: NOT, SOME: QUALIFIED, COMPATIBLE: REPRODUCED}
    return Finding(
        value=limit * 1e6,
        # The worst outcome among the observations that were read from a publication.
        verdict=next((verdict for code, verdict in verdicts.items() if named[code]), OPEN),
        errors={"model": np.nan},
        facts={
            "rubber": rubber,
            "missed": named[MISSED],
            "some": named[SOME],
            "compatible": named[COMPATIBLE],
            "wanted": DEFAULT_SHARE,
        },
    )


def name_case(case, experiments):
    """Author and label of a case."""
    experiment, name = case.split("/")
    entry = experiments[experiment]
    return f"{entry.get('short', entry['label'])} ({entry['cases'][name]['label']})"
