"""What a page keeps: files in the viewer's output folder, under names that the page cannot choose.

Names are made of the scene's and a number that is free, so nothing is overwritten and no path can be given.
"""

from __future__ import annotations

import copy
import os
import shlex
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import output, sources
from illuminant.errors import Error, UsageError
from illuminant.scene_file import MAX_BYTES
from illuminant.viewer.tables import relocate

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["command", "image", "names_outside", "received", "scene", "solution", "spectrum"]

LOCK = threading.RLock()
"""Two pages that keep at once get different names."""

MOST_BYTES = 1_000_000
"""Of a file that a page sends."""


def image(session: Session) -> list[Path]:
    """The picture at hand, as PNG with the look and as EXR in absolute XYZ.

    Raises:
        UsageError: there is no picture yet.
    """
    from dataclasses import replace

    frame = session.frame
    if frame is not None and frame.illuminance is not None:
        raise UsageError("A map of illuminance is no picture: choose another under show first.")
    if frame is None or frame.preview:
        raise UsageError("There is no whole picture yet: wait a moment.")
    look = replace(session.state.look, exposure=session.state.exposure)
    files = [_free(session, "view", ".png"), _free(session, "view", ".exr")]
    frame.image.save(files[0], look=look)
    frame.image.save(files[1])
    return files


def scene(session: Session) -> list[Path]:
    """The scene as it stands, camera included: the file that was read with the changed tables in it.

    Raises:
        UsageError: the scene was no file.
    """
    path = session.state.scene.path
    if not session.state.tables or path is None:
        raise UsageError("Only a scene that was read from a file can be written.")
    import tomlkit

    document: Any = tomlkit.parse(sources.read(path, MAX_BYTES).decode("utf-8-sig"))
    if "animation" in document:
        _hold_first_frame(document, Path(path))
    for kind in ("materials", "lights"):
        before, now = session.start.tables.get(kind, {}), session.state.tables.get(kind, {})
        for name, table in now.items():
            if table != before.get(name):
                _update(document[kind][name], table)
    camera = session.state.scene.replace(camera=session.camera()).frame["camera"]
    wanted = {key: camera[key] for key in ("eye", "target", "up", "field_of_view", "size") if key in camera}
    _update(document["camera"], dict(document["camera"]) | _plain(wanted))
    document["camera"].pop("crop", None)
    target = _free(session, "scene", ".toml")
    relocate(document, Path(path).parent, lambda file: Path(os.path.relpath(file, target.parent)))
    output.write_bytes(target, tomlkit.dumps(document).encode())
    return [target]


def names_outside(session: Session, folder: Path) -> bool:
    """Whether the scene as it stands, written into a folder, could be read with `allow_outside` only."""
    names = relocate(copy.deepcopy(session.state.tables), Path(), Path.absolute)
    try:
        for name in names:
            sources.located(name, folder)
    except sources.SourceError:
        return True
    return session.allow_outside


def spectrum(session: Session) -> list[Path]:
    """The spectrum of the last reading, as CSV.

    Raises:
        UsageError: nothing has been read yet.
    """
    found = session.last_reading
    if found is None:
        raise UsageError("Nothing has been read yet: click a point.")
    from illuminant import spectrum_file
    from illuminant.spectrum import Spectrum

    name = f"{found.thing or 'surroundings'}, pixel {found.pixel[0]}, {found.pixel[1]}"
    curve = Spectrum(
        name,
        tuple(found.wavelengths_nm.tolist()),
        tuple(found.radiance.tolist()),
        "zero",
        unit="W sr-1 m-2 nm-1",
        quantity="emission",
    )
    target = _free(session, "spectrum", ".csv")
    spectrum_file.write(target, curve)
    return [target]


def solution(session: Session) -> list[Path]:
    """The solution of radiosity.

    Raises:
        UsageError: the technique has none, or it is not there yet.
    """
    found = session.refiner.solution
    if found is None:
        raise UsageError("There is no solution: choose radiosity or hybrid, and wait for it.")
    target = _free(session, "view", ".solution")
    found.save(target)
    return [target]


def received(session: Session, content: bytes) -> Path:
    """A spectrum that the page sent, as a file of the output folder under a name of ours.

    Raises:
        UsageError: it is larger than 1 MB.
        DataError: it is no spectrum; then nothing is left of it.
    """
    from illuminant import spectrum_file

    if len(content) > MOST_BYTES:
        raise UsageError("A spectrum is a file of at most 1 MB.")
    target = _free(session, "lamp", ".csv")
    output.write_bytes(target, content)
    try:
        spectrum_file.read(target)
    except Error:
        target.unlink()
        raise
    return target


def command(session: Session) -> str:
    """The command line that renders the view; the scene is written first if it differs from its file.

    Raises:
        UsageError: the scene was no file.
    """
    state = session.state
    file = scene(session)[0]
    camera = session.camera()
    words = ["illuminant", "render", str(file), "-o", f"{file.stem}.png"]
    if names_outside(session, file.parent):
        words.append("--allow-outside")
    words += [
        "--technique",
        state.technique,
        "--illumination",
        state.illumination,
        "--sampling",
        state.sampling,
    ]
    words += ["--size", f"{camera['size'][0]}x{camera['size'][1]}"]
    if session.frame is not None and not session.frame.preview:
        words += ["--samples", str(session.frame.samples)]
    if state.exposure is not None:
        words += ["--exposure", f"{state.exposure:.6g}"]
    words += [
        "--display",
        str(state.look.display),
        "--gamut",
        state.look.method,
        "--dither",
        state.look.dither,
    ]
    return shlex.join(words)


def _free(session: Session, what: str, ending: str) -> Path:
    """A file of the output folder that is not there yet."""
    stem = Path(session.state.scene.path or "scene").stem
    for number in range(1, 10_000):
        path = session.folder / f"{stem}-{what}-{number}{ending}"
        if not path.exists():
            return output.check(path)
    raise UsageError(f"{session.folder} holds 9,999 of these files already.")


def _hold_first_frame(document: Any, path: Path) -> None:
    """Make a document the still scene of an animation's first frame, which is what the page shows."""
    from illuminant.animation import Animation
    from illuminant.report import Report

    animation = Animation.read(document.unwrap(), Report(str(path)), path.parent)
    for track in animation.tracks:
        holder = document
        for part in track.path[:-1]:
            holder = holder[part]
        holder[track.path[-1]] = track.at(animation.time(animation.first))
    del document["animation"]


def _update(target: Any, table: Mapping[str, Any]) -> None:
    """Make a table of the document hold these keys, and leave what is the same as it is written."""
    for key in [key for key in target if key not in table]:
        del target[key]
    for key, value in table.items():
        if key not in target or target[key] != value:
            target[key] = value


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    return round(float(value), 9) if isinstance(value, float) else value
