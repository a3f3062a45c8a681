"""How far two images are apart, as an eye sees it.

- ΔE00: CIEDE2000 (CIE 142-2001) of every pixel; the white of CIE Lab is D65 with Y = 1, the display's white.
- FLIP (Andersson et al. 2020, LDR-FLIP at 67 pixels a degree): what a person notices who flips between the
  two on one display; 0 is no difference, 1 the largest.

Absolute images (EXR) are both multiplied by one exposure first, the given one or that of the first image; two
PNGs are compared as they are. FLIP sees colours clamped to sRGB; ΔE00 clamps nothing but negative XYZ, which
has no Lab.

References: Sharma, Wu, Dalal, Color Research and Application 30(1), 2005; Andersson et al., FLIP, HPG 2020.

Example:
    >>> import numpy as np
    >>> from illuminant.image import Image
    >>> grey = Image(np.full((8, 8, 3), 20.0))
    >>> diff(grey, grey).max                       # doctest: +SKIP
    0.0
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import color, output, rgb_system
from illuminant.errors import MachineError, UsageError
from illuminant.image import UNIT, Image, check_output

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["MEASURES", "Difference", "check_map", "diff", "save_map"]

MEASURES = ("mean", "p95", "max", "flip")


@dataclass(frozen=True)
class Difference:
    """How far two images are apart.

    Attributes:
        delta_e: (h, w), ΔE00 of every pixel.
        mean, p95, max: of `delta_e`.
        worst: column and row of the largest.
        flip: mean FLIP.
        flip_map: (h, w), FLIP of every pixel.
        exposure: factor from Y of both images to the display's 0 to 1.
    """

    delta_e: Array
    mean: float
    p95: float
    max: float
    worst: tuple[int, int]
    flip: float
    flip_map: Array
    exposure: float

    @property
    def scale(self) -> float:
        """ΔE00 that a map in colours shows as white: the largest there is, at least 1."""
        return max(1.0, self.max)


def diff(
    a: Image | str | os.PathLike[str],
    b: Image | str | os.PathLike[str],
    *,
    exposure: float | None = None,
    assume: str | None = None,
) -> Difference:
    """Compare two images of one size.

    Args:
        a: reference: an `Image`, or the path of an EXR or PNG.
        b: the image to be compared with it.
        exposure: factor from Y of absolute images to the display's 0 to 1; default that of the first absolute
            one.
        assume: display of a file that does not say which its numbers are for.

    Returns:
        ΔE00 and FLIP, for every pixel and in all.

    Raises:
        ImageError: a file cannot be read.
        UsageError: the sizes differ, or the exposure is not positive.
        MachineError: the package flip-evaluator is not there.
    """
    import numpy as np

    first = a if isinstance(a, Image) else Image.open(a, assume)
    second = b if isinstance(b, Image) else Image.open(b, assume)
    if (first.width, first.height) != (second.width, second.height):
        raise UsageError(
            f"The images differ in size: {first.width}x{first.height} and {second.width}x{second.height} pixels."
        )
    if exposure is not None and not (exposure > 0 and math.isfinite(exposure)):
        raise UsageError(f"An exposure is a positive number, not {exposure}.")
    absolute = [image for image in (first, second) if image.unit == UNIT]
    if exposure is None:
        exposure = (absolute[0].exposure or absolute[0].auto_exposure()) if absolute else 1.0
    # A relative image beside an absolute one is what a display shows already.
    shown = [
        image.xyz * (exposure if image.unit == UNIT or not absolute else 1.0) for image in (first, second)
    ]

    labs = [color.xyz_to_lab(np.maximum(xyz, 0.0), "D65") for xyz in shown]
    delta_e = np.asarray(color.delta_e_2000(*labs), np.float64)
    row, column = np.unravel_index(int(delta_e.argmax()), delta_e.shape)
    flip_map = _flip(*shown)
    return Difference(
        delta_e=delta_e,
        mean=float(delta_e.mean()),
        p95=float(np.percentile(delta_e, 95)),
        max=float(delta_e.max()),
        worst=(int(column), int(row)),
        flip=float(flip_map.mean()),
        flip_map=flip_map,
        exposure=float(exposure),
    )


def _flip(a: Array, b: Array) -> Array:
    """LDR-FLIP of every pixel of two images in relative XYZ."""
    import numpy as np

    try:
        import flip_evaluator
    except ImportError as error:
        raise MachineError("FLIP needs the package flip-evaluator: pip install flip-evaluator.") from error
    from_xyz = np.asarray(rgb_system.named("sRGB")["from_xyz"], np.float64)
    linear = [np.clip(xyz @ from_xyz.T, 0.0, 1.0).astype(np.float32) for xyz in (a, b)]
    found = flip_evaluator.evaluate(linear[0], linear[1], "LDR", inputsRGB=False, applyMagma=False)[0]
    return np.asarray(found, np.float64).reshape(a.shape[:2])


def check_map(path: str | os.PathLike[str]) -> Path:
    """Refuse a map's path before the work; errors as `illuminant.image.check_output`."""
    return check_output(path)


# Black, violet, red, orange, white: even steps of lightness, readable without colour.
_HEAT = ((0.0, 0.0, 0.0), (0.30, 0.05, 0.45), (0.75, 0.15, 0.25), (0.98, 0.60, 0.15), (1.0, 1.0, 1.0))


def save_map(path: str | os.PathLike[str], difference: Difference) -> None:
    """Save the map of ΔE00.

    Args:
        path: `.exr` for the numbers (in each of R, G and B, and FLIP as the layer `flip`), `.png` for colours
            from black (0) to white (`difference.scale`).
        difference: what `diff` found.

    Raises:
        ImageError, MachineError: the file cannot be written.
    """
    import numpy as np

    path = check_map(path)
    if path.suffix.lower() == ".exr":
        from illuminant import exr, rgb_system

        contents = exr.Contents(
            rgb=np.repeat(difference.delta_e[..., None], 3, axis=2),
            chromaticities=rgb_system.chromaticities(rgb_system.named("sRGB")),
            layers={"flip": difference.flip_map[..., None]},
            attributes={"unit": "CIEDE2000", "exposure": difference.exposure},
        )
        output.write(path, lambda temporary: exr.write(temporary, contents))
        return
    from illuminant.display.picture import Picture

    heat = np.asarray(_HEAT)
    level = np.clip(difference.delta_e / difference.scale, 0.0, 1.0)
    places = np.linspace(0.0, 1.0, len(heat))
    colors = np.stack([np.interp(level, places, heat[:, channel]) for channel in range(3)], axis=2)
    text = {
        "Software": "illuminant",
        "Description": f"CIEDE2000, 0 (black) to {difference.scale:.6g} (white)",
    }
    Picture.of_values(colors, "sRGB", text=text).save(path)
