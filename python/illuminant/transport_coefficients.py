"""Transport coefficients: where light comes from, asked from the eye and from the light (book 4.1, eqs 4.1 to 4.5).

A coefficient ξ says how much of a source's intensity an active patch sends on. Seen from the eye it belongs to a
target, a source and an active patch, for a patch may send another intensity in every direction: n³ coefficients. Where
all patches are diffuse it belongs to a source and an active patch: n². Both schools come to the same intensities; that
of the light solves for all patches at once.

Example:
    >>> import numpy as np
    >>> room = Diffuse(lit=[0.5, 0.2, 0.0], exchanged=[[0.0, 0.2, 0.3], [0.2, 0.0, 0.1], [0.3, 0.1, 0.0]])
    >>> [round(float(v), 4) for v in room.from_light(1)], [round(float(v), 4) for v in room.from_light(2)]
    ([0.5, 0.2, 0.0], [0.54, 0.3, 0.17])
    >>> bool(np.allclose(room.from_light(100), room.solved()))
    True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Diffuse", "Directional"]


def _array(values: ArrayLike, name: str, shape: tuple[int, ...] | None = None) -> Array:
    import numpy as np

    found = np.asarray(values, float)
    if not np.isfinite(found).all() or (found < 0.0).any():
        raise UsageError(f"{name} must be finite and not negative.")
    if shape is not None and found.shape != shape:
        raise UsageError(f"{name} must have the shape {shape}, found {found.shape}.")
    return found


class Diffuse:
    """Patches that send the same intensity in all directions: n² coefficients.

    Args:
        lit: ξ(light, p) I(light), shape (n,): what each patch sends of the light alone.
        exchanged: ξ(source, active), shape (n, n): row the source, column the active patch.

    Raises:
        UsageError: a shape is wrong, a value is negative, or light would grow from bounce to bounce.
    """

    def __init__(self, lit: ArrayLike, exchanged: ArrayLike) -> None:
        import numpy as np

        self.lit = _array(lit, "lit")
        count = len(self.lit)
        self.exchanged = _array(exchanged, "exchanged", (count, count))
        radius = float(np.abs(np.linalg.eigvals(self.exchanged)).max()) if count else 0.0
        if radius >= 1.0:
            raise UsageError(
                f"Light would grow by {radius:.3g} from bounce to bounce: the patches create energy."
            )

    @property
    def coefficients(self) -> int:
        """How many coefficients between patches there are: n²."""
        return int(self.exchanged.size)

    def from_light(self, iterations: int) -> Array:
        """Intensities of all patches after some iterations, the first of which knows the light alone (book eq 4.5).

        I ← ξ_light I_light + ξᵀ I
        """
        import numpy as np

        intensity = np.zeros_like(self.lit)
        for _ in range(iterations):
            intensity = self.lit + self.exchanged.T @ intensity
        return intensity

    def solved(self) -> Array:
        """The intensities in balance: (1 - ξᵀ) I = ξ_light I_light."""
        import numpy as np

        return np.asarray(np.linalg.solve(np.eye(len(self.lit)) - self.exchanged.T, self.lit))

    def seen_from_eye(self) -> Directional:
        """The same patches as the eye asks: coefficients that do not depend on the target."""
        import numpy as np

        count = len(self.lit)
        return Directional(
            np.broadcast_to(self.lit, (count + 1, count)),
            np.broadcast_to(self.exchanged, (count + 1, count, count)),
        )


class Directional:
    """Patches that may send another intensity to every target: n³ coefficients, and n² for the eye.

    Args:
        lit: ξ(target, light, p) I(light), shape (n + 1, n): row the target, of which the last is the eye.
        exchanged: ξ(target, source, active), shape (n + 1, n, n).

    Raises:
        UsageError: a shape is wrong or a value is negative.
    """

    def __init__(self, lit: ArrayLike, exchanged: ArrayLike) -> None:
        self.lit = _array(lit, "lit")
        if self.lit.ndim != 2 or self.lit.shape[0] != self.lit.shape[1] + 1:
            raise UsageError(f"lit must have the shape (n + 1, n), found {self.lit.shape}.")
        count = self.lit.shape[1]
        self.exchanged = _array(exchanged, "exchanged", (count + 1, count, count))

    @property
    def coefficients(self) -> int:
        """How many coefficients between patches there are, those to the eye counted: n³ + n²."""
        return int(self.exchanged.size)

    def from_eye(self, patch: int, approximation: int, ambient: float = 0.0) -> float:
        """The intensity that the eye sees of a patch (book eqs 4.1 to 4.4).

        The first approximation knows the light and takes `ambient` for what comes from patches; each further one asks
        the patches that are seen in the same way, and so counts one more reflection.

        Args:
            patch: number of the active patch, from 0.
            approximation: 1 or more.
            ambient: intensity that stands for what is not asked.
        """
        if approximation < 1:
            raise UsageError(f"The first approximation has the number 1; found {approximation}.")
        count = self.lit.shape[1]

        def asked(target: int, active: int, rest: int) -> float:
            total = float(self.lit[target, active])
            for source in range(count):
                coefficient = float(self.exchanged[target, source, active])
                if coefficient:
                    total += coefficient * (ambient if rest == 1 else asked(active, source, rest - 1))
            return total

        return asked(count, patch, approximation)
