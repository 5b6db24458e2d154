"""Why a criterion says what it says of a pair: what it looks at, with the numbers of the pair."""

from pipeline.numbers import interval, number, quantity
from pipeline.pages.surface_texts import rms_height

REGIMES = ("weak", "between weak and tough", "tough, near JKR", "strong, but not near JKR")

NAMES = {
    "edge_adhesion": "edges of contact",
    "violano": "derived, DMT limit",
    "violano_constant": "derived, constant a_V",
    "violano_printed": "as printed, 9/4",
    "pastewka_robbins": "Pastewka–Robbins",
    "fuller_tabor": "Fuller–Tabor",
    "bearing_area": "bearing area (BAM)",
    "persson_tosatti": "Persson–Tosatti",
    "dahlquist": "Dahlquist",
}
REASONS = {
    "edge_adhesion": "attractive over contact area {t}, edges of strength {tau} ({regime}): "
    "{over_dmt} times the attraction of the DMT limit",
    "violano": "h_rms = {h}, q0 = {q0}/m and a_V = {a_v}: long waves set the load, the pull is "
    "that over gaps without adhesion",
    "violano_constant": "the same with a_V = {constant} of a broad spectrum in place of {a_v}",
    "violano_printed": "the same with a_V = 1.5 in place of {a_v}",
    "pastewka_robbins": "slope {slope} and curvature {curvature}/m, those of the shortest waves; "
    "neither h_rms nor q0",
    "fuller_tabor": "h_rms = {h} against asperities of radius {radius}, that of the shortest waves",
    "bearing_area": "attraction where heights reach within the range of the mean plane: h_rms = "
    "{h} and q0 = {q0}/m, nothing finer",
    "persson_tosatti": "energy of full contact, {energy}, against the work of adhesion, {work}: "
    "contact need not be full to stick",
    "dahlquist": "E* = {modulus} at 1 Hz against 1 MPa: no roughness at all",
}


def reasons(pair, surface, work_of_adhesion):
    """One row a criterion for a material on a surface: what it says, its margin and on what.

    Parameters
    ----------
    pair : xarray.Dataset
        Verdicts of the pair.
    surface : xarray.Dataset
        The surface.
    work_of_adhesion : float
        [J/m^2].
    """
    said = facts(pair, surface, work_of_adhesion)
    edges = pair.margin.sel(criterion="edge_adhesion") > 1
    rows = []
    for name in map(str, pair.criterion.values):
        margin = pair.margin.sel(criterion=name)
        sticky = margin > 1
        says = "sticks" if sticky.all() else "depends" if sticky.any() else "does not stick"
        rows.append(
            {
                "name": NAMES.get(name, name.replace("_", " ")),
                "says": says,
                "margins": [float(margin.sel(end=end)) for end in ("rough", "smooth")],
                "disagrees": bool((sticky != edges).any()),
                "reason": REASONS.get(name, "").format(**said),
            }
        )
    return rows


def facts(pair, surface, work_of_adhesion):
    """Numbers that the reasons quote, from the smooth to the rough end."""
    curvature = float(surface.rms_curvature.sel(end="rough"))
    modulus = float(pair.modulus_quoted)
    energy = float(surface.elastic_energy.sel(end="rough")) * modulus

    def of_edges(name):
        return interval(*sorted(map(float, pair[name].values)), 2)

    return {
        "t": of_edges("attractive_over_contact"),
        "tau": of_edges("edge_strength"),
        "over_dmt": of_edges("over_dmt"),
        "regime": " to ".join(dict.fromkeys(REGIMES[int(regime)] for regime in pair.regime)),
        "h": rms_height(surface),
        "q0": number(float(surface.q0)),
        "a_v": number(float(pair.pair_a_v.mean()), 2),
        "constant": number(float(pair.a_v), 2),
        "slope": number(float(surface.rms_slope.sel(end="rough")), 2),
        "curvature": number(curvature, 2),
        "radius": quantity(2 / curvature, 2 / curvature, "m", 2),
        "energy": f"{number(energy, 2)} J/m²",
        "work": f"{number(work_of_adhesion, 2)} J/m²",
        "modulus": quantity(modulus, modulus, "Pa", 2),
    }
