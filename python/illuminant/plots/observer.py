"""An observer as numbers: its matching functions, in CIE XYZ, in another space, or for three primaries.

The amounts of three primaries that match light of one wavelength are linear in its tristimulus values. With the
XYZ of the primaries as the columns of P,

    (l̄, m̄, h̄)(λ) = P⁻¹ (x̄, ȳ, z̄)(λ)                          (book 3.2 and eq 3.1; Grassmann 1853)

so each function is 1 at its own primary and 0 at the two others, and negative where a primary has to be added to
the side of the test light. A space that is a matrix on XYZ gives functions in the same way: AC1C2 of Meyer (1988; book
eq 3.6) or an RGB system, whose functions sample a spectrum directly into its RGB (book 3.3).

All tables are taken by 1 nm, with straight lines between the entries of a coarser one.

Example:
    >>> lmh = for_primaries(named("1931"), (445, 535, 630))
    >>> lmh.at([445, 500]).round(3).tolist()
    [[1.0, 0.0, 0.0], [0.146, 0.411, -0.216]]
"""

from __future__ import annotations

import functools
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant import color, colorimetry, rgb_system
from illuminant.core import core
from illuminant.errors import UsageError, suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from illuminant.spectra import Spectrum

__all__ = ["INTEGRATION_NM", "Functions", "for_primaries", "in_space", "named", "names"]

INTEGRATION_NM = (360, 830)
"""First and last wavelength of the sums for tristimulus values, by 1 nm: all of the CIE's tables (CIE 15:2018)."""


@dataclass(frozen=True)
class Functions:
    """Three functions of wavelength that sample a spectrum into three numbers.

    Attributes:
        title: what they are, for a heading.
        labels: what each is called.
        wavelengths_nm: (n,), increasing.
        values: (n, 3).
    """

    title: str
    labels: tuple[str, str, str]
    wavelengths_nm: NDArray[np.float64]
    values: NDArray[np.float64]

    def at(self, wavelengths_nm: ArrayLike) -> NDArray[np.float64]:
        """The three functions at wavelengths (nm, any shape), linear between entries and zero outside the table.

        Returns:
            Array of the shape of `wavelengths_nm`, and a last axis of 3.
        """
        import numpy as np

        wanted = np.asarray(wavelengths_nm, dtype=np.float64)
        columns = [np.interp(wanted, self.wavelengths_nm, column, 0, 0) for column in self.values.T]
        return np.stack(columns, axis=-1)

    def sample(self, *curves: Spectrum) -> NDArray[np.float64]:
        """Σ f(λ) Δλ times the product of the curves, by 1 nm over `INTEGRATION_NM`: (3,).

        For the matching functions of an observer these are tristimulus values without the factor of 683 lm/W.

        Example:
            >>> from illuminant.spectra import load
            >>> xyz = named("1931").sample(load("D65"))
            >>> (xyz / xyz.sum()).round(4).tolist()
            [0.3127, 0.329, 0.3583]
        """
        import numpy as np

        grid = np.arange(INTEGRATION_NM[0], INTEGRATION_NM[1] + 1.0)
        product = np.ones_like(grid)
        for curve in curves:
            product = product * curve.at(grid)
        return np.asarray(product @ self.at(grid))

    def transformed(self, matrix: ArrayLike, title: str, labels: tuple[str, str, str]) -> Functions:
        """The functions of another space, whose coordinates are `matrix` (3, 3) times these."""
        import numpy as np

        values = self.values @ np.asarray(matrix, dtype=np.float64).T
        return Functions(title, labels, self.wavelengths_nm, values)


def names() -> list[str]:
    """Short names of the observers of `illuminant.colorimetry`, which are easy to type.

    Example:
        >>> names()
        ['1931', '1964', 'book', 'book-as-printed']
    """
    return [_short(name) for name in colorimetry.observers()]


def _short(name: str) -> str:
    """`1931` of `CIE 1931 2°`."""
    return re.sub(r"^CIE (\d+) .*", r"\1", name).replace(" ", "-")


