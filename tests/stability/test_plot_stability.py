"""The map of validity of two made-up components, from the probes to the picture."""

from types import SimpleNamespace

import matplotlib.image
import numpy as np
import pytest
from helpers.jobs import make_job

from stability import components, plot_stability, probe_stability
from stability.components import RIGHT, Check, Component
from stickiness import datasets


@pytest.mark.slow
def test_map_is_stored_and_drawn(tmp_path, monkeypatch):
    files = []
    for name, axes in (("spectrum", ("hurst", "unit")), ("sampling", ("hurst",))):
        made_up = Component(lambda hurst, **_: [Check("a check", hurst, 0.5)], axes)
        monkeypatch.setitem(probe_stability.COMPONENTS, name, made_up)
        job = make_job(tmp_path / f"{name}.nc", wildcards={"component": name})
        probe_stability.main(job)
        files += job.output
        data = datasets.read(files[-1])
        assert np.array_equal(data.outcome == RIGHT, data.hurst <= 0.5)
        assert 0 < int((data.outcome == RIGHT).sum()) < data.sizes["point"]
    outputs = [str(tmp_path / f"map.{suffix}") for suffix in ("png", "pdf")]
    plot_stability.main(SimpleNamespace(input=SimpleNamespace(components=files), output=outputs))
    assert matplotlib.image.imread(outputs[0])[..., :3].std() > 0.05


def test_axes_have_labels():
    assert plot_stability.LABELS.keys() == components.AXES.keys()
    assert len(plot_stability.OUTCOMES) == len(components.OUTCOMES)


@pytest.mark.parametrize(
    ("value", "text"), [(0.0, "0"), (0.5, "0.5"), (1e4, "$10^{4}$"), (100.0, "100")]
)
def test_numbers_are_short(value, text):
    assert plot_stability.shorten(value) == text
