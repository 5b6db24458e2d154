"""What models of the adhesion that remains cost, and how far they err on heights of many shapes."""

from common.heights_table import GAUSSIAN

MODELS = {
    "theory": "theory of the spectrum",
    "shaped": "theory with the skewness",
    "bound": "contact without adhesion",
    "states": "states with adhesion on the heights",
    "simulated": "full simulation",
}
OF_SURFACE = ("bound", "states")  # models whose simulations serve for all pairs of a surface
COVERED = 0.9  # share of the simulations that an error covers
LEAST_SHARE = 0.05  # that remains, from which errors are relative


def condense(table):
    """Condense the table of heights into one row for every model.

    Parameters
    ----------
    table : DataFrame
        As `heights_table.read` gives it.

    Returns
    -------
    list of dict
        `model`, `label`, median processor time `seconds` [s], whether it `serves_all` pairs of a
        surface, and errors that cover 90 % of the simulations on Gaussian and on other heights:
        `gaussian` and `other`, relative, where at least `LEAST_SHARE` remains, and
        `gaussian_little` and `other_little`, absolute, where less does.
    """
    table = table.dropna(subset=["simulated"])
    is_gaussian = table.kind == GAUSSIAN
    remains = table.simulated >= LEAST_SHARE
    rows = []
    for model, label in MODELS.items():
        error = abs(table[model] - table.simulated)
        timed = "theory" if model == "shaped" else model
        row = {
            "model": model,
            "label": label,
            "seconds": table[f"seconds_{timed}"].median(),
            "serves_all": model in OF_SURFACE,
        }
        for heights, chosen in (("gaussian", is_gaussian), ("other", ~is_gaussian)):
            relative = (error / table.simulated)[chosen & remains]
            row[heights] = relative.quantile(COVERED)
            row[f"{heights}_little"] = error[chosen & ~remains].quantile(COVERED)
        rows.append(row)
    return rows
