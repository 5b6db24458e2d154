"""The JSON schema that editors use: current, named in the files, and right about them."""

import json
import re

import jsonschema
import pytest
import yaml

from common.config import reference

CONFIG = reference.PROJECT / "config"
FILES = [*(CONFIG / f"{name}.yaml" for name in ("config", "materials", "surfaces", "experiments"))]
FILES += [CONFIG / "campaigns/paper.yaml"]


@pytest.fixture(scope="module")
def schema():
    content = json.loads(reference.SCHEMA.read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(content)
    return jsonschema.Draft202012Validator(content)


def test_the_schema_is_that_of_the_models(schema):
    assert schema.schema == json.loads(json.dumps(reference.schema()))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_files_name_the_schema_and_agree_with_it(schema, file):
    text = file.read_text(encoding="utf-8")
    named = re.match(r"# yaml-language-server: \$schema=(\S+)\n", text)[1]
    assert (file.parent / named).resolve() == reference.SCHEMA
    schema.validate(yaml.safe_load(text))


@pytest.mark.parametrize(
    ("content", "place"),
    [
        ({"fidelty": "draft"}, []),
        ({"fidelities": {"mine": {"seeds": "3"}}}, ["fidelities", "mine", "seeds"]),
        ({"materials": {"a": {"common": "psa", "tickness": "1 um"}}}, ["materials", "a"]),
        ({"materials": {"a": {"common": "psa", "poisson_ratio": 0.7}}}, ["materials", "a"]),
        ({"surfaces": {"a": {"kind": "measure", "label": "a", "source": "b"}}}, ["surfaces", "a"]),
    ],
)
def test_wrong_keys_and_values_have_their_place(schema, content, place):
    (error,) = schema.iter_errors(content)
    assert list(error.absolute_path)[: len(place)] == place


def test_a_configuration_may_hold_a_single_key(schema):
    assert schema.is_valid({"fidelity": "draft", "materials": "my_materials.yaml"})
    assert schema.is_valid({"criteria": {"a_v": {"pressure": 0.03}}})
