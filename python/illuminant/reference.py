"""The reference of the scene file, written from its schema.

`docs/scene-file.md` is this text, and `illuminant check --schema` prints it; a test compares the two. Every key has
its meaning, its unit, its default and an example, all from the models in `schema`.

Example:
    >>> print(scene_file_reference().splitlines()[0])
    # The scene file
"""

from __future__ import annotations

import re
import tomllib
from typing import Any, get_args

from illuminant import coefficient_schema, pattern_schema, schema, texture_schema
from illuminant.quantities import FITTING, QUANTITIES
from illuminant.report import kind_of

__all__ = ["scene_file_reference"]

INTRODUCTION = """\
# The scene file

A scene is one TOML file. Lengths are in the unit that `length_unit` names (metres by default), angles in degrees,
wavelengths in nm, and every other quantity is in the SI unit that its key names. The world is right-handed. Names of
files are relative to the folder of the scene file. A name with blanks stands in quotes: `[materials."red paint"]`.

`illuminant check FILE` reports every mistake of a scene at once, each with its line; an unknown key is a mistake.
`illuminant check --schema` prints this page.

```toml
title = "A grey ball under daylight"

[camera]
eye = [0.0, 1.0, 4.0]
target = [0.0, 0.5, 0.0]

[materials.grey]
kind = "diffuse"
reflectance = 0.5

[objects.ball]
material = "grey"
sphere = { center = [0.0, 0.5, 0.0], radius = 0.5 }

[lights.sky]
kind = "environment"
spectrum = "D65"
luminance_cd_m2 = 1000.0
```
"""

SPECTRA = """\
## Spectra

Wherever a key takes a spectrum, it can be written as

- a text: the name of one in `[spectra]`, else of one in the library (`"D65"`, `"ColorChecker/dark skin"`, `"gold.n"`);
- a number: the same value at every wavelength;
- a table with exactly one of `library`, `file`, `constant`, `blackbody_k`, `daylight_k`, `wavelengths_nm` and `rgb`.

`[spectra]` gives names to spectra, so that materials and lights can share them:

```toml
[spectra]
paint = "ColorChecker/dark skin"
bulb = { blackbody_k = 2700.0 }
red = { rgb = [0.6, 0.1, 0.1], role = "albedo" }
measured = { file = "spectra/paint.csv", scale = 0.01 }
ramp = { wavelengths_nm = [400.0, 700.0], values = [0.1, 0.8], outside = "hold" }
```

A spectrum is checked for its use: a reflectance is a fraction from 0 to 1, light and absorption are not negative, n is
above 0. RGB must say its role, and is refused for n, k and absorption, which it does not determine.
"""

IMAGES = """\
## Images on surfaces

A reflectance, a pigment, a transmittance or a roughness can be an image, and an image can perturb the normal. Images
lie over the unit square of the texture coordinates that a mesh brings; rectangles, boxes, discs and spheres have their
own (on a sphere u runs round its z axis, and v from +z to -z). All techniques look them up alike, as the mean over
what a pixel sees of them.

```toml
[materials.tiles]
kind = "coated"
reflectance = { image = "images/tiles.png", repeat = [4.0, 4.0] }
roughness = { image = "images/worn.png", black = 0.05, white = 0.4 }
bump = { image = "images/grout.png", height = 0.002, repeat = [4.0, 4.0] }
```
"""

SHAPES = """\
A built-in rectangle, box or disc is a mesh of triangles; a disc is a polygon of 128 sides with the area of the disc. A
sphere stays a true sphere. The front of a face is the side from which its corners run anticlockwise; box and sphere
face outwards. A mesh must have finite vertices, vertex numbers in range, and no face without area.
"""

QUANTITY = """\
## Quantities

A spectrum gives the colour of light, and exactly one quantity its amount:
"""


def scene_file_reference() -> str:
    """The whole page (Markdown)."""
    top = schema.SceneFile
    simple = [
        name for name in top.model_fields if top.model_fields[name].examples != [""] and name != "spectra"
    ]
    parts = [
        INTRODUCTION,
        "## Top of the file\n",
        _keys(top, simple),
        _section("[camera]", schema.Camera),
        _table("`moves_to`", schema.CameraMove),
        _section("[render]", schema.Render),
        _table("The filter", schema.Filter),
        SPECTRA,
        _keys(schema.SpectrumTable),
        "## Materials\n\nA material is a table `[materials.NAME]`; `kind` says which one it is.\n",
        *(_kind("materials", name, model) for name, model in schema.KINDS_OF_MATERIAL.items()),
        _table("`coefficients` for one model", coefficient_schema.Coefficients),
        IMAGES,
        _table("An image in place of a reflectance", texture_schema.ColourImage),
        _table("An image in place of a roughness", texture_schema.SlopeImage),
        _table("`bump`", texture_schema.HeightImage),
        _table("`normal_map`", texture_schema.NormalImage),
        _table("A pattern in place of a reflectance", pattern_schema.ColourPattern),
        _table("A pattern in place of a roughness", pattern_schema.SlopePattern),
        _table("A pattern for `bump`", pattern_schema.HeightPattern),
        "## Objects\n",
        (schema.Object.__doc__ or "").strip().replace("\n    ", "\n") + "\n",
        SHAPES,
        _keys(schema.Object),
        _table("`mesh` as a table", schema.MeshTable),
        _table("`sphere`", schema.Sphere),
        _table("`rectangle`", schema.Rectangle),
        _table("`box`", schema.Box),
        _table("`disc`", schema.Disc),
        _table("`rotate`", schema.Rotation),
        _table("`motion`", schema.Move),
        "## Lights\n\nA light is a table `[lights.NAME]`; `kind` says which one it is. Objects with an emitter "
        "material shine too.\n",
        *(_kind("lights", name, model) for name, model in schema.KINDS_OF_LIGHT.items()),
        "## Atmosphere\n\n`[atmosphere]` says what becomes of light on its way to the eye; `kind` says how. These are "
        "effects for the eye, not media: light between surfaces does not know of them.\n",
        *(_kind("atmosphere", name, model) for name, model in schema.KINDS_OF_ATMOSPHERE.items()),
        _section("Medium", schema.Medium).replace("## Medium", "## Medium\n\n`[medium]`", 1),
        _section("Animation", schema.AnimationTable).replace(
            "## Animation", "## Animation\n\n`[animation]`", 1
        ),
        _table("`keys`", schema.Keys),
        QUANTITY,
        _quantities(),
    ]
    return "\n".join(part.rstrip("\n") + "\n" for part in parts)


