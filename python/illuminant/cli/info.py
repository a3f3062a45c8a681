"""`illuminant info`: what was found on this machine, or in an image."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

import typer

from illuminant.cli.options import Json

__all__ = ["info"]


def info(
    image: Annotated[
        Path | None,
        typer.Argument(
            metavar="IMAGE", help="Show the header of this .exr, .png or .rle.", show_default=False
        ),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Option(
            "--scene",
            metavar="SCENE",
            help="Check that the image was made from this scene as it is now (exit code 1 if not).",
            show_default=False,
        ),
    ] = None,
    json: Json = False,
) -> None:
    """Say what was found on this machine and what to do about the rest; or what an image says of itself, and the
    command that makes it again.

    \b
    Examples:
      illuminant info room.exr
      illuminant info room.exr --scene room.toml
    """
    from illuminant import info as facts_of
    from illuminant.cli.report import emit_json
    from illuminant.errors import UsageError

    if scene is not None and image is None:
        raise UsageError("--scene: goes with an image.")
    facts = facts_of.machine_facts() if image is None else facts_of.image_facts(image)
    if scene is not None:
        facts["same_scene"] = facts_of.same_scene(facts["settings"], scene)
    if json:
        emit_json(facts)
    elif image is None:
        _print_machine(facts)
    else:
        _print_image(facts)
        if scene is not None:
            made = "made from it as it is now" if facts["same_scene"] else "NOT made from it as it is now"
            typer.echo(f"\n{scene}: the image was {made}.")
    if not facts.get("same_scene", True):
        raise typer.Exit(1)


def _line(name: str, value: Any, remedy: str | None = None) -> None:
    typer.echo(f"{name:<16}{value}")
    if remedy:
        typer.echo(f"{'':<16}-> {remedy}")


def _print_machine(facts: dict[str, Any]) -> None:
    from illuminant.machine import size

    for name in ("illuminant", "python"):
        _line(name, f"{facts[name]['version']}  ({facts[name]['path']})")
    _line("core", facts["core"]["version"] or "not found", facts["core"].get("remedy"))
    embree = facts["embree"]
    found = f"{embree['version']}  ({Path(embree['path']).name})" if embree["version"] else "not found"
    _line("Embree", found, embree.get("remedy"))
    cpu = facts["processor"]
    _line("processor", cpu["model"])
    _line("", f"{cpu['level']}{'; ' if cpu['wide'] else ''}{', '.join(cpu['wide'])}", cpu.get("remedy"))
    _line("cores", f"{cpu['cores']} usable")
    memory = facts["memory"]
    if memory["total"] and memory["available"]:
        _line("memory", f"{size(memory['available'])} free of {size(memory['total'])}")
    for name, package in facts["packages"].items():
        _line(name, f"{package['version'] or 'not found'}  for {package['for']}", package.get("remedy"))


def _print_image(facts: dict[str, Any]) -> None:
    width, height = facts["size"]
    _line("file", facts["file"])
    _line("size", f"{width}x{height}")
    _line("format", facts["format"])
    if facts.get("unit"):
        _line("unit", facts["unit"])
    if facts.get("exposure"):
        _line("exposure", f"{facts['exposure']:g}")
    if facts.get("layers"):
        _line("layers", ", ".join(f"{name} ({count})" for name, count in facts["layers"].items()))
    lanes = facts.get("wavelengths_nm")
    if lanes:
        _line("wavelengths", f"{len(lanes)}, {lanes[0]:g} to {lanes[-1]:g} nm")
    for key, value in facts["settings"].items():
        if key == "developed":
            _print_developed(value)
            continue
        if isinstance(value, list):
            value = {"samples": " to ", "size": "x"}.get(key, ",").join(map(str, value))
        _line(key.replace("_", " "), "no limit" if key == "depth" and value is None else value)
    if facts.get("remake"):
        version = facts["settings"].get("version")
        by = f", by illuminant {version}" if version else ""
        typer.echo(f"\nMake it again with{by}:\n  {facts['remake']}")


def _print_developed(stages: Any) -> None:
    """Say what an image was made into without rendering again."""
    from illuminant.display.developing import described

    said = [line for stage in stages if isinstance(stage, dict) for line in described(stage)]
    for number, line in enumerate(said):
        _line("" if number else "developed", line)
