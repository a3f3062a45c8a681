"""What a lookup table loses: display codes that are never used, and image codes that become one.

Where a table is steeper than 1, an increment of the image's code skips codes of the display; where it is flatter,
several image codes fall on one. Table 5.1 does both: 3 goes to 33 and 4 to 38, while 254 and 253 go to 254; and the
lowest 10 % of intensities are spread over the lowest 35 % of the display's range, as 0.1^(1/2.2) = 0.351 (book 5.1.2).

Example:
    >>> from illuminant.display.gamma.lookup_table import correction_table
    >>> found = lost_levels(correction_table(2.2, rounding="truncate"))
    >>> found.used, len(found.unused), found.merged_codes, found.largest_gap
    (184, 72, 72, (0, 20))
    >>> [round(share, 3) for share in spread(correction_table(2.2, rounding="truncate"), 0.1)]
    [0.098, 0.345]
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from illuminant.display.gamma.lookup_table import LookupTable, top_code
from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["LostLevels", "lost_levels", "spread"]


@dataclass(frozen=True, eq=False)
class LostLevels:
    """What becomes of the codes of a table.

    Attributes:
        used: how many codes of the display appear in the table.
        unused: (n,) those that never do.
        merged: (k, 3) first and last image code of each run that falls on one display code, and that code.
        merged_codes: how many image codes are lost by that: codes of the image, less the display codes used.
        largest_gap: display codes that follow each other in the table with the largest step between them.
        steps: (2^in_bits − 1,) differences of neighbouring entries.
    """

    used: int
    unused: NDArray[np.int64]
    merged: NDArray[np.int64]
    merged_codes: int
    largest_gap: tuple[int, int]
    steps: NDArray[np.int64]


def lost_levels(table: LookupTable) -> LostLevels:
    """Count what a table loses.

    Raises:
        UsageError: the table falls somewhere, so that neighbouring codes are no neighbours.
    """
    import numpy as np

    entries = table.entries.astype(np.int64)
    steps = np.diff(entries)
    if steps.min() < 0:
        at = int(np.argmin(steps))
        raise UsageError(f"The table falls after code {at}, and levels are counted in one that rises.")
    present = np.unique(entries)
    unused = np.setdiff1d(np.arange(top_code(table.out_bits) + 1), present)
    first = np.searchsorted(entries, present, side="left")
    last = np.searchsorted(entries, present, side="right") - 1
    several = last > first
    merged = np.stack([first[several], last[several], present[several]], axis=1)
    widest = int(np.argmax(steps))
    gap = (int(entries[widest]), int(entries[widest + 1]))
    return LostLevels(len(present), unused, merged, len(entries) - len(present), gap, steps)


def spread(table: LookupTable, share: float = 0.1) -> tuple[float, float]:
    """Over which share of the display's range the lowest share of the image's range is spread.

    Args:
        table: one that rises.
        share: of the image's range, above 0 and at most 1.

    Returns:
        The largest image code within that share, and its entry, each divided by the largest there is.

    Raises:
        UsageError: the share is not between 0 and 1.
    """
    import numpy as np

    if not 0.0 < share <= 1.0:
        raise UsageError(f"A share is above 0 and at most 1, not {share}.")
    code = int(np.floor(share * (len(table.entries) - 1) + 1e-9))
    return float(table.inputs[code]), float(table.outputs[code])
