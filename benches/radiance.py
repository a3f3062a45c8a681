"""Irradiance on the work plane of a furnished room beside Radiance: error against seconds.

    .venv/bin/python benches/radiance.py [--runs 3] [--error 0.003] [--peer .venv-bench/bin/python]

A room with grey diffuse surfaces (so that spectra do not matter) under one rectangular lamp of radiance
1 W/(m² sr); sensors face up on the work plane, and what is compared is their irradiance in W/m². Both sides of the
lamp are black apart from the light that its lower side gives. Seconds are by the clock, everything included that
starts from the description of the room (with Radiance: `oconv`, `rtrace` and the start of both), on two processes;
processor seconds, of all of them, vary less on a machine that is not quiet. Medians of runs, whose settings
alternate. Errors are relative, (E - R) / R with R the reference; RMS and largest over the sensors and runs.

The reference is neither Radiance nor illuminant but a Monte Carlo integral in NumPy, written here.
"""

from __future__ import annotations

import argparse
import hashlib
import inspect
import os
import statistics
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from converged import CACHE
from renderer_process import RendererProcess

BENCHES = Path(__file__).resolve().parent
PEER = BENCHES.parent / ".venv-bench" / "bin" / "python"
Point = tuple[float, float, float]


@dataclass(frozen=True)
class Box:
    """Furniture on the floor, its sides along the axes."""

    low: Point
    high: Point
    reflectance: float


@dataclass(frozen=True)
class Rectangle:
    """A face; edges[0] x edges[1] is the normal of the side that is seen (and, of a lamp, that shines)."""

    name: str
    corner: Point
    first: Point
    second: Point
    reflectance: float
    radiance: float = 0.0


@dataclass(frozen=True)
class Room:
    """The room from the origin to `size`, z up; lengths in m."""

    size: Point = (6.0, 4.0, 3.0)
    floor: float = 0.2
    walls: float = 0.5
    ceiling: float = 0.7
    lamp_low: Point = (2.4, 1.7, 2.95)
    lamp_size: tuple[float, float] = (1.2, 0.6)
    boxes: tuple[Box, ...] = (
        Box((0.75, 1.1, 0.0), (1.5, 1.8, 2.0), 0.3),
        Box((4.5, 2.55, 0.0), (5.25, 3.25, 1.6), 0.6),
    )
    sensor_grid: tuple[int, int] = (16, 11)
    sensor_height: float = 0.8

    def sensors(self) -> np.ndarray:
        """Middles of the cells of the grid, (n, 3), x fastest; without those that would be inside a box."""
        x, y = (
            (np.arange(count) + 0.5) / count * self.size[axis] for axis, count in enumerate(self.sensor_grid)
        )
        points = np.stack([*np.meshgrid(x, y), np.full((len(y), len(x)), self.sensor_height)], axis=-1)
        points = points.reshape(-1, 3)
        inside = [((points > box.low) & (points < box.high)).all(axis=1) for box in self.boxes]
        kept: np.ndarray = points[~np.any(inside, axis=0)]
        return kept

    def rectangles(self) -> list[Rectangle]:
        """Every surface; boxes without their lower faces."""
        (w, d, h), (a, b) = self.size, self.lamp_size
        found = [
            Rectangle("floor", (0, 0, 0), (w, 0, 0), (0, d, 0), self.floor),
            Rectangle("ceiling", (0, 0, h), (0, d, 0), (w, 0, 0), self.ceiling),
            Rectangle("south", (0, 0, 0), (0, 0, h), (w, 0, 0), self.walls),
            Rectangle("north", (0, d, 0), (w, 0, 0), (0, 0, h), self.walls),
            Rectangle("west", (0, 0, 0), (0, d, 0), (0, 0, h), self.walls),
            Rectangle("east", (w, 0, 0), (0, 0, h), (0, d, 0), self.walls),
            Rectangle("lamp", self.lamp_low, (0, b, 0), (a, 0, 0), 0.0, radiance=1.0),
        ]
        for i, box in enumerate(self.boxes):
            (x, y, z), low = box.low, box.low
            w, d, h = (box.high[k] - low[k] for k in range(3))
            top, right, back = (x, y, z + h), (x + w, y, z), (x, y + d, z)
            for name, corner, first, second in (
                ("top", top, (w, 0, 0), (0, d, 0)),
                ("south", low, (w, 0, 0), (0, 0, h)),
                ("north", back, (0, 0, h), (w, 0, 0)),
                ("west", low, (0, 0, h), (0, d, 0)),
                ("east", right, (0, d, 0), (0, 0, h)),
            ):
                found.append(Rectangle(f"box{i}_{name}", corner, first, second, box.reflectance))
        return found


