"""The frames of an animation as image files, each made once.

A frame is finished when its file is there, whole, and says in its header that it was made from the same scene (its
hash), by the same version, with the same options; such a frame is passed over. A file appears whole or not at all
(`illuminant.output`), and a frame that is interrupted is not written; so the same command goes on where it stopped.

All pictures of a sequence have one exposure. If neither an option nor the scene states it, it is that of the first
picture that is there already, else the one that the first frame rendered would have by itself.

With fields (book 5.5, figure 5.21) two images are rendered for each frame, each at its own time, and a frame has the
odd lines of the one and the even lines of the other. They have the seed and the settings of a frame; what a pixel of
a field is, it is in the image of that moment, to the bit.

Example:
    >>> for frame in render_frames("scenes/turntable.toml", "0-47x2", "shot.####.png"):       # doctest: +SKIP
    ...     print(frame.number, frame.files, frame.skipped)
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import machine
from illuminant.animation import Animation
from illuminant.errors import ImageError, Interrupted, UsageError
from illuminant.image import Image, Saved, check_output
from illuminant.job import Job, OnProgress, resized, stated
from illuminant.settings import Settings, resolve

if TYPE_CHECKING:
    from illuminant.display.look import Look
    from illuminant.scene import Scene

__all__ = ["Frame", "file_of", "frame_numbers", "render_frames"]

DIGITS = 4
"""Digits of a frame's number where `{frame}` stands for it."""


@dataclass(frozen=True)
class Frame:
    """A frame that is done.

    Attributes:
        number: of the frame.
        time_s: its time in the animation, in seconds.
        files: where it is.
        skipped: whether it was finished already, and nothing was done.
        image: what was rendered; None when it was skipped.
        saved: how it was saved.
        jobs: the render, or the two of its fields.
    """

    number: int
    time_s: float
    files: tuple[Path, ...]
    skipped: bool
    image: Image | None = None
    saved: tuple[Saved, ...] = ()
    jobs: tuple[Job, ...] = ()


def frame_numbers(text: str, first: int, last: int) -> list[int]:
    """The frames that a text asks for, in order.

    Args:
        text: `all`, a number, a range such as `1-48`, every second of one such as `1-48x2`, or several of these with
            commas.
        first, last: of the animation.

    Raises:
        UsageError: it is none of these, or asks for a frame that the animation has not.

    Example:
        >>> frame_numbers("7,1-5x2", 0, 47)
        [1, 3, 5, 7]
    """
    wanted: set[int] = set()
    for part in text.split(","):
        match = re.fullmatch(r"\s*(?:(all)|(\d{1,7})(?:-(\d{1,7}))?)(?:x([1-9]\d{0,6}))?\s*", part)
        if match is None or (match[4] and match[2] and not match[3]):
            raise UsageError(f"--frames {text}: expected all, or frames such as 12, 1-48, 1-48x2 or 5,7,9.")
        start, end = (first, last) if match[1] else (int(match[2]), int(match[3] or match[2]))
        if start > end:
            raise UsageError(f"--frames {text}: {start} is after {end}.")
        if start < first or end > last:
            raise UsageError(f"--frames {text}: the animation has the frames {first} to {last}.")
        wanted |= set(range(start, end + 1, int(match[4] or 1)))
    return sorted(wanted)


def file_of(pattern: str | os.PathLike[str], number: int) -> Path:
    """The file of a frame: its number with leading zeros in place of `####`, or of `{frame}`.

    Example:
        >>> str(file_of("frames/shot.####.png", 12)), str(file_of("{frame}.exr", 12))
        ('frames/shot.0012.png', '0012.exr')
    """
    path = Path(pattern)
    name = path.name.replace("{frame}", f"{number:0{DIGITS}d}")
    return path.with_name(re.sub("#+", lambda run: f"{number:0{len(run[0])}d}", name))


def followed(job: Job, progress: OnProgress | None) -> None:
    """Do the work of a render in this process."""
    for _ in job.passes(progress):
        pass


