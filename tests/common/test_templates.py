"""What templates make of numbers and symbols."""

import pytest
from markupsafe import Markup

from stickiness.pages.rendering import make_environment, typeset


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("7 × 10⁻⁶ … 3", 3),
        ("87 … 100 % (87 to 100 %)", 4),
        ("(163 ± 33) m", 1),
        ("H = 0.8, l<sub>a</sub> = 0.05 range", 3),
        ("&lt; 0.01 %", 1),
    ],
)
def test_numbers_do_not_break_on_pages_of_html(tmp_path, text, pieces):
    for name in ("page.html.j2", "page.md.j2"):
        (tmp_path / name).write_text("{{ text }}", encoding="utf-8")
    environment = make_environment(tmp_path)
    shown = environment.get_template("page.html.j2").render(text=Markup(text))
    assert len(shown.split(" ")) == pieces
    assert shown.replace("\u00a0", " ") == text
    assert environment.get_template("page.md.j2").render(text=text) == text


@pytest.mark.parametrize(
    ("text", "html"),
    [
        ("u/h_rms, q0 h'_rms", "u/h<sub>rms</sub>, q<sub>0</sub> h&#39;<sub>rms</sub>"),
        ("a_V,PR ~ ζ^((5H-3)/3)", "a<sub>V,PR</sub> ~ ζ<sup>(5H−3)/3</sup>"),
        ("C0 = 10⁻³ m^0.4, 5 um", "C<sub>0</sub> = 10⁻³ m<sup>0.4</sup>, 5 µm"),
        ("shape_a q01 x_rms_y", "shape_a q01 x_rms_y"),
        (
            "<i> & doi:10.1234/q0",
            '&lt;i&gt; &amp; <a href="https://doi.org/10.1234/q0">doi:10.1234/q0</a>',
        ),
    ],
)
def test_symbols_are_set(text, html):
    assert typeset(text) == html


def test_pages_leave_out_solids_that_form_in_place():
    assert "from a liquid" in make_environment("report").get_template("left_out.j2").render()
