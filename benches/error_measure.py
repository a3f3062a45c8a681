"""How far an image is from its reference, and what it cost: the numbers that benchmarks compare.

relative MSE = mean over pixels and over X, Y, Z of (I - R)^2 / (R^2 + 0.01 mean(R)^2), with R the reference
and mean(R) its mean in that channel. The second term keeps pixels that are nearly black from deciding alone;
a pixel of the mean brightness is hardly touched by it. efficiency = 1 / (relative MSE x seconds): it does not
depend on the number of samples while the error falls with its root, and it is twice as high for a renderer
that needs half the time. Against the renderer's own converged image the error is noise alone; against one
reference for all, bias counts too, and efficiency falls with the number of samples once bias is what is left.

mean dE00 = mean over pixels of CIEDE2000 between two converged images, both multiplied by the exposure of the
reference, as `illuminant diff` compares them (CIE Lab beside D65). What noise is left in them counts as well;
the means of blocks of pixels have less of it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np


def relative_mse(image: np.ndarray, reference: np.ndarray) -> float:
    """Relative mean squared error of an XYZ image (h, w, 3) against its reference.

    >>> import numpy as np
    >>> flat = np.ones((4, 4, 3))
    >>> round(relative_mse(1.1 * flat, flat), 6)
    0.009901
    """
    mean = reference.mean(axis=(0, 1))
    return float(((image - reference) ** 2 / (reference**2 + 0.01 * mean**2)).mean())


def efficiency(error: float, seconds: float) -> float:
    """1 / (relative MSE x seconds)."""
    return 1.0 / (error * seconds)


def largest_block_difference(image: np.ndarray, other: np.ndarray, block: int = 32) -> float:
    """Largest difference of the mean Y of a block of pixels, as a fraction of the mean Y of the other image.

    A mirrored image, a lamp at another place or a wrong colour of one wall can leave the mean untouched; this cannot.
    """
    height, width = (side // block * block for side in other.shape[:2])

    def blocks(xyz: np.ndarray) -> np.ndarray:
        luminance = xyz[:height, :width, 1]
        return luminance.reshape(height // block, block, width // block, block).mean(axis=(1, 3))

    return float(abs(blocks(image) - blocks(other)).max() / other[..., 1].mean())


def mean_delta_e(image: np.ndarray, reference: np.ndarray, block: int = 1) -> float:
    """Mean CIEDE2000 between two XYZ images (h, w, 3), of the means of blocks of that many pixels squared.

    >>> import numpy as np
    >>> flat = np.full((8, 8, 3), 20.0)
    >>> mean_delta_e(flat, flat)
    0.0
    >>> checks = flat + np.indices((8, 8)).sum(axis=0)[..., None] % 2 - 0.5
    >>> mean_delta_e(checks, flat) > 0.5, mean_delta_e(checks, flat, block=2) < 1e-9
    (True, True)
    """
    import numpy as np

    from illuminant import Image, color

    exposure = Image(reference).auto_exposure()
    height, width = (side // block * block for side in reference.shape[:2])

    def lab(xyz: np.ndarray) -> np.ndarray:
        cut = xyz[:height, :width].reshape(height // block, block, width // block, block, 3)
        return color.xyz_to_lab(np.maximum(cut.mean(axis=(1, 3)) * exposure, 0.0), "D65")

    return float(np.mean(color.delta_e_2000(lab(image), lab(reference))))
