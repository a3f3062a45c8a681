"""Letters of 5 by 7 pixels, so that a pattern can say what its patches are.

Drawn here, and not by a font of the system, so that a pattern has the same bits everywhere. Capital letters, digits and
a few signs; lower case is drawn as capitals, and what is not known as a blank.

Example:
    >>> mask("I").astype(int).tolist()[:2]
    [[0, 1, 1, 1, 0], [0, 0, 1, 0, 0]]
    >>> mask("2.2", scale=3).shape
    (21, 51)
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.display.patterns.screen import Color, Values

__all__ = ["mask", "write"]

# Seven rows of five bits each, the highest bit at the left.
_ROWS = {
    "0": "0e11131519110e", "1": "040c040404040e", "2": "0e11010204081f", "3": "1f02040201110e",
    "4": "02060a121f0202", "5": "1f101e0101110e", "6": "0608101e11110e", "7": "1f010204080808",
    "8": "0e11110e11110e", "9": "0e11110f01020c", "A": "0e11111f111111", "B": "1e11111e11111e",
    "C": "0e11101010110e", "D": "1c12111111121c", "E": "1f10101e10101f", "F": "1f10101e101010",
    "G": "0e11101711110f", "H": "1111111f111111", "I": "0e04040404040e", "J": "0702020202120c",
    "K": "11121418141211", "L": "1010101010101f", "M": "111b1515111111", "N": "11111915131111",
    "O": "0e11111111110e", "P": "1e11111e101010", "Q": "0e11111115120d", "R": "1e11111e141211",
    "S": "0f10100e01011e", "T": "1f040404040404", "U": "1111111111110e", "V": "11111111110a04",
    "W": "1111111515150a", "X": "11110a040a1111", "Y": "1111110a040404", "Z": "1f01020408101f",
    ".": "00000000000c0c", "-": "0000001f000000", "+": "0004041f040400", "%": "18190204081303",
    "=": "00001f001f0000", "/": "00010204081000", ",": "000000000c0408",
}  # fmt: skip


def mask(text: str, scale: int = 1) -> NDArray[np.bool_]:
    """Where the text is, (7 scale, (6 n - 1) scale) for n letters."""
    import numpy as np

    columns = []
    for letter in text.upper():
        rows = bytes.fromhex(_ROWS.get(letter, "00" * 7))
        columns.append([[bool(row >> bit & 1) for bit in (4, 3, 2, 1, 0)] + [False] for row in rows])
    if not columns:
        return np.zeros((7 * scale, 0), bool)
    letters = np.concatenate([np.array(letter, bool) for letter in columns], axis=1)[:, :-1]
    return np.kron(letters, np.ones((scale, scale), bool)).astype(bool)


def write(values: Values, text: str, center: tuple[int, int], color: Color, scale: int = 1) -> None:
    """Write text into a pattern, centred on (x, y); what lies outside is cut off.

    Args:
        values: pattern to be written into.
        text: what to write.
        center: column and row of its middle.
        color: code values.
        scale: pixels of a dot of the letters.
    """
    from illuminant.display.patterns.screen import rgb

    letters = mask(text, scale)
    top, left = center[1] - letters.shape[0] // 2, center[0] - letters.shape[1] // 2
    first_row, first_column = max(0, -top), max(0, -left)
    part = values[max(0, top) : top + letters.shape[0], max(0, left) : left + letters.shape[1]]
    shown = letters[first_row : first_row + part.shape[0], first_column : first_column + part.shape[1]]
    part[shown] = rgb(color)
