"""Make `scenes/copper-spheres.toml` and `scenes/copper-spheres-mapped.toml`: the twenty spheres of book figure II.4.

    python tools/make_copper_spheres.py

The parameters are those of book figure II.5 (`illuminant.appearance.COPPER_SPHERES`): rows 1 and 2 are lit by a lamp
alone, rows 3 and 4 by the lamp and a reflection map.
"""

from __future__ import annotations

from pathlib import Path

from illuminant.appearance import COPPER_SPHERES

SCENES = Path(__file__).resolve().parent.parent / "scenes"
HEAD = """\
# {rows} of book figure II.4: copper at ten finishes, with the coefficients of book figure II.5. Made by
# tools/make_copper_spheres.py.
#
{hint}

title = "Copper spheres, {what}"

[camera]
eye = [0.0, 0.0, 12.0]
target = [0.0, 0.0, 0.0]
field_of_view = 26.0
size = [1000, 440]

[render]
technique = "phong"
illumination = "{illumination}"
samples = 16
ambient = 0.15

[lights.lamp]
kind = "directional"
direction = [-1.0, -1.0, -1.6]
spectrum = "D65"
illuminance_lx = 10000.0
"""
ROOM = """
[lights.room]
kind = "environment"
image = "images/studio.exr"
luminance_cd_m2 = 2000.0
"""
BALL = """
[materials."{name}"]
kind = "conductor"
metal = "copper"
roughness = {roughness:.4f}
coefficients.all = {{ ambient = {ambient}, diffuse = {diffuse}, specular = {specular}, exponent = {exponent:.1f}, \
distribution = "blinn", diffuse_curve = "book/copper", specular_curve = "book/copper" }}

[objects."{name}"]
material = "{name}"
sphere = {{ center = [{x:.3f}, {y:.3f}, 0.0], radius = 0.48 }}
"""


def text(mapped: bool) -> str:
    """A scene of ten spheres."""
    from illuminant import optics

    hint = (
        "# `whitted` and `hall` look up what surrounds the spheres in the mirror direction, as the book's renderer did."
        if mapped
        else "# Any model: `phong` and `blinn` have the highlight of the book's renderer."
    )
    parts = [
        HEAD.format(
            rows="Rows 3 and 4" if mapped else "Rows 1 and 2",
            hint=hint,
            what="with a reflection map" if mapped else "under a lamp",
            illumination="whitted" if mapped else "phong",
        )
    ]
    if mapped:
        parts.append(ROOM)
    spheres = [sphere for sphere in COPPER_SPHERES if sphere["mapped"] == mapped]
    for i, sphere in enumerate(spheres):
        exponent = float(sphere["exponent"])
        beta = float(optics.lobe_half_angle("blinn", exponent))
        parts.append(
            BALL.format(
                name=f"copper {i + 1}",
                # The slope of Beckmann's distribution with the same half-width.
                roughness=min(1.0, float(optics.lobe_coefficient("cook", beta)) ** 0.5),
                ambient=sphere["ambient"],
                diffuse=sphere["diffuse"],
                specular=sphere["specular"],
                exponent=exponent,
                x=1.05 * (i % 5 - 2),
                y=0.525 if i < 5 else -0.525,
            )
        )
    return "".join(parts)


def main() -> None:
    """Write both scenes."""
    for name, mapped in (("copper-spheres", False), ("copper-spheres-mapped", True)):
        (SCENES / f"{name}.toml").write_text(text(mapped), encoding="utf-8")


if __name__ == "__main__":
    main()