@dataclass
class Row:
    """One setting of one program."""

    program: str
    setting: str
    irradiance: list[np.ndarray] = field(default_factory=list)  # of every run
    seconds: list[float] = field(default_factory=list)
    processor_seconds: list[float] = field(default_factory=list)


@dataclass(frozen=True)
class Setting:
    """What `rtrace` is told, and how often each sensor is asked (answers are averaged)."""

    options: str
    repeat: int = 1


# Direct light. Every part of the lamp is tested with a ray (-dt 0), none guessed (-dc 1). -ds bounds a part's side over
# its distance, *divided by the weight of the ray*, and there are at most 64 parts: at the end of a path of small weight
# the lamp is one point at its middle, which shifts indirect light (here 1 % of the first bounce, by place up to 10 %).
# `-dj 1` takes a random point of each part and so has no such bias, but noise at the sensors themselves.
# -aa 0 is Monte Carlo without a cache; -lw must then be below 0.8 / ad, or fewer than -ad rays are sent. A limit of
# reflections below zero is roulette, as is the default -lr -10, which then ends paths after ten.
_MIDDLE = "-dt 0 -dc 1 -ds 0.05 -dj 0"
_FINE = "-dt 0 -dc 1 -ds 0.02 -dj 0"
_RANDOM = "-dt 0 -dc 1 -ds 0.02 -dj 1"
_PATHS = f"-ab 12 -lr -12 -aa 0 -as 0 {_RANDOM}"
SETTINGS = {
    "cached, -ab 3 -aa 0.3 -ar 32 -ad 256": Setting(f"-ab 3 -aa 0.3 -ar 32 -ad 256 -as 0 -lw 4e-3 {_MIDDLE}"),
    "cached, -ab 4 -aa 0.25 -ar 16 -ad 512": Setting(
        f"-ab 4 -aa 0.25 -ar 16 -ad 512 -as 0 -lw 1e-3 {_MIDDLE}"
    ),
    "cached, -ab 5 -aa 0.2 -ar 32 -ad 512 -as 128": Setting(
        f"-ab 5 -aa 0.2 -ar 32 -ad 512 -as 128 -lw 1e-3 {_MIDDLE}"
    ),
    "cached, -ab 8 -aa 0.2 -ar 32 -ad 1024 -as 256": Setting(
        f"-ab 8 -aa 0.2 -ar 32 -ad 1024 -as 256 -lw 1e-4 {_FINE}"
    ),
    "Monte Carlo, -ad 64": Setting(f"-ad 64 -lw 2e-3 {_PATHS}"),
    "Monte Carlo, -ad 256": Setting(f"-ad 256 -lw 5e-4 {_PATHS}"),
    "Monte Carlo, -ad 1024": Setting(f"-ad 1024 -lw 1e-4 {_PATHS}"),
    "Monte Carlo, -ad 256, 32 times": Setting(f"-ad 256 -lw 5e-4 {_PATHS}", repeat=32),
}


def scene_text(room: Room) -> str:
    """The room in Radiance's language."""
    lines = []
    for face in room.rectangles():
        if face.radiance > 0.0:
            # A `light` shines from its front and is black otherwise.
            lines.append(f"void light {face.name}_m\n0\n0\n3 {' '.join([f'{face.radiance:.9g}'] * 3)}")
        else:
            grey = " ".join([f"{face.reflectance:.9g}"] * 3)
            lines.append(f"void plastic {face.name}_m\n0\n0\n5 {grey} 0 0")
        corner, first, second = (np.array(edge) for edge in (face.corner, face.first, face.second))
        corners = np.concatenate([corner, corner + first, corner + first + second, corner + second])
        numbers = " ".join(f"{x:.9g}" for x in corners)
        lines.append(f"{face.name}_m polygon {face.name}\n0\n0\n12 {numbers}")
    return "\n".join(lines) + "\n"