@functools.cache
def named(name: str = "1931") -> Functions:
    """The matching functions of an observer.

    Args:
        name: short, as `names` lists it, or whole, as `illuminant.colorimetry.observers` does; case does not matter.

    Raises:
        UsageError: there is none of that name; says which there are.

    Example:
        >>> named("1931").title, named("CIE 1964 10°").title
        ('CIE 1931 2° observer', 'CIE 1964 10° observer')
        >>> named("1932")
        Traceback (most recent call last):
        illuminant.errors.UsageError: There is no observer '1932' (did you mean "1931"?): known are 1931, 1964, ...
    """
    import numpy as np

    wanted = name.strip().casefold()
    known = {key.casefold(): whole for whole in colorimetry.observers() for key in (_short(whole), whole)}
    if wanted not in known:
        hint = suggestion(name, names())
        known_names = ", ".join(names())
        raise UsageError(
            f"There is no observer {name!r}{f' ({hint})' if hint else ''}: known are {known_names}."
        )
    curves = colorimetry.matching_functions(known[wanted])
    values = np.stack([curve.values for curve in curves], axis=-1)
    return Functions(f"{known[wanted]} observer", ("x̄", "ȳ", "z̄"), np.array(curves[0].wavelengths_nm), values)


def in_space(observer: Functions, space: str) -> Functions:
    """The matching functions of an observer in another space.

    Args:
        observer: x̄, ȳ and z̄.
        space: "xyz", "ac1c2", or the name of an RGB system, whose functions sample a spectrum into its linear RGB.

    Raises:
        UsageError: there is no such space; says which there are.

    Example:
        >>> achromatic = in_space(named(), "ac1c2")
        >>> achromatic.at(555).round(4).tolist()
        [1.0, 0.2969, -0.1018]
    """
    folded = space.strip().casefold()
    if folded == "xyz":
        return observer
    if folded == "ac1c2":
        # The columns of a matrix are what it makes of unit vectors.
        matrix = color.xyz_to_ac1c2([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]).T
        return observer.transformed(matrix, f"AC1C2 of Meyer, {observer.title}", ("A", "C1", "C2"))
    known = {str(name).casefold(): name for name in core().rgb_systems()}
    if folded not in known:
        hint = suggestion(space, ["xyz", "ac1c2", *known.values()])
        raise UsageError(
            f"There is no space {space!r}{f' ({hint})' if hint else ''}: expected xyz, ac1c2 or an RGB system "
            f"({', '.join(known.values())})."
        )
    system = rgb_system.named(folded)
    return observer.transformed(system["from_xyz"], f"{system['name']}, {observer.title}", ("r̄", "ḡ", "b̄"))


def primaries_matrix(observer: Functions, primaries_nm: Sequence[float]) -> NDArray[np.float64]:
    """XYZ of unit power at three wavelengths as the columns of a matrix, shortest wavelength first.

    Raises:
        UsageError: not three different wavelengths that the observer sees, or one can be matched by the two others.
    """
    import numpy as np

    wanted = sorted(float(w) for w in primaries_nm)
    first, last = observer.wavelengths_nm[0], observer.wavelengths_nm[-1]
    if len(wanted) != 3 or len(set(wanted)) != 3 or not all(first <= w <= last for w in wanted):
        text = ",".join(f"{w:g}" for w in primaries_nm)
        raise UsageError(
            f"Primaries at {text} nm: expected three different wavelengths from {first:g} to {last:g} nm, such as "
            "445,535,630."
        )
    matrix = observer.at(wanted).T
    # Columns brought to one size: two lights of the far red differ in power only, and match one another.
    if np.linalg.cond(matrix / np.linalg.norm(matrix, axis=0)) > 1e5:
        text = ",".join(f"{w:g}" for w in wanted)
        raise UsageError(
            f"Primaries at {text} nm: one can be matched by the two others, so they span no space."
        )
    return matrix


def for_primaries(observer: Functions, primaries_nm: Sequence[float]) -> Functions:
    """How much of three monochromatic lights matches unit power at each wavelength (book figure 3.5).

    Args:
        observer: x̄, ȳ and z̄.
        primaries_nm: three wavelengths, nm, in any order.

    Returns:
        Functions L, M and H for the short, the middle and the long (high) wavelength, in units of power per power.

    Raises:
        UsageError: see `primaries_matrix`.

    Example:
        >>> for_primaries(named(), (630, 445, 535)).labels
        ('L 445 nm', 'M 535 nm', 'H 630 nm')
        >>> for_primaries(named(), (445, 535, 900))
        Traceback (most recent call last):
        illuminant.errors.UsageError: Primaries at 445,535,900 nm: expected three different wavelengths from 360 ...
    """
    import numpy as np

    matrix = primaries_matrix(observer, primaries_nm)
    short, middle, long = (f"{w:g} nm" for w in sorted(primaries_nm))
    title = f"Lights at {short[:-3]}, {middle[:-3]} and {long}, {observer.title}"
    return observer.transformed(np.linalg.inv(matrix), title, (f"L {short}", f"M {middle}", f"H {long}"))
