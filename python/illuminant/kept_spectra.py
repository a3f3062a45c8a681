"""What kept spectra mean: the spectral sampling, the lamps and the reflectances that an image's lanes were made by.

The lanes of a pixel are a few numbers at wavelengths which a spectral sampling has chosen. They are the product of a
lamp's light and of what paths left of it, so that another lamp, or another observer, can be put in its place afterwards
(`illuminant.display.develop`), if it is known

- what each lamp's spectrum is, at every nm and in the lanes, to divide by it;
- what the surfaces reflect, at every nm, to find new weights from lanes to a colour. Irregular wavelengths must not be
  integrated by interpolation: their weights are fitted to what a scene can show.

An EXR with lanes holds this as JSON in the attribute `illuminant:basis`: `sampling`, `range_nm`, `wavelengths_nm`,
`curves` (relative spectra of lamps at every nm, each once), `lanes` (those in the lanes), `lamps` (name, number of the
curve, factor), `reflectances`, `develop_for` and `fog`. Wavelengths in nm; lamps in the unit of the scene.

Errors: `ImageError` for an attribute that is damaged.

Example:
    >>> import numpy as np
    >>> lamp = LampLight("desk", np.array([1.0, 2.0, 4.0]), np.array([2.0]))
    >>> kept = KeptSpectra("uniform:1", (500, 502), np.array([501.0]), (lamp,), np.ones((1, 3)))
    >>> KeptSpectra.from_json(kept.to_json()).lamps[0].spectrum.tolist()
    [1.0, 2.0, 4.0]
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.errors import ImageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["MOST_REFLECTANCES", "KeptSpectra", "LampLight"]

MOST_REFLECTANCES = 64
"""The most reflectances that a file holds; of more, as many are taken, evenly among them."""

DIGITS = 9


@dataclass(frozen=True, eq=False)
class LampLight:
    """The light of one lamp.

    Attributes:
        name: as in the scene, and in the layers `lamp:NAME` and `spectra:NAME`.
        spectrum: (n,) at every nm of the range.
        lanes: (N,) in the lanes of the sampling.
    """

    name: str
    spectrum: Array
    lanes: Array


@dataclass(frozen=True, eq=False)
class KeptSpectra:
    """What the lanes of an image mean.

    Attributes:
        sampling: name of the spectral sampling.
        range_nm: first and last wavelength that were carried, whole nm.
        wavelengths_nm: (N,) of the lanes, increasing.
        lamps: the lamps of the scene.
        reflectances: (M, n) of what stands in the scene, at every nm of the range.
        develop_for: lamps under which the sampling was made to serve too.
        fog: whether a part of the light is that of no lamp.
    """

    sampling: str
    range_nm: tuple[int, int]
    wavelengths_nm: Array
    lamps: tuple[LampLight, ...]
    reflectances: Array
    develop_for: tuple[str, ...] = ()
    fog: bool = False

    @property
    def every_nm(self) -> Array:
        """(n,) the wavelengths of spectra and reflectances."""
        import numpy as np

        return np.arange(self.range_nm[0], self.range_nm[1] + 1, dtype=np.float64)

    @classmethod
    def of_render(
        cls, render: Any, range_nm: Sequence[float], sampling: str, develop_for: Sequence[str], fog: bool
    ) -> KeptSpectra:
        """What the core says of a render; lanes in the order of their wavelengths.

        Args:
            render: the core's.
            range_nm: first and last wavelength of the scene.
            sampling: name of the spectral sampling.
            develop_for: names of the lamps that the fit was to serve too.
            fog: whether the scene has an atmosphere.
        """
        import numpy as np

        order = np.argsort(render.wavelengths(), kind="stable")
        lamps = tuple(
            LampLight(name, np.asarray(spectrum), np.asarray(lanes)[order])
            for name, spectrum, lanes in render.lamp_spectra()
        )
        first, last = (int(nm) for nm in range_nm)
        reflectances = render.reflectances()
        if len(reflectances) > MOST_REFLECTANCES:
            chosen = np.linspace(0, len(reflectances) - 1, MOST_REFLECTANCES).astype(int)
            reflectances = [reflectances[i] for i in chosen]
        return cls(
            sampling,
            (first, last),
            np.asarray(render.wavelengths())[order],
            lamps,
            np.reshape(reflectances, (-1, last - first + 1)),
            tuple(develop_for),
            fog,
        )

    def to_json(self) -> str:
        """As text, numbers to nine digits; lamps of one relative spectrum share a curve."""
        import numpy as np

        curves: list[list[float]] = []
        lanes: list[list[float]] = []
        lamps = []
        for lamp in self.lamps:
            factor = float(np.abs(lamp.spectrum).max(initial=0.0)) or 1.0
            curve, own = _rounded(lamp.spectrum / factor), _rounded(lamp.lanes / factor)
            pairs = list(zip(curves, lanes, strict=True))
            if (curve, own) not in pairs:
                pairs.append((curve, own))
                curves.append(curve)
                lanes.append(own)
            lamps.append({"name": lamp.name, "curve": pairs.index((curve, own)), "factor": factor})
        return json.dumps(
            {
                "sampling": self.sampling,
                "range_nm": list(self.range_nm),
                "wavelengths_nm": self.wavelengths_nm.tolist(),
                "curves": curves,
                "lanes": lanes,
                "lamps": lamps,
                "reflectances": [_rounded(row, 6) for row in self.reflectances],
                "develop_for": list(self.develop_for),
                "fog": self.fog,
            }
        )

    @classmethod
    def from_json(cls, text: str) -> KeptSpectra:
        """From what `to_json` wrote.

        Raises:
            ImageError: it is damaged.
        """
        import numpy as np

        try:
            found = json.loads(text)
            first, last = (int(nm) for nm in found["range_nm"])
            wavelengths = np.array(found["wavelengths_nm"], np.float64)
            points, count = last - first + 1, len(wavelengths)
            curves = np.array(found["curves"], np.float64).reshape(-1, points)
            lanes = np.array(found["lanes"], np.float64).reshape(-1, count)
            with np.errstate(all="ignore"):  # what is no number is refused below
                lamps = tuple(
                    LampLight(
                        str(lamp["name"]),
                        curves[int(lamp["curve"])] * float(lamp["factor"]),
                        lanes[int(lamp["curve"])] * float(lamp["factor"]),
                    )
                    for lamp in found["lamps"]
                )
            reflectances = np.array(found["reflectances"], np.float64).reshape(-1, points)
            numbers = [wavelengths, curves, lanes, reflectances]
            of_lamps = [part for lamp in lamps for part in (lamp.spectrum, lamp.lanes)]
            if (
                not all(np.isfinite(array).all() for array in [*numbers, *of_lamps])
                or not (np.diff(wavelengths) > 0).all()
            ):
                raise ValueError
            return cls(
                str(found["sampling"]),
                (first, last),
                wavelengths,
                lamps,
                reflectances,
                tuple(str(name) for name in found["develop_for"]),
                bool(found["fog"]),
            )
        except (ValueError, KeyError, TypeError, IndexError, AttributeError, OverflowError, RecursionError):
            raise ImageError(
                "its attribute illuminant:basis, which says what its lanes mean, is damaged"
            ) from None


def _rounded(values: Array, digits: int = DIGITS) -> list[float]:
    return [float(f"{value:.{digits}g}") for value in values.tolist()]
