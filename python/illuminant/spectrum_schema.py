"""How the scene file writes a spectrum: by name, as a number, or as a table.

Example:
    >>> SpectrumTable.model_validate({"blackbody_k": 2700.0}).blackbody_k
    2700.0
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag

from illuminant.table import Positive, Rgb, Table, key

__all__ = ["SpectrumTable", "SpectrumValue", "spectrum_form"]


class SpectrumTable(Table):
    """A spectrum written in place.

    Exactly one of `library`, `file`, `constant`, `blackbody_k`, `daylight_k`, `wavelengths_nm` (with `values`) and
    `rgb` (with `role`) says where it comes from. Between its points it is linear.
    """

    library: str | None = key(
        "name of a spectrum in the library of the package", '"ColorChecker/dark skin"', None
    )
    file: str | None = key(
        "CSV or two-column file of wavelength in nm and value, beside the scene file",
        '"spectra/paint.csv"',
        None,
    )
    column: str | None = key("name of the column of `file`, where it has several", '"red"', None)
    constant: float | None = key("the same value at every wavelength", "0.18", None)
    blackbody_k: Positive | None = key(
        "temperature of a black body (Planck), in K; absolute radiance, for use with `radiance_scale`, or relative "
        "with any other quantity",
        "2700.0",
        None,
    )
    daylight_k: Annotated[float, Field(ge=4000, le=25000)] | None = key(
        "correlated colour temperature of a CIE daylight, 4000 to 25,000 K; relative", "6504.0", None
    )
    wavelengths_nm: list[float] | None = key("wavelengths, increasing, in nm", "[400.0, 550.0, 700.0]", None)
    values: list[float] | None = key("the value at each of `wavelengths_nm`", "[0.1, 0.4, 0.2]", None)
    rgb: Rgb | None = key(
        "three linear values (not gamma-encoded) of an RGB system, made a smooth spectrum by the sigmoid of Jakob "
        "and Hanika (2019); refused for n, k and absorption",
        "[0.6, 0.2, 0.1]",
        None,
    )
    role: Literal["albedo", "emission"] | None = key(
        "what `rgb` is: the albedo of a surface, or light under the white of its system", '"albedo"', None
    )
    system: str | None = key('RGB system of `rgb`; default "sRGB"', '"Rec.2020"', None)
    scale: float | None = key("factor on all values; default 1", "0.01", None)
    outside: Literal["zero", "hold", "error"] | None = key(
        "the rule beyond the first and last point: zero, hold the end value, or an error when the scene's "
        "wavelength range needs it; default what the data say of themselves, else zero for light and hold for others",
        '"hold"',
        None,
    )


def spectrum_form(value: Any) -> str | None:
    """Which form a value has, for the messages of pydantic."""
    if isinstance(value, str):
        return "<name>"
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return "<constant>"
    return "<table>" if isinstance(value, (dict, SpectrumTable)) else None


SpectrumValue = Annotated[
    Annotated[str, Tag("<name>")]
    | Annotated[float, Tag("<constant>")]
    | Annotated[SpectrumTable, Tag("<table>")],
    Discriminator(
        spectrum_form,
        custom_error_type="spectrum_form",
        custom_error_message="must be a spectrum: a name, a number, or a table such as { blackbody_k = 2700.0 }",
    ),
]
"""A name (of `[spectra]`, else of the library), a number (the same at every wavelength) or a `SpectrumTable`."""
