"""What the lanes of kept spectra are worth to an observer: a matrix (3, N) from lanes to XYZ, and its cost in ΔE00.

For the lanes of one lamp the weights of `illuminant.display.refitting`, which go with the filter, are divided by the
lamp's own light in each lane; with a new spectrum they are those of that light. Lanes that hold the light of several
lamps have one matrix, fitted to the products under all of them.

Where a lamp is dark, nothing is known of what paths leave: such a lane has no weight. With fewer than three others a
new spectrum is refused; for another observer the lamp then takes the matrix of all lamps.

Errors: `ImageError` where a lamp is dark in too many lanes.

Example:
    >>> import numpy as np
    >>> from illuminant.display.observer import standard
    >>> from illuminant.kept_spectra import KeptSpectra, LampLight
    >>> nm = np.arange(380.0, 781.0)
    >>> lamp = LampLight("desk", np.ones(401), np.ones(401))
    >>> weights = LaneWeights(KeptSpectra("1nm", (380, 780), nm, (lamp,), np.ones((0, 401))), "room.exr")
    >>> eye = standard(nm)
    >>> bool(np.allclose(weights.of_lamp(lamp, eye, new=np.full(401, 2.0)), 2 * eye.functions.T))
    True
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.core import core
from illuminant.display.observer import STANDARD, Observer
from illuminant.display.refitting import Error, error_of, fitted, integrated, products
from illuminant.errors import ImageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.kept_spectra import KeptSpectra, LampLight

    Array = NDArray[np.floating[Any]]

__all__ = ["ALL", "AT_WAVELENGTHS", "DARK", "LaneWeights"]

ALL = "all lamps"
"""Under this name stands the error of the matrix of all lamps."""

DARK = 1e-6
"""A lane in which a lamp has less than this fraction of its brightest lane says nothing of what paths leave."""

FEWEST = 3
"""A colour needs as many lanes."""

INTEGRATED = ("uniform", "1nm")
"""Samplings of close and even wavelengths, which are integrated by straight lines."""

AT_WAVELENGTHS = (*INTEGRATED, "fitted", "meyer", "gauss")
"""Samplings whose lanes are what spectra are at wavelengths; those of others are boxes or colours."""


class LaneWeights:
    """The weights of one image's lanes.

    Args:
        basis: what the lanes mean.
        path: the image as messages name it.

    Attributes:
        errors: what weights cost, by lamp, and of all lamps together under `ALL`.
        dark: how many lanes of a lamp say nothing, for those that have such.
    """

    def __init__(self, basis: KeptSpectra, path: str) -> None:
        self.basis = basis
        self.path = path
        self.errors: dict[str, Error] = {}
        self.dark: dict[str, int] = {}
        self.nm = basis.every_nm
        self.products = products(basis.reflectances, self.nm)
        self.integrates = basis.sampling.partition(":")[0] in INTEGRATED

    def of_lamp(self, light: LampLight, observer: Observer, new: Array | None = None) -> Array:
        """(3, N) what lanes of the light of one lamp are worth.

        Args:
            light: of the lamp that was rendered.
            observer: who looks.
            new: (n,) the spectrum that the lamp shall have instead; None leaves it.

        Raises:
            ImageError: it is dark in so many lanes that nothing is known of another.
        """
        import numpy as np

        wavelengths = self.basis.wavelengths_nm
        if new is None and self.integrates:
            weights = integrated(self.nm, wavelengths, observer.functions)
            rows = self._rows(wavelengths, observer.functions * light.spectrum[:, None])
            self.errors[light.name] = self._error(weights * light.lanes, *rows)
            return weights
        usable = light.lanes > DARK * float(light.lanes.max(initial=0.0))
        known = int(usable.sum())
        if known < min(FEWEST, len(usable)):
            if new is None:
                return self.together(observer)
            raise ImageError(
                f"Lamp {light.name!r} has light in {known} of the {len(usable)} wavelengths of {self.path} only, "
                "too few to tell what another would show: render the scene with another lamp there."
            )
        if known < len(usable):
            self.dark[light.name] = len(usable) - known
        curves = observer.functions * (light.spectrum if new is None else new)[:, None]
        found = integrated(self.nm, wavelengths[usable], curves)
        rows = self._rows(wavelengths[usable], curves)
        if not self.integrates:
            found = fitted(*rows, self.products.weights, found, positive=_positive(observer))
        self.errors[light.name] = self._error(found, *rows)
        weights = np.zeros((3, len(usable)))
        weights[:, usable] = found / light.lanes[usable]
        return weights

    def together(self, observer: Observer) -> Array:
        """(3, N) what lanes are worth that hold the light of all lamps, or of none."""
        import numpy as np

        wavelengths = self.basis.wavelengths_nm
        weights = integrated(self.nm, wavelengths, observer.functions)
        kinds = self._kinds()
        if not kinds:
            return weights
        rows = []
        for spectrum, lanes in kinds:
            features, targets, white = self._rows(wavelengths, observer.functions * spectrum[:, None])
            rows.append((features * lanes, targets, white))
        features, targets, white = (np.concatenate(part) for part in zip(*rows, strict=True))
        if not self.integrates:
            counts = np.tile(self.products.weights, len(rows))
            weights = fitted(features, targets, white, counts, weights, positive=_positive(observer))
        known = np.tile(np.arange(len(self.products.filters)) < self.products.known, len(rows))
        self.errors[ALL] = error_of(weights, features[known], targets[known], white[known])
        return weights

    def _kinds(self) -> list[tuple[Array, Array]]:
        """Spectrum and lanes of the lamps that can be seen, of luminance 1: one of each relative spectrum."""
        import numpy as np

        seen = core().matching_functions(self.nm, STANDARD)[:, 1]
        found: list[tuple[Array, Array]] = []
        for lamp in self.basis.lamps:
            luminance = float(lamp.spectrum @ seen)
            if luminance > 0:
                spectrum, lanes = lamp.spectrum / luminance, lamp.lanes / luminance
                if not any(np.allclose(spectrum, other, rtol=1e-6) for other, _ in found):
                    found.append((spectrum, lanes))
        return found

    def _rows(self, wavelengths: Array, curves: Array) -> tuple[Array, Array, Array]:
        """What lanes hold of the products, their XYZ at 1 nm, and the white beside them."""
        import numpy as np

        filters = self.products.filters
        features = np.stack([np.interp(wavelengths, self.nm, row) for row in filters])
        targets = filters @ curves
        return features, targets, np.broadcast_to(curves.sum(axis=0), targets.shape)

    def _error(self, weights: Array, features: Array, targets: Array, white: Array) -> Error:
        known = self.products.known
        return error_of(weights, features[:known], targets[:known], white[:known])


def _positive(observer: Observer) -> bool:
    return bool((observer.functions >= 0).all())
