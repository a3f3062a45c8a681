"""The viewer: walk through a scene in a browser, change it, measure it (`illuminant view`).

    view(scene)      a running `Viewer`; its `url` is the page, and a notebook shows it inline

Every pixel is drawn by the renderers of illuminant and sent as PNG; the browser draws controls and charts (viser).

Example:
    >>> from illuminant.viewer import view
    >>> with view("scenes/cornell.toml") as viewer:      # doctest: +SKIP
    ...     print(viewer.url)
    ...     viewer.wait()
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import os

    from illuminant.scene import Scene
    from illuminant.viewer.server import Viewer

__all__ = ["view"]


def view(scene: Scene | str | os.PathLike[str], **options: Any) -> Viewer:
    """Open a scene in a browser.

    Args:
        scene: a `Scene`, or the path of a scene file.
        options: `host`, `port`, `folder`, `technique`, `illumination`, `sampling`, as `Viewer` takes them.

    Returns:
        The viewer; `stop` ends it.
    """
    from illuminant.viewer.server import Viewer

    return Viewer(scene, **options)
