"""`illuminant radiosity show`: what a solution looks like, and what it says."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli.options import Exposure, Gather, Json
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.radiosity import Solution

__all__ = ["show"]

VECTOR = "three numbers, such as 1,1.6,3"


def show(
    solution: Annotated[Path, typer.Argument(metavar="SOLUTION", help="A solution.", show_default=False)],
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Image .png or .exr, mesh .glb, or illuminance .csv; may be given again.",
            show_default=False,
        ),
    ] = None,
    eye: Annotated[
        str | None,
        typer.Option("--eye", metavar="X,Y,Z", help="Where the eye is, in the scene's unit (the scene's)."),
    ] = None,
    target: Annotated[
        str | None, typer.Option("--target", metavar="X,Y,Z", help="Where it looks (the scene's).")
    ] = None,
    size: Annotated[str | None, typer.Option("--size", metavar="WxH", help="Pixels (the camera's).")] = None,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help="Samples of each pixel (16).")
    ] = None,
    gather: Gather = None,
    exposure: Exposure = None,
    grid: Annotated[
        str | None,
        typer.Option(
            "--grid",
            metavar="X0,Y0,Z0:X1,Y1,Z1:NxM",
            help="For .csv: sensors spread over a rectangle with these opposite corners, in metres, that face up.",
        ),
    ] = None,
    sensors: Annotated[
        Path | None,
        typer.Option(
            "--sensors",
            metavar="FILE",
            help="For .csv: a CSV file with the columns x, y, z in metres, and nx, ny, nz, which each faces.",
        ),
    ] = None,
    luminance: Annotated[
        Path | None,
        typer.Option("--luminance", metavar="FILE", help="A map of luminance in false colours, .png."),
    ] = None,
    json: Json = False,
) -> None:
    """Say what a solution is; write its image, its mesh, or illuminance at sensors.

    \b
    Examples:
      illuminant radiosity show room.solution -o room.png --gather full
      illuminant radiosity show room.solution -o room.glb
      illuminant radiosity show room.solution -o desk.csv --grid 0,0.8,0:4,0.8,3:16x12
    """
    from illuminant import output as files
    from illuminant import radiosity
    from illuminant.cli.radiosity.report import closing, facts
    from illuminant.cli.report import emit_json, note
    from illuminant.errors import UsageError

    paths = [files.check(path) for path in dict.fromkeys(output or [])]
    kinds = {path: path.suffix.lower() for path in paths}
    for path, kind in kinds.items():
        if kind not in (".png", ".exr", ".glb", ".csv"):
            raise UsageError(f"{path}: expected a name that ends with .png, .exr, .glb or .csv.")
    tables = [path for path, kind in kinds.items() if kind == ".csv"]
    if tables and (grid is None) == (sensors is None):
        raise UsageError(f"{tables[0]}: illuminance needs places: give --grid or --sensors.")
    if not tables and (grid or sensors):
        raise UsageError("--grid and --sensors go with an output that ends with .csv.")
    found = radiosity.Solution.load(solution)
    report: dict[str, Any] = facts(found) | {"file": solution, "outputs": [str(path) for path in paths]}
    camera = {
        key: numbers(text, f"--{key}", VECTOR, count=3)
        for key, text in (("eye", eye), ("target", target))
        if text is not None
    }
    pictures = [path for path, kind in kinds.items() if kind in (".png", ".exr")]
    if pictures or luminance is not None:
        image = found.render(
            camera=camera or None, size=size, samples=16 if samples is None else samples, gather=gather
        )
        for path in pictures:
            saved = image.save(path, exposure=exposure)
            report |= {"exposure": saved.exposure}
        if luminance is not None:
            from illuminant.plots.luminance import save_map

            save_map(image, luminance)
    for path, kind in kinds.items():
        if kind == ".glb":
            report |= {"exposure": found.save_mesh(path, exposure=exposure)}
    for path in tables:
        report |= _write_illuminance(found, path, grid, sensors)
    if json:
        emit_json(report)
    else:
        note(closing(str(solution), report))
        if "mean_lx" in report:
            note(
                f"illuminance: mean {report['mean_lx']:.4g} lx, least {report['least_lx']:.4g}, most "
                f"{report['most_lx']:.4g}, uniformity {report['uniformity']:.3f}"
            )


def _grid(text: str) -> list[list[float]]:
    """Points in the middle of equal parts of a rectangle."""
    import re

    from illuminant.errors import UsageError

    parts = text.split(":")
    match = re.fullmatch(r"(\d{1,5})[xX×](\d{1,5})", parts[2]) if len(parts) == 3 else None
    if match is None or 0 in (int(match[1]), int(match[2])):
        raise UsageError(
            f"--grid {text}: expected two corners and a number of points, such as 0,0.8,0:4,0.8,3:16x12."
        )
    low, high = (numbers(part, "--grid", VECTOR, count=3) for part in parts[:2])
    # The axis along which the corners agree is the one that the grid does not spread over.
    flat = min(range(3), key=lambda axis: abs(high[axis] - low[axis]))
    first, second = (axis for axis in range(3) if axis != flat)
    points = []
    for j in range(int(match[2])):
        for i in range(int(match[1])):
            point = list(low)
            point[first] += (high[first] - low[first]) * (i + 0.5) / int(match[1])
            point[second] += (high[second] - low[second]) * (j + 0.5) / int(match[2])
            points.append(point)
    return points


def _write_illuminance(
    solution: Solution, path: Path, grid: str | None, sensors: Path | None
) -> dict[str, float]:
    import numpy as np

    from illuminant import output as files
    from illuminant.sensor_file import read

    facing = (0.0, 0.0, 1.0) if solution.scene.frame.get("up") == "z" else (0.0, 1.0, 0.0)
    if sensors is not None:
        table = read(sensors, up=facing)
        points, normals = table.points, table.normals
    else:
        points = _grid(grid or "")
        normals = [list(facing)] * len(points)
    xyz = solution.irradiance_xyz(points, normals)
    lines = ["x,y,z,nx,ny,nz,illuminance_lx,X,Z"]
    for place, normal, (x, y, z) in zip(points, normals, xyz, strict=True):
        lines.append(",".join(f"{value:.6g}" for value in (*place, *normal, y, x, z)))
    files.write_bytes(path, ("\n".join(lines) + "\n").encode())
    lux = xyz[:, 1]
    mean = float(np.mean(lux))
    return {
        "mean_lx": mean,
        "least_lx": float(lux.min()),
        "most_lx": float(lux.max()),
        "uniformity": float(lux.min() / mean) if mean > 0 else 0.0,
    }
