"""Surface finishes by name: how high and how steep a relief is, along the grain and across it.

The heights of the machined metals are those of the book's table 2.1 (microinches of a profilometer, with and across
the grain). The book gives no slopes; those here are ours, typical of the finish, as are all finishes that are not in
that table. A slope is m = 2σ/τ of the book's equation 2.19, √2 times the root mean square slope.

Example:
    >>> from illuminant.finishes import finish
    >>> finish("circular mill", "stainless").sigma_nm
    (635.0, 1016.0)
    >>> finish("gloss").is_smooth
    True
"""

from __future__ import annotations

from dataclasses import dataclass

from illuminant.errors import DataError, suggestion

__all__ = ["FINISHES", "MICROINCH_NM", "Finish", "finish"]

MICROINCH_NM = 25.4
"""Nanometres in a microinch."""


@dataclass(frozen=True)
class Finish:
    """A finish.

    Attributes:
        name: as it is called.
        slope: m along the grain and across it.
        sigma_nm: root mean square height along the grain and across it, in nm; None where it is far above a wavelength
            and nobody has measured it.
        source: where the heights come from.
    """

    name: str
    slope: tuple[float, float]
    sigma_nm: tuple[float, float] | None
    source: str = "typical"

    @property
    def is_smooth(self) -> bool:
        """Whether it is a mirror."""
        return max(self.slope) == 0.0

    @property
    def correlation_nm(self) -> tuple[float, float] | None:
        """The correlation distance τ = 2σ/m along the grain and across it, in nm (book eq 2.19)."""
        if self.sigma_nm is None or self.is_smooth:
            return None
        along, across = (2.0 * s / m for s, m in zip(self.sigma_nm, self.slope, strict=True))
        return along, across


BOOK = "book table 2.1"

MACHINED = {
    # name: (slopes along and across, microinches of stainless steel, of aluminium)
    "fine grind": ((0.03, 0.10), (3.0, 5.0), (3.0, 9.0)),
    "coarse grind": ((0.08, 0.25), (15.0, 28.0), (22.0, 55.0)),
    "circular mill": ((0.06, 0.15), (25.0, 40.0), (15.0, 40.0)),
    "side mill": ((0.08, 0.20), (30.0, 45.0), (30.0, 80.0)),
}

FINISHES: dict[str, Finish] = {
    one.name: one
    for one in (
        Finish("mirror", (0.0, 0.0), (0.0, 0.0)),
        Finish("polished", (0.02, 0.02), (5.0, 5.0)),
        Finish("gloss", (0.0, 0.0), (0.0, 0.0)),
        Finish("semi-gloss", (0.12, 0.12), None),
        Finish("satin", (0.25, 0.25), None),
        Finish("matte", (0.5, 0.5), None),
        Finish("brushed", (0.05, 0.25), None),
        Finish("etched", (0.2, 0.2), (300.0, 300.0)),
        Finish("ground", (0.4, 0.4), None),
        Finish("sandblasted", (0.5, 0.5), None),
    )
}
"""The finishes of any material; those of `MACHINED` are known for stainless steel and aluminium, and for other metals
as for stainless steel."""


def names() -> list[str]:
    """All finishes."""
    return [*FINISHES, *MACHINED]


def finish(name: str, material: str = "stainless") -> Finish:
    """A finish by name.

    Args:
        name: for example "circular mill"; upper and lower case are the same.
        material: of the machined finishes, "aluminium" has heights of its own; every other material those of stainless
            steel.

    Raises:
        DataError: no finish has that name.

    Example:
        >>> finish("Side Mill", "aluminium").sigma_nm
        (762.0, 2032.0)
    """
    known = " ".join(name.lower().split())
    if known in FINISHES:
        return FINISHES[known]
    if known not in MACHINED:
        hint = suggestion(known, names())
        raise DataError(
            f'"{name}" is no finish; known are {", ".join(names())}' + (f" ({hint})" if hint else "")
        )
    slope, steel, aluminium = MACHINED[known]
    heights = aluminium if material.lower() in ("aluminium", "aluminum") else steel
    along, across = (round(height * MICROINCH_NM, 6) for height in heights)
    return Finish(known, slope, (along, across), BOOK)