def render_frames(
    scene: Animation | str | os.PathLike[str],
    frames: str = "all",
    output: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None = None,
    *,
    again: bool = False,
    look: Look | None = None,
    rgb: str | None = None,
    half: bool = False,
    save: Callable[..., Saved] = Image.save,
    on_job: Callable[[Job], object] | None = None,
    follow: Callable[[Job, OnProgress | None], object] = followed,
    solve_by: Callable[[Scene, Settings], Any] | None = None,
    allow_outside: bool = False,
    memory_limit: int | str | None = None,
    progress: OnProgress | None = None,
    **options: Any,
) -> Iterator[Frame]:
    """Render frames of an animation and save them, but for those that are finished already.

    Args:
        scene: an `Animation`, or the path of a scene file with a table `[animation]`.
        frames: which ones; see `frame_numbers`.
        output: one or more file names in which `####` or `{frame}` stands for the number; default `SCENE.####.png`.
        again: render finished frames too.
        look, rgb, half: as for `Image.save`.
        save: saves an image, with the arguments of `Image.save`.
        on_job: called with each render before it begins, so that it can be interrupted from outside.
        follow: does the work of a render: this process, or a farm.
        solve_by: as for `Job`.
        allow_outside: whether files that the scene names may lie outside its folder.
        memory_limit: as for `illuminant.render`.
        progress: as for `illuminant.render`.
        options: as for `illuminant.render`.

    Yields:
        Each frame when its files are there.

    Raises:
        SceneError: the scene, or a frame of it, has mistakes, or no `[animation]`.
        UsageError: an option cannot be, or there is no such frame.
        ImageError, MachineError: a file cannot be written.
        Interrupted: Ctrl-C; the frame that was under way is not written.
    """
    with machine.limited_to(memory_limit):
        animation = (
            scene if isinstance(scene, Animation) else Animation.load(scene, allow_outside=allow_outside)
        )
    numbers = frame_numbers(frames, animation.first, animation.last)
    sequence = _Sequence(animation, _patterns(output, animation, len(numbers)), options, look, rgb, half)
    for number in numbers:
        for path in sequence.files(number):
            check_output(path)
    sequence.adopt_exposure(set(numbers) if again else set())
    before: Scene | None = None

    def frame(done: int, number: int) -> Frame:
        nonlocal before
        scenes = [animation.still(number, field) for field in range(animation.times_of_fields)]
        files = sequence.files(number)
        if not again and sequence.finished(number, scenes):
            return Frame(number, animation.time(number), files, True)
        jobs = []
        for one in scenes:
            if before is not None:
                one.share_geometry(before)
            before = _shapes_of(one)
            job = Job(one, memory_limit=memory_limit, solve_by=solve_by, **options)
            if on_job is not None:
                on_job(job)
            follow(job, progress)
            if job.interrupted or job.stopped:
                there = f"{done} of {len(numbers)} frames are there" if len(numbers) > 1 else "nothing is"
                raise Interrupted(
                    f"frame {number} was not finished and is not written; {there}. The same command goes on."
                )
            jobs.append(job)
        image = sequence.image(number, scenes, jobs)
        saved = tuple(
            save(image, path, sequence.look, exposure=sequence.exposure, rgb=rgb, half=half) for path in files
        )
        return Frame(number, animation.time(number), files, False, image, saved, tuple(jobs))

    for done, number in enumerate(numbers):
        with machine.limited_to(memory_limit):
            made = [frame(done, number)]
        # Nothing here holds a frame any more when the next one is begun.
        yield made.pop()


def _shapes_of(scene: Scene) -> Scene:
    """What the next frame may share of a scene: its shapes, without images and without what the core makes of it."""
    import copy

    found = copy.copy(scene)
    found.arrays = {name: array for name, array in scene.arrays.items() if not name.startswith("image:")}
    found._core = None
    return found


def _patterns(
    output: str | os.PathLike[str] | Sequence[str | os.PathLike[str]] | None, animation: Animation, count: int
) -> tuple[Path, ...]:
    """Names in which the number of a frame is missing; one is enough for a single frame."""
    if output is None:
        output = f"{Path(animation.report.file or 'scene').stem}.####.png"
    several = [output] if isinstance(output, (str, os.PathLike)) else list(output)
    patterns = tuple(dict.fromkeys(Path(one) for one in several))
    for path in patterns:
        if count > 1 and file_of(path, 1) == file_of(path, 2):
            raise UsageError(
                f"{path} is one name for {count} frames: write #### where the frame's number goes, such as "
                f"{path.with_name(f'{path.stem}.####{path.suffix}')}."
            )
    return patterns


