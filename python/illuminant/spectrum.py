"""A curve on wavelength: samples in nm, straight lines between them, and a stated rule outside their range.

Rules that hold everywhere:
    - outside its range the spectrum of a lamp is zero, and a reflectance, n or k holds its end value;
    - wavelengths increase, at least two of them, all numbers finite; they may lie anywhere, in the ultraviolet
      and infrared too;
    - light and reflectance are never negative, and a reflectance is at most 1. n and k may have any sign
      (a medium with gain has k below 0): what a material accepts is decided where it is used;
    - nothing is clamped, sorted or resampled by itself.

Sources: Hall 1989, III.7.2 (sum, product, scale, area of curves), III.8 (pseudocolour); the numbers are computed in
`crates/spectrum`.

Example:
    >>> from illuminant.spectrum import Spectrum
    >>> Spectrum("grey", [380, 780], [0.5, 0.5]).area()
    200.5
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from illuminant.core import core
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Given = tuple[tuple[float, ...], tuple[float, ...], str]

__all__ = [
    "EXTRAPOLATIONS",
    "INTERPOLATIONS",
    "OBSERVER",
    "OUTSIDE",
    "QUANTITIES",
    "RANGE_NM",
    "Extrapolation",
    "Interpolation",
    "Outside",
    "Quantity",
    "Spectrum",
    "floats",
    "mistake_in",
    "one_of",
    "whole_range",
]

Outside = Literal["zero", "hold", "error"]
Quantity = Literal["", "emission", "reflectance", "n", "k"]
Interpolation = Literal["linear", "pchip", "cubic", "sprague"]
Extrapolation = Literal["zero", "hold", "linear", "error"]

QUANTITIES = ("", "emission", "reflectance", "n", "k")
OUTSIDE = ("zero", "hold", "error")
INTERPOLATIONS = ("linear", "pchip", "cubic", "sprague")
EXTRAPOLATIONS = ("zero", "hold", "linear", "error")
OBSERVER = "CIE 1931 2°"
"""The observer where none is named."""
RANGE_NM = (380, 780)
"""The wavelengths over which XYZ is summed where no range is given, both ends included."""


@dataclass(frozen=True, slots=True)
class Spectrum:
    """A curve on wavelength, linear between its samples.

    Args:
        name: what messages call it.
        wavelengths_nm: at least two, increasing, above zero; any sequence or array of numbers.
        values: as many; in `unit`.
        outside: value outside the range: "zero", "hold" (that of the nearest end) or "error".
        unit: "1" (reflectance, n, k), "relative" (power known but for a factor), or a unit such as
            "W sr-1 m-2 nm-1" (absolute).
        provenance: where it comes from, in one line.
        quantity: "emission", "reflectance", "n", "k", or "" when unknown.

    Operators:
        `a + b`, `a - b`, `a * b`, `2 * a`, `a / 2`. A sum is exact at every wavelength, a product at the points of
        both and at every whole nm; outside, the two rules decide (a product with a lamp is zero beyond the lamp).
        Light times a reflectance is light; two reflectances make a reflectance. Spectra that are added have one unit.

    Raises:
        DataError: the samples break a rule of this module; the message names the wavelength.

    Example:
        >>> ramp = Spectrum("ramp", [400, 700], [0.0, 0.6], "hold")
        >>> ramp.at([390, 500, 710]).round(9).tolist()
        [0.0, 0.2, 0.6]
        >>> (0.5 * ramp + 0.5 * ramp).values
        (0.0, 0.6)
        >>> (ramp * ramp).at([550]).round(9).tolist()
        [0.09]
    """

    name: str
    wavelengths_nm: tuple[float, ...]
    values: tuple[float, ...]
    outside: Outside = "hold"
    unit: str = "1"
    provenance: str = ""
    quantity: Quantity = ""

    # NumPy's numbers leave `*` to this class and do not try to make an array of it.
    __array_ufunc__: ClassVar[None] = None

    def __post_init__(self) -> None:
        """Turn the samples into tuples of float and check them."""
        subject = f"spectrum {self.name!r}: " if self.name else "spectrum: "
        for key in ("wavelengths_nm", "values"):
            object.__setattr__(self, key, floats(getattr(self, key), subject + key))
        if len(self.wavelengths_nm) != len(self.values):
            counts = f"{len(self.wavelengths_nm)} wavelengths and {len(self.values)} values"
            raise DataError(f"{subject}{counts}; expected as many of one as of the other")
        if self.outside not in OUTSIDE:
            raise DataError(f"{subject}outside is {self.outside!r}; expected {one_of(OUTSIDE)}")
        if self.quantity not in QUANTITIES:
            raise DataError(f"{subject}quantity is {self.quantity!r}; expected {one_of(QUANTITIES[1:])}")
        mistake = mistake_in(self.wavelengths_nm, self.values, self.quantity)
        if mistake:
            raise DataError(subject + mistake[1])

    @property
    def range_nm(self) -> tuple[float, float]:
        """First and last wavelength, nm."""
        return self.wavelengths_nm[0], self.wavelengths_nm[-1]

    def at(self, wavelengths_nm: ArrayLike) -> NDArray[np.float64]:
        """The curve at any wavelengths.

        Args:
            wavelengths_nm: array of any shape, nm.

        Returns:
            Array of that shape, in `unit`.

        Raises:
            DataError: a wavelength is outside the range and `outside` is "error".

        Example:
            >>> Spectrum("lamp", [400, 700], [1.0, 4.0], "zero").at([500, 900]).tolist()
            [2.0, 0.0]
        """
        import numpy as np

        wanted = np.asarray(wavelengths_nm, dtype=np.float64)
        first, last = self.range_nm
        if self.outside == "error" and not np.all((wanted >= first) & (wanted <= last)):
            raise DataError(f"spectrum {self.name!r} is known from {first:g} to {last:g} nm only")
        end = 0.0 if self.outside == "zero" else None
        return np.asarray(np.interp(wanted, self.wavelengths_nm, self.values, left=end, right=end))

    # --- arithmetic -----------------------------------------------------------------------------------------

    def __add__(self, other: Spectrum) -> Spectrum:
        """The sum with a spectrum of the same unit."""
        return self._with(other, "curve_sum", "+")

    def __sub__(self, other: Spectrum) -> Spectrum:
        """The difference; refused where it is negative, unless both are n or both k."""
        return self._with(other, "curve_difference", "-")

    def __mul__(self, other: Spectrum | float) -> Spectrum:
        """The product with a spectrum or a number."""
        if isinstance(other, Spectrum):
            return self._times(other)
        factor = _factor(other)
        return NotImplemented if factor is None else self._scaled(factor, f"{factor:g} × {self.name}")

    def __rmul__(self, other: float) -> Spectrum:
        """The product with a number."""
        return self.__mul__(other)

    def __truediv__(self, other: float) -> Spectrum:
        """The spectrum divided by a number."""
        divisor = _factor(other)
        if divisor is None:
            return NotImplemented
        if divisor == 0.0:
            raise UsageError(f"Spectrum {self.name!r} cannot be divided by zero.")
        return self._scaled(1.0 / divisor, f"{self.name} / {divisor:g}")

    def area(self, range_nm: Sequence[int] | None = None) -> float:
        """The area under the curve, as the sum of its values at every whole nm (Hall 1989, III.7.2).

        Args:
            range_nm: first and last whole nm, both counted; None: those within the spectrum's own range.

        Returns:
            In `unit` × nm.

        Example:
            >>> Spectrum("line", [499, 500, 501], [0.0, 2.0, 0.0], "zero").area()
            2.0
        """
        if range_nm is None:
            first, last = math.ceil(self.range_nm[0]), math.floor(self.range_nm[1])
            if first >= last:
                raise UsageError(f"Spectrum {self.name!r} covers no two whole nm; give a range_nm.")
            range_nm = (first, last)
        return float(_asked(core().curve_area, self.given(range_nm), whole_range(range_nm)))

    def normalised(self, wavelength_nm: float = 560.0, value: float = 1.0) -> Spectrum:
        """The spectrum times the factor that makes it `value` at a wavelength; the book's lamps are 1 at 560 nm.

        Args:
            wavelength_nm: where, nm.
            value: what it becomes there, in no unit: the result is relative.

        Raises:
            DataError: the spectrum is zero there.

        Example:
            >>> Spectrum("lamp", [400, 700], [1.0, 4.0], "zero", "W").normalised(500).at([500, 600]).tolist()
            [1.0, 1.5]
        """
        quantity: Quantity = "emission" if self.quantity == "emission" else ""
        unit = "relative" if quantity else "1"
        given = self.given((wavelength_nm, wavelength_nm))
        made = _asked(core().curve_normalised, given, float(wavelength_nm), float(value))
        return self._made(made, self.name, unit, quantity, self.outside)

    def between(self, first_nm: float, last_nm: float) -> Spectrum:
        """The part from one wavelength to another; the rule outside stays.

        A spectrum that is zero outside stays within its own range, one that holds its ends has points at both.

        Example:
            >>> Spectrum("ramp", [400, 700], [0.0, 0.6]).between(500, 800).wavelengths_nm
            (500.0, 700.0, 800.0)
        """
        made = _asked(core().curve_between, self.given((first_nm, last_nm)), float(first_nm), float(last_nm))
        return self._made(made, self.name, self.unit, self.quantity, self.outside)

    def resampled(
        self,
        wavelengths_nm: ArrayLike,
        interpolation: Interpolation = "linear",
        extrapolation: Extrapolation | None = None,
    ) -> Spectrum:
        """The spectrum through its values at other wavelengths.

        "linear" and "pchip" (Fritsch and Butland 1984) stay between neighbouring points; "cubic" (natural spline)
        and "sprague" (CIE 167:2005; equal steps, six points) do not. Where one of them, or "linear"
        extrapolation, would make a spectrum negative that has no negative point, it is refused and not clamped.

        Args:
            wavelengths_nm: the new wavelengths, increasing, for instance `range(380, 781)`.
            interpolation: "linear", "pchip", "cubic" or "sprague".
            extrapolation: "zero", "hold", "linear" or "error"; None: as `outside` says.

        Returns:
            Samples at `wavelengths_nm`, with straight lines between and the same rule outside.

        Raises:
            DataError: beyond the range with "error"; a value would be negative; Sprague on unequal steps.

        Example:
            >>> peak = Spectrum("peak", [400, 500, 600], [0.0, 1.0, 0.0])
            >>> peak.resampled([400, 450, 500]).values, peak.resampled([400, 450, 500], "pchip").values
            ((0.0, 0.5, 1.0), (0.0, 0.75, 1.0))
        """
        for said, known in ((interpolation, INTERPOLATIONS), (extrapolation, (None, *EXTRAPOLATIONS))):
            if said not in known:
                raise UsageError(f"There is no {said!r}: expected {one_of(word for word in known if word)}.")
        wanted = list(floats(wavelengths_nm, "wavelengths_nm"))
        beyond = extrapolation or self.outside
        made = _asked(core().curve_resampled, self.given(), wanted, interpolation, beyond)
        return self._made(made, self.name, self.unit, self.quantity, self.outside)

    def pseudo_color(
        self, band_nm: Sequence[float], visible_nm: Sequence[float] = (380.0, 780.0)
    ) -> Spectrum:
        """The spectrum with a band that nobody sees shown at visible wavelengths (Hall 1989, III.8).

        The wavelength axis is shifted and stretched, λ' = v₀ + (λ − b₀)(v₁ − v₀)/(b₁ − b₀); values stay as they
        are. Shown in this way, the lamps and surfaces of a scene make the picture that an eye would see whose
        sensitivity lay in the band.

        Args:
            band_nm: first and last wavelength of the band, nm.
            visible_nm: where it is shown, nm.

        Example:
            >>> leaf = Spectrum("leaf", [780, 1100], [0.4, 0.5], quantity="reflectance")
            >>> leaf.pseudo_color([780, 1100]).range_nm
            (380.0, 780.0)
        """
        band, visible = (list(floats(pair, "band")) for pair in (band_nm, visible_nm))
        if len(band) != 2 or len(visible) != 2:
            raise UsageError("A band is two wavelengths, the first and the last.")
        made = _asked(core().curve_pseudo_color, self.given(), band, visible)
        return self._made(made, self.name, self.unit, self.quantity, self.outside)

    def xyz(
        self,
        lamp: Spectrum | None = None,
        observer: str = OBSERVER,
        range_nm: Sequence[int] = RANGE_NM,
    ) -> NDArray[np.float64]:
        """Tristimulus values, summed at 1 nm.

        Args:
            lamp: for a reflectance or transmittance, what lights it. None for light: the sums times 683 lm/W, so that
                a radiance in W·sr⁻¹·m⁻²·nm⁻¹ gives cd/m².
            observer: see `illuminant.colorimetry.observers`.
            range_nm: first and last nm.

        Returns:
            X, Y and Z; with a lamp, Y = 1 for a perfect diffuser.

        Raises:
            UsageError: a reflectance without a lamp.
            DataError: the lamp gives no light that this observer sees.

        Example:
            >>> lamp = Spectrum("E", [360, 830], [1.0, 1.0], "zero", quantity="emission")
            >>> Spectrum("grey", [380, 780], [0.5, 0.5]).xyz(lamp).round(4).tolist()
            [0.5, 0.5, 0.5]
        """
        span = whole_range(range_nm)
        if lamp is None:
            if self.quantity == "reflectance":
                raise UsageError(f"A reflectance has a colour under a lamp only: give {self.name!r} a lamp.")
            found: NDArray[np.float64] = _asked(core().xyz, *self.given(span), span, observer)
            return found
        seen = _asked(core().curve_product, self.given(span), lamp.given(span))
        white = _asked(core().xyz, *lamp.given(span), span, observer)[1]
        if not white > 0.0:
            raise DataError(f"spectrum {lamp.name!r} gives no light from {span[0]} to {span[1]} nm")
        product: NDArray[np.float64] = _asked(core().xyz, *seen, span, observer) / white
        return product

    def given(self, needed_nm: Sequence[float] | None = None) -> Given:
        """Points and rule as the core takes them.

        Args:
            needed_nm: first and last wavelength that are asked for; None for no more than there are.

        Raises:
            DataError: the spectrum is an error outside its range, and more is needed.

        Example:
            >>> Spectrum("ramp", [400, 700], [0.0, 0.6]).given()
            ((400.0, 700.0), (0.0, 0.6), 'hold')
        """
        if self.outside != "error":
            return self.wavelengths_nm, self.values, self.outside
        first, last = self.range_nm
        if needed_nm is not None and not first <= needed_nm[0] <= needed_nm[1] <= last:
            raise DataError(
                f"spectrum {self.name!r} is known from {first:g} to {last:g} nm only, and {needed_nm[0]:g} to "
                f"{needed_nm[1]:g} nm are needed"
            )
        return self.wavelengths_nm, self.values, "hold"

    def _made(
        self, made: Any, name: str, unit: str, quantity: Quantity, outside: Outside | None = None
    ) -> Spectrum:
        """A result of the core as a spectrum."""
        wavelengths, values, rule = made
        return Spectrum(
            name,
            tuple(wavelengths.tolist()),
            tuple(values.tolist()),
            outside or rule,
            unit,
            self.provenance,
            quantity,
        )

    def _scaled(self, factor: float, name: str) -> Spectrum:
        return replace(self, name=name, values=tuple(factor * value for value in self.values))

    def _with(self, other: Spectrum, operation: str, sign: str) -> Spectrum:
        if not isinstance(other, Spectrum):
            return NotImplemented
        if self.unit != other.unit:
            units = f"{self.name!r} in {self.unit!r} and {other.name!r} in {other.unit!r}"
            raise UsageError(f"Spectra of one unit only can be added: {units}.")
        quantity: Quantity = self.quantity if self.quantity == other.quantity else ""
        return self._combined(other, operation, f"{self.name} {sign} {other.name}", self.unit, quantity)

    def _times(self, other: Spectrum) -> Spectrum:
        quantities = {self.quantity, other.quantity}
        quantity: Quantity = ""
        if quantities in ({"emission", "reflectance"}, {"emission", ""}):
            quantity = "emission"
        elif quantities == {"reflectance"}:
            quantity = "reflectance"
        units = [unit for unit in (self.unit, other.unit) if unit not in ("", "1")]
        unit = "relative" if "relative" in units else " ".join(units) or "1"
        return self._combined(other, "curve_product", f"{self.name} × {other.name}", unit, quantity)

    def _combined(
        self, other: Spectrum, operation: str, name: str, unit: str, quantity: Quantity
    ) -> Spectrum:
        known = [spectrum.range_nm for spectrum in (self, other) if spectrum.outside == "error"]
        made = _asked(getattr(core(), operation), self.given(), other.given())
        origins = "; ".join(dict.fromkeys(filter(None, (self.provenance, other.provenance))))
        result = replace(self._made(made, name, unit, quantity), provenance=origins)
        if not known:
            return result
        # Nothing is said beyond what is known of both.
        first, last = max(low for low, _ in known), min(high for _, high in known)
        return replace(result.between(first, last), outside="error")


def _factor(value: object) -> float | None:
    """A number to multiply with, or None for what is no number."""
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return float(value)
    # NumPy's numbers, without importing it.
    return float(value) if hasattr(value, "__float__") and getattr(value, "shape", None) == () else None


def _asked(function: Callable[..., Any], *arguments: object) -> Any:
    """The answer of the core, whose mistakes are the data's."""
    try:
        return function(*arguments)
    except ValueError as error:
        raise DataError(str(error)) from None


