"""OpenColorIO: a studio's own way from scene to display, in place of ours (optional).

A config names displays and, for each, views. What it makes is taken as it is: exposure comes before, dither and bits
after, and the gamut's method is the config's own. Colour goes in as ACES2065-1, through the config's role
`aces_interchange`: XYZ relative to D65, adapted to the white of ACES by Bradford, as the standard configs do. A
config is a file (`.ocio`, `.ocioz`) or one of those inside the library (`ocio://default`).

OpenColorIO comes with OpenImageIO; nothing more is installed.

Reference: OpenColorIO 2, documentation of roles and built-in configs; SMPTE ST 2065-1:2021.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from illuminant.display.displays import Display, named
from illuminant.errors import DataError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["Config"]

_ROLE = "aces_interchange"

# H.273: primaries and transfer of the displays that are known here.
_BY_CODE_POINT = {
    (1, 13): "sRGB",
    (1, 1): "Rec.709",
    (12, 13): "Display P3",
    (9, 16): "Rec.2020 PQ",
    (9, 18): "Rec.2020 HLG",
}


class Config:
    """An OpenColorIO config.

    Args:
        source: a file, or `ocio://NAME`.

    Raises:
        DataError: the file is not there or no config, or the config has no role `aces_interchange`.

    Example:
        >>> config = Config("ocio://default")
        >>> config.displays()[0]
        'sRGB - Display'
        >>> "Un-tone-mapped" in config.views("sRGB - Display")
        True
    """

    def __init__(self, source: str | os.PathLike[str]) -> None:
        import OpenImageIO as oiio

        self.source = os.fspath(source)
        if not self.source.startswith("ocio://") and not os.path.isfile(self.source):
            raise DataError(f"{self.source} cannot be read: there is no such file.")
        self._config = oiio.ColorConfig(self.source)
        trouble = str(self._config.geterror())
        if trouble or not self._config.getDisplayNames():
            reason = " ".join(trouble.split()).rstrip(".") or "it names no display"
            raise DataError(f"{self.source} is no OpenColorIO config: {reason[:200]}.")
        if not self._config.getColorSpaceNameByRole(_ROLE):
            raise DataError(f"{self.source} has no role {_ROLE}, by which colour could be handed to it.")

    def displays(self) -> list[str]:
        """The displays that the config names."""
        return [str(name) for name in self._config.getDisplayNames()]

    def views(self, display: str) -> list[str]:
        """The views of a display."""
        return [str(name) for name in self._config.getViewNames(display)]

    def chosen(self, display: str | None, view: str | None) -> tuple[str, str]:
        """A display and a view of this config; its defaults where none is named.

        Raises:
            UsageError: there is none of that name; the sentence lists those there are.
        """
        display = display or str(self._config.getDefaultDisplayName())
        if display not in self.displays():
            raise UsageError(
                f"{self.source} has no display {display!r}: it has {', '.join(self.displays())}."
            )
        view = view or str(self._config.getDefaultViewName(display))
        if view not in self.views(display):
            raise UsageError(
                f"{self.source} has no view {view!r} of {display}: it has {', '.join(self.views(display))}."
            )
        return display, view

    def described(self, display: str, view: str) -> Display | None:
        """The display that shows what the config makes, if its colour space has a code point that is known here."""
        space = self._config.getDisplayViewColorSpaceName(display, view)
        code = self._config.get_cicp(space) if space else None
        name = _BY_CODE_POINT.get((code[0], code[1])) if code else None
        return None if name is None else named(name)

    def values(self, xyz: Array, exposure: float, display: str, view: str) -> Array:
        """Code values 0 to 1 (h, w, 3) of an image of XYZ, as the config makes them.

        Raises:
            DataError: OpenColorIO fails; the sentence has its reason.
        """
        import numpy as np
        import OpenImageIO as oiio

        from illuminant import color

        aces = named("ACES AP0")
        aces_white = aces.to_xyz_matrix.sum(axis=1)
        adapted = color.adaptation_matrix("D65", (aces_white[0], 1.0, aces_white[2]), method="Bradford")
        to_aces = aces.from_xyz_matrix @ np.asarray(adapted) * exposure
        pixels = np.nan_to_num(xyz @ to_aces.T, nan=0.0, posinf=65504.0, neginf=0.0).astype(np.float32)
        source = oiio.ImageBuf(np.ascontiguousarray(pixels))
        made = oiio.ImageBufAlgo.ociodisplay(source, display, view, fromspace=_ROLE, colorconfig=self.source)
        if made.has_error:
            raise DataError(f"{self.source}: {' '.join(made.geterror().split()).rstrip('.')}.")
        return np.asarray(made.get_pixels(oiio.FLOAT), np.float64)[..., :3]
