"""An animation: the tables of a scene at any time, and the still scene of each frame.

The table `[animation]` of a scene file (`animation_schema`) names keys of the scene by their path, and gives their
values at some times; `keyframes` says what is between them. At a time, each of these values is put into the tables of
the file, and what results is a still scene, resolved as every other: what a scene file must be, every frame must be.
A mistake in a frame is reported at the line of the keyframes, with the time.

Frame n is at n / `frames_per_second`. With fields (book 5.5) a frame holds two, at that time and half a frame later.

While the camera's `shutter` is open (a fraction of the time to the next frame or field) a keyed camera moves from
where it is at the frame's time to where it is at the next, straight on; keyed objects get the key `motion`, with
enough steps for their turns. All else, lamps and materials and shapes, stays as it is at the frame's time; so does
what changes in steps, or a cut would be smeared. A camera that does not state its `shutter` makes sharp frames.

Example:
    >>> animation = Animation.build({
    ...     "camera": {"eye": [0, 0, 3], "target": [0, 0, 0], "size": [8, 8]},
    ...     "materials": {"grey": {"kind": "diffuse", "reflectance": 0.5}},
    ...     "objects": {"ball": {"sphere": {"radius": 1.0}, "material": "grey"}},
    ...     "lights": {"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 100.0}},
    ...     "animation": {
    ...         "frames": [0, 30],
    ...         "keys": {"lights.sky.luminance_cd_m2": {"times": [0.0, 1.0], "values": [100.0, 200.0]}},
    ...     },
    ... })
    >>> animation.data(0.5)["lights"]["sky"]["luminance_cd_m2"]
    150.0
    >>> animation.still(30).hash() != animation.still(0).hash()
    True
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path as FilePath
from typing import Any

from illuminant import keyframes
from illuminant.animation_schema import AnimationTable, Keys
from illuminant.errors import Problem, SceneError, suggestion
from illuminant.report import Path, Report, read_table
from illuminant.scene import Scene

__all__ = ["Animation", "Track", "path_of"]

KEYED = ("camera", "spectra", "materials", "objects", "lights", "atmosphere", "medium")
"""The tables whose keys can change."""

FIXED = {
    ("camera", "size"): "is the same in all frames",
    ("camera", "crop"): "is the same in all frames",
    ("camera", "moves_to"): "is found from the keyframes of the camera and its `shutter`",
}
MOVES = ("scale", "rotate", "translate")
VIEW = ("eye", "target", "up")

MOST_MOMENTS = 100
"""At how many keyframes a scene is checked before anything is rendered; every frame is checked anyway."""

STEPS = 4
"""Steps of an object's motion in a frame; more if it turns by more than `DEGREES` in one."""
DEGREES = 10.0
MOST_STEPS = 64


def path_of(text: str) -> Path | None:
    """Keys and indices of a path as it is written, or None when it is none.

    Example:
        >>> path_of('objects."red ball".rotate[1].degrees')
        ('objects', 'red ball', 'rotate', 1, 'degrees')
        >>> path_of("camera..eye") is None
        True
    """
    parts: list[str | int] = []
    at = 0
    while True:
        match = re.compile(r'([A-Za-z0-9_-]+)|"([^"]*)"|\'([^\']*)\'').match(text, at)
        if match is None:
            return None
        parts.append(next(part for part in match.groups() if part is not None))
        at = match.end()
        while index := re.compile(r"\[(\d{1,9})\]").match(text, at):
            parts.append(int(index[1]))
            at = index.end()
        if at == len(text):
            return tuple(parts)
        if text[at] != ".":
            return None
        at += 1


@dataclass(frozen=True)
class Track:
    """One key of the scene that changes.

    Attributes:
        name: its path as the file has it.
        path: its path as keys and indices.
        times: of its values, in seconds, increasing.
        values: as the file has them.
        interpolation: `step`, `linear` or `smooth`.
        turning: whether the values are rotations whose axes differ.
    """

    name: str
    path: Path
    times: tuple[float, ...]
    values: tuple[Any, ...]
    interpolation: str
    turning: bool = False

    def at(self, time: float) -> Any:
        """The value at a time."""
        value = keyframes.turned if self.turning else keyframes.between
        return value(self.times, self.values, time, self.interpolation)