def whole_range(range_nm: Sequence[int]) -> list[int]:
    """First and last whole nm of a range, checked.

    Example:
        >>> whole_range((380, 780))
        [380, 780]
    """
    pair = list(range_nm)
    fine = len(pair) == 2 and all(float(nm).is_integer() and 1 <= nm <= 1e6 for nm in pair)
    if not fine or not pair[0] < pair[1]:
        raise UsageError(f"A range runs from one whole nm to a larger one, not {range_nm!r}.")
    return [int(nm) for nm in pair]


def floats(values: Any, subject: str) -> tuple[float, ...]:
    """Any one-dimensional sequence of numbers as a tuple of float."""
    if type(values) is tuple and set(map(type, values)) == {float}:
        return values
    tolist = getattr(values, "tolist", None)
    try:
        return tuple(float(value) for value in (tolist() if tolist else values))
    except (TypeError, ValueError):
        raise DataError(f"{subject} is not a list of numbers") from None


def _fine(wavelengths: tuple[float, ...], values: tuple[float, ...], quantity: str) -> bool:
    """Whether samples keep all rules, told at once; `mistake_in` walks through the others to find which is broken."""
    return (
        len(wavelengths) > 1
        and wavelengths[0] > 0
        and 20 <= wavelengths[-1] < math.inf
        and all(map(operator.lt, wavelengths, wavelengths[1:]))
        and all(map(math.isfinite, values))
        and (min(values) >= 0 or quantity in ("n", "k"))
        and (max(values) <= 1 or quantity != "reflectance")
    )


