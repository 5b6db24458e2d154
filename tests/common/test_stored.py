"""Names of files say what they hold, and new files hold what no file on disk does."""

from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from common import stored
from common.stored import NO_LOAD, Part, Store

positive = st.floats(min_value=0, exclude_min=True, allow_nan=False, allow_infinity=False)
LOADS = st.lists(positive, min_size=1, max_size=4, unique=True).map(sorted).map(tuple)


@st.composite
def parts(draw, seeds=40, loads=LOADS):
    first, last = sorted(draw(st.tuples(*[st.integers(1, seeds)] * 2)))
    return Part(first, last, draw(st.one_of(st.just(NO_LOAD), loads)))


@given(parts())
def test_a_name_says_what_its_file_holds(part):
    text = str(part)
    assert Part.of(text) == part
    assert not set(text) & set(",:= /")  # Snakemake hands it on as name=value,name=value
    assert stored.find_parts([f"seeds{text}.nc", f"maps{text}.nc"], "seeds") == [part]


def test_names_are_read_and_written_in_one_way_only():
    assert str(Part(1, 8, (1e-5, 0.065))) == "1-8_p1e-05_0.065"
    others = ["seeds1.nc", "seeds1-8_p0.10.nc", "seeds1-8_p0.1.tsv", ".seeds1-8.nc.1a2b3c4d.nc"]
    assert stored.find_parts([*others, "ensembles", "seeds01-8.nc"], "seeds") == []


@given(st.lists(positive, max_size=60, unique=True).map(sorted))
def test_names_are_short_enough_for_every_load_to_be_in_one(loads):
    chunks = stored.chunk_loads(loads)
    assert [load for chunk in chunks for load in chunk] == loads
    for chunk in chunks:
        # What is written first has a longer name: a dot, nine characters and an ending.
        assert len(f".coarse99999-99999_p{stored.join_loads(chunk)}.nc.12345678.nc") <= 255


def test_the_loads_of_a_usual_case_are_in_one_file():
    curve = (0.001, 0.003, 0.0065, 0.015, 0.03, 0.065, 0.13, 0.2, 0.26, 0.33, 0.39, 0.46, 0.52)
    found = Store("there", [], "seeds", [(range(1, 11), curve)]).find([1, 2, 9], curve)
    text = stored.join_loads(curve)
    assert found == [f"there/seeds1-8_p{text}.nc", f"there/seeds9-10_p{text}.nc"]


A, B, C = 0.1, 0.2, 0.3


@pytest.mark.parametrize(
    ("names", "wanted", "new"),
    [
        ([], [(3, (A, B))], ["1-3_p0.1_0.2"]),
        ([], [(3, NO_LOAD), (10, NO_LOAD)], ["1-8", "9-10"]),
        (["1-3"], [(5, NO_LOAD)], ["4-5"]),
        (["1-5"], [(3, NO_LOAD)], []),
        (["1-3_p0.1_0.2"], [(3, (A, B)), (5, (A,))], ["4-5_p0.1"]),
        (["1-3_p0.1_0.2"], [(3, (A, B, C))], ["1-3_p0.3"]),
        (["1-3_p0.1_0.2", "4-5_p0.1"], [(5, (A, B, C))], ["1-3_p0.3", "4-5_p0.2_0.3"]),
        (["1-3_p0.1_0.2"], [(2, (B,))], []),
        ([], [(2, (A, B)), (4, (B, C))], ["1-2_p0.1_0.2_0.3", "3-4_p0.2_0.3"]),
    ],
)
def test_only_what_no_file_holds_is_new(names, wanted, new):
    names = [f"seeds{name}.nc" for name in names]
    blocks = [(range(1, count + 1), loads) for count, loads in wanted]
    used = Store("there", names, "seeds", blocks).used
    assert [str(part) for part in used if f"seeds{part}.nc" not in names] == new


def test_a_case_takes_only_the_files_that_hold_what_it_wants():
    store = Store("there", [], "seeds", [([1, 2], (A,)), ([1, 2, 3, 4], (B,))])
    assert store.find([1, 2], (A,)) == ["there/seeds1-2_p0.1_0.2.nc"]
    assert store.find([4], (B,)) == ["there/seeds3-4_p0.2.nc"]
    with pytest.raises(LookupError, match=r"there: nothing asks for seed 3 at load 0\.1"):
        store.find([3], (A,))


# Few seeds and loads, so that blocks overlap and files lie side by side; short chunks, so that the
# loads of one block are in several files.
FEW = st.lists(st.sampled_from([0.1, 0.2, 0.3, 0.4, 0.5]), min_size=1, unique=True)
BLOCKS = st.lists(
    st.tuples(st.integers(1, 12).map(lambda count: range(1, count + 1)), FEW),
    min_size=1,
    max_size=3,
)
HELD = st.lists(parts(12, FEW.map(sorted).map(tuple)), max_size=4)


def make_store(held, blocks):
    names = [f"seeds{part}.nc" for part in held]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(stored, "LONGEST", len("0.1_0.2"))
        return Store("there", names, "seeds", blocks, seeds_a_file=4)


@settings(max_examples=300)
@given(HELD, BLOCKS)
def test_every_pair_that_is_wanted_is_in_one_file_and_new_files_hold_nothing_else(held, blocks):
    held = [part for part in held if part.loads != NO_LOAD]
    wanted = {pair for seeds, loads in blocks for pair in product(seeds, loads)}
    on_disk = {pair for part in held for pair in product(part.seeds, part.loads)}
    new = [part for part in make_store(held, blocks).used if part not in held]
    pairs = [pair for part in new for pair in product(part.seeds, part.loads)]
    assert sorted(pairs) == sorted(wanted - on_disk)
    assert all(len(part.seeds) <= 4 for part in new)
    assert all((part.first - 1) // 4 == (part.last - 1) // 4 for part in new)


@settings(max_examples=300)
@given(HELD, BLOCKS, st.data())
def test_files_that_are_made_in_any_order_leave_the_others_as_they_were_planned(held, blocks, data):
    store = make_store(held, blocks)
    new = [part for part in store.used if part not in held]
    made = data.draw(st.lists(st.sampled_from(new), unique=True)) if new else []
    assert set(make_store([*held, *made], blocks).used) == set(store.used)


@settings(max_examples=300)
@given(HELD, BLOCKS, st.data())
def test_a_job_finds_its_planned_files_whatever_else_is_made_or_replaced(held, blocks, data):
    """Snakemake deletes a file before the job that makes it again."""
    store = make_store(held, blocks)
    planned = [*held, *store.used]
    for block in blocks:
        inputs = store.find_parts(*block)
        others = data.draw(st.lists(st.sampled_from(planned), unique=True))
        there = data.draw(st.permutations([*inputs, *others]))
        assert make_store(there, blocks).find_parts(*block) == inputs


def test_files_of_a_folder_are_listed_and_none_if_it_is_missing(tmp_path):
    (tmp_path / "seeds1-2.nc").touch()
    assert stored.list_names(str(tmp_path)) == ["seeds1-2.nc"]
    assert stored.list_names(str(tmp_path / "missing")) == []
    assert stored.list_names(str(tmp_path / "seeds1-2.nc")) == []
