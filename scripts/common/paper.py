"""What the paper states, and where the configuration sets the same.

The paper is Violano, Afferrante, Papangelo & Ciavarella, On stickiness of multiscale randomly rough
surfaces, J. Adhesion (2019), doi:10.1080/00218464.2019.1685384.

The report shows where parameters of a panel differ from the paper's. A claim whose parameters
differ has no grade, because the grade would be a statement on something else.
"""

from typing import Any

import numpy as np

from stickiness.formatting import amount, number

A_V = 3.0  # to which a_V converges; Figures 3A, 5A and 5B
A_V_FIG4B = 2.8  # of the formula in Figure 4B
C0_LINES = (1e-3, 1e-5)  # m^0.4, of the two lines of Figure 6
HURST = 0.8  # of all panels but 3C
HURST_3C = (0.7, 0.8, 0.9)
LOAD = 0.065  # over E* q0 h_rms, of Figures 3A and 3C
LOADS_3B = (0.0065, 0.03, 0.07, 0.13, 0.20, 0.26, 0.33, 0.39, 0.46, 0.52)
ZETAS_3A = (10, 100, 500, 1000, 5000, 1e4, 2e4, 5e4)
ZETA_3B = 1000
ZETA_3D = 1000
RANGES_4B = (1, 1 / 10, 1 / 50, 1 / 100)  # over h_rms
RANGE_2 = 7.5e-3  # over h_rms, of the maps with adhesion in Figure 2
CRYSTAL = 0.05  # l_a/range of a crystal on itself, to which these limits belong:
H_RMS_LIMITS = {1e-6: 1e3, 1e-9: 6.7e4, 1e-12: 1e6}  # range q0: largest h_rms/range that sticks

# Numbers of the examples.
RANGE = 0.2e-9  # m
WORK_OF_ADHESION = 0.05  # J/m^2
PRINTED_MODULUS = 0.2  # MPa, of a block that sticks to asphalt
ASPHALT = {"q0": 1e3, "hurst": HURST, "C0": C0_LINES[0]}  # SI

# Ends of what the claims state or what their grades cover.
LOADS_OF_GAPS = (0.1, 0.001)  # at which mean gaps are 1 and 3 h_rms (claim 4)
LOADS_OF_A_V = (0.001, 0.1)  # over which a_V should be steady (claim 9)
ZETAS_OF_A_V = (1e3, 1e5)  # at which a_V should be about 3 (claim 8)
LENGTHS_4B = (1e-6, 1.0)  # six decades of l_a/range (claim 11)

# Symbols and SI units by the last part of a key.
SYMBOLS = {
    "C0": "C0",
    "adhesion_length_over_range": "l_a/ε",
    "h_rms": "h_rms",
    "hurst": "H",
    "longest_wavelength": "λ_L",
    "magnification": "ζ",
    "maps": "p̂",
    "mean_gap": "ū/h_rms",
    "pressure": "p̂",
    "pressures": "p̂",
    "q0_h_rms": "q0 h_rms",
    "range_over_h_rms": "ε/h_rms",
    "seeds": "realisations",
    "slope_a_v": "a_V",
    "slope_parameter": "εq0/(l_a/ε)",
    "window": "L",
}
UNITS = {"h_rms": "m", "longest_wavelength": "m", "window": "m"}
MOST_VALUES = 6  # of a list that is written out
TOLERANCE = 1e-3  # relative, within which values agree

# Entries of the configuration that name others, and the tables of these.
REFERENCES = {"case": "cases", "surface": "model_surfaces", "fidelity": "fidelities"}


class Largest(float):
    """Value of the paper that is compared with the largest of several values here."""


def _under(owner: str, **values: Any) -> dict[str, Any]:
    """Values by the whole paths of keys that belong to one entry."""
    return {f"{owner}.{key}": value for key, value in values.items()}


