"""A real room beside its image (Meyer, Rushmeier, Cohen, Greenberg and Torrance 1986; book 4.4.2).

Their test had two halves, and so has this one: irradiance measured in the real room is compared with that of the
solution, point by point; and people look at a photograph and an image side by side and say which is the real one. In
1986 they "did no better than they would have simply by guessing".

Example:
    >>> order = trials(4, seed=1)
    >>> sorted(order)
    ['left', 'left', 'right', 'right']
    >>> verdict = judge(right=13, total=24)
    >>> verdict.guessing, round(verdict.p_value, 2)
    (True, 0.84)
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.image import Image
    from illuminant.radiosity import Solution

    Array = NDArray[np.floating[Any]]

__all__ = ["Radiometry", "Verdict", "judge", "radiometry", "sheet", "trials"]

Side = Literal["left", "right"]


@dataclass(frozen=True)
class Radiometry:
    """Measured and computed illuminance.

    Attributes:
        points: (n, 3), in metres.
        measured, computed: (n,), lx.
        errors: (n,), (computed − measured)/measured.
        rms, mean, largest: of the errors.
    """

    points: Array
    measured: Array
    computed: Array
    errors: Array
    rms: float
    mean: float
    largest: float


@dataclass(frozen=True)
class Verdict:
    """What a forced-choice test says.

    Attributes:
        fraction: of answers that were right.
        interval: of 95 % for the fraction (Wilson 1927).
        p_value: the chance that guessing is right at least as far from half of the time.
        guessing: whether that is above 5 %: nothing speaks against guessing.
    """

    fraction: float
    interval: tuple[float, float]
    p_value: float
    guessing: bool


def radiometry(
    solution: Solution, points: Any, normals: Any, measured_lx: Any, *, samples: int = 4096
) -> Radiometry:
    """Compare measured illuminance with that of a solution.

    Args:
        solution: of the scene that stands for the room.
        points: (n, 3), in metres.
        normals: (n, 3) or (3,), what the meter faced.
        measured_lx: (n,), above 0.
        samples: as `Solution.illuminance`.

    Raises:
        UsageError: the numbers do not fit together.
    """
    import numpy as np

    places = np.atleast_2d(np.asarray(points, float))
    measured = np.asarray(measured_lx, float)
    if measured.shape != places.shape[:1] or not (measured > 0).all():
        raise UsageError("There must be one measured illuminance above 0 for each point.")
    computed = solution.illuminance(places, normals, samples=samples)
    errors = computed / measured - 1.0
    return Radiometry(
        places,
        measured,
        computed,
        errors,
        rms=float(np.sqrt(np.mean(errors**2))),
        mean=float(np.mean(errors)),
        largest=float(np.abs(errors).max()),
    )


def trials(count: int, *, seed: int = 0) -> list[Side]:
    """On which side the photograph is shown in each trial: half of them on either, in an order of chance.

    Raises:
        UsageError: there are no trials, or their number is odd.
    """
    import random

    if count < 2 or count % 2:
        raise UsageError(f"trials {count}: expected an even number, so that each side is as frequent.")
    half: list[Side] = ["left"] * (count // 2)
    order: list[Side] = [*half, *(["right"] * (count // 2))]  # type: ignore[list-item]
    random.Random(seed).shuffle(order)
    return order


def sheet(
    real: Image, synthetic: Image, side: Side, path: str | os.PathLike[str], *, exposure: float
) -> None:
    """Write the two images side by side on grey, at one exposure, without a word on which is which.

    Args:
        real: the photograph, in absolute XYZ.
        synthetic: the image, of the same size.
        side: where the photograph is.
        path: the file, .png.
        exposure: display value of 1 cd/m².

    Raises:
        UsageError: the sizes differ.
    """
    import numpy as np

    from illuminant.color import rgb_to_xyz
    from illuminant.image import Image

    if real.xyz.shape != synthetic.xyz.shape:
        raise UsageError(f"The images differ in size: {real.xyz.shape[:2]} and {synthetic.xyz.shape[:2]}.")
    pair = [real.xyz, synthetic.xyz] if side == "left" else [synthetic.xyz, real.xyz]
    height, width = real.xyz.shape[:2]
    margin = max(8, width // 12)
    grey = np.asarray(rgb_to_xyz([0.18, 0.18, 0.18])) / exposure
    page = np.broadcast_to(grey, (height + 2 * margin, 2 * width + 3 * margin, 3)).copy()
    page[margin : margin + height, margin : margin + width] = pair[0]
    page[margin : margin + height, 2 * margin + width : 2 * margin + 2 * width] = pair[1]
    Image(page).save(path, exposure=exposure)


def judge(*, right: int, total: int) -> Verdict:
    """What so many right answers out of so many say.

    Raises:
        UsageError: the numbers cannot be.

    Example:
        >>> judge(right=23, total=24).guessing
        False
    """
    if not 0 <= right <= total or total < 1:
        raise UsageError(f"{right} right answers out of {total}: expected from 0 to all of them.")
    apart = abs(2 * right - total)
    ways = sum(math.comb(total, k) for k in range(total + 1) if abs(2 * k - total) >= apart)
    p_value = ways / 2**total
    fraction, z = right / total, 1.959964
    centre = (fraction + z * z / (2 * total)) / (1 + z * z / total)
    half = (
        z / (1 + z * z / total) * math.sqrt(fraction * (1 - fraction) / total + z * z / (4 * total * total))
    )
    return Verdict(fraction, (centre - half, centre + half), p_value, p_value > 0.05)
