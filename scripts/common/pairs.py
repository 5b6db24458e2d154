"""All pairs of materials and surfaces, as pages show them: the user's own first."""

from common import provided
from stickiness.pages.rows import describe_pair
from stickiness.verdicts.limits import read_limited
from stickiness.verdicts.wording import tell_doubt

SHARES = (0.01, 0.1, 0.3)  #: of the work of adhesion, that may be wanted


def arrange_pairs(verdicts, labels):
    """Rows of all pairs, the user's first, by the `labels` of surfaces."""
    rows = []
    for material in provided.user_defined_first(verdicts.material.values, provided.MATERIALS):
        for surface in provided.user_defined_first(verdicts.surface.values, provided.SURFACES):
            row = describe_pair(verdicts.sel(material=material, surface=surface))
            row["key"] = material
            row["name"] = surface
            row["surface"] = labels[surface]
            row["mine"] = False
            rows.append(row)
    for row in provided.choose_mine(rows):
        row["mine"] = True
    return rows


def list_doubts(verdicts):
    """Doubts about the materials, each with the name of its material."""
    cells = [verdicts.sel(material=name) for name in verdicts.material.values]
    return [
        f"{cell.material_label.item()}: {tell_doubt(doubt)}"
        for cell in cells
        for doubt in cell.material_doubts.item().splitlines()
    ]


def count_pairs(dataset):
    """Numbers of pairs that keep each of `SHARES` by their low and by their high limit."""
    _, *limits = read_limited(dataset.remaining)
    return {share: [int((limit >= share).sum()) for limit in limits] for share in SHARES}
