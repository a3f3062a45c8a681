"""The schema as documentation: every key has a meaning and an example that is right, and the page is up to date."""

import tomllib

import pytest
from pydantic import TypeAdapter

from illuminant import object_schema, schema
from illuminant.report import example
from illuminant.scene import Scene
from illuminant.scene_file import resolve, schema_text
from illuminant.table import Table


def models():
    found = {
        model
        for module in (schema, object_schema)
        for model in vars(module).values()
        if isinstance(model, type) and issubclass(model, Table) and model not in (Table, schema.Quantities)
    }
    return sorted(found, key=lambda model: model.__name__)


KEYS = [(model, name) for model in models() for name in model.model_fields]


@pytest.mark.parametrize(("model", "name"), KEYS, ids=[f"{model.__name__}.{name}" for model, name in KEYS])
def test_every_key_has_a_meaning_and_a_right_example(model, name):
    field = model.model_fields[name]
    assert field.description
    if field.examples == [""]:
        assert model is schema.SceneFile  # a table with a section of its own
        return
    holder = type("Holder", (Table,), {"__annotations__": {"x": field.annotation}, "x": field})
    holder.model_validate({"x": example(model, name)})
    assert TypeAdapter(model)


def test_the_page_in_docs_is_the_schema(repository):
    page = (repository / "docs" / "scene-file.md").read_text(encoding="utf-8")
    assert page == schema_text(), "write it anew: illuminant check --schema > docs/scene-file.md"


def test_every_example_in_the_page_is_toml_and_the_first_is_a_scene():
    blocks = [block.split("```")[0] for block in schema_text().split("```toml\n")[1:]]
    tables = [tomllib.loads(block) for block in blocks]
    assert len(tables) > 15
    assert isinstance(resolve(tables[0]), Scene)
