"""A map of luminance in false colours, with its scale in cd/m²."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from illuminant.plots.style import new_figure, save, styled

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.image import Image

__all__ = ["DECADES", "ends", "save_map"]

DECADES = 3.0
"""How far below the brightest the scale begins, in powers of ten."""


def ends(luminance: NDArray[np.floating[Any]]) -> tuple[float, float]:
    """The ends of the scale of a map: the 99.5th percentile of what shines, and three powers of ten below.

    Example:
        >>> import numpy as np
        >>> ends(np.full((2, 2), 500.0))
        (0.5, 500.0)
    """
    import numpy as np

    positive = luminance[luminance > 0]
    top = float(np.percentile(positive, 99.5)) if positive.size else 1.0
    return top / 10**DECADES, top


def save_map(image: Image, path: str | os.PathLike[str]) -> None:
    """Draw the luminance of an image, cd/m², on a logarithmic scale: three powers of ten below the 99.5th percentile.

    Raises:
        UsageError: the name does not end with .png or .svg.
        ImageError: the path cannot be an output.
    """
    import numpy as np
    from matplotlib.colors import LogNorm

    luminance = image.xyz[..., 1]
    low, top = ends(luminance)
    height, width = luminance.shape
    with styled():
        figure, axes = new_figure((8.0, 8.0 * height / width * 0.85 + 0.4))
        norm = LogNorm(low, top, clip=True)
        shown = axes.imshow(np.maximum(luminance, low), norm=norm, cmap="viridis", interpolation="nearest")
        axes.set_axis_off()
        bar = figure.colorbar(shown, ax=axes, fraction=0.04, pad=0.02)
        bar.set_label("luminance, cd/m²")
        save(figure, path)
