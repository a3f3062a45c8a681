"""A chromaticity diagram as numbers: its projection, the spectral locus, the Planckian locus, gamuts, points.

Each diagram is one central projection of tristimulus values onto a plane,

    (a, b, s) = H (X, Y, Z),    point = (a / s, b / s)

with the rows of H
    xy (CIE 1931)            (1, 0, 0)   (0, 1, 0)   (1, 1, 1)
    u'v' (CIE 1976)          (4, 0, 0)   (0, 9, 0)   (1, 15, 3)       book eq 3.5
    three primaries          the amounts H and M, and the sum L + M + H, of `observer.for_primaries`
                             (book 3.2, figures 3.6 and 3.7: seen along -L)

H has an inverse, so a point of the plane gives back a colour up to its size: the ground of a diagram is coloured by it.

Example:
    >>> xy = diagram("xy")
    >>> xy.project([0.95047, 1.0, 1.08883]).round(4).tolist()
    [0.3127, 0.329]
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant import rgb_system
from illuminant.core import core
from illuminant.errors import UsageError
from illuminant.plots import observer as observers
from illuminant.plots.observer import INTEGRATION_NM, Functions

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.spectra import Spectrum

__all__ = ["Diagram", "diagram"]

_PLANES = {
    "xy": (((1, 0, 0), (0, 1, 0), (1, 1, 1)), ("x", "y"), "xy chromaticity"),
    "uv": (((4, 0, 0), (0, 9, 0), (1, 15, 3)), ("u'", "v'"), "u'v' chromaticity (CIE 1976)"),
}


@dataclass(frozen=True)
class Diagram:
    """A plane of chromaticities for one observer.

    Attributes:
        title: what it is, for a heading.
        axes: what the horizontal and the vertical axis show.
        observer: x̄, ȳ and z̄.
        matrix: (3, 3), the H of this module.
        primaries_nm: the wavelengths of its primaries; empty for xy and u'v'.
    """

    title: str
    axes: tuple[str, str]
    observer: Functions
    matrix: NDArray[np.float64]
    primaries_nm: tuple[float, ...] = ()

    def project(self, xyz: ArrayLike) -> NDArray[np.float64]:
        """Points (..., 2) of tristimulus values (..., 3); nan for black."""
        import numpy as np

        mapped = np.asarray(xyz, dtype=np.float64) @ self.matrix.T
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.asarray(mapped[..., :2] / mapped[..., 2:])

    def colour(self, points: ArrayLike) -> NDArray[np.float64]:
        """Tristimulus values (..., 3) of points (..., 2), up to a factor: those with s = 1.

        Example:
            >>> plane = diagram("uv")
            >>> plane.project(plane.colour([0.2, 0.5])).round(12).tolist()
            [0.2, 0.5]
        """
        import numpy as np

        p = np.asarray(points, dtype=np.float64)
        flat = np.concatenate([p, np.ones((*p.shape[:-1], 1))], axis=-1)
        return np.asarray(flat @ np.linalg.inv(self.matrix).T)

    def spectral_locus(self, first_nm: float = 390, last_nm: float = 700) -> tuple[NDArray[np.float64], ...]:
        """Wavelengths (n,) by 1 nm and the points (n, 2) of light of one wavelength.

        Beyond 390 and 700 nm the points hardly move, while the tables are rounded there.

        Example:
            >>> wavelengths, points = diagram("xy").spectral_locus()
            >>> points[wavelengths == 520].round(3).tolist()
            [[0.074, 0.834]]
        """
        import numpy as np

        wavelengths = np.arange(first_nm, last_nm + 0.5)
        return wavelengths, self.project(self.observer.at(wavelengths))

    def planckian_locus(self, temperatures_k: ArrayLike) -> NDArray[np.float64]:
        """Points (n, 2) of blackbodies of temperatures (n,), K (Planck 1900).

        Example:
            >>> diagram("xy").planckian_locus([2856]).round(3).tolist()
            [[0.448, 0.407]]
        """
        import numpy as np

        grid = np.arange(INTEGRATION_NM[0], INTEGRATION_NM[1] + 1.0)
        temperatures = np.asarray(temperatures_k, dtype=np.float64)
        light = np.stack([core().planck(grid, float(t)) for t in temperatures])
        return self.project(light @ self.observer.at(grid))

    def gamut(self, system: str) -> tuple[str, NDArray[np.float64], NDArray[np.float64]]:
        """An RGB system: its name, the points (3, 2) of red, green and blue, and the point (2,) of its white.

        Raises:
            UsageError: there is none of that name; says which there are.

        Example:
            >>> diagram("xy").gamut("srgb")[1].round(4).tolist()
            [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]]
        """
        import numpy as np

        found = rgb_system.named(system)
        to_xyz = np.asarray(found["to_xyz"], dtype=np.float64)
        return str(found["name"]), self.project(to_xyz.T), self.project(to_xyz.sum(axis=1))

    def point(self, spectrum: Spectrum, light: Spectrum | None = None) -> NDArray[np.float64]:
        """The point (2,) of a lamp, or of a reflectance under a light.

        Raises:
            UsageError: the spectrum is neither, no light is given for a reflectance, or nothing of it is visible.
        """
        import numpy as np

        if spectrum.quantity == "emission":
            xyz = self.observer.sample(spectrum)
        elif spectrum.quantity == "reflectance" and light is not None:
            xyz = self.observer.sample(spectrum, light)
        else:
            kind = f"holds {spectrum.quantity}" if spectrum.quantity else "does not say what it holds"
            raise UsageError(
                f"{spectrum.name} {kind}: expected an emission or a reflectance for a point in a diagram."
            )
        found = self.project(xyz)
        if not np.all(np.isfinite(found)):
            raise UsageError(
                f"{spectrum.name} has no light from {INTEGRATION_NM[0]} to {INTEGRATION_NM[1]} nm."
            )
        return found


def diagram(kind: str | Sequence[float] = "xy", observer: str | Functions = "1931") -> Diagram:
    """A diagram by name, or for three monochromatic primaries.

    Args:
        kind: "xy", "uv" (u'v' of 1976), or three wavelengths in nm, also written "445,535,630".
        observer: a name, see `observer.named`, or its functions.

    Raises:
        UsageError: no such diagram, no such observer, or unusable primaries.

    Example:
        >>> lights = diagram("445,535,630")
        >>> lights.project(lights.observer.at([445, 535, 630])).round(9).tolist()
        [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]]
    """
    import numpy as np

    eye = observers.named(observer) if isinstance(observer, str) else observer
    if isinstance(kind, str):
        if kind.casefold() in _PLANES:
            rows, axes, title = _PLANES[kind.casefold()]
            return Diagram(title, axes, eye, np.array(rows, dtype=np.float64))
        if not re.fullmatch(r"[\d.]+(,[\d.]+){2}", kind):
            raise UsageError(
                f"There is no diagram {kind!r}: expected xy, uv, or three wavelengths in nm such as 445,535,630."
            )
        try:
            kind = [float(text) for text in kind.split(",")]
        except ValueError:
            raise UsageError(f"{kind}: expected three wavelengths in nm such as 445,535,630.") from None
    amounts = np.linalg.inv(observers.primaries_matrix(eye, kind))
    short, middle, long = sorted(float(w) for w in kind)
    return Diagram(
        f"Chromaticity for lights at {short:g}, {middle:g} and {long:g} nm",
        (f"H = share of {long:g} nm", f"M = share of {middle:g} nm"),
        eye,
        np.stack([amounts[2], amounts[1], amounts.sum(axis=0)]),
        (short, middle, long),
    )
