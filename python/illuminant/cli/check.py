"""`illuminant check`: every mistake of a scene, without rendering it."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import Json

__all__ = ["check"]


def check(
    scenes: Annotated[
        list[Path] | None, typer.Argument(metavar="SCENE", help="Scene files (TOML).", show_default=False)
    ] = None,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print every table and key of a scene file, with an example.")
    ] = False,
    json: Json = False,
) -> None:
    """Report every mistake of a scene without rendering it.

    Each mistake is one line: file, line, table, key, and what was expected. Ends with 1 if there is any.

    \b
    Example:
      illuminant check room.toml
    """
    from illuminant import scene_file
    from illuminant.cli.report import emit_json
    from illuminant.errors import UsageError

    if schema:
        typer.echo(scene_file.schema_text().rstrip("\n"))
        return
    if not scenes:
        raise UsageError("Name a scene file, or use --schema to print what may stand in one.")
    for scene in scenes:
        if not scene.is_file():
            raise UsageError(f"{scene}: there is no such file.")
    problems = {str(path): list(scene_file.check(path)) for path in scenes}
    count = sum(len(found) for found in problems.values())
    if json:
        emit_json(
            [
                {
                    "file": problem.file or path,
                    "line": problem.line,
                    "table": problem.table,
                    "key": problem.key,
                    "kind": problem.kind,
                    "message": problem.message,
                    "hint": problem.hint,
                }
                for path, found in problems.items()
                for problem in found
            ]
        )
    else:
        for path, found in problems.items():
            for problem in found:
                typer.echo(str(problem))
            if not found:
                typer.echo(f"{path}: no mistakes")
    if count:
        raise typer.Exit(1)
