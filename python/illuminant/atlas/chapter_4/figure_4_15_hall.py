"""Figure 4.15: glass and copper by Hall's model (Hall and Greenberg 1983; book eq 4.21).

What a surface reflects is multiplied by Fresnel's reflectance F(λ, θ), θ being the angle between the lamp and the
bisector H. At normal incidence that is the colour of the metal; at 90° it is 1 at every wavelength, and the highlight
has the colour of the lamp. With a distant lamp and a distant eye θ is half the angle between them, all over a ball.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    from illuminant.scene import Scene

MATERIALS: dict[str, dict[str, Any]] = {
    "glass": {
        "kind": "dielectric",
        "medium": "BK7",
        "dispersion": False,
        "absorption": {"wavelengths_nm": [380.0, 550.0, 780.0], "values": [0.5, 0.05, 0.4]},
    },
    "copper": {"kind": "conductor", "metal": "copper", "roughness": 0.15},
    "floor": {
        "kind": "diffuse",
        "reflectance": {"pattern": "checker", "colours": [0.12, 0.6], "scale": 0.8},
    },
    "wall": {"kind": "diffuse", "reflectance": "ColorChecker/neutral 6.5"},
}


def picture(size: tuple[int, int]) -> Scene:
    """A ball of greenish glass and one of brushed copper over a chequered floor, under two lamps."""
    from illuminant.scene import Scene

    def plane(material: str, corner: list[float], *edges: list[float]) -> dict[str, Any]:
        return {"rectangle": {"corner": corner, "edges": list(edges)}, "material": material}

    return Scene.build(
        camera={
            "eye": [0.0, 1.6, 5.2],
            "target": [0.0, 0.75, 0.0],
            "field_of_view": 54.0,
            "size": list(size),
        },
        materials=MATERIALS,
        objects={
            "floor": plane("floor", [-5, 0, 6], [10, 0, 0], [0, 0, -10]),
            "wall": plane("wall", [-5, 0, -4], [10, 0, 0], [0, 5, 0]),
            "glass": {"sphere": {"center": [-0.85, 0.8, 0.6], "radius": 0.8}, "material": "glass"},
            "copper": {"sphere": {"center": [1.0, 0.9, -0.4], "radius": 0.9}, "material": "copper"},
        },
        lights={
            "key": {"kind": "point", "position": [2.5, 4.5, 4], "spectrum": "D65", "intensity_cd": 4000.0},
            "fill": {"kind": "point", "position": [-4, 3, 3], "spectrum": "A", "intensity_cd": 1200.0},
        },
    )


def highlight(angle_deg: float, sampling: str) -> Any:
    """XYZ of the highlight on a ball of copper whose lamp makes an angle of incidence with H everywhere on it."""
    import math

    import numpy as np

    from illuminant.rendering import render
    from illuminant.scene import Scene

    turn = 2.0 * math.radians(angle_deg)
    scene = Scene.build(
        camera={"eye": [0, 0, 400], "target": [0, 0, 0], "field_of_view": 0.3, "size": [48, 48]},
        materials={"copper": {"kind": "conductor", "metal": "copper", "roughness": 0.3}},
        objects={"ball": {"sphere": {"center": [0, 0, 0], "radius": 1.0}, "material": "copper"}},
        lights={
            "sun": {
                "kind": "directional",
                "direction": [-math.sin(turn), 0.0, -math.cos(turn)],
                "spectrum": "D65",
                "illuminance_lx": 1000.0,
            }
        },
    )
    found = render(
        scene,
        technique="phong",
        illumination="hall",
        samples=4,
        layers="terms",
        ambient=0.0,
        sampling=sampling,
    )
    return np.asarray(found.layers["specular"].reshape(-1, 3).sum(axis=0))


def draw(quick: bool) -> Sheet:
    """The picture; below, the chromaticity of copper's highlight against the angle, and Fresnel's equations."""
    import numpy as np

    from illuminant import color, optics, spectra
    from illuminant.atlas.chapter_4.pictures_over_curve import pictures_over_curve
    from illuminant.plots.style import GREY, TODAY, line_look
    from illuminant.rendering import render

    size = (240, 97) if quick else (940, 380)
    shown = render(
        picture(size), technique="raytrace", illumination="hall", ambient=0.1, samples=4 if quick else 6
    )
    figure, axes = pictures_over_curve(
        [shown.shown(exposure=0.7 * shown.auto_exposure()).picture.codes],
        ["raytrace × hall: glass that absorbs, and copper"],
        curve_height=300,
    )
    angles = np.array([5.0, 25.0, 45.0, 60.0, 70.0, 78.0, 84.0])
    found = np.array([highlight(float(angle), "fitted:8") for angle in angles])
    seen = np.asarray(color.xyz_to_xyy(found))[:, :2]
    nm = np.arange(380.0, 781.0, 5.0)
    n, k = (spectra.load(f"copper.{part}").at(nm) for part in "nk")
    exact_angles = np.linspace(0.0, 89.9, 91)
    reflected = np.asarray(optics.fresnel_conductor(np.cos(np.radians(exact_angles))[:, None], n, k))
    exact = np.asarray(color.xyz_to_xyy(color.spectra_to_xyz(reflected, nm, illuminant="D65")))[:, :2]
    white = np.asarray(color.xyz_to_xyy(color.white_xyz("D65")))[:2]
    for i, name in enumerate("xy"):
        axes.plot(exact_angles, exact[:, i], **TODAY)
        axes.plot(
            angles, seen[:, i], "o", color=line_look(i)["color"], label=f"{name} of the highlight as rendered"
        )
        axes.axhline(white[i], color=GREY, linestyle=":", linewidth=0.9)
    axes.plot([], [], **TODAY, label="Fresnel's equations")
    axes.plot([], [], color=GREY, linestyle=":", label="the lamp, D65")
    axes.set(
        xlabel="angle of incidence θ between lamp and H, degrees",
        ylabel="chromaticity",
        xlim=(0, 90),
        ylim=(0.308, 0.361),
    )
    axes.legend(loc="center left", bbox_to_anchor=(0.0, 0.56), ncols=2)
    at = np.stack([np.interp(angles, exact_angles, exact[:, i]) for i in (0, 1)], axis=-1)
    return Sheet(
        picture=figure,
        columns={
            "angle of incidence, degrees": angles,
            "x as rendered": seen[:, 0],
            "y as rendered": seen[:, 1],
            "x by Fresnel": at[:, 0],
            "y by Fresnel": at[:, 1],
        },
        checks=(
            Check("chromaticity at 5° from Fresnel's", float(np.abs(seen - at)[0].max()), "", at_most=0.001),
            Check("the same at any angle", float(np.abs(seen - at).max()), "", at_most=0.01),
            Check("x over the lamp's, at 5°", float(seen[0, 0] - white[0]), "", at_least=0.04),
            Check(
                "that at 84° over that at 5°",
                float((seen[-1, 0] - white[0]) / (seen[0, 0] - white[0])),
                "",
                at_most=0.6,
            ),
        ),
    )


PLATE = Plate(
    number="4.15",
    title="Glass and copper by Hall's model",
    shows="Hall's model (eq 4.21) for glass and copper: Fresnel's reflectance in highlights and reflections, its "
    "complement in what is transmitted, and attenuation along the way through glass.",
    claim="The highlight of copper has Fresnel's colour where the lamp stands behind the eye, turns to that of the "
    "lamp towards grazing, about half way at 84°, and is within 0.01 of Fresnel's in x and y at every angle.",
    today="The model takes Cook and Torrance's interpolation between normal and grazing incidence (eq III.20), as "
    "Hall did: the dots lie off the curve between 60° and 84°. `general` has the exact equations at every "
    "wavelength, with masking and in equilibrium.",
    draw=draw,
    commands=("illuminant render scenes/glass-and-copper.toml --size 480x270",),
)
