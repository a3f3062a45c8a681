"""Figure 3.6: a chromaticity diagram is the projection of three amounts onto the plane L + M + H = 1 (section 3.2)."""

from __future__ import annotations

from illuminant.atlas.chapter_3.control_lights import LIGHTS_NM
from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """The curve of amounts in space, the rays through it, and where they meet the plane."""
    import numpy as np

    from illuminant import plots
    from illuminant.plots import observer as observers
    from illuminant.plots.projection_space import on_plane

    nm = np.arange(400.0, 701.0)
    amounts = observers.for_primaries(observers.named(), LIGHTS_NM).at(nm)
    flat = on_plane(amounts)
    inside = (flat >= 0).all(axis=1) & ~np.isin(nm, LIGHTS_NM)
    aside = np.linalg.norm(np.cross(amounts, flat), axis=1) / np.linalg.norm(amounts, axis=1)
    return Sheet(
        picture=plots.projection(LIGHTS_NM, size=(7.5, 5.5)),
        columns={
            "wavelength, nm": nm,
            **dict(zip("LMH", amounts.T, strict=True)),
            **{f"{name} on the plane": column for name, column in zip("LMH", flat.T, strict=True)},
        },
        checks=(
            Check(
                "spectral lights inside the triangle of the three", float(inside.sum()), at_least=0, at_most=0
            ),
            Check("farthest that a projected point lies from its ray", float(aside.max()), at_most=1e-12),
            Check("smallest H on the plane", float(flat[:, 2].min()), at_least=-0.65, at_most=-0.6),
        ),
    )


PLATE = Plate(
    number="3.6",
    title="Projection onto the plane of chromaticity",
    shows="Space with one axis for each control light, L (445 nm), M (535 nm) and H (630 nm). The amounts that match "
    "unit power at each wavelength make a curve; the ray from the origin through each of its points meets the plane "
    "$L + M + H = 1$ at $(L, M, H) / (L + M + H)$. Between the axes the plane is a triangle.",
    claim="Projected along rays onto the plane, all spectral colours lie outside of the triangle of the three lights, "
    "which holds all colours that these can make.",
    today="Diagrams are still made so; xy and u'v' are other planes of the same space. What is dropped, the length of "
    "the ray, is kept today as Y or L*.",
    draw=draw,
    commands=("illuminant spectra plot --chromaticity 445,535,630 --projection -o projection.png",),
)
