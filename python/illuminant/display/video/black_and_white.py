"""What a black and white set shows, and which edges of colour it loses (book 5.6, eq 5.5).

    R = G = B = Y_t = 0.299 R + 0.587 G + 0.114 B

Colours that are very different may have one Y_t. `isoluminant` finds where such colours meet: pixels a few columns or
rows apart (edges of a rendered image take two or three pixels) whose ΔE00 is large while their Y_t is nearly one.

Example:
    >>> import numpy as np
    >>> image = np.zeros((8, 16, 3))
    >>> image[:, :8], image[:, 8:] = [0.8, 0.1, 0.1], [0.1, 0.45, 0.1]
    >>> int(isoluminant(image)[4].sum()), preview(image)[4, [0, 15], 0].round(2).tolist()
    (6, [0.31, 0.31])
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Float64 = NDArray[np.float64]

__all__ = ["isoluminant", "preview"]


def preview(rgb: ArrayLike) -> Float64:
    """The picture (h, w, 3) as a black and white set shows it: Y_t to all three guns (book eq 5.5)."""
    import numpy as np

    from illuminant.color.axes import monochrome
    from illuminant.display.video.transmission import picture

    return np.repeat(monochrome(picture(rgb))[..., None], 3, axis=-1)


def isoluminant(
    rgb: ArrayLike,
    *,
    delta_e: float = 20.0,
    delta_y: float = 0.05,
    distance: int = 3,
    system: str = "NTSC 1953 D65",
) -> NDArray[np.bool_]:
    """Where (h, w) colours meet that differ in colour and not in black and white; both sides are marked.

    Args:
        rgb: (h, w, 3), code values from 0 to 1.
        delta_e: from which ΔE00 on two colours are very different.
        delta_y: below which difference of Y_t, from 0 to 1, they are one in black and white.
        distance: between the two pixels compared, in pixels.
        system: RGB system of the code values.

    Raises:
        UsageError: `rgb` is no picture, or a limit is not positive.
    """
    import numpy as np

    from illuminant.color.axes import monochrome
    from illuminant.color.differences import delta_e_2000
    from illuminant.color.rgb import rgb_to_xyz
    from illuminant.color.rgb import system as system_of
    from illuminant.color.uniform import xyz_to_lab
    from illuminant.display.video.transmission import picture

    if not (delta_e > 0.0 and delta_y > 0.0 and distance >= 1):
        raise UsageError("The limits of isoluminant colours, and their distance, are above 0.")
    array = picture(rgb)
    found = system_of(system)
    white = np.asarray(found.to_xyz).sum(axis=1)
    lab = xyz_to_lab(rgb_to_xyz(np.clip(array, 0.0, 1.0), found, encoded=True), white)
    y = monochrome(array)
    mask = np.zeros(y.shape, bool)
    for axis in (0, 1):
        n = y.shape[axis] - distance
        if n < 1:
            continue
        one, other = _pair(axis, distance)
        alike = np.abs(y[one] - y[other]) < delta_y
        # Most neighbours are alike in every way; the formula is worked out for the rest.
        candidates = alike & (np.abs(lab[one] - lab[other]).max(axis=-1) > 2.0)
        differs = np.zeros(alike.shape, bool)
        if candidates.any():
            differs[candidates] = delta_e_2000(lab[one][candidates], lab[other][candidates]) >= delta_e
        mask[one] |= differs
        mask[other] |= differs
    return mask


def _pair(axis: int, distance: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Where the first and where the second of two pixels stand."""
    whole = slice(None)
    one, other = slice(None, -distance), slice(distance, None)
    return ((one, whole), (other, whole)) if axis == 0 else ((whole, one), (whole, other))
