"""Write the three ColorChecker scenes: the same 24 patches under D65, A and FL11.

    python tools/make_colorcheckers.py

The light is parallel and falls straight on the chart with an illuminance of 1000 π lx, so a perfect diffuser has
exactly 1000 cd/m², and each patch the XYZ that follows from its spectrum alone: nothing else is lit by it.
"""

from __future__ import annotations

from pathlib import Path

from illuminant import spectra

SCENES = Path(__file__).resolve().parent.parent / "scenes"
PITCH, PATCH = 46, 40  # mm
LAMPS = {
    "D65": ("d65", "Average daylight."),
    "A": ("a", "An incandescent lamp of 2856 K."),
    "FL11": (
        "fl11",
        "A fluorescent lamp of three narrow bands: its lines need every nm, or a fitted sampling.",
    ),
}


def chart(lamp: str, about: str) -> str:
    """The scene file for one lamp."""
    names = [name for name in spectra.names("reflectance") if name.startswith("ColorChecker/")]
    lines = [
        f"# A ColorChecker under {lamp}: 24 flat patches, measured (BabelColor average), lit straight from the front.",
        f"# {about}",
        "# A perfect diffuser would have 1000 cd/m2 (the illuminance is 1000 pi lx), so the XYZ of every patch can be",
        "# computed from its reflectance, the lamp and the observer alone. Written by tools/make_colorcheckers.py.",
        "",
        f'title = "ColorChecker under {lamp}"',
        'length_unit = "mm"',
        "",
        "[camera]",
        "eye = [0, 0, 800]",
        "target = [0, 0, 0]",
        "field_of_view = 21.2",
        "size = [600, 400]",
        "",
        "[render]",
        "samples = 16",
        *(['sampling = "1nm"'] if lamp.startswith("FL") else []),
        "",
        "[lights.lamp]",
        'kind = "directional"',
        "direction = [0, 0, -1]",
        f'spectrum = "{lamp}"',
        "illuminance_lx = 3141.592653589793",
        "",
        "[materials]",
        'board = { kind = "diffuse", reflectance = 0.03 }',
        *(f'"{name[13:]}" = {{ kind = "diffuse", reflectance = "{name}" }}' for name in names),
        "",
        "[objects]",
        'board = { material = "board", rectangle = { corner = [-148, -102, -1], edges = [[296, 0, 0], [0, 204, 0]] } }',
    ]
    for i, name in enumerate(names):
        x = PITCH * (i % 6) - PITCH * 3 + (PITCH - PATCH) // 2
        y = PITCH * 2 - PITCH * (i // 6) - PITCH + (PITCH - PATCH) // 2
        shape = f"{{ corner = [{x}, {y}, 0], edges = [[{PATCH}, 0, 0], [0, {PATCH}, 0]] }}"
        lines.append(f'"{name[13:]}" = {{ material = "{name[13:]}", rectangle = {shape} }}')
    return "\n".join([*lines, ""])


def main() -> None:
    """Write the scenes."""
    for lamp, (word, about) in LAMPS.items():
        (SCENES / f"colorchecker-{word}.toml").write_text(chart(lamp, about))


if __name__ == "__main__":
    main()
