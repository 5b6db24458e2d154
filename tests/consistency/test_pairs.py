"""Numbers of 60 pairs of a material and a surface, against a table of what they were.

No number of the table is right by itself: it shows what a change of the code changes. Contact on
heights is simulated on a coarse grid. ``python -m pytest tests/consistency/test_pairs.py --fix``
prints what has changed and writes the table anew.
"""

import tempfile
from functools import cache, partial
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from stickiness import Material, Surface, judge
from stickiness.entries import check_surface
from stickiness.spectrum import SelfAffine, Tabulated
from stickiness.surface import realised_spectrum, synthesise
from stickiness.verdicts.rough_ball import pull_off_of_ball

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::stickiness.plausibility.PlausibilityWarning"),
    pytest.mark.usefixtures("coarse_simulation"),
]

TABLE = Path(__file__).parents[1] / "data/pairs.csv"
HEADER = """\
# What verdicts say of the pairs in tests/consistency/test_pairs.py: low limit, value, high limit.
# All numbers are in SI units. A number without limits has nan in their place.
# To renew: python -m pytest tests/consistency/test_pairs.py --fix
"""
KEY = ["pair", "output"]
LIMITS = ["low", "value", "high"]
RELATIVE = 1e-6  #: largest change of a number that counts as none
# The last bits of another processor decide where descents on thin incompressible layers stop, and
# which of two measurements is counted first.
ROUNDED = {"layer on map": 1e-2, "rubber on several": 1e-5}
ABSOLUTE = {"remaining": 1e-9}  #: the same of shares, which may be 0

SIDE = 1e-3  #: of most maps [m]


def describe(h_rms=1e-6, hurst=0.8, q0=6e4, q1=6e8, **options):
    return SelfAffine(hurst=hurst, q0=q0, q1=q1, h_rms=h_rms, **options)


def make_known(*heights, **options):
    """A surface of one rms height, or between two."""
    return Surface.from_spectrum(*(describe(h_rms, **options) for h_rms in heights))


def make_heights(seed, points=64, h_rms=1e-6, side=SIDE, waves=4, **options):
    """Periodic heights with so many of the longest waves, the shortest of 3 points."""
    q0 = 2 * np.pi * waves / side
    spectrum = describe(h_rms, q0=q0, q1=2 * np.pi * points / 3 / side, **options)
    return synthesise(spectrum, points, side, seed)


def make_map(seed, side=SIDE, extend_to=None, contact=None, **options):
    heights = make_heights(seed, side=side, **options)
    return Surface.from_heights(heights, side, extend_to=extend_to, contact=contact)


def make_skewed_map():
    """Peaks on a plain."""
    heights = 2e-6 * np.exp(0.5e6 * make_heights(4, points=96))
    return Surface.from_heights(heights, SIDE, extend_to=2e-5)


def make_periodic_map():
    options = {"detrend": "mean", "window": "none", "fit_to": 5e-5, "extend_to": 3e-5}
    return Surface.from_heights(make_heights(6, waves=1), SIDE, **options)


def make_profile():
    """A row of a rough square."""
    heights = make_heights(7, points=512, side=4e-3, waves=8)
    return Surface.from_profile(heights[0], 4e-3, extend_to=1e-5)


def make_several():
    """Two maps, of which the smaller shows shorter waves."""
    measurements = []
    with tempfile.TemporaryDirectory() as folder:
        for seed, side, h_rms in ((8, SIDE, 1e-6), (9, SIDE / 5, 3e-7)):
            file = Path(folder, f"{seed}.npy")
            np.save(file, make_heights(seed, side=side, h_rms=h_rms, waves=2))
            measurements.append({"file": str(file), "length": side, "height_unit": "m"})
        entry = {"kind": "measured", "measurements": measurements, "extend_to": 5e-6}
        return Surface.from_entry(check_surface(entry, arguments=True))


def make_shells():
    """A periodic cell."""
    return Surface.from_spectrum(realised_spectrum(make_heights(10), SIDE))


def make_table():
    """Smooth in long waves and rough in short ones."""
    psd = [1e-22, 1e-22 * 20**-3.8, 1e-22 * 20**-3.8 * 500**-3.0]
    return Surface.from_spectrum(Tabulated([5e4, 1e6, 5e8], psd))


