"""What a click reads: colour, light, material, and the spectrum as a chart."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.viewer.scale import amount

if TYPE_CHECKING:
    from illuminant.viewer.reading import Reading
    from illuminant.viewer.session import Session

__all__ = ["MeasurePanel"]


class MeasurePanel:
    """The folder of readings."""

    def __init__(self, session: Session) -> None:
        import numpy as np

        gui = session.client.gui
        with gui.add_folder("Measure"):
            self._told = gui.add_markdown("Click a point.")
            self._spectrum = gui.add_uplot(
                (np.array([380.0, 780.0]), np.zeros(2)),
                ({"label": "nm"}, {"label": "mW/(sr m² nm)", "stroke": "#56B4E9", "width": 2}),
                scales={"x": {"time": False}},
                axes=(
                    {"label": "wavelength, nm", "size": 32, "labelSize": 22},
                    {"label": "mW·sr⁻¹·m⁻²·nm⁻¹", "size": 60},
                ),
                title="spectral radiance",
                aspect=1.5,
                padding=(12, 12, 0, 0),
                visible=False,
            )

    def show(self, found: Reading) -> None:
        """Show a reading."""
        x, y = found.chromaticity
        what = f"**{found.thing}**, {found.material}" if found.thing else "surroundings"
        rows = [
            f"{what}, pixel {found.pixel[0]}, {found.pixel[1]}",
            f"luminance {amount(found.luminance)} cd/m²",
            "X Y Z " + "  ".join(amount(value) for value in found.xyz),
            f"x {x:.4f}, y {y:.4f}" if found.luminance > 0 else "black",
        ]
        if found.illuminance is not None:
            rows.append(f"illuminance {amount(found.illuminance)} lx")
        if found.delta_e is not None:
            rows.append(f"ΔE00 of what the display shows: {found.delta_e:.2f}")
        if len(found.wavelengths_nm) < 100:
            rows.append(f"spectrum at the {len(found.wavelengths_nm)} wavelengths of the solution")
        rows.append(f"by {found.by}")
        self._told.content = "\n\n".join(rows)
        self._spectrum.data = (found.wavelengths_nm, 1000.0 * found.radiance)
        self._spectrum.visible = True
