"""Images whose colours can be trusted: from measured lamps and materials to a calibrated display.

The seven names that most people need are here; everything else lives in the module of its concern
(`illuminant.spectra`, `illuminant.image`, `illuminant.errors` and so on).

    load(path)            read a scene file (`illuminant.scene.Scene`)
    render(scene, ...)    make an `Image` of a scene or of a scene file
    compare(scene, ...)   one scene by every technique and illumination model
    diff(a, b)            CIEDE2000 and FLIP between two images
    view(scene)           walk through a scene in a browser
    audit(material)       where the light goes that reaches a material, and which laws its model keeps
    Scene, Image          what the first two return
    Error                 base of every error raised on purpose; its kinds are in `illuminant.errors`

Importing this package loads neither NumPy nor any other large package nor any data: each name is looked up
when it is first used. Images hold absolute XYZ, so that Y is a luminance in cd/m².

Example:
    >>> import illuminant
    >>> image = illuminant.render("scenes/cornell.toml", samples=64)  # doctest: +SKIP
    >>> image.xyz[..., 1].mean()                                      # doctest: +SKIP
    >>> image.save("cornell.png")                                     # doctest: +SKIP
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.auditing import audit
    from illuminant.comparison import compare
    from illuminant.difference import diff
    from illuminant.errors import (
        DataError,
        Error,
        ImageError,
        Interrupted,
        MachineError,
        SceneError,
        UsageError,
    )
    from illuminant.image import Image
    from illuminant.rendering import render
    from illuminant.scene import Scene, load
    from illuminant.viewer import view

    __version__: str

__all__ = [
    "DataError",
    "Error",
    "Image",
    "ImageError",
    "Interrupted",
    "MachineError",
    "Scene",
    "SceneError",
    "UsageError",
    "__version__",
    "audit",
    "compare",
    "diff",
    "load",
    "render",
    "view",
]

# Where each name lives. No module may bear the name of a function in this table: importing it would replace the
# function by the module (hence `rendering` and `difference`).
_HOME = {
    "DataError": "errors",
    "Error": "errors",
    "Image": "image",
    "ImageError": "errors",
    "Interrupted": "errors",
    "MachineError": "errors",
    "Scene": "scene",
    "SceneError": "errors",
    "UsageError": "errors",
    "audit": "auditing",
    "compare": "comparison",
    "diff": "difference",
    "load": "scene",
    "render": "rendering",
    "view": "viewer",
}


def __getattr__(name: str) -> Any:
    """Look up a lazy name of this package and keep it (PEP 562)."""
    from importlib import import_module

    if name == "__version__":
        from importlib.metadata import version

        value: Any = version("illuminant")
    elif name in _HOME:
        value = getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Names that exist already and those that are looked up on first use."""
    return sorted({*globals(), *__all__})
