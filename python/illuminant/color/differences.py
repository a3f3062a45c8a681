"""Colour differences ΔE, under reference conditions (all k = 1 but where stated).

Colours come as arrays (..., 3) that broadcast against each other: one colour beside an image, or image beside image.
The result has one number for each pair, computed in float64, and is float32 only when both are.

Example:
    >>> import numpy as np
    >>> image = np.full((2, 2, 3), [50.0, 2.6772, -79.7751])
    >>> delta_e_2000(image, [50.0, 0.0, -82.7485]).round(4).tolist()
    [[2.0425, 2.0425], [2.0425, 2.0425]]
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from illuminant.color.triples import asked, floating, output
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["delta_e_1976", "delta_e_1994", "delta_e_2000", "delta_e_luv"]


def delta_e_1976(lab_a: ArrayLike, lab_b: ArrayLike, *, out: Array | None = None) -> Any:
    """The distance in L*a*b*, √(ΔL² + Δa² + Δb²) (CIE 1976).

    Args:
        lab_a, lab_b: L*a*b*, (..., 3), of shapes that broadcast.
        out: array to fill, of the broadcast shape without its last axis.

    Returns:
        That array, or a number for two single colours.

    Raises:
        UsageError: the shapes do not go together, or `out` does not fit.

    Example:
        >>> float(delta_e_1976([50, 3, 0], [50, 0, 4]))
        5.0
    """
    return _difference("1976", lab_a, lab_b, out)


def delta_e_1994(
    lab_a: ArrayLike,
    lab_b: ArrayLike,
    *,
    constants: Literal["graphic arts", "textiles"] = "graphic arts",
    out: Array | None = None,
) -> Any:
    """CIE 1994 (CIE 116-1995): ΔL/k_L, ΔC/(1 + K₁C₁), ΔH/(1 + K₂C₁), with C₁ the chroma of the first colour.

    Args:
        lab_a: the standard, (..., 3); the formula is not symmetric.
        lab_b: what is compared with it, (..., 3).
        constants: "graphic arts" (k_L 1, K₁ 0.045, K₂ 0.015) or "textiles" (k_L 2, K₁ 0.048, K₂ 0.014).
        out: as `delta_e_1976`.

    Example:
        >>> float(delta_e_1994([60, 0, 0], [50, 0, 0], constants="textiles"))
        5.0
    """
    return _difference(f"1994 {constants}", lab_a, lab_b, out)


def delta_e_2000(lab_a: ArrayLike, lab_b: ArrayLike, *, out: Array | None = None) -> Any:
    """CIEDE2000 (ISO/CIE 11664-6), in the form of Sharma, Wu and Dalal (2005); arguments as `delta_e_1976`.

    Example:
        >>> round(float(delta_e_2000([50, 2.5, 0], [50, 0, -2.5])), 4)
        4.3065
    """
    return _difference("2000", lab_a, lab_b, out)


def delta_e_luv(luv_a: ArrayLike, luv_b: ArrayLike, *, out: Array | None = None) -> Any:
    """The distance in L*u*v*, √(ΔL² + Δu² + Δv²) (CIE 1976; book 3.4); arguments as `delta_e_1976`.

    Example:
        >>> float(delta_e_luv([50, 3, 0], [50, 0, 4]))
        5.0
    """
    return _difference("1976", luv_a, luv_b, out)


def _difference(formula: str, first: ArrayLike, second: ArrayLike, out: Array | None) -> Any:
    """The differences by one formula of the core."""
    import numpy as np

    pair = [floating(first), floating(second)]
    if any(colours.ndim == 0 or colours.shape[-1] != 3 for colours in pair):
        shapes = " and ".join(str(colours.shape) for colours in pair)
        raise UsageError(f"Colours need a last axis of length 3, and the shapes are {shapes}.")
    try:
        shape = np.broadcast_shapes(pair[0].shape, pair[1].shape)
    except ValueError as error:
        raise UsageError(f"Shapes {pair[0].shape} and {pair[1].shape} do not go together.") from error
    dtype = np.result_type(*pair)
    # One colour beside many is repeated by the core, without a copy.
    pair = [
        np.ascontiguousarray(colours if colours.size == 3 else np.broadcast_to(colours, shape), dtype)
        for colours in pair
    ]
    result = output(shape[:-1], dtype, out)
    apart = not result.flags.c_contiguous or any(np.may_share_memory(result, colours) for colours in pair)
    direct = np.empty(shape[:-1], dtype) if apart else result
    asked("difference", formula, *pair, direct)
    if apart:
        result[...] = direct
    return result if shape[:-1] or out is not None else result[()]
