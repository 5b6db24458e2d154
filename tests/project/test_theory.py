"""The theory guide: its worked example is that of the code, and its equations have numbers."""

import re
from pathlib import Path

import numpy as np
import pytest

from stickiness.remaining import predict
from stickiness.remaining.calibration import find_spread
from stickiness.remaining.roughness import Roughness
from stickiness.remaining.share import tough_area, tough_share, weak_share
from stickiness.spectrum import SelfAffine

THEORY = Path(__file__).parents[2] / "docs/theory"
CHAPTERS = sorted(THEORY.glob("*.md"))
ADHESION = (THEORY / "adhesion.md").read_text(encoding="utf-8")
WALL = SelfAffine(hurst=0.8, q0=2 * np.pi / 100e-6, q1=2 * np.pi / 10e-9, h_rms=1e-6)
WAFER = SelfAffine(
    hurst=0.8, q0=2 * np.pi / 10e-6, q_rolloff=2 * np.pi / 1e-6, q1=2 * np.pi / 1e-9, h_rms=1.2e-9
)
EXAMPLES = (  # spectrum, law, E* [Pa] and range [m]
    (WALL, "exponential", 0.27e6, 0.3e-9),
    (WALL, "exponential", 2.7e6, 0.3e-9),
    (WAFER, "van_der_waals", 85e9, 0.165e-9),
)
WORK = 0.05
ROUNDING = 6e-4  # of numbers with four digits


def compute_example(spectrum, law, modulus, range_):
    """Numbers of an example in the units of the page, by the first cell of their row."""
    length = WORK / modulus
    longest = spectrum.q_rolloff or spectrum.q0
    rough = Roughness(
        h_rms=spectrum.h_rms,
        q0=longest,
        elastic_energy=spectrum.elastic_energy(),
        q1=spectrum.q1,
        rms_slope=spectrum.rms_slope,
        law=law,
    )
    ratio = length / spectrum.elastic_energy()
    onset = rough.onset(length, range_)
    found = predict(spectrum, adhesion_length=length, range=range_, law=law)
    distance = rough.distance(length, range_)
    return {
        r"$U_\mathrm{full}$ [J/m²]": modulus * spectrum.elastic_energy(),
        r"$h'_\mathrm{rms}$": spectrum.rms_slope,
        r"$x$": ratio,
        r"$z$": rough.zone(length, range_),
        r"$k_n$": rough.narrowest_wave(length, range_),
        r"$N$": 3.7 * onset / (1 - onset),
        r"$x_0$": onset,
        r"$s$": 0.74 * onset * np.sqrt(1 - onset),
        r"$A_\mathrm{t}$": tough_area(ratio, onset),
        r"$S_\mathrm{t}$": tough_share(ratio, onset),
        r"$S_\mathrm{w}$": weak_share(ratio, range_ / spectrum.h_rms, rough.load_scale, law),
        r"$S$": found.separation,
        r"$\mu$": found.tabor,
        r"$T$": spectrum.h_rms * ratio * found.separation / distance,
        r"$\ell$ [µm]": 1e6 * distance,
        r"$\sigma_\mathrm{po}$ [Pa]": modulus * found.pull_off,
        r"$E^\ast_\mathrm{th}$ [MPa]": 1e-6 * WORK / rough.threshold(range_, 0.1),
    }


def read_number(text):
    """A number as the page writes it, such as 3.054 × 10⁻⁸."""
    digits, _, power = text.partition(" × 10")
    plain = power.translate(str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-"))
    return float(digits) * 10.0 ** int(plain or 0)


def test_the_worked_example_is_that_of_the_code():
    table = ADHESION.partition("## Worked example")[2].partition("## In the code")[0]
    rows = [line.strip("| ").split(" | ") for line in table.splitlines() if line.startswith("| $")]
    on_page = {name: [read_number(cell) for cell in cells] for name, _, *cells in rows}
    computed = [compute_example(*example) for example in EXAMPLES]
    assert on_page.keys() == computed[0].keys()
    for name, numbers in on_page.items():
        expected = [float(example[name]) for example in computed]
        assert numbers == pytest.approx(expected, rel=ROUNDING), name


def test_the_factor_of_the_pull_off_is_that_of_the_limits():
    (power,) = re.findall(r"e\^\{(0\.\d+)\}, \\frac\{s_Lw\}", ADHESION)
    assert float(power) == find_spread("spectrum", "ln_tension").value


@pytest.mark.parametrize("chapter", CHAPTERS, ids=lambda path: path.stem)
def test_equations_are_numbered_in_order(chapter):
    """Every set equation has a tag, and equations that are referred to exist."""
    text = chapter.read_text(encoding="utf-8")
    equations = re.findall(r"^\$\$(.*?)\$\$$", text, re.M | re.S)
    tags = [re.findall(r"\\tag\{(\d+)\.(\d+)\}", equation) for equation in equations]
    assert all(len(tag) == 1 for tag in tags)
    assert [int(number) for ((_, number),) in tags] == list(range(1, len(tags) + 1))
    assert len({number for ((number, _),) in tags}) <= 1


def test_equations_that_are_referred_to_exist():
    texts = [chapter.read_text(encoding="utf-8") for chapter in CHAPTERS]
    tags = {tag for text in texts for tag in re.findall(r"\\tag\{(\d+\.\d+)\}", text)}
    for text in texts:
        prose = re.sub(r"\$\$.*?\$\$", "", text, flags=re.S)
        named = re.findall(r"\((\d\.\d+)(?: to (\d\.\d+))?\)", prose)
        assert {tag for pair in named for tag in pair if tag} <= tags
