"""`illuminant view`: a scene in a browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import AllowOutside, Json

__all__ = ["view"]


def view(
    scene: Annotated[Path, typer.Argument(metavar="SCENE", help="A scene file.", show_default=False)],
    technique: Annotated[
        str | None, typer.Option("--technique", metavar="NAME", help="At the start (the scene's).")
    ] = None,
    illumination: Annotated[
        str | None, typer.Option("--illumination", metavar="NAME", help="At the start (the scene's).")
    ] = None,
    sampling: Annotated[
        str | None, typer.Option("--sampling", metavar="NAME", help="At the start (fitted:8).")
    ] = None,
    host: Annotated[
        str, typer.Option("--host", metavar="ADDRESS", help="Address to listen on.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", metavar="N", help="Port; the next free one if it is taken.")
    ] = 8080,
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for what the page keeps.")
    ] = Path("."),
    allow_outside: AllowOutside = False,
    json: Json = False,
) -> None:
    """Walk through a scene in a browser: look, change, measure, keep.

    The page needs the address that is printed, which holds a token, and is reachable from this machine alone unless
    --host says otherwise. Ctrl-C ends the viewer.

    \b
    Example:
      illuminant view room.toml
      illuminant view room.toml --technique radiosity --port 9000
    """
    from illuminant.cli.report import emit_json, note, warning
    from illuminant.errors import UsageError
    from illuminant.viewer.guard import LOOPBACK
    from illuminant.viewer.server import Viewer

    if not output.is_dir():
        raise UsageError(f"{output}: there is no such folder.")
    with Viewer(
        scene,
        host=host,
        port=port,
        folder=output,
        allow_outside=allow_outside,
        technique=technique,
        illumination=illumination,
        sampling=sampling,
    ) as viewer:
        if viewer.problem is not None:
            warning(f"the page shows what is wrong with {scene}.")
        if host not in LOOPBACK:
            warning(
                f"every machine that reaches {host} can open this page if it learns the address with its token."
            )
        if json:
            emit_json({"url": viewer.url})
        else:
            note(f"Open {viewer.url}")
            note("Ctrl-C ends the viewer.")
        viewer.wait()