class _Moment(Report):
    """The report of a scene at one time, which adds its mistakes to that of the file.

    What keyframes brought about is reported at their line, with the time; what stands in the file, once.
    """

    def __init__(
        self, animation: Animation, time: float, problems: list[Problem], said: set[tuple[Path, str]]
    ) -> None:
        super().__init__(animation.report.file, animation.report.lines)
        self.problems = problems
        self.said = said
        self.animation = animation
        self.time = time

    def add(self, path: Path, message: str, hint: str = "", kind: str = "value") -> None:
        """Add a mistake at a key path of the still scene."""
        tracks = self.animation.tracks
        track = next((track for track in tracks if path[: len(track.path)] == track.path), None)
        once = (path, message)
        if track is None or kind in ("unknown-key", "missing-key"):
            if once in self.said:
                return
            self.said.add(once)
        if track is not None:
            if self.time not in track.times and (track.path, "") in self.said:
                return  # what it holds beside its values comes from them
            self.said.add((track.path, ""))
            place: Path = ("animation", "keys", track.name, "values")
            if self.time in track.times:
                place = (*place, track.times.index(self.time))
            rest = _written(path[len(track.path) :])
            if rest:
                dot = "" if rest.startswith("[") else "."
                message = f"{track.path[-1]}{dot}{rest} {message}"
            super().add(place, f"at {self.time:g} s, {message}", hint, kind)
        elif self.time != self.animation.time(self.animation.first):
            # Had it nothing to do with keyframes, it would have been said of the first frame.
            super().add(path, f"at {self.time:g} s: {message}", hint, kind)
        else:
            super().add(path, message, hint, kind)


def _written(path: Path) -> str:
    text = ""
    for part in path:
        text += f"[{part}]" if isinstance(part, int) else f"{'.' if text else ''}{part}"
    return text