class _Sequence:
    """What all frames of one command have in common.

    Attributes:
        look: of pictures.
        exposure: of all pictures; None while nobody knows.
    """

    def __init__(
        self,
        animation: Animation,
        patterns: tuple[Path, ...],
        options: dict[str, Any],
        look: Look | None,
        rgb: str | None,
        half: bool,
    ) -> None:
        from illuminant.display.look import Look

        self.animation = animation
        self.patterns = patterns
        self.look = look or Look()
        render = animation.tables.get("render", {})
        self.settings: Settings = resolve(render, **options)
        stated_exposure = render.get("exposure")
        self.exposure: float | None = self.look.exposure or stated_exposure
        self.asked = _asked(self.settings, rgb, half)
        if animation.fields != "none" and self.settings.keep_spectra:
            raise UsageError(
                "--keep-spectra: the two fields of a frame may have different wavelengths; render without fields."
            )

    def files(self, number: int) -> tuple[Path, ...]:
        """The files of a frame."""
        return tuple(dict.fromkeys(file_of(pattern, number) for pattern in self.patterns))

    def adopt_exposure(self, but: set[int]) -> None:
        """Take the exposure of the first picture of the whole sequence that is there, `but` for some frames."""
        from illuminant import png

        if self.exposure is not None:
            return
        replaced = {path for number in but for path in self.files(number)}
        for number in range(self.animation.first, self.animation.last + 1):
            for path in self.files(number):
                if path.suffix.lower() != ".png" or path in replaced or not path.is_file():
                    continue
                try:
                    header = png.read_header(path)
                    exposure = float(header.text.get("Exposure", "0"))
                except (ImageError, ValueError):
                    continue
                known = "frame" in header.settings and not header.settings.get("black")
                if known and 0 < exposure < float("inf"):
                    self.exposure = exposure
                    return

    def header(self, number: int, scenes: list[Scene]) -> dict[str, Any]:
        """What the header of a frame says of how it is made, as far as it is known before the work."""
        if self.settings.size is not None:
            scenes = [resized(scene, self.settings.size) for scene in scenes]
        header = stated(scenes[0], scenes[0].path or "", self.settings)
        return header | self._of_frame(number, scenes)

    def _of_frame(self, number: int, scenes: list[Scene]) -> dict[str, Any]:
        """What only the header of a frame says."""
        found: dict[str, Any] = {"frame": number}
        if len(scenes) > 1:
            found |= {"fields": self.animation.fields, "second_scene_hash": scenes[1].hash()}
        return found | ({"asked": self.asked} if self.asked else {})

    def finished(self, number: int, scenes: list[Scene]) -> bool:
        """Whether all files of a frame are there, whole, and made as this command would make them."""
        wanted = json.loads(json.dumps(self.header(number, scenes)))
        return all(self._made(path, wanted) for path in self.files(number))

    def _made(self, path: Path, wanted: dict[str, Any]) -> bool:
        from illuminant import exr, png

        if not path.is_file():
            return False
        try:
            if path.suffix.lower() == ".exr":
                found = exr.read(path).attributes.get("settings")
            else:
                header = png.read_header(path)
                found = header.settings
                exposure = float(header.text.get("Exposure", "0"))
                same = self.exposure is None or float(f"{self.exposure:.9g}") == exposure
                same |= isinstance(found, dict) and bool(found.get("black"))
                if not same or header.look != self.look.to_dict():
                    return False
        except (ImageError, ValueError):
            return False
        if not isinstance(found, dict):
            return False
        # The scene is told by its hash; its path is as it was given, and another way to it leads to the same.
        unsure = {"dropped", "scene", "black"} | ({"samples"} if self._open_ended else set())
        return {key: value for key, value in found.items() if key not in unsure} == {
            key: value for key, value in wanted.items() if key not in unsure
        }

    @property
    def _open_ended(self) -> bool:
        """Whether nobody knows before how many samples there will be."""
        return self.settings.time is not None or self.settings.error is not None

    def image(self, number: int, scenes: list[Scene], jobs: list[Job]) -> Image:
        """The image of a frame from its render, or from those of its fields."""
        image = jobs[0].image()
        if len(jobs) > 1:
            image = _woven(image, jobs[1].image(), self.animation.fields)
        image.settings |= self._of_frame(number, [job.scene for job in jobs])
        if not image.xyz.any():
            image.settings["black"] = (
                True  # it looks the same with every exposure, and says nothing of others
            )
        elif self.exposure is None:
            self.exposure = image.auto_exposure()
        return image


def _asked(settings: Settings, rgb: str | None, half: bool) -> dict[str, Any]:
    """Options that a header says nothing about because they change no number, but what a file holds."""
    open_ended = settings.time is not None or settings.error is not None
    return {
        **({"layers": list(settings.layers)} if settings.layers else {}),
        **({"lamps": True} if settings.lamps else {}),
        **({"keep_spectra": True} if settings.keep_spectra else {}),
        **({"rgb": rgb} if rgb else {}),
        **({"half": True} if half else {}),
        **({"time": settings.time} if settings.time is not None else {}),
        **({"samples": settings.samples} if open_ended and settings.samples else {}),
    }


def _woven(first: Image, second: Image, fields: str) -> Image:
    """One frame of the images of its two fields, the first of which is that of the odd lines or of the even ones."""
    from illuminant.display.video.interlace import weave

    odd, even = (first, second) if fields == "odd-first" else (second, first)
    statistics = dict(first.statistics)
    for name in ("samples", "rays", "dropped", "wall_seconds", "dropped_samples"):
        if name in statistics:
            statistics[name] = first.statistics[name] + second.statistics[name]
    return replace(
        first,
        xyz=weave(odd.xyz, even.xyz),
        layers={name: weave(odd.layers[name], even.layers[name]) for name in odd.layers},
        settings=first.settings | {"dropped": first.settings["dropped"] + second.settings["dropped"]},
        statistics=statistics,
    )
