"""What a render leaves: its files, and what is said of them and of dropped samples."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from illuminant.settings import SCANLINE

if TYPE_CHECKING:
    from illuminant.image import Image, Saved
    from illuminant.job import Job

__all__ = ["again_command", "facts", "print_path", "save", "say_dropped", "say_exposure"]

_NOT_OF_A_PATH = {"threads", "layers", "keep_spectra", "lamps", "time"}

SHOWN = 3
"""How many dropped samples are named one by one."""


def again_command(scene: Path, options: dict[str, Any], allow_outside: bool) -> str:
    """The command that follows a path of this render again, up to the pixel: all options that a path depends on."""
    import shlex

    given: list[str] = []
    for name, value in options.items():
        if value is not None and name not in _NOT_OF_A_PATH:
            word = f"--{name.replace('_', '-')}"
            given += [word] if value is True else [word, str(value)]
    given += ["--allow-outside"] if allow_outside else []
    return shlex.join(["illuminant", "render", str(scene), *given])


def save(image: Image, path: Path, *, half: bool, **look: Any) -> Saved:
    """Save an image whose work shall not be lost: without half floats if it must, in another folder if it must."""
    import tempfile

    from illuminant import exr
    from illuminant.cli.report import warning
    from illuminant.errors import ImageError, MachineError

    if half and path.suffix.lower() == ".exr" and not exr.fits_half(image.xyz, *image.layers.values()):
        warning(f"{path} has 32-bit floats, since a value of this image is above 65504.")
        half = False
    try:
        return image.save(path, half=half, **look)
    except (ImageError, MachineError) as error:
        folder = None
        try:
            folder = Path(tempfile.mkdtemp(prefix="illuminant-"))
            kept = folder / path.name
            image.save(kept, half=half, **look)
        except (ImageError, MachineError, OSError):
            if folder is not None:
                with suppress(OSError):
                    folder.rmdir()
            raise error from None
        raise type(error)(f"{str(error).rstrip('.')}; the image is kept as {kept}.") from error


def facts(job: Job, image: Image, saved: list[Saved], again: str) -> dict[str, Any]:
    """What the closing line and `--json` say."""
    found = image.statistics
    seconds = float(found["wall_seconds"])
    samples = float(found["samples"])
    shown = next((item for item in saved if item.exposure is not None), None)
    return {
        "files": [item.path for item in saved],
        "seconds": seconds,
        "samples": int(samples),
        "samples_per_pixel": found["samples_per_pixel"],
        "msamples_per_second": samples / max(seconds, 1e-9) / 1e6,
        "mrays_per_second": float(found["rays"]) / max(seconds, 1e-9) / 1e6,
        "peak_memory": int(found["peak_memory"]),
        "spectral_error": job.spectral_error(),
        "dropped": int(found["dropped"]),
        "dropped_samples": [
            {**item, "again": None if job.settings.technique in SCANLINE else _follow(again, item)}
            for item in found["dropped_samples"]
        ],
        "unit": image.unit,
        "exposure": shown.exposure if shown else None,
        "outside_gamut": shown.outside if shown else None,
        "white": image.white(),
        "settings": image.settings,
    }


def say_exposure(saved: list[Saved], image: Image) -> None:
    """Say which exposure a PNG was given, if nobody had chosen one, and how much of it lay outside the gamut."""
    from illuminant.cli.report import note

    shown = next((item for item in saved if item.exposure is not None), None)
    if shown is None:
        return
    if not image.xyz.any():
        note("The image is black.")
    elif shown.chosen and shown.exposure:
        white = f"{0.8 / shown.exposure:.4g} {image.unit}"
        note(f"White, {white}, is shown as 0.8; --exposure {shown.exposure:g} repeats it.")
    if shown.outside and shown.outside >= 0.0005:
        note(
            f"{100 * shown.outside:.1f} % of the pixels are outside the gamut or above white, and were moved."
        )


def _follow(again: str, item: dict[str, Any]) -> str:
    """The command that follows a dropped sample again."""
    x, y = item["pixel"]
    return f"{again} --pixel {x},{y} --sample {item['sample']}"


def say_dropped(facts: dict[str, Any]) -> None:
    """Name the first dropped samples, and the command that follows one again."""
    from illuminant.cli.report import warning

    dropped = facts["dropped_samples"]
    for item in dropped[:SHOWN]:
        x, y = item["pixel"]
        where = f"object {item['object']}, material {item['material']}" if item["object"] else "no object"
        follow = f"; to follow it again: {item['again']}" if item["again"] else ""
        warning(f"Sample {item['sample']} of pixel {x},{y} is no radiance and was dropped ({where}){follow}")
    if facts["dropped"] > SHOWN:
        warning(f"{facts['dropped']:,} samples were dropped in all; --json names the first {len(dropped)}.")


def print_path(job: Job, pixel: str, sample: int, json: bool) -> None:
    """Follow one path again and print its vertices, one a line."""
    from illuminant.cli.report import emit_json
    from illuminant.rendering import replay_job
    from illuminant.settings import pixel as parse

    path = replay_job(job, parse(pixel), sample)
    if json:
        emit_json(path)
        return
    for number, vertices in enumerate(path["passes"]):
        if len(path["passes"]) > 1:
            typer.echo(f"pass {number}")
        if not vertices:
            typer.echo("nothing was hit")
        for index, vertex in enumerate(vertices):
            typer.echo(
                f"{index:3}  {vertex['object']} ({vertex['material']}) at {_short(vertex['position'])}"
            )
            typer.echo(f"     throughput {_short(vertex['throughput'])}")
            typer.echo(f"     added      {_short(vertex['added'])}")
    typer.echo(f"XYZ  {_short(path['xyz'])}")


def _short(value: Any) -> str:
    """A value for a line of text: numbers to five digits, long lists cut."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, float):
        return f"{value:.5g}"
    if isinstance(value, (list, tuple)):
        shown = ", ".join(_short(item) for item in value[:4])
        return f"({shown}, ... {len(value)} in all)" if len(value) > 4 else f"({shown})"
    return str(value)
