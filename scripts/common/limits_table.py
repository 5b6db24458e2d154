"""The committed tables of simulations behind the limits of verdicts."""

from common import committed

OF_TOPOGRAPHY = ("set", "role", "family", "hurst", "points", "waves", "shortest", "seed")
SHARES = {"3": 0.03, "10": 0.1, "30": 0.3, "60": 0.6}  # of thresholds, by the ends of their names
OF_QUARTERS = ("10", "30")  # thresholds that are kept of the quarters of a patch
JUDGED = ("10", "30")  # thresholds that are judged for a larger contact
#: Columns of the tables by their kind.
COLUMNS = {
    "solids": (
        *("set", "role", "kind", "hurst", "magnification", "window", "points", "seed"),
        *("thickness", "poisson", "backing"),
        *("film_modulus_ratio", "film_poisson", "film_thickness"),
        *("skin_modulus_ratio", "skin_poisson"),
        *("full_contact_energy", "half_space_energy", "rms_slope", "q1"),
        *("relative_compliance", "flow"),
        *("energy_ratio", "pixels_in_zone", "adhesion_length", "range", "simulated"),
    ),
    "patches": (
        *OF_TOPOGRAPHY,
        *("patch_waves", "patch", "h_rms", "skewness", "kurtosis"),
        *("independent_areas", "mean_cube", "full_contact_energy"),
        *("whole_skewness", "whole_kurtosis", "whole_full_contact_energy", "range"),
        *(
            f"{name}_{share}"
            for name in ("threshold", "whole_threshold", "share")
            for share in SHARES
        ),
        *(f"q{number}_{share}" for share in OF_QUARTERS for number in (1, 2, 3, 4)),
    ),
    "ranges": (
        *OF_TOPOGRAPHY,
        *("full_contact_energy", "adhesion_length", "energy_ratio", "is_between"),
        *("range", "range_ratio", "finer", "bound", "chord", "simulated"),
    ),
    "pull_offs": (
        *OF_TOPOGRAPHY,
        *("full_contact_energy", "adhesion_length", "energy_ratio", "range", "range_ratio"),
        *("finer", "share", "distance", "path_share", "pull_off"),
    ),
    "unresolved": (
        *OF_TOPOGRAPHY,
        *("full_contact_energy", "stride", "lacking", "range"),
        *(f"{grid}_{share}" for grid in ("full", "thinned") for share in SHARES),
    ),
    "larger": (
        *("set", "role", "family", "hurst", "height_skewness", "points", "waves", "shortest"),
        *("seed", "parts", "patch", "skewness", "is_judged", "found_hurst", "found_rolloff"),
        *("is_simulated", "longer", "shape", "unevenness"),
        *(f"{limit}_{share}" for share in JUDGED for limit in ("value", "low", "high")),
        *("whole_skewness", "whole_full_contact_energy", "range"),
        *(f"whole_threshold_{share}" for share in SHARES),
    ),
    "coated": (
        *OF_TOPOGRAPHY,
        *("stride", "solid", "thickness", "poisson", "backing"),
        *("skin_modulus_ratio", "skin_poisson"),
        *("energy_ratio", "pixels_in_zone", "adhesion_length", "range"),
        *("full_contact_energy", "half_space_energy"),
        *("map_full_contact_energy", "map_half_space_energy", "simulated"),
        *("is_judged", "is_simulated", "unresolved", "value", "low", "high"),
    ),
    "balls": (
        *("set", "role", "tabor", "law", "hurst", "skewness", "shortest", "side", "points"),
        *("seed", "waves", "height", "place", "simulated"),
    ),
}
DESCRIPTIONS = {
    "solids": """\
Adhesion that remains at zero load on layers and below skins, simulated on Gaussian surfaces.
kind: layer (on a rigid base), film (layer on a film), thin (incompressible and bonded), skin.
energy_ratio: work of adhesion over full_contact_energy, which is that of the solid.
pixels_in_zone: width of the cohesive zone that sets the range, for that ratio on a half-space.
simulated: deepest state of four starts; none where that did not converge.""",
    "patches": """\
What patches tell of the surface that they were cut from, by states simulated on their heights as on
those of a measured map. waves, shortest: of the surface, longest along a side, shortest in pixels.
threshold_3 … threshold_60: ln of the adhesion length at which 3 % … 60 % of w remains, at a range;
whole_…: on the surface; q1_10 … q4_30: on quarters of the patch; none where so much remains at any.
share_3 … share_60: share on the patch at the thresholds of the surface.
independent_areas: 1 over the mean square of its autocorrelation; mean_cube: mean of the cube.""",
    "ranges": """\
What remains at ranges shorter than those of states on a coarse grid. waves, shortest, points: of
the coarse grid. is_between: 1 for works of adhesion between two that were simulated.
range_ratio: range over that of the states at this work. finer: points along a side of the finer
grid over those of the coarse one. bound: deepest of the states at this range. chord: between the
shares of the states at their own ranges. simulated: on the finer grid.""",
    "pull_offs": """\
Pull-off at the ranges of states on a coarse grid and at shorter ones. waves, shortest, points: of
the coarse grid. range_ratio: range over that of the states at this work. finer: points along a side
of the finer grid over those of the coarse one. share: predicted to remain at this range. distance:
work that remains over the largest tension, of the states at their own range. path_share, pull_off:
largest gain of energy, and largest tension over E*, where the surfaces are pressed together and
part at given mean gaps on the finer grid; none where that did not converge.""",
    "unresolved": """\
What states on every second or fourth point tell of a surface.
lacking: energy of full contact that the thinned grid lacks, over that of the others.
full_3 … full_60: ln of the adhesion length at which 3 % … 60 % of w remains, on the full grid.
thinned_…: the same on the thinned grid, for w over 1 + lacking; none where so much remains at
any.""",
    "larger": """\
What scans tell of a larger contact: patches judged for the whole surface that they were cut from,
in the way of users. parts: patches along a side. height_skewness: of the surface, if not that of
its family. is_judged: 0 where a patch has no verdict. found_…: by the fit to the patch. longer:
share of the energy in longer waves. whole_threshold_3 … whole_threshold_60: ln of the adhesion
length at which 3 % … 60 % of w remains on the surface, simulated. value_10 … high_30: the same with
its limits, predicted, without what a scan does not tell of a larger contact; none where so much
remains at any.""",
    "coated": """\
Adhesion that remains at zero load below skins and on layers, simulated on surfaces whose finest
waves a map lacks. waves, shortest, points: of the surface, longest along a side, shortest in
pixels. stride: the map has every so many-th point, and no waves shorter than four of its pixels.
full_contact_energy: of the surface on the solid; half_space_energy: on a half-space; map_…: of
its map. energy_ratio: work of adhesion over full_contact_energy.
pixels_in_zone: width of the cohesive zone that sets the range, for that ratio on a half-space.
simulated: on the surface, deepest state of all starts; none where that did not converge.
is_judged: 0 where a map has no verdict. is_simulated: 1 where states simulated on the map decide.
unresolved: share of the energy in waves that the map lacks, as drawn. value, low, high: of ln of
the adhesion length that keeps the simulated share, by a verdict on the map with the end of the
waves told, without the error of skins on maps; none where next to nothing remains.""",
    "balls": """\
Pull-off forces of balls from rough heights, over those of smooth balls. tabor: 0 of rigid solids,
whose tractions are summed; others by boundary elements. waves: longest ones across the zone of a
smooth ball. height: rms height over w over the strength of the law. shortest, side: shortest wave
and cell, over the radius of the zone. simulated: none where a ball did not pull off.""",
}
ALL = """\
role: limits are fitted to rows that are fitted, and compared with those that are unseen.
Shares are over the work of adhesion, lengths over h_rms, wave numbers over q0, thicknesses over
1/q0, energies and adhesion lengths over q0 h_rms^2."""


def make_dataset(rows, kind):
    """Rows of one kind as a dataset; what they do not tell of is empty, or not a number."""
    rows = rows.reindex(columns=COLUMNS[kind])
    texts = rows.select_dtypes(exclude="number").columns
    dataset = rows.fillna(dict.fromkeys(texts, "")).rename_axis("row").to_xarray()
    for name in dataset.variables:
        dataset[name].attrs = {
            "long_name": f"{name}, as the head of config/{kind}.csv explains it",
            "units": "1",
            "nan_means": "not known, or none",
        }
    return dataset


def describe(kind, version):
    """Comment at the head of a table."""
    origin = (
        f"Simulated with version {version} (target limits_measured, config/campaigns/limits.yaml). "
        "To take\na new measurement over, copy it here."
    )
    lines = "\n".join([DESCRIPTIONS[kind], ALL, origin]).splitlines()
    return "".join(f"# {line}\n" for line in lines)


def read(path, kind):
    """Read a table; errors as of `committed.read`."""
    return committed.read(path, COLUMNS[kind], "limits_measured")