SURFACES = {
    "wall": partial(make_known, 1e-6),
    "flat": partial(make_known, 2e-8),
    "polished": partial(make_known, 1e-9, q0=6e6, q1=6e9),
    "rolloff": partial(make_known, 4e-7, hurst=0.9, q0=1e4, q_rolloff=1e5),
    "ground": partial(make_known, 5e-7, anisotropy=4.0, angle=0.3),
    "known": partial(make_known, 5e-7, 2e-6),
    "plate": partial(make_known, 2e-7, 6e-7, hurst=0.7),
    "table": make_table,
    "shells": make_shells,
    "drawing": partial(Surface.from_drawing, Ra=("0.2 um", "0.4 um"), RSm="0.1 mm"),
    "drawing of Rq": partial(Surface.from_drawing, Rq="0.8 um"),
    "profile": make_profile,
    "map": partial(make_map, 1, extend_to=3.2e-5),
    "fine map": partial(make_map, 2, points=96, extend_to=1e-6),
    "open map": partial(make_map, 3),
    "skewed map": make_skewed_map,
    "rolloff map": partial(make_map, 5, points=96, waves=1, q_rolloff=5e4, extend_to=1e-5),
    "periodic map": make_periodic_map,
    "large contact": partial(make_map, 11, waves=1, extend_to=1e-5, contact=1e-2),
    "several": make_several,
    "tiny map": partial(make_map, 12, side=5e-6, h_rms=1e-9, extend_to=2e-9),
}

ADHESION = {"work_of_adhesion": 0.06, "range": 3e-10}
SOFT = ADHESION | {"youngs_modulus": 2e5}
GEL = ADHESION | {"youngs_modulus": 1e4}
RUBBER = ADHESION | {"youngs_modulus": 2e6}
PLASTIC = ADHESION | {"youngs_modulus": 3e9, "poisson_ratio": 0.35}
TERMS = [["0.1 MPa", "1 s"], ["10 MPa", "1 ms"]]
SERIES = ADHESION | {"youngs_modulus_prony": {"equilibrium": "20 kPa", "terms": TERMS}}
STEPS = [["1 mHz", "0.1 MPa"], ["1 kHz", "3 MPa"]]
FILM = {"youngs_modulus": 3e9, "poisson_ratio": 0.4, "thickness": 2.5e-5}
LAYER = SOFT | {"thickness": 1e-5}

#: Keys of `Material`; its own surface by name, and the radius of a ball.
MATERIALS = {
    "soft": SOFT,
    "rubber": RUBBER,
    "plastic": PLASTIC,
    "steel": ADHESION | {"youngs_modulus": 2.1e11, "poisson_ratio": 0.3},
    "tail": PLASTIC | {"law": "van_der_waals"},
    "pressed": RUBBER | {"pressed": 1e7},
    "rates": SERIES,
    "dwell": SERIES | {"dwell": 10.0},
    "steps": ADHESION | {"youngs_modulus_table": STEPS},
    "layer": LAYER,
    "thick layer": SOFT | {"thickness": 1e-3},
    "thin layer": GEL | {"thickness": 2e-6},
    "slip": SOFT | {"thickness": 2e-5, "backing": "slip"},
    "foam": SOFT | {"thickness": 2e-5, "poisson_ratio": 0.3},
    "pressed layer": LAYER | {"pressed": 1e5},
    "tape": SOFT | {"thickness": 2e-5, "backing": FILM},
    "hard skin": GEL | {"skin": {"thickness": 9e-8, "modulus": 3e8, "poisson": 0.4}},
    "thick skin": SOFT | {"skin": {"thickness": 1e-6, "modulus": 2e7, "poisson": 0.4}},
    "mild skin": SOFT | {"skin": {"thickness": 1e-6, "modulus": 6e5, "poisson": 0.5}},
    "soft plate": SOFT | {"surface": "plate"},
    "fine rubber": RUBBER | {"youngs_modulus": 1e6, "surface": "fine map"},
    "rubber map": RUBBER | {"surface": "map"},
    "flat rubber": RUBBER | {"surface": "flat"},
    "rubber profile": RUBBER | {"surface": "profile"},
    "rough layer": LAYER | {"surface": "rolloff"},
    "ball": SOFT | {"radius": 1e-2},
    "stiff ball": PLASTIC | {"radius": 1e-3},
    "large ball": RUBBER | {"radius": 0.1},
    "tip": PLASTIC | {"radius": 5e-8},
    "rough ball": SOFT | {"surface": "plate", "radius": 1e-2},
}

_ALL = ("remaining", "pull_off", "plane_strain_modulus_threshold")
#: What is written of a pair, by its kind; of balls the names are those of the result.
OUTPUTS = {
    "plain": (*_ALL, "margin", "contact_pressure"),
    "height": (*_ALL, "margin", "rms_height_threshold"),
    "rate": (*_ALL, "margin", "rate_threshold"),
    "layer": (*_ALL, "thickness_threshold", "contact_pressure"),
    "ball": ("force", "smooth_force", "waves"),
}

