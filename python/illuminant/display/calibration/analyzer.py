"""The two instruments of a calibration before colorimeters were cheap: comparator and colour analyzer (book 5.4).

A **comparator** shows a reference white in one half of its field and the screen in the other. A person says whether
they match, and if not, on which side of it the screen lies: a difference below what an eye sees is no difference (0.002
in u', v', 2 % in luminance, for fields side by side).

A **colour analyzer** has a sensor for each phosphor, and knows nothing of white: it is taught one. With a white that
was set by the comparator in front of it, it stores its three readings in a memory, and from then on shows red, green
and blue as fractions of them: all alike when the colour is that of the white taught, at any level. Its memories hold a
white for each type of monitor, since its sensors see different phosphors differently.

Units: XYZ in cd/m²; readings of an analyzer are relative to the taught white.

Example:
    >>> analyzer = Analyzer()
    >>> analyzer.teach("studio", [97.9, 103.0, 112.2])
    >>> analyzer.read([9.79, 10.3, 11.22], "studio").round(3).tolist()
    [0.1, 0.1, 0.1]
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from illuminant.display.calibration.monitor import D6500, SMPTE_C, WHITE_LUMINANCE
from illuminant.errors import UsageError, suggestion

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["Analyzer", "Comparator", "Match"]

Triple = tuple[float, float, float]


class Match(NamedTuple):
    """What a person says of the two halves.

    Attributes:
        matches: no difference is seen.
        du, dv: how far the screen is from the reference, in u', v'; 0 when no tint is seen.
        brighter: luminance of the screen over that of the reference, less 1; 0 when no difference is seen.
    """

    matches: bool
    du: float
    dv: float
    brighter: float


@dataclass(frozen=True)
class Comparator:
    """A split field with a reference white.

    Attributes:
        xy: of the reference.
        luminance: of the reference, cd/m².
        tint, step: least difference that is seen, in u', v' and as a fraction of luminance.
    """

    xy: tuple[float, float] = D6500
    luminance: float = WHITE_LUMINANCE
    tint: float = 0.002
    step: float = 0.02

    def judge(self, xyz: ArrayLike) -> Match:
        """Compare the screen with the reference.

        Args:
            xyz: of the screen, cd/m².

        Example:
            >>> Comparator().judge([97.9, 103.0, 112.2]).matches
            True
            >>> Comparator().judge([110.0, 103.0, 112.2]).du > 0.0
            True
        """
        import numpy as np

        from illuminant import color

        reference = color.xyz_to_uvy(np.array(color.white_xyz(self.xy)))
        seen = color.xyz_to_uvy(np.asarray(xyz, np.float64))
        du, dv = (float(value) for value in seen[:2] - reference[:2])
        tinted = not math.hypot(du, dv) < self.tint
        brighter = float(seen[2]) / self.luminance - 1.0
        uneven = not abs(brighter) < self.step
        return Match(
            not tinted and not uneven,
            du if tinted else 0.0,
            dv if tinted else 0.0,
            brighter if uneven else 0.0,
        )


@dataclass
class Analyzer:
    """Three sensors and memories for the whites they were taught.

    Attributes:
        phosphors: x and y of red, green and blue that its sensors are made for.
        memories: readings of the taught whites, by name.
    """

    phosphors: tuple[tuple[float, float], ...] = SMPTE_C
    memories: dict[str, Triple] = field(default_factory=dict)

    def sense(self, xyz: ArrayLike) -> Array:
        """Raw readings (..., 3) of the sensors."""
        import numpy as np

        from illuminant import color

        return np.asarray(
            np.asarray(xyz, np.float64) @ np.array(color.monitor(self.phosphors, D6500).from_xyz).T
        )

    def teach(self, memory: str, xyz: ArrayLike) -> None:
        """Store the white in front of the sensors in a memory, in place of what was there.

        Raises:
            UsageError: a sensor sees nothing, so there is no white in front of them.
        """
        r, g, b = self.sense(xyz).tolist()
        if not min(r, g, b) > 0.0:
            raise UsageError("An analyzer is taught a white, and one of its sensors sees no light.")
        self.memories[memory] = (r, g, b)

    def read(self, xyz: ArrayLike, memory: str) -> Array:
        """Red, green and blue (..., 3) relative to the white in a memory.

        Raises:
            UsageError: nothing was taught to this memory.
        """
        import numpy as np

        taught = self.memories.get(memory)
        if taught is None:
            hint = suggestion(memory, self.memories)
            known = ", ".join(self.memories) or "none"
            raise UsageError(
                f"The analyzer's memory {memory!r} is empty; taught: {known}{f' ({hint})' if hint else ''}."
            )
        return np.asarray(self.sense(xyz) / np.array(taught))

    def scales(self, xyz: ArrayLike, memory: str) -> dict[str, Any]:
        """The three rows of lamps: green as the level, red and blue as balance against it.

        Example:
            >>> analyzer = Analyzer()
            >>> analyzer.teach("a", [97.9, 103.0, 112.2])
            >>> {name: round(value, 3) for name, value in analyzer.scales([48.95, 51.5, 56.1], "a").items()}
            {'green': 0.5, 'red': 1.0, 'blue': 1.0}
        """
        r, g, b = self.read(xyz, memory).tolist()
        level = g if g else float("nan")
        return {"green": g, "red": r / level, "blue": b / level}
