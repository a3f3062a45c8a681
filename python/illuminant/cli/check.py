"""`illuminant check`: every mistake of a scene, without rendering it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from illuminant.cli.options import AllowOutside, Json

__all__ = ["check"]


def check(
    scenes: Annotated[
        list[Path] | None, typer.Argument(metavar="SCENE", help="Scene files (TOML).", show_default=False)
    ] = None,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print every table and key of a scene file, with an example.")
    ] = False,
    allow_outside: AllowOutside = False,
    json: Json = False,
) -> None:
    """Report every mistake of a scene without rendering it.

    Each mistake is one line: file, line, table, key, and what was expected. Ends with 1 if there is any.

    \b
    Example:
      illuminant check room.toml
    """
    from illuminant import examination, scene_file, sources
    from illuminant.cli.report import emit_json, warning
    from illuminant.errors import Problem, SceneError, UsageError
    from illuminant.scene import Scene

    if schema:
        typer.echo(scene_file.schema_text().rstrip("\n"))
        return
    if not scenes:
        raise UsageError("Name a scene file, or use --schema to print what may stand in one.")
    for path in scenes:
        try:
            sources.check(path, sys.maxsize)
        except sources.SourceError as error:
            raise UsageError(f"{error}.") from None
    problems: dict[str, list[Problem]] = {}
    for path in scenes:
        try:
            scene = Scene.load(path, allow_outside=allow_outside)
            problems[str(path)] = examination.problems(scene)
        except SceneError as error:
            problems[str(path)] = error.problems
        if not problems[str(path)]:
            for text in examination.warnings(scene):
                warning(f"{path}: {text}" if len(scenes) > 1 else text)
    count = sum(len(found) for found in problems.values())
    if json:
        emit_json(
            [
                {
                    "file": problem.file or name,
                    "line": problem.line,
                    "table": problem.table,
                    "key": problem.key,
                    "kind": problem.kind,
                    "message": problem.message,
                    "hint": problem.hint,
                }
                for name, found in problems.items()
                for problem in found
            ]
        )
    else:
        for name, found in problems.items():
            for problem in found:
                typer.echo(str(problem))
            if not found:
                typer.echo(f"{name}: no mistakes")
    if count:
        raise typer.Exit(1)
