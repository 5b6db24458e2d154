"""Rows of a campaign on their way to a table, and one seed of each measured again."""

from importlib import import_module
from itertools import islice
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
from helpers.campaigns import CAMPAIGNS, read
from helpers.jobs import make_job

from campaigns import heights, measure, tabulate
from common import committed, heights_table, remaining_table

COLUMNS = {
    "set": "name",
    "role": "of it",
    "seed": "number",
    "length": ("m", "of it"),
    "word": "said",
}


def measure_lengths(setting, seed, shared):
    """Two rows, of which the second one lacks a word."""
    yield {"length": shared["factor"] * setting["number"] * seed, "word": "long"}
    yield {"length": np.nan}


@pytest.fixture
def path(tmp_path):
    """Table of two sets."""
    files = []
    lengths = SimpleNamespace(
        __doc__="Lengths.\n\nOf two sets.\n", COLUMNS=COLUMNS, measure=measure_lengths
    )
    for name, number in (("one", 1.5), ("two", 2.0)):
        files.append(tmp_path / name / "seed3.nc")
        params = {"setting": {"role": "unseen", "number": number}, "shared": {"factor": 2}}
        wildcards = {"campaign": "lengths", "set": name, "seed": "3"}
        measure.write_rows(make_job(files[-1], params, wildcards), lengths)
    table = tmp_path / "lengths.csv"
    params = SimpleNamespace(target="lengths_measured")
    tabulate.main(SimpleNamespace(input=files, output=[table], params=params))
    return table


def test_rows_of_all_sets_become_a_table(path):
    table = committed.read(path, COLUMNS, "lengths_measured")
    assert table["set"].tolist() == ["one", "one", "two", "two"]
    assert set(table.role) == {"unseen"}
    assert table.seed.tolist() == [3] * 4
    np.testing.assert_array_equal(table.length, [9.0, np.nan, 12.0, np.nan])
    assert table.word.isna().tolist() == [False, True] * 2


def test_the_head_explains_the_table_and_its_columns(path):
    comment = [line[2:] for line in path.read_text().splitlines() if line.startswith("#")]
    assert comment[:2] == ["Lengths.", "Of two sets."]
    assert any("lengths_measured" in line for line in comment)
    assert comment[-2:] == ["length: of it [m]", "word: said"]


@pytest.mark.parametrize(
    ("read_path", "lacking"),
    [
        (lambda path: committed.read(path, ("set", "kind"), "limits_measured"), "kind"),
        (heights_table.read, "family"),
        (remaining_table.read, "magnification"),
    ],
)
def test_a_table_without_a_column_is_refused(tmp_path, read_path, lacking):
    path = tmp_path / "some.csv"
    path.write_text("set,role,hurst\nx,fitted,0.8\n")
    with pytest.raises(ValueError, match=f"some.csv: lacks the columns {lacking}"):
        read_path(path)
    with pytest.raises(ValueError, match="no such file"):
        read_path(tmp_path / "none.csv")


#: A small set of every campaign, and how many of its first rows are measured again.
SMALL = {
    "solids": ("layer_1", 1),
    "patches": ("gaussian_1", 1),
    "ranges": ("gaussian_5", 2),
    "pull_offs": ("gaussian_1", 2),
    "unresolved": ("gaussian_1", 2),
    "larger": ("gaussian_1", 1),
    "coated": ("plateau_honed_1", 1),
    "balls": ("gaussian_5", 3),
    "long_ranges": ("H0.5_1x1_zeta8", 3),
    "heights": ("H0.5_zeta8_2x2", 2),
    "remaining": ("H0.8_zeta4_coarse", 1),
}
#: Of a path, which takes other steps since: within 1 %, and jumps are counted anew.
ROUGHLY = {"remaining": ("approach", "separation", "pull_off")}
#: Limits by the calibration of their time, and times.
NOT_COMPARED = {
    "remaining": ("jumps",),
    "heights": tuple(each for each in heights.COLUMNS if each.endswith(("_low", "_high"))),
}
SLOW = ("patches", "larger", "coated", "heights")


@pytest.mark.parametrize(
    "name", [pytest.param(each, marks=pytest.mark.slow if each in SLOW else ()) for each in SMALL]
)
def test_one_seed_is_that_of_the_committed_table(name):
    chosen, count = SMALL[name]
    module = import_module(f"campaigns.{name}")
    campaign = CAMPAIGNS[name]
    setting = campaign["sets"][chosen]
    seed = setting["seeds"][0]
    rows = list(islice(module.measure(setting, seed, campaign), count))
    of_set = {**setting, "set": chosen, "seed": seed}
    made = measure.make_dataset(rows, of_set, module).to_dataframe()
    table = read(name)
    known = table[(table["set"] == chosen) & (table.seed == seed)].head(count)
    for column in module.COLUMNS:
        if column.startswith("seconds") or column in NOT_COMPARED.get(name, ()):
            continue
        if known[column].isna().all():
            assert made[column].replace("", np.nan).isna().all()
        elif pd.api.types.is_numeric_dtype(known[column]):
            tolerance = 1e-2 if column in ROUGHLY.get(name, ()) else 1e-3
            np.testing.assert_allclose(
                made[column].astype(float), known[column], tolerance, 1e-6, err_msg=column
            )
        else:
            assert made[column].tolist() == known[column].tolist()
