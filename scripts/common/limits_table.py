"""The committed tables of simulations behind the limits of verdicts."""

from itertools import product
from typing import NamedTuple

import pandas as pd

from common.conventions import RMS_SLOPE

SHARES = {"3": 0.03, "10": 0.1, "30": 0.3, "60": 0.6}  # of thresholds, by the ends of their names
OF_QUARTERS = ("10", "30")  # thresholds that are kept of the quarters of a patch
JUDGED = ("10", "30")  # thresholds that are judged for a larger contact
OF_TOPOGRAPHY = ("set", "role", "family", "hurst", "points", "waves", "shortest", "seed")

NEVER = "the share remains at any adhesion length"
NO_VERDICT = "the patch is not judged"
NOT_CONVERGED = "not converged"


def list_thresholds(name, text="ln of the adhesion length at which {share:g} of w remains"):
    """Columns of all shares, whose names begin alike."""
    return {
        f"{name}_{ending}": ("1", text.format(share=share), NEVER)
        for ending, share in SHARES.items()
    }


class Table(NamedTuple):
    """What a committed table holds."""

    title: str
    comment: str  # at its head
    of_set: tuple[str, ...]  # columns that tell of the set and its surface
    measured: dict[str, str | tuple]  # the others, with texts as of `conventions.annotate`


