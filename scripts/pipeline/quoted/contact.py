"""Contact without adhesion: kappa and a_V by simulation, beside theory on the same spectrum."""

import numpy as np

from pipeline.claims import contact as claims
from pipeline.claims.texts import quote, quote_number
from pipeline.conventions import VARIANT, at_load
from pipeline.model_surfaces import cell_size, model_spectrum
from pipeline.numbers import number, percent
from pipeline.quoted.sources import Sources, say_range
from stickiness.core import datasets
from stickiness.surfaces.synthesis import lattice_spectrum

ONE_WAVE = ("H0.8_zeta32", "H0.8_zeta64", "H0.8_zeta128")  # cells of one longest wavelength
WIDE = "H0.8_zeta32_wide"
CELLS = {  # at one magnification, by the longest wavelengths along their side
    1: "H0.8_zeta16_1x1",
    2: "H0.8_zeta16_2x2",
    4: "H0.8_zeta16_4x4",
    8: "H0.8_zeta16_8x8",
}
RANGE = 0.1  # over h_rms, of attractive areas


def quote_kappa(sources: Sources) -> dict[str, str]:
    coarse, fine = (sources.read(f"fits/kappa/{case}") for case in ONE_WAVE[1:])
    (_, first), (area, last) = claims.kappa_ends(fine)
    return {
        "kappa.zeta64": quote(at_load(coarse), "kappa"),
        "kappa.zeta128": quote(at_load(fine), "kappa"),
        "kappa.smallest_load": f"{first:.2f}",
        "kappa.largest_area": f"{last:.2f}",
        "kappa.area": percent(area),
    }


def quote_a_v(sources: Sources) -> dict[str, str]:
    """a_V by case at the load of the paper, simulated and by theory on the cell's spectrum."""
    texts, means, small = {}, [], []
    for case in (*ONE_WAVE, WIDE):
        simulated = sources.read(f"fits/a_v/ensembles/{case}").isel(window=0)
        theory = sources.read(f"fits/a_v/lattice/{case}").isel(window=0).sel(variant=VARIANT)
        texts[f"a_v.{case}"] = quote(at_load(simulated), "a_v_mean")
        texts[f"a_v.{case}.theory"] = f"{float(at_load(theory).a_v):.2f}"
        if case != WIDE:
            means.append(float(at_load(simulated).a_v_mean))
            small.append((float(simulated.a_v_mean[0]), float(theory.a_v[0])))
    simulated, theory = zip(*small, strict=True)
    alone, error = average_seeds(sources)
    return texts | {
        "a_v.one_wave": say_range(means),
        "a_v.small_load": say_range(simulated),
        "a_v.small_load.theory": say_range(theory),
        "a_v.seeds_alone": quote_number(alone, error),
        "a_v.seeds_alone.error": percent(error / alone),
    }


def average_seeds(sources: Sources) -> tuple[float, float]:
    """a_V of the seeds alone, without coarse ones, and its standard error."""
    values = at_load(sources.read("fits/a_v/ensembles/H0.8_zeta64")).isel(window=0, resolution=-1)
    values = values.a_v.values
    return float(values.mean()), float(values.std(ddof=1) / np.sqrt(values.size))


def quote_cells(sources: Sources) -> dict[str, str]:
    """Simulation over theory in the attractive area at the smallest load, by width of the cell."""
    texts = {}
    for width, case in CELLS.items():
        at = sources.read(f"fits/theory/{case}").sel(variant=VARIANT).isel(pressure=0)
        at = at.interp({"range": RANGE})
        ratio = 1 / (1 + float(at.attractive_area_difference))
        error = ratio**2 * float(at.attractive_area_difference_total_error)
        texts[f"cell_{width}.small_load"] = quote_number(ratio, error)
    gaps = [
        float(sources.read(f"fits/theory/{c}").theory_mean_gap.sel(variant=VARIANT)[0])
        for c in (*ONE_WAVE, CELLS[1])
    ]
    narrow = sources.read(f"fits/theory/{ONE_WAVE[1]}")
    return texts | {
        "cell_1.highest_summit": number(float(narrow.highest_summit), 2),
        "cell_1.mean_gap": say_range(gaps),
        "cell_1.variance_of_four": percent(share_of_longest(sources)),
    }


def share_of_longest(sources: Sources) -> float:
    """Share of the height variance in the longest waves of a cell of one longest wavelength."""
    made = datasets.parameters(sources.read(f"contact/ensembles/{ONE_WAVE[1]}"))
    lattice = lattice_spectrum(model_spectrum(made), cell_size(made))
    return float(lattice.variance[0] / lattice.variance.sum())


def quote_growth(sources: Sources) -> dict[str, str]:
    """a_V by theory against the magnification, and the exponent of P(u)."""
    first = claims.theory_a_v(sources.read("fits/a_v/sweeps/fig3c"))
    first = first.sel(hurst=0.8, method="nearest")
    texts = {
        f"a_v.theory_1e{power}": number(float(first.sel(magnification=10.0**power)), 2)
        for power in (3, 4, 5, 6)
    }
    exponent = claims.density_exponent(sources.read("persson/sweeps/fig3a"))
    shown = exponent.sel(magnification=claims.SHOWN, method="nearest")
    broad = claims.exponents_at(exponent.isel(magnification=-1), claims.SMALL_GAPS)
    at = [number(x, 2) for x in claims.exponents_at(shown, claims.SMALL_GAPS)]
    return texts | {
        "a_v.theory_growth": percent(float(claims.last_growth(first))),
        "exponent.1e3": f"{', '.join(at[:-1])} and {at[-1]}",
        "exponent.5e4": f"{number(broad.max(), 2)} to {number(broad.min(), 2)}",
    }


NUMBERS = (quote_kappa, quote_a_v, quote_cells, quote_growth)