def radiance_rows(room: Room, peer: Path, runs: int, processes: int) -> list[Row]:
    """Radiance at every setting."""
    up = [0.0, 0.0, 1.0]
    asked = {"scene": scene_text(room), "sensors": [[*point, *up] for point in room.sensors().tolist()]}
    rows: dict[str, Row] = {}
    with (
        RendererProcess([str(peer), str(BENCHES / "radiance_peer.py")]) as process,
        tempfile.TemporaryDirectory() as folder,
    ):
        program = process.opening["version"]
        output = Path(folder) / "irradiance.npy"
        for _ in range(runs):
            for name, setting in SETTINGS.items():
                answer = process.ask(
                    **asked,
                    options=["-n", str(processes), *setting.options.split()],
                    repeat=setting.repeat,
                    output=str(output),
                )
                row = rows.setdefault(name, Row(program, name))
                row.seconds.append(answer["seconds"])
                row.processor_seconds.append(answer["processor_seconds"])
                row.irradiance.append(np.load(output))
    return list(rows.values())


RADIOSITY = {
    "1,500 elements, 256 rays": {"elements": 1500, "form_factors": "rays:256", "sensors": 256},
    "6,000 elements, 256 rays": {"elements": 6000, "form_factors": "rays:256", "sensors": 512},
    "12,000 elements, 256 rays": {"elements": 12000, "form_factors": "rays:256", "sensors": 1024},
    "24,000 elements, 512 rays": {"elements": 24000, "form_factors": "rays:512", "sensors": 4096},
}


def illuminant_rows(room: Room, runs: int, threads: int) -> list[Row]:
    """illuminant's radiosity at several settings.

    A lamp of luminance 1 cd/m² makes as many lux as one of radiance 1 W/(m² sr) makes W/m². Three samples, as Radiance
    has.
    """
    from illuminant import Scene, radiosity

    def grey(reflectance: float) -> dict[str, object]:
        return {"kind": "diffuse", "reflectance": reflectance}

    rows = {name: Row("illuminant radiosity", name) for name in RADIOSITY}
    for run in range(runs + 1):
        for name, told in RADIOSITY.items():
            begun, busy = time.monotonic(), time.process_time()
            faces = room.rectangles()
            materials = {
                face.name: grey(face.reflectance)
                if face.radiance == 0.0
                else {
                    "kind": "emitter",
                    "spectrum": "E",
                    "luminance_cd_m2": face.radiance,
                    "reflectance": 0.0,
                }
                for face in faces
            }
            objects = {}
            for face in faces:
                corner, first, second = (
                    np.array(edge, float) for edge in (face.corner, face.first, face.second)
                )
                corners = [corner, corner + first, corner + first + second, corner + second]
                objects[face.name] = {"rectangle": {"corners": corners}, "material": face.name}
            camera = {"eye": [3.0, 1.0, 1.5], "target": [3.0, 3.0, 1.2], "size": [16, 16]}
            scene = Scene.build(camera=camera, materials=materials, objects=objects, up="z")
            options = {key: value for key, value in told.items() if key != "sensors"}
            solution = radiosity.solve(scene, sampling="xyz", threads=threads, **options)
            found = solution.illuminance(room.sensors(), (0.0, 0.0, 1.0), samples=told["sensors"])
            if run == 0:
                continue  # to load what is loaded once
            row = rows[name]
            row.seconds.append(time.monotonic() - begun)
            row.processor_seconds.append(time.process_time() - busy)
            row.irradiance.append(found)
    return list(rows.values())