#: The tables by their kind.
TABLES = {
    "solids": Table(
        title="adhesion that remains on a layer or below a skin",
        comment="""\
Adhesion that remains at zero load on layers and below skins, simulated on Gaussian surfaces.
kind: layer (on a rigid base), film (layer on a film), thin (incompressible and bonded), skin.
energy_ratio: work of adhesion over full_contact_energy, which is that of the solid.
pixels_in_zone: width of the cohesive zone that sets the range, for that ratio on a half-space.
simulated: deepest state of four starts; none where that did not converge.""",
        of_set=(
            *("set", "role", "kind", "hurst", "magnification", "window", "points", "seed"),
            *("thickness", "poisson", "backing"),
            *("film_modulus_ratio", "film_poisson", "film_thickness"),
            *("skin_modulus_ratio", "skin_poisson"),
        ),
        measured={
            "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
            "half_space_energy": "the same on a half-space",
            "rms_slope": RMS_SLOPE,
            "q1": "largest wave number of the surface over q0",
            "relative_compliance": "see remaining.solid_response.find_relative_compliance",
            "flow": "see remaining.thin_layers.find_flow",
            "energy_ratio": "work of adhesion over elastic energy of full contact on this solid",
            "pixels_in_zone": "width of the cohesive zone on a half-space, in pixels",
            "adhesion_length": "adhesion length over q0 h_rms^2",
            "range": "range over h_rms",
            "simulated": ("1", "largest gain of energy over the work of adhesion", NOT_CONVERGED),
        },
    ),
    "patches": Table(
        title="what patches of a surface tell of it",
        comment="""\
What patches tell of the surface that they were cut from, by states simulated on their heights as on
those of a measured map. waves, shortest: of the surface, longest along a side, shortest in pixels.
threshold_3 … threshold_60: ln of the adhesion length at which 3 % … 60 % of w remains, at a range;
whole_…: on the surface; q1_10 … q4_30: on quarters of the patch; none where so much remains at any.
share_3 … share_60: share on the patch at the thresholds of the surface.
independent_areas: 1 over the mean square of its autocorrelation; mean_cube: mean of the cube.""",
        of_set=OF_TOPOGRAPHY,
        measured={
            "patch_waves": "longest waves along a side of the patch",
            "patch": "number of the patch among those of its size",
            "h_rms": "rms height of the levelled patch over that of the surface",
            "skewness": "of the levelled patch",
            "kurtosis": "of the levelled patch",
            "independent_areas": "1 over the mean of the squared autocorrelation of the patch",
            "mean_cube": "mean of the cubed autocorrelation of the patch",
            "full_contact_energy": "elastic energy of full contact of the patch over E* q0 h_rms^2",
            "whole_skewness": "of the surface",
            "whole_kurtosis": "of the surface",
            "whole_full_contact_energy": "that of the surface",
            "range": "range over h_rms of the surface",
            **list_thresholds("threshold"),
            **list_thresholds("whole_threshold"),
            **list_thresholds("share", "share on the patch where {share:g} remains on the surface"),
            **{
                f"q{number}_{ending}": ("1", f"threshold_{ending} of quarter {number}", NEVER)
                for ending, number in product(OF_QUARTERS, range(1, 5))
            },
        },
    ),
    "ranges": Table(
        title="what remains at ranges shorter than those of simulated states",
        comment="""\
What remains at ranges shorter than those of states on a coarse grid. waves, shortest, points: of
the coarse grid. is_between: 1 for works of adhesion between two that were simulated.
range_ratio: range over that of the states at this work. finer: points along a side of the finer
grid over those of the coarse one. bound: deepest of the states at this range. chord: between the
shares of the states at their own ranges. simulated: on the finer grid.""",
        of_set=OF_TOPOGRAPHY,
        measured={
            "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
            "adhesion_length": "adhesion length over q0 h_rms^2",
            "energy_ratio": "work of adhesion over elastic energy of full contact",
            "is_between": "1 for a work between those simulated, 0 at one of them",
            "range": "range over h_rms",
            "range_ratio": "range over that of the states at this work",
            "finer": "points along a side over those of the states",
            "bound": "share in the deepest of the states, at this range",
            "chord": "chord between the shares of the states, at their ranges",
            "simulated": ("1", "share at zero load on the finer grid", NOT_CONVERGED),
        },
    ),
    "pull_offs": Table(
        title="pull-off at the ranges of simulated states and at shorter ones",
        comment="""\
Pull-off at the ranges of states on a coarse grid and at shorter ones. waves, shortest, points: of
the coarse grid. range_ratio: range over that of the states at this work. finer: points along a side
of the finer grid over those of the coarse one. share: predicted to remain at this range. distance:
work that remains over the largest tension, of the states at their own range. path_share, pull_off:
largest gain of energy, and largest tension over E*, where the surfaces are pressed together and
part at given mean gaps on the finer grid; none where that did not converge.""",
        of_set=OF_TOPOGRAPHY,
        measured={
            "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2",
            "adhesion_length": "adhesion length over q0 h_rms^2",
            "energy_ratio": "work of adhesion over elastic energy of full contact",
            "range": "range over h_rms",
            "range_ratio": "range over that of the states at this work",
            "finer": "points along a side over those of the states",
            "share": "share that a verdict predicts to remain, at this range",
            "distance": "work that remains over the largest tension, of the states at their range",
            "path_share": ("1", "largest share gained on the finer grid", NOT_CONVERGED),
            "pull_off": ("1", "largest tension over E* on the finer grid", NOT_CONVERGED),
        },
    ),
    "unresolved": Table(
        title="what states on thinned heights tell of a surface",
        comment="""\
What states on every second or fourth point tell of a surface.
lacking: energy of full contact that the thinned grid lacks, over that of the others.
full_3 … full_60: ln of the adhesion length at which 3 % … 60 % of w remains, on the full grid.
thinned_…: the same on the thinned grid, for w over 1 + lacking; none where so much remains at
any.""",
        of_set=OF_TOPOGRAPHY,
        measured={
            "full_contact_energy": "elastic energy of full contact over E* q0 h_rms^2, full grid",
            "stride": "of which every so many-th point is simulated",
            "lacking": "energy that the thinned grid lacks, over that of the others",
            "range": "range over h_rms",
            **list_thresholds("full"),
            **list_thresholds("thinned", "the same of thinned heights, for w over 1 + lacking"),
        },
    ),
    "larger": Table(
        title="what patches of a surface tell of contact with all of it",
        comment="""\
What scans tell of a larger contact: patches judged for the whole surface that they were cut from,
in the way of users. parts: patches along a side. height_skewness: of the surface, if not that of
its family. is_judged: 0 where a patch has no verdict. found_…: by the fit to the patch. longer:
share of the energy in longer waves. whole_threshold_3 … whole_threshold_60: ln of the adhesion
length at which 3 % … 60 % of w remains on the surface, simulated. value_10 … high_30: the same with
its limits, predicted, without what a scan does not tell of a larger contact; none where so much
remains at any.""",
        of_set=(
            *("set", "role", "family", "hurst", "height_skewness", "points", "waves", "shortest"),
            "seed",
        ),
        measured={
            "parts": "patches along a side of the surface",
            "patch": "number of the patch among those of its size",
            "skewness": "of the patch",
            "is_judged": "1 if the patch has a verdict",
            "found_hurst": ("1", "Hurst exponent fitted to the patch", NO_VERDICT),
            "found_rolloff": ("1", "wave number of the fitted roll-off, over q0", "none"),
            "is_simulated": "1 if contact is simulated on the heights of the patch",
            "longer": ("1", "share of the energy in longer waves than the patch's", NO_VERDICT),
            "shape": ("1", "ln of the factor that the shape of the heights makes", NO_VERDICT),
            "unevenness": ("1", "scatter of ln of the mean square slope of quarters", NO_VERDICT),
            **{
                f"{limit}_{ending}": ("1", f"{limit} of ln of that length, predicted", NO_VERDICT)
                for ending, limit in product(JUDGED, ("value", "low", "high"))
            },
            "whole_skewness": "of the surface",
            "whole_full_contact_energy": "elastic energy of full contact of the surface",
            "range": "range over h_rms of the surface",
            **list_thresholds("whole_threshold"),
        },
    ),
    "balls": Table(
        title="pull-off of balls from rough heights",
        comment="""\
Pull-off forces of balls from rough heights, over those of smooth balls. tabor: 0 of rigid solids,
whose tractions are summed; others by boundary elements. waves: longest ones across the zone of a
smooth ball. height: rms height over w over the strength of the law. shortest, side: shortest wave
and cell, over the radius of the zone. simulated: none where a ball did not pull off.""",
        of_set=(
            *("set", "role", "tabor", "law", "hurst", "skewness", "shortest", "side", "points"),
            "seed",
        ),
        measured={
            "waves": "longest waves across the zone of a smooth ball",
            "height": "rms height over the distance of the attraction, w over strength",
            "place": "number of the place that the ball touches",
            "simulated": ("1", "pull-off force over that of a smooth ball", "does not pull off"),
        },
    ),
}
COLUMNS = {kind: (*table.of_set, *table.measured) for kind, table in TABLES.items()}
ALL = """\
role: limits are fitted to rows that are fitted, and compared with those that are unseen.
Shares are over the work of adhesion, lengths over h_rms, wave numbers over q0, thicknesses over
1/q0, energies and adhesion lengths over q0 h_rms^2."""


def describe(kind, version):
    """Comment at the head of a table."""
    origin = (
        f"Simulated with version {version} (target limits_measured, config/campaigns/limits.yaml). "
        "To take\na new measurement over, copy it here."
    )
    lines = "\n".join([TABLES[kind].comment, ALL, origin]).splitlines()
    return "".join(f"# {line}\n" for line in lines)


def read(path, kind):
    """Read a table; ValueError naming the file and what it lacks."""
    try:
        table = pd.read_csv(path, comment="#")
    except FileNotFoundError:
        raise ValueError(f"{path}: no such file; the target limits_measured makes it") from None
    missing = [name for name in COLUMNS[kind] if name not in table]
    if missing:
        raise ValueError(f"{path}: lacks the columns {', '.join(missing)}")
    return table