def _section(title: str, model: type[schema.Table]) -> str:
    return f"## {title}\n\n{_page(model)}\n\n{_keys(model)}"


def _table(title: str, model: type[schema.Table]) -> str:
    return f"### {title}\n\n{_page(model)}\n\n{_keys(model)}"


def _kind(family: str, name: str, model: type[schema.Table]) -> str:
    fields = [key for key in model.model_fields if key not in QUANTITIES or key in FITTING.get(name, ())]
    fields.sort(key=lambda key: (key != "kind", key in QUANTITIES))
    return f"### {kind_of(model)}\n\n{_page(model)}\n\n{_keys(model, fields)}"


def _page(model: type[schema.Table]) -> str:
    return " ".join((model.__doc__ or "").split())


def _keys(model: type[schema.Table], names: list[str] | None = None) -> str:
    """The keys of a table as a list, and one example of every key."""
    names = list(model.model_fields) if names is None else names
    rows = ["| key | value | default | meaning |", "| --- | --- | --- | --- |"]
    examples = []
    for name in names:
        field = model.model_fields[name]
        default = "required" if field.is_required() else _default(field.default)
        rows.append(f"| `{name}` | {_type(field, name)} | {default} | {field.description} |")
        examples.append(f"{name} = {(field.examples or [''])[0]}")
    return "\n".join([*rows, "", "Each key once:", "", "```toml", *examples, "```", ""])


def _default(value: Any) -> str:
    if value is None or value == "" or value == {}:
        return "-"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    return f'`"{value}"`' if isinstance(value, str) else f"`{value}`"


def _type(field: Any, name: str) -> str:
    """A type in words, from the annotation and, for lists, from the shape of the example."""
    annotation = field.annotation
    text = repr(annotation)
    for form, words in {
        "ColourImage": "spectrum, image or pattern",
        "SlopeImage": "number, image or pattern",
        "HeightImage": "table",
        "NormalImage": "table",
        "dict[str": "table of tables",
        "SpectrumTable": "spectrum",
        "MeshTable": "text or table",
        "_axis_form": "`x`, `y`, `z` or 3 numbers",
        "_scale_form": "number or 3 numbers",
        "_rotate_form": "table or list of tables",
        "_rate_form": "number or text",
        "list[typing.Any]": "list of values",
    }.items():
        if form in text or form in repr(field.metadata):
            return words
    if annotation is Any:
        return "text" if name == "image" else "rows of numbers"
    literals = _literals(annotation)
    if literals:
        return ", ".join(f'`"{word}"`' for word in literals)
    if "list[" in text:
        lengths = (repr(field.metadata) + text).replace("MinLen(min_length=1)", "")
        return _shape(tomllib.loads(f"x = {field.examples[0]}")["x"], "MinLen" in lengths)
    for kind, words in {
        "str": "text",
        "bool": "true or false",
        "int": "whole number",
        "float": "number",
    }.items():
        if re.search(rf"\b{kind}\b", text):
            return words
    return "table"


def _shape(example: list[Any], fixed: bool) -> str:
    rows = isinstance(example[0], list)
    what = "whole numbers" if isinstance((example[0] if rows else example)[0], int) else "numbers"
    if not fixed:
        return f"list of {what}"
    return f"{len(example)} × {len(example[0])} {what}" if rows else f"{len(example)} {what}"


def _literals(annotation: Any) -> list[str]:
    if type(annotation).__name__ == "_LiteralGenericAlias":
        return [str(word) for word in get_args(annotation)]
    return [word for argument in get_args(annotation) for word in _literals(argument)]


def _quantities() -> str:
    rows = ["| key | states | fits |", "| --- | --- | --- |"]
    for name, meaning in QUANTITIES.items():
        fits = ", ".join(source for source, keys in FITTING.items() if name in keys)
        rows.append(f"| `{name}` | {meaning} | {fits} |")
    return "\n".join(rows) + "\n"