_ROUGH, _NEAR, _SMOOTH = (f"adhesion.fig4b_{name}" for name in ("rough", "rough_near", "smooth"))
_LINES_4B = {
    **_under(f"{_ROUGH}.case.surface", hurst=HURST, magnification=64),
    **_under(_ROUGH, h_rms=5e-6, window=1e-4),
    f"{_ROUGH}.range_over_h_rms, {_NEAR}.range_over_h_rms": RANGES_4B,
    **_under(f"{_SMOOTH}.case.surface", hurst=HURST, magnification=128),
    **_under(_SMOOTH, h_rms=1e-7, window=1e-4, range_over_h_rms=RANGES_4B),
}
_SURFACE_2 = "adhesion.fig2.case.surface"
_MAPS_2 = "adhesion.fig2.maps"

#: Values of the paper, None if unknown, by our keys and the paper's panel. A path goes on in the
#: entry that the value of a key names, such as a case. Values of two keys are taken together.
PANELS: dict[str, dict[str, Any]] = {
    "1A": _under("theory.sweeps.fig1a", hurst=HURST, magnification=(10, 100, 1000), mean_gap=2),
    "1B": _under("theory.sweeps.fig1b", hurst=HURST, magnification=None, mean_gap=1.37),
    "2A": _under(_SURFACE_2, hurst=None, magnification=None),
    "2B": {
        **_under(_MAPS_2, range_over_h_rms=None, adhesion_length_over_range=None),
        "adhesion.fig2.q0_h_rms": None,
    },
    "2C": _under("adhesion.fig2", range_over_h_rms=None, adhesion_length_over_range=None),
    "2D–F": {"adhesion.fig2.case.maps": None},
    "2G–I": _under(_MAPS_2, range_over_h_rms=RANGE_2, adhesion_length_over_range=Largest(0.2)),
    "3A": _under("theory.sweeps.fig3a", hurst=HURST, magnification=ZETAS_3A, pressure=LOAD),
    "3B": _under("theory.sweeps.fig3b", hurst=HURST, magnification=ZETA_3B, pressure=LOADS_3B),
    "3C": _under("theory.sweeps.fig3c", hurst=HURST_3C, magnification=None, pressure=LOAD),
    "3D": _under("theory.sweeps.fig3d", hurst=HURST, magnification=ZETA_3D, pressure=None),
    "4A": {
        "loops.fig4a.surface.magnification": None,
        **_under("loops.fig4a", range_over_h_rms=None, adhesion_length_over_range=None),
    },
    "4B": {**_LINES_4B, "fidelity.seeds": 8},
    "5A": _under("criteria.map", hurst=HURST, slope_a_v=A_V),
    "5B": _under("criteria.map", slope_a_v=A_V, slope_parameter=(1, 3 / 4, 1 / 2, 1 / 4, 1 / 10)),
    "6": {},
}

_ASPHALT = _under(
    "surfaces.asphalt",
    hurst=ASPHALT["hurst"],
    longest_wavelength=2 * np.pi / ASPHALT["q0"],
    C0=Largest(ASPHALT["C0"]),
)

#: The same by the number of a claim. The other claims are about closed forms, about any surface
#: (18), or about tables and experiments that the configuration does not parametrise (21, 22).
CLAIMS: dict[int, dict[str, Any]] = {
    1: {
        **_under("roles.broad_band.surface", hurst=HURST, magnification=128),
        "roles.broad_band.pressures": LOAD,
    },
    2: PANELS["1B"],
    3: PANELS["3A"],
    4: {**PANELS["3D"], "roles.wide_cell.surface.hurst": HURST},
    5: {
        f"{_SURFACE_2}.hurst": HURST,
        **_under("adhesion.fig2", range_over_h_rms=RANGE_2, pressures=LOAD),
    },
    6: PANELS["3A"],
    7: {**PANELS["3B"], "roles.wide_cell.surface.hurst": HURST},
    8: PANELS["3C"],
    9: PANELS["3D"],
    10: {"loops.fig4a.surface.hurst": HURST},
    11: {**_LINES_4B, **{f"{name}.pressures": LOAD for name in (_ROUGH, _NEAR, _SMOOTH)}},
    12: {**PANELS["5A"], **PANELS["5B"]},
    14: _ASPHALT,
    15: _under("surfaces.polished_steel", longest_wavelength=1e-4, h_rms=1e-6),
    20: _ASPHALT,
}

#: Ends of keys of which claims select their values. Further values do no harm.
SELECTED = ("hurst", "magnification", "pressures", "fig2.range_over_h_rms")

