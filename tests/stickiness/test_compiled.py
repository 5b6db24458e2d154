"""Loops are compiled wherever their source is."""

from stickiness.compiled import compiled


def test_a_source_without_a_folder_for_its_cache_is_compiled_all_the_same():
    names = {}
    exec("def double(x):\n    return x + x\n", names)
    assert compiled(names["double"])(1.5) == 3.0