class Reference:
    """Irradiance by Monte Carlo: what the lamp sends, and paths that end by roulette; no bias.

    From a sensor, and from every point where a path meets a surface, one point of the lamp is tried with a ray;
    directions have the density cos/π. The first numbers of all paths of one pass are a Kronecker sequence (with the
    powers of the root of x^(d+1) = x + 1: Roberts 2018), shifted at random for every pass; later ones are
    independent. The spread of passes gives the standard error. Arrays are (3, n): x, y, z of n points.
    """

    DIMENSIONS = 6  # of the sequence: two directions and the points of the lamp tried after the first of them
    PATHS = 4096  # of a sensor in one pass
    LEAST, MOST = 8, 4000  # passes

    def __init__(self, room: Room, seed: int = 1) -> None:
        self.room = room
        self.rng = np.random.default_rng(seed)
        root = 1.0
        for _ in range(64):
            root = (1.0 + root) ** (1.0 / (self.DIMENSIONS + 1))
        steps = root ** -np.arange(1.0, self.DIMENSIONS + 1)
        self.sequence = steps[:, None] * np.arange(self.PATHS)

    def irradiance(self, error: float) -> tuple[np.ndarray, np.ndarray]:
        """Means and relative standard errors of all sensors; each has passes until the latter is below `error`."""
        found = np.array([self._sensor(sensor, error) for sensor in self.room.sensors()])
        return found[:, 0], found[:, 1]

    def _sensor(self, sensor: np.ndarray, error: float) -> tuple[float, float]:
        passes: list[float] = []
        while True:
            passes.append(self._pass(sensor))
            if len(passes) >= self.LEAST:
                mean = statistics.fmean(passes)
                spread = statistics.stdev(passes) / len(passes) ** 0.5 / mean
                if spread < error or len(passes) == self.MOST:
                    return mean, spread

    def _pass(self, sensor: np.ndarray) -> float:
        numbers = (self.sequence + self.rng.random((self.DIMENSIONS, 1))) % 1.0
        points = np.repeat(sensor[:, None], self.PATHS, axis=1)
        axis, sign = np.full(self.PATHS, 2), np.ones(self.PATHS)
        # The points of the lamp and the first directions share numbers: their sum is what is averaged.
        total = self._from_lamp(points, axis, sign, numbers[:2]).sum()
        weight, bounce = np.ones(self.PATHS), 0
        while len(weight):
            used = numbers[4 * bounce : 4 * bounce + 4]
            used = np.concatenate([used, self.rng.random((4 - len(used), len(weight)))])
            points, axis, sign, reflectance = self._follow(points, axis, sign, used[:2])
            alive = reflectance > 0.0
            if bounce >= 2:
                # Instead of being weakened, a path ends.
                alive = self.rng.random(len(weight)) < reflectance
            else:
                weight = weight * reflectance
            points, axis, sign, weight = points[:, alive], axis[alive], sign[alive], weight[alive]
            numbers, used = numbers[:, alive], used[:, alive]
            total += (weight * self._from_lamp(points, axis, sign, used[2:])).sum()
            bounce += 1
        return float(total) / self.PATHS

    def _from_lamp(
        self, points: np.ndarray, axis: np.ndarray, sign: np.ndarray, numbers: np.ndarray
    ) -> np.ndarray:
        """Irradiance from the lamp on surfaces whose normals are `sign` along `axis`, by one point of it."""
        low, (a, b) = self.room.lamp_low, self.room.lamp_size
        way = (
            np.stack([low[0] + a * numbers[0], low[1] + b * numbers[1], np.full(len(axis), low[2])]) - points
        )
        square = (way**2).sum(axis=0)
        cosines = np.maximum(sign * np.choose(axis, way), 0.0) * np.maximum(way[2], 0.0) / square
        seen = cosines > 0.0
        for box in self.room.boxes:
            near, far = slabs(points, way, box.low, box.high)
            near, far = near.max(axis=0), far.min(axis=0)
            seen &= ~((near < far) & (near > 0.0) & (near < 1.0))
        irradiance: np.ndarray = np.where(seen, a * b * cosines / square, 0.0)
        return irradiance

    def _follow(
        self, points: np.ndarray, axis: np.ndarray, sign: np.ndarray, numbers: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Where rays in directions of density cos/π end: points, axes and signs of normals, reflectances."""
        room = self.room
        radius, angle = np.sqrt(numbers[0]), 2.0 * np.pi * numbers[1]
        outward, u, v = sign * np.sqrt(1.0 - numbers[0]), radius * np.cos(angle), radius * np.sin(angle)
        way = np.stack([np.choose((k - axis) % 3, [outward, u, v]) for k in range(3)])
        _, far = slabs(points, way, (0.0, 0.0, 0.0), room.size)
        distance, axis = far.min(axis=0), far.argmin(axis=0)
        up_or_down = np.where(way[2] > 0.0, room.ceiling, room.floor)
        reflectance = np.where(axis == 2, up_or_down, room.walls)
        for box in room.boxes:
            near, far = slabs(points, way, box.low, box.high)
            entry = near.max(axis=0)
            met = (entry < far.min(axis=0)) & (entry > 0.0) & (entry < distance)
            distance = np.where(met, entry, distance)
            axis = np.where(met, near.argmax(axis=0), axis)
            reflectance = np.where(met, box.reflectance, reflectance)
        low, (a, b) = room.lamp_low, room.lamp_size
        with np.errstate(divide="ignore", invalid="ignore"):
            to_lamp = (low[2] - points[2]) / way[2]
            x, y = points[0] + to_lamp * way[0] - low[0], points[1] + to_lamp * way[1] - low[1]
        lamp = (to_lamp > 0.0) & (to_lamp < distance) & (x > 0.0) & (x < a) & (y > 0.0) & (y < b)
        reflectance = np.where(lamp, 0.0, reflectance)
        points, sign = points + distance * way, -np.sign(np.choose(axis, way))
        # A little off the surface, so that it is not met again.
        points += np.where(np.arange(3)[:, None] == axis, 1e-9 * sign, 0.0)
        return points, axis, sign, reflectance


def slabs(points: np.ndarray, ways: np.ndarray, low: Point, high: Point) -> tuple[np.ndarray, np.ndarray]:
    """Where lines enter and leave the space between the two planes of each axis, in lengths of `ways`, (3, n)."""
    with np.errstate(divide="ignore", invalid="ignore"):
        first, second = (np.array(low)[:, None] - points) / ways, (np.array(high)[:, None] - points) / ways
    return np.minimum(first, second), np.maximum(first, second)


def reference(room: Room, error: float) -> np.ndarray:
    """The reference, kept in the temporary folder."""
    digest = hashlib.sha256(f"{room} {error} {inspect.getsource(Reference)}".encode()).hexdigest()[:24]
    kept = CACHE / f"irradiance-{digest}.npy"
    if not kept.exists():
        CACHE.mkdir(exist_ok=True)
        print("reference ...", end=" ", file=sys.stderr, flush=True)
        found, spread = Reference(room).irradiance(error)
        print(
            f"standard error {100 * spread.mean():.2f} %, at most {100 * spread.max():.2f} %", file=sys.stderr
        )
        partial = CACHE / f"irradiance-{digest}.{os.getpid()}.npy"
        np.save(partial, found)
        partial.rename(kept)
    stored: np.ndarray = np.load(kept)
    return stored


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument(
        "--error", type=float, default=0.003, help="largest relative standard error of the reference"
    )
    parser.add_argument("--processes", type=int, default=2, help="of rtrace")
    parser.add_argument("--peer", type=Path, default=PEER, help="a Python with pyradiance")
    options = parser.parse_args()
    room = Room()
    truth = reference(room, options.error)
    rows = radiance_rows(room, options.peer, options.runs, options.processes)
    rows += illuminant_rows(room, options.runs, options.processes)
    print(f"{len(truth)} sensors, {truth.min():.4f} to {truth.max():.4f} W/m², mean {truth.mean():.4f}")
    print("| program | setting | seconds | processor seconds | RMS error | largest error | mean error |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for row in rows:
        relative = np.array(row.irradiance) / truth - 1.0
        print(
            f"| {row.program} | {row.setting} | {statistics.median(row.seconds):.2f} "
            f"| {statistics.median(row.processor_seconds):.2f} "
            f"| {100 * np.sqrt((relative**2).mean()):.2f} % | {100 * np.abs(relative).max():.2f} % "
            f"| {100 * relative.mean():+.2f} % |"
        )


if __name__ == "__main__":
    main()