def mistake_in(
    wavelengths: tuple[float, ...], values: tuple[float, ...], quantity: str
) -> tuple[int, str] | None:
    """The first sample that breaks a rule of this module, and a sentence about it; None when all is well."""
    if _fine(wavelengths, values, quantity):
        return None
    if not wavelengths:
        return 0, "no data; expected at least two lines with a wavelength and a value"
    before = 0.0
    for i, (wavelength, value) in enumerate(zip(wavelengths, values, strict=True)):
        if not math.isfinite(wavelength):
            return i, f"wavelength {wavelength:g}; expected a finite number of nm"
        if wavelength <= 0:
            return i, f"wavelength {wavelength:g} nm; expected one above zero"
        if i and wavelength == before:
            return i, f"wavelength {wavelength:g} nm twice; expected increasing wavelengths"
        if i and wavelength < before:
            return (
                i,
                f"wavelength {wavelength:g} nm comes after {before:g} nm; expected increasing wavelengths",
            )
        if not math.isfinite(value):
            return i, f"value {value:g} at {wavelength:g} nm; expected a finite number"
        if value < 0 and quantity not in ("n", "k"):
            kind = quantity or "spectrum (other than of n or k)"
            return i, f"value {value:g} at {wavelength:g} nm; expected {_article(kind)} that is not negative"
        if value > 1 and quantity == "reflectance":
            hint = "; are these percent?" if value > 2 else ""
            return i, f"value {value:g} at {wavelength:g} nm; expected a reflectance from 0 to 1{hint}"
        before = wavelength
    if len(wavelengths) == 1:
        return 0, "only one point; expected at least two"
    if wavelengths[-1] < 20:
        ends = f"{wavelengths[0]:g} to {wavelengths[-1]:g}"
        return 0, f"wavelengths from {ends} look like micrometres; expected nm"
    return None


def _article(noun: str) -> str:
    return f"{'an' if noun[0] in 'aeiou' else 'a'} {noun}"


def one_of(choices: Iterable[str]) -> str:
    """`'a', 'b' or 'c'`."""
    quoted = [repr(choice) for choice in choices]
    return quoted[0] if len(quoted) == 1 else f"{', '.join(quoted[:-1])} or {quoted[-1]}"