@dataclass(frozen=True)
class Animation:
    """A scene that changes with time; made by `load`, `build` or `read`.

    Attributes:
        tables: of the scene file, without `[animation]`.
        tracks: what changes.
        first, last: numbers of the first and the last frame.
        frames_per_second: frames in a second.
        fields: `none`, `odd-first` or `even-first`.
        directory: folder that file names are relative to.
        report: knows the lines of the file.
        meshes: files that were read already.
    """

    tables: Mapping[str, Any]
    tracks: tuple[Track, ...]
    first: int
    last: int
    frames_per_second: Fraction
    fields: str
    directory: FilePath
    report: Report
    allow_outside: bool = False
    meshes: dict[tuple[Any, ...], Any] = field(default_factory=dict, repr=False)

    # --- making ----------------------------------------------------------------------------------------------------

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, allow_outside: bool = False) -> Animation:
        """Read a scene file with a table `[animation]`, and check it.

        Args:
            path: the scene file.
            allow_outside: whether files that it names may lie outside its folder.

        Raises:
            SceneError: the file cannot be read, has mistakes (all of them are in `problems`), or has no such table.
        """
        from illuminant import scene_file

        data, report = scene_file.parse(path)
        return cls._checked(data, report, FilePath(path).parent, allow_outside)

    @classmethod
    def build(cls, tables: Mapping[str, Any], directory: str | os.PathLike[str] = ".") -> Animation:
        """Make an animation from the tables of a scene file, as `Scene.build` takes them, and check it.

        Args:
            tables: by name, `animation` among them.
            directory: folder that file names are relative to.

        Raises:
            SceneError: mistakes; all of them are in `problems`.
        """
        from illuminant import scene_file

        return cls._checked(scene_file.plain(tables), Report(), FilePath(directory), allow_outside=True)

    @classmethod
    def _checked(
        cls, data: dict[str, Any], report: Report, directory: FilePath, allow_outside: bool
    ) -> Animation:
        if "animation" not in data:
            message = "is missing, so the scene has no frames; expected a table with frames and keys"
            report.add(("animation",), message, kind="missing-key")
            report.raise_if_any()
        animation = cls.read(data, report, directory, allow_outside=allow_outside)
        animation.check()
        return animation

    @classmethod
    def read(
        cls, data: Mapping[str, Any], report: Report, directory: FilePath, *, allow_outside: bool = False
    ) -> Animation:
        """The animation of a scene file; mistakes of its form go to the report.

        Args:
            data: the tables of the file.
            report: takes the mistakes.
            directory: folder that file names are relative to.
            allow_outside: whether files may lie outside that folder.
        """
        raw = data["animation"]
        keys = raw.get("keys", {}) if isinstance(raw, dict) else {}
        head = raw if not isinstance(raw, dict) or not isinstance(keys, dict) else raw | {"keys": {}}
        table, _ = read_table(AnimationTable, head, ("animation",), report)
        if table is None:
            table = AnimationTable(frames=[0, 0])
        first, last = table.frames
        if first > last:
            message = f"must be the first and a last frame that is not before it, found {table.frames}"
            report.add(("animation", "frames"), message, kind="range")
            last = first
        rate = Fraction(table.frames_per_second)
        tables = {key: value for key, value in data.items() if key != "animation"}
        tracks: list[Track] = []
        for name, one in keys.items() if isinstance(keys, dict) else ():
            track = _Reader(report, tables, rate, table.interpolation, name).track(one)
            if track is not None:
                _check_alone(track, tracks, report)
                tracks.append(track)
        return cls(tables, tuple(tracks), first, last, rate, table.fields, directory, report, allow_outside)

    # --- times -----------------------------------------------------------------------------------------------------

    @property
    def times_of_fields(self) -> int:
        """How many times a frame shows: 2 with fields, else 1."""
        return 1 if self.fields == "none" else 2

    def time(self, frame: int, field: int = 0) -> float:
        """The time of a frame, or of its second field (`field=1`), in seconds.

        Example:
            >>> still = Animation({}, (), 0, 9, Fraction(30000, 1001), "odd-first", FilePath(), Report())
            >>> round(still.time(30), 6), round(1 / (still.time(0, 1) - still.time(0)), 2)
            (1.001, 59.94)
        """
        return float((frame + Fraction(field, 2)) / self.frames_per_second)

    def data(self, time: float) -> dict[str, Any]:
        """The tables of the scene at a time, at rest.

        Args:
            time: in seconds.
        """
        return self._data(time, time)

    def _data(self, time: float, opened: float) -> dict[str, Any]:
        """The tables at a time while a shutter is open, which opened at another: steps are cuts and wait until then."""
        tables = dict(self.tables)
        for track in self.tracks:
            at = opened if track.interpolation == "step" else time
            tables = _with(tables, track.path, track.at(at))
        return tables

    def still(self, frame: int, field: int = 0) -> Scene:
        """The scene of a frame, or of its second field (`field=1`), with what moves while the shutter is open.

        Raises:
            SceneError: this frame has mistakes; all of them are in `problems`.
        """
        from illuminant import scene_file

        time = self.time(frame, field)
        duration = float(1 / (self.frames_per_second * self.times_of_fields))
        moment = _Moment(self, time, [], set())
        return scene_file.still(
            self._moving(time, duration),
            moment,
            self.directory,
            self.meshes,
            allow_outside=self.allow_outside,
        )

    def check(self) -> None:
        """Look for mistakes in the first frame and at the times of keyframes.

        Raises:
            SceneError: all of them are in `problems`.
        """
        from illuminant import scene_file

        keys = sorted({time for track in self.tracks for time in track.times} - {self.time(self.first)})
        if len(keys) > MOST_MOMENTS:
            keys = [keys[i * (len(keys) - 1) // (MOST_MOMENTS - 1)] for i in range(MOST_MOMENTS)]
        said: set[tuple[Path, str]] = set()
        for time in [self.time(self.first), *keys]:
            moment = _Moment(self, time, self.report.problems, said)
            with suppress(SceneError):
                scene_file.still(
                    self.data(time), moment, self.directory, self.meshes, allow_outside=self.allow_outside
                )
        self.report.raise_if_any()

    # --- while the shutter is open ---------------------------------------------------------------------------------

    def _moving(self, time: float, duration: float) -> dict[str, Any]:
        """The tables at a time, in which what is keyed moves until `duration` later if the camera has a shutter."""
        tables = self.data(time)
        camera = tables.get("camera")
        if not isinstance(camera, dict) or camera.get("shutter") is None:
            return tables
        after = self._data(time + duration, time)
        keyed = {track.path[1] for track in self.tracks if track.path[0] == "camera" and len(track.path) > 1}
        moved = {
            key: after["camera"][key] for key in VIEW if key in keyed and after["camera"][key] != camera[key]
        }
        if moved:
            tables["camera"] = camera | {"moves_to": moved}
        for name in dict.fromkeys(str(track.path[1]) for track in self.tracks if _places(track.path)):
            thing, end = tables["objects"][name], after["objects"][name]
            if any(thing.get(key) != end.get(key) for key in MOVES):
                count = min(max(STEPS, math.ceil(self._turn(name, time, duration) / DEGREES)), MOST_STEPS)
                steps = [
                    self._data(time + duration * step / count, time)["objects"][name]
                    for step in range(1, count + 1)
                ]
                motion = [{key: step[key] for key in MOVES if key in step} for step in steps]
                tables["objects"] = tables["objects"] | {name: thing | {"motion": motion}}
        return tables

    def _turn(self, name: str, time: float, duration: float) -> float:
        """How far an object turns in a frame, at most, in degrees."""
        total = 0.0
        for track in self.tracks:
            if track.path[:3] == ("objects", name, "rotate") and track.interpolation != "step":
                total += _angle(track.at(time), track.at(time + duration))
        return total


def _angle(start: Any, end: Any) -> float:
    """Between two rotations, or two values of a key of one."""
    if isinstance(start, list) and isinstance(end, list):
        return sum(_angle(one, other) for one, other in zip(start, end, strict=False))
    if isinstance(start, dict) and isinstance(end, dict):
        if start.get("axis") == end.get("axis"):
            return _angle(start.get("degrees"), end.get("degrees"))
        return 180.0
    if isinstance(start, (int, float)) and isinstance(end, (int, float)):
        return abs(end - start)
    return 180.0


def _places(path: Path) -> bool:
    """Whether a path leads to where an object stands."""
    return len(path) > 2 and path[0] == "objects" and path[2] in MOVES


def _with(holder: Any, path: Path, value: Any) -> Any:
    """A copy of tables in which a path has a value; what the path does not touch is shared."""
    if not path:
        return value
    head, rest = path[0], path[1:]
    if isinstance(head, int):
        return [*holder[:head], _with(holder[head], rest, value), *holder[head + 1 :]]
    return {**holder, head: _with(holder.get(head), rest, value)}


def _check_alone(track: Track, others: list[Track], report: Report) -> None:
    """Report a path that another one leads to or through."""
    for other in others:
        depth = min(len(track.path), len(other.path))
        if track.path[:depth] == other.path[:depth]:
            message = f"changes what [{_table_of(other.name)}] changes; give one or the other"
            report.add(("animation", "keys", track.name), message, kind="exactly-one")
            return


def _table_of(name: str) -> str:
    return f'animation.keys."{name}"' if '"' not in name else f"animation.keys.'{name}'"


class _Reader:
    """Reads the keyframes of one path."""

    def __init__(
        self, report: Report, tables: Mapping[str, Any], rate: Fraction, interpolation: str, name: str
    ) -> None:
        self.report = report
        self.tables = tables
        self.rate = rate
        self.interpolation = interpolation
        self.name = name
        self.place: Path = ("animation", "keys", name)

    def add(self, message: str, hint: str = "", kind: str = "value", key: Path = ()) -> None:
        """Report a mistake in these keyframes."""
        self.report.add((*self.place, *key), message, hint, kind)

    def track(self, raw: Any) -> Track | None:
        """The keyframes as a track; None when its path or its form is wrong, which is reported."""
        path = self._path()
        before = len(self.report.problems)
        table, _ = read_table(Keys, raw, self.place, self.report)
        if table is None or path is None:
            return None
        if len(self.report.problems) > before:
            first = raw.get("values")
            # A value of the right kind, so that what holds it is not found wrong for want of it.
            return (
                Track(self.name, path, (0.0,), (first[0],), "step")
                if isinstance(first, list) and first
                else None
            )
        times = self._times(table)
        turning = path[-1] == "rotate" or (
            len(path) > 1 and path[-2] == "rotate" and isinstance(path[-1], int)
        )
        values = tuple(table.values)
        interpolation, turning = self._interpolation(table, turning and path[0] == "objects", path)
        if times is None:
            return Track(self.name, path, (0.0,), values[:1], "step")
        return Track(self.name, path, times, values, interpolation, turning)

    def _path(self) -> Path | None:
        path = path_of(self.name)
        if path is None or len(path) < 2:
            message = 'is no path of a key; expected one such as "camera.eye" or "objects.ball.translate"'
            self.add(message, kind="path")
            return None
        if path[0] not in KEYED:
            words = ", ".join(KEYED[:-1]) + f" or {KEYED[-1]}"
            message = f"cannot change with time; expected a path that begins with {words}"
            self.add(message, suggestion(str(path[0]), KEYED), "path")
            return None
        for fixed, why in FIXED.items():
            if path[: len(fixed)] == fixed:
                self.add(f"cannot change with time: it {why}", kind="path")
                return None
        if path[0] == "objects" and len(path) > 2 and path[2] == "motion":
            self.add("cannot change with time: it is found from the keyframes of the object", kind="path")
            return None
        holder: Any = self.tables
        for depth, part in enumerate(path[:-1] if isinstance(path[-1], str) else path):
            inside = part in holder if isinstance(holder, dict) else False
            if isinstance(holder, list) and isinstance(part, int):
                inside = part < len(holder)
            if inside:
                holder = holder[part]
            else:
                where = _written(path[:depth]) or "the scene"
                known = holder if isinstance(holder, dict) else ()
                what = f"[{part}]" if isinstance(part, int) else f'"{part}"'
                self.add(f"leads nowhere: {where} has no {what}", suggestion(str(part), known), "path")
                return None
        if not isinstance(holder, dict) and isinstance(path[-1], str):
            self.add(f"leads nowhere: {_written(path[:-1])} is no table", kind="path")
            return None
        self._check_own_motion(path)
        return path

    def _check_own_motion(self, path: Path) -> None:
        """Report a motion that is stated beside the keyframes that it would be found from."""
        holder: Path = ()
        if path[0] == "camera" and path[1] in VIEW:
            holder = ("camera", "moves_to")
        elif _places(path):
            holder = (*path[:2], "motion")
        table = (
            self.tables.get("camera")
            if len(holder) == 2
            else self.tables["objects"][path[1]]
            if holder
            else None
        )
        if isinstance(table, dict) and holder[-1] in table:
            message = f"stands instead of keyframes of the same thing, [{_table_of(self.name)}]; give one or the other"
            self.report.add(holder, message, kind="exactly-one")

    def _times(self, table: Keys) -> tuple[float, ...] | None:
        given = [key for key in ("times", "frames") if getattr(table, key) is not None]
        if len(given) != 1:
            what = " and ".join(given) or "none"
            self.add(f"must have exactly one of times and frames; found {what}", kind="exactly-one")
            return None
        key = given[0]
        moments: list[float] = getattr(table, key)
        if len(moments) != len(table.values):
            message = (
                f"must be as many as {key}, of which there are {len(moments)}; found {len(table.values)}"
            )
            self.add(message, kind="length", key=("values",))
            return None
        for i in range(1, len(moments)):
            if not moments[i] > moments[i - 1]:
                message = f"must be after the one before it, {moments[i - 1]!r}; found {moments[i]!r}"
                self.add(message, kind="range", key=(key, i))
                return None
        if key == "times":
            return tuple(float(moment) for moment in moments)
        return tuple(float(Fraction(moment) / self.rate) for moment in moments)

    def _interpolation(self, table: Keys, rotation: bool, path: Path) -> tuple[str, bool]:
        """How to go between the values, and whether as turns."""
        wanted = table.interpolation or self.interpolation
        if wanted == "step":
            return "step", False
        why = keyframes.misfit(table.values)
        axes = [_axes(value) for value in table.values] if rotation else []
        if path[0] == "objects" and len(path) > 2 and path[2] == "matrix":
            why = "a matrix between two others is no rigid motion; scale, rotate and translate are"
        elif rotation and None not in axes:
            if not why and all(one == axes[0] for one in axes):
                return wanted, False
            return wanted, True
        if why and table.interpolation is not None:
            message = f'"{wanted}" is not possible between these values: {why}'
            self.add(message, 'expected "step"', "interpolation", ("interpolation",))
        return ("step" if why else wanted), False


def _axes(value: Any) -> list[Any] | None:
    """The axes of a rotation, or of several; None when it is none, which the scene will report."""
    axes = []
    for one in value if isinstance(value, list) else [value]:
        if not isinstance(one, dict) or one.keys() != {"axis", "degrees"}:
            return None
        if not isinstance(one["degrees"], (int, float)) or isinstance(one["degrees"], bool):
            return None
        try:
            keyframes.turns(one)
        except (ValueError, TypeError):
            return None
        if isinstance(one["axis"], list) and len(one["axis"]) != 3:
            return None
        axes.append(one["axis"])
    return axes or None