#: Limits that the values of our keys have to reach, by the number of a claim.
COVERED = {
    1: {"roles.broad_band.pressures": (LOAD, 0.15)},  # up to an area of 30 % at kappa = 2
    4: {"roles.wide_cell.pressures": LOADS_OF_GAPS},
    7: {"roles.wide_cell.pressures": (LOADS_3B[0], LOADS_3B[-1])},
    8: {"theory.sweeps.fig3c.magnification": ZETAS_OF_A_V},
    9: {"theory.sweeps.fig3d.pressure": LOADS_OF_A_V},
    11: {f"{name}.adhesion_length_over_range": LENGTHS_4B for name in (_ROUGH, _NEAR, _SMOOTH)},
}


def at_load(data):
    """Data at the load of the paper's Figures 3A and 3C."""
    return data.sel(pressure=LOAD, method="nearest")


def compare_panels(config):
    """Compare a checked configuration with all parameters of every panel.

    Returns the name of each `panel` and its `parameters`, each as `compare` returns it.
    """
    return [
        {
            "panel": panel,
            "parameters": [compare(config, keys, paper, is_same) for keys, paper in known.items()],
        }
        for panel, known in PANELS.items()
    ]


def find_differences(config, surfaces):
    """Find where a checked configuration differs from the parameters of the claims.

    `surfaces` are the checked entries of the real surfaces. Returns the parameters that differ by
    the number of the claim, each as `compare` returns it.
    """
    whole = {**config, "surfaces": surfaces}
    differences = {}
    for claim, parameters in CLAIMS.items():
        rows = [
            compare(whole, keys, paper, includes if keys.endswith(SELECTED) else is_same)
            for keys, paper in parameters.items()
            if paper is not None
        ]
        covered = COVERED.get(claim, {})
        rows += [compare(whole, keys, ends, covers) for keys, ends in covered.items()]
        differences[claim] = [row for row in rows if not row["equal"]]
    return differences


def compare(config, keys, paper, agrees):
    """Compare values of the configuration with those of the paper.

    Returns the `key`, the texts of the values `here` and in the `paper` (empty if we do not know
    them), and whether they are `equal` by the function `agrees`.
    """
    found = [np.atleast_1d(np.asarray(look_up(config, key), float)) for key in keys.split(", ")]
    here = np.unique(np.concatenate(found))
    if isinstance(paper, Largest):
        here = here[-1:]
    known = np.unique(np.asarray([] if paper is None else paper, float))
    name = keys.rpartition(".")[-1]
    unit = UNITS.get(name, "")
    return {
        "key": keys,
        "here": f"{SYMBOLS[name]} = {write(here, unit)}",
        "paper": write(known, unit) if known.size else "",
        "equal": bool(here.size and known.size) and agrees(here, known),
    }


def look_up(config, path):
    """Value at a path of keys with dots between them; names of other entries are followed."""
    value = config
    previous = ""
    for key in path.split("."):
        if isinstance(value, str):
            table = "cases" if previous in config["roles"] else REFERENCES[previous]
            value = config[table][value]
        # A key that is left out, such as the loads of maps, has no values.
        value = value.get(key)
        if value is None:
            return []
        previous = key
    return value


def is_same(here, paper):
    """Whether there are the paper's values and no others."""
    return includes(here, paper) and includes(paper, here)


def includes(here, paper):
    """Whether the paper's values are among those here."""
    return bool(np.isclose(here[:, None], paper, rtol=TOLERANCE, atol=0).any(axis=0).all())


def covers(here, paper):
    """Whether the paper's values lie between those here, both in increasing order."""
    return bool(here[0] <= paper[0] * (1 + TOLERANCE) and here[-1] >= paper[-1] * (1 - TOLERANCE))


def write(values, unit):
    """Values of one parameter as text; of many, the ends and how many there are."""
    if not values.size:
        return "–"
    shown = values if values.size <= MOST_VALUES else values[[0, -1]]
    texts = [amount(value, unit) if unit else number(value) for value in shown]
    if values.size > MOST_VALUES:
        return f"{' … '.join(texts)} ({values.size} values)"
    return ", ".join(texts)