#: Kind, material, and all surfaces that it meets.
GROUPS = [
    ("plain", "soft", ["table", "drawing of Rq"]),
    ("plain", "rubber", ["wall", "rolloff", "ground", "shells"]),
    ("plain", "rubber", ["fine map", "skewed map", "periodic map", "large contact"]),
    ("plain", "plastic", ["flat", "tiny map"]),
    ("plain", "steel", ["wall"]),
    ("plain", "tail", ["flat", "tiny map"]),
    ("plain", "pressed", ["skewed map"]),
    ("plain", "dwell", ["wall", "open map"]),
    ("height", "soft", ["wall", "known"]),
    ("height", "rubber", ["drawing", "rolloff map", "profile"]),
    ("height", "steel", ["polished"]),
    ("rate", "rates", ["wall", "rolloff map"]),
    ("rate", "steps", ["known"]),
    ("plain", "rubber", ["map", "open map", "several"]),
    ("layer", "layer", ["map"]),
    ("layer", "layer", ["wall", "shells"]),
    ("layer", "thick layer", ["wall"]),
    ("layer", "thin layer", ["rolloff"]),
    ("layer", "slip", ["wall", "large contact"]),
    ("layer", "foam", ["known", "profile", "skewed map"]),
    ("layer", "pressed layer", ["drawing"]),
    ("layer", "tape", ["wall", "fine map"]),
    ("plain", "hard skin", ["rolloff", "open map"]),
    ("plain", "thick skin", ["rolloff"]),
    ("height", "mild skin", ["known", "fine map"]),
    ("height", "soft plate", ["known"]),
    ("plain", "fine rubber", ["skewed map"]),
    ("plain", "rubber map", ["map"]),
    ("plain", "rubber map", ["flat"]),
    ("plain", "flat rubber", ["map"]),
    ("plain", "rubber profile", ["fine map"]),
    ("layer", "rough layer", ["wall"]),
    ("ball", "ball", ["wall"]),
    ("ball", "stiff ball", ["flat"]),
    ("ball", "large ball", ["map"]),
    ("ball", "tip", ["tiny map"]),
    ("ball", "rough ball", ["known"]),
]
PAIRS = {
    f"{material} on {surface}": (kind, material, surface)
    for kind, material, surfaces in GROUPS
    for surface in surfaces
}


@cache
def find_surface(name):
    return SURFACES[name]()


def judge_pair(kind, material, surface):
    """Low limit, value and high limit of every output."""
    keys = dict(MATERIALS[material])
    radius = keys.pop("radius", None)
    if "surface" in keys:
        keys["surface"] = find_surface(keys["surface"])
    surface = find_surface(surface)
    if kind == "ball":
        ball = pull_off_of_ball(surface, Material(**keys), radius)
        alone = {name: (np.nan, getattr(ball, name), np.nan) for name in OUTPUTS[kind]}
        return alone | {"force": (ball.force_limits[0], ball.force, ball.force_limits[1])}
    cell = judge([Material(**keys)], [surface], curves=False).isel(material=0, surface=0)
    return {name: cell[name].sel(limit=LIMITS).values for name in OUTPUTS[kind]}


def list_keys():
    """Pair and output of every row."""
    return [(name, output) for name, (kind, *_) in PAIRS.items() for output in OUTPUTS[kind]]


@pytest.fixture(scope="module")
def table(pytestconfig):
    """Numbers by pair and output; after the tests they are written if they are to be renewed."""
    table = {}
    if TABLE.exists():
        rows = pd.read_csv(TABLE, comment="#", index_col=KEY)
        table = dict(zip(rows.index, rows[LIMITS].to_numpy(), strict=True))
    yield table
    if pytestconfig.getoption("fix"):
        rows = [(*key, *table[key]) for key in list_keys() if key in table]
        frame = pd.DataFrame(rows, columns=KEY + LIMITS)
        TABLE.write_text(HEADER + frame.to_csv(index=False, float_format="%.10g", na_rep="nan"))


@pytest.mark.parametrize("pair", PAIRS)
def test_numbers_are_those_of_the_table(pair, table, pytestconfig, capsys):
    is_renewed = pytestconfig.getoption("fix")
    changes = []
    for output, numbers in judge_pair(*PAIRS[pair]).items():
        was = table.get((pair, output), np.full(3, np.nan))
        absolute = ABSOLUTE.get(output, 0.0)
        relative = ROUNDED.get(pair, RELATIVE)
        is_same = np.isclose(numbers, was, rtol=relative, atol=absolute, equal_nan=True)
        for i in np.flatnonzero(~is_same):
            change = f"was {was[i]:.10g}, is {numbers[i]:.10g}"
            changes.append(f"{pair}: {output}, {LIMITS[i]}: {change}")
        if is_renewed:  # digits that do not count stay
            table[pair, output] = np.where(is_same, was, numbers)
    if changes and not is_renewed:
        pytest.fail("\n".join(changes), pytrace=False)
    if changes:
        with capsys.disabled():
            print("", *changes, sep="\n")


def test_the_table_has_all_pairs_and_no_others(table, pytestconfig):
    assert len(PAIRS) == 60
    if not pytestconfig.getoption("fix"):
        assert list(table) == list_keys()
