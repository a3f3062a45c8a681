"""A render under way: one scene with one set of options, in passes that can be stopped.

Samples are taken in ranges over the whole image (1 of every pixel, then up to 4, 16 and 64, and from there
64, or a quarter of what is done, at a time), so that an image which is stopped early is even. Ranges change
no bit of the result: the film's sums are exact.

When to end:

- `samples=N`: after N samples of every pixel;
- `time="30s"`: when the time is up. The last ranges are cut to what still fits, by the rate so far;
- `error="1%"`: when 95 % of the pixels have a standard error of luminance below 1 % of the larger of the
  pixel's luminance and the image's mean. The error is estimated from two independently scrambled halves of
  the samples; the difference of two halves is a coarse estimate (one degree of freedom), so variances are
  averaged over 5 × 5 pixels first, and no decision is taken before 64 samples.

Ctrl-C ends the work between tiles; `Job.image` is then the partial image.

Example:
    >>> job = Job("scenes/cornell.toml", samples=4, size=(16, 16))       # doctest: +SKIP
    >>> [done for done in job.passes()]                                 # doctest: +SKIP
    [1, 4]
"""

from __future__ import annotations

import os
import time as clock
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from illuminant import job_memory, machine
from illuminant.checkpoint import Checkpoint, Keeper
from illuminant.core import core, embree
from illuminant.errors import DataError, Error, Interrupted, MachineError, UsageError
from illuminant.examination import WORDS, refuse
from illuminant.film_memory import check_memory, check_shadow_maps
from illuminant.image import Image
from illuminant.sample_ranges import next_range, standard_error_fraction
from illuminant.settings import SOLVED, Settings, resolve

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.form_factor_rows import Rows
    from illuminant.kept_spectra import KeptSpectra
    from illuminant.scene import Scene

    Array = NDArray[np.floating[Any]]

__all__ = [
    "Job",
    "OnProgress",
    "Progress",
    "held",
    "resized",
    "stated",
]

LEAST_SAMPLES_FOR_ERROR = 64
PIXELS_WITHIN_ERROR = 0.95
MOST_SAMPLES = 2**32 - 1
COUNTED = ("stratified", "jittered", "poisson-disk")
"""Samplers whose numbers depend on how many samples there shall be."""


@dataclass(frozen=True)
class Progress:
    """How far a render is.

    Attributes:
        fraction: of the whole, 0 to 1; None when that cannot be told yet.
        samples: samples taken so far, mean over pixels.
        seconds: since the work began.
        msamples_per_second: rate so far, in millions of samples (paths).
        seconds_left: estimate; None when that cannot be told yet.
    """

    fraction: float | None
    samples: float
    seconds: float
    msamples_per_second: float
    seconds_left: float | None


OnProgress = Callable[[Progress], object]


class Job:
    """One scene being rendered with one set of options.

    Args:
        scene: a `Scene`, or the path of a scene file.
        solution: the core's, where the light between surfaces has been solved for already.
        like: a job of the same scene with another camera or other settings, whose wavelengths are taken over: to fit
            them again takes longer than a first image of few pixels.
        checkpoint: of the same render, which goes on from there.
        solve_by: solves for the light between surfaces in place of this process's threads: takes the scene and the
            settings, and returns the core's solution, or None to leave it to them.
        keeper: writes checkpoints while the light between surfaces is solved for; that some will be made takes memory.
        allow_outside, memory_limit: as for `illuminant.render`.
        options: as `illuminant.render`.

    Attributes:
        scene, settings: what is rendered, and how.
        done: samples of every pixel that complete ranges have taken.
        under_way: end of the range that is being taken.
        interrupted: whether Ctrl-C ended the work.
        stopped: whether `progress` ended it by returning False.
    """

    def __init__(
        self,
        scene: Scene | str | os.PathLike[str],
        *,
        solution: Any = None,
        like: Job | None = None,
        checkpoint: Checkpoint | None = None,
        solve_by: Callable[[Scene, Settings], Any] | None = None,
        keeper: Keeper | None = None,
        allow_outside: bool = False,
        memory_limit: int | str | None = None,
        **options: Any,
    ) -> None:
        with machine.limited_to(memory_limit):
            self._prepare(scene, solution, like, checkpoint, solve_by, keeper, allow_outside, options)

    def _prepare(
        self,
        scene: Scene | str | os.PathLike[str],
        solution: Any,
        like: Job | None,
        checkpoint: Checkpoint | None,
        solve_by: Callable[[Scene, Settings], Any] | None,
        keeper: Keeper | None,
        allow_outside: bool,
        options: dict[str, Any],
    ) -> None:
        self.scene, self.source = _scene(scene, allow_outside)
        defaults = self.scene.render_defaults
        self.settings = resolve(defaults, **options)
        if self.settings.size is not None:
            self.scene = resized(self.scene, self.settings.size)
        self.exposure: float | None = defaults.get("exposure")
        self.done = self.under_way = 0
        self.interrupted = False
        self.stopped = False
        width, height = _pixels(self.scene)
        self.width, self.height = width, height
        description = self.scene.description
        lamps = sum(1 + bool(light.get("sun")) for light in description["lights"])
        lamps += sum(thing["emission"] is not None for thing in description["objects"])
        check_memory(self.settings, width * height, lamps)
        check_shadow_maps(self.settings, description)
        solved = 0 if solution is not None else len(checkpoint.solution) if checkpoint is not None else 0
        known = solution is not None or solved > 0
        light = solved if known else None
        needed = job_memory.parts(
            self.settings, self.scene, width * height, lamps, light, checkpoints=keeper is not None
        )
        job_memory.check(needed)
        embree()
        self._spent, self._kept_solution = 0.0, b""
        self._rows: list[Rows] = []
        self.core_render: Any = None
        self._identity: dict[str, Any] = {}
        if checkpoint is not None:
            checkpoint.check(self.identity())
            if checkpoint.solution and solution is None:
                solution = self._restored(checkpoint.solution)
        self._began = clock.monotonic()
        try:
            self.core_scene = self.scene.core(self.settings.threads)
            refuse(self.scene, words=())
            # What the lanes of kept spectra mean is fitted with them.
            if self.settings.keep_spectra or self.settings.develop_for:
                like = None
            if solution is None and solve_by is not None and self.settings.technique in SOLVED:
                solution = solve_by(self.scene, self.settings)
            if solution is None and self.settings.technique == "radiosity":
                solution = self._solved_with_checkpoints(keeper, checkpoint)
            make: Any = core().Render if like is None else like.core_render.again
            self.core_render = make(self.core_scene, self.settings.to_core(), solution)
        except Error:
            raise
        except ValueError as error:
            # A word that the core does not know is a mistake of the scene, unless an option gave it.
            refuse(self.scene, words=[word for word in WORDS if options.get(word) is None])
            raise UsageError(self._blame(options) + _sentence(error)) from error
        except MemoryError as error:
            raise MachineError("There is not enough memory for this scene and image.") from error
        if checkpoint is not None:
            self._go_on(checkpoint)

    def _solved_with_checkpoints(self, keeper: Keeper | None, before: Checkpoint | None) -> Any:
        """The core's solution for `radiosity`, row by row; None where nobody keeps rows and none are kept."""
        from illuminant.form_factor_rows import Rows, solve

        self._rows = [Rows.from_bytes(before.rows)] if before is not None and before.rows else []
        if keeper is None and not self._rows:
            return None

        def look() -> None:
            if keeper is not None and keeper.due():
                keeper.keep(self)

        try:
            return solve(self.scene, self.settings, self._rows, look)
        except KeyboardInterrupt:
            if keeper is None or not self._rows or not keeper.keep(self):
                raise
            raise Interrupted(
                f"{keeper.path} holds the form factors that were found; no image was made."
            ) from None
        finally:
            self._rows = []

    def _go_on(self, checkpoint: Checkpoint) -> None:
        """Take over what a checkpoint holds."""
        if checkpoint.rows:
            return
        self.join(checkpoint.part)
        self.done, self.under_way, self._spent = checkpoint.done, checkpoint.end, checkpoint.seconds
        tiles, from_lamps = self.core_render.seen()
        most = max((ranges[-1][1] for ranges in [*tiles, from_lamps] if ranges), default=0)
        most = max(most, self.under_way)
        wanted = self.settings.samples
        if wanted is not None and most > wanted:
            raise UsageError(
                f"--samples {wanted}: the checkpoint holds up to {most} of a pixel; ask for as many or more."
            )

    def identity(self) -> dict[str, Any]:
        """What must be equal for samples to be those of one image: scene, settings, versions."""
        if self._identity:
            return self._identity
        import illuminant

        chosen = asdict(self.settings)
        free = {"threads", "time", "size"}
        if self.settings.sampler not in COUNTED:
            free.add("samples")
        kept = {key: list(one) if isinstance(one, tuple) else one for key, one in chosen.items()}
        self._identity = {
            "scene": self.scene.hash(),
            "size": list(self.scene.description["camera"]["size"]),
            **{key: one for key, one in kept.items() if key not in free},
            "version": illuminant.__version__,
            "embree": embree(),
        }
        return self._identity

    def join(self, part: bytes) -> None:
        """Add samples that another process has taken for the same render (`core_render.part()`).

        Raises:
            DataError: the bytes are damaged, of another render, or hold samples that are here already.
        """
        try:
            self.core_render.join(part)
        except ValueError as error:
            raise DataError(_sentence(error)) from error

    def checkpoint(self) -> Checkpoint:
        """All that is needed to go on from here in another process."""
        if self.core_render is None:
            from illuminant.form_factor_rows import joined

            self._rows[:] = [joined(self._rows)]
            return Checkpoint(self.identity(), 0, 0, 0, self._spent, b"", rows=self._rows[0].to_bytes())
        return Checkpoint(
            self.identity(),
            done=self.done,
            end=max(self.done, self.under_way),
            samples=int(self.core_render.statistics()["samples"]),
            seconds=self._seconds(),
            part=self.core_render.part(),
            solution=self.solution_bytes(),
        )

    def solution_bytes(self) -> bytes:
        """The light between surfaces as solved for; empty where there is none, or none that can be kept."""
        from illuminant.radiosity import Solution

        if self.settings.technique not in SOLVED or self.settings.technique == "specular-radiosity":
            return b""
        if not self._kept_solution:
            found = Solution(self.scene, self.settings, self.core_render.solution())
            self._kept_solution = found.to_bytes()
        return self._kept_solution

    def _restored(self, content: bytes) -> Any:
        """The core's solution from its bytes."""
        from illuminant.radiosity import Solution

        self._kept_solution = content
        return Solution.from_bytes(content, "the solution of the checkpoint").core_solution

    def _blame(self, options: dict[str, Any]) -> str:
        """The option that the core refuses, as the beginning of a sentence."""
        for word in WORDS:
            if options.get(word) is not None:
                try:
                    # As little work as there can be, should something have to be solved for.
                    little = {"elements": 1, "cube": 4, "light_samples": 1, "form_factors": "rays:1"}
                    core().Render(self.core_scene, resolve({**little, word: options[word]}).to_core())
                except ValueError:
                    return f"--{word} {options[word]}: "
        return ""

    def warnings(self) -> list[str]:
        """Sentences on what in these settings does not suit this scene."""
        return [*self.scene.warnings, *self.core_render.warnings()]

    def spectral_error(self) -> dict[str, Any]:
        """Error of the spectral sampling against 1 nm, in ΔE00, over what paths can meet in this scene."""
        return dict(self.core_render.spectral_error())

    def interrupt(self) -> None:
        """End the work at the next tile, as Ctrl-C does; for signal handlers."""
        self.interrupted = True

    def passes(self, progress: OnProgress | None = None, keeper: Keeper | None = None) -> Iterator[int]:
        """Render range after range, and yield the number of samples each pixel then holds.

        Ends when the settings say so, or after Ctrl-C (`interrupted`), or after `progress` returned False
        (`stopped`). With a keeper there are checkpoints on the way, and one of the end.
        """
        self.begin()
        while not (self.interrupted or self.stopped) and (end := self.next_end()) > self.done:
            self.under_way = end
            if self._run(end, progress, keeper):
                self.done = end
                yield end
        self.keep(keeper)

    def begin(self) -> None:
        """From now on time counts."""
        self._began = clock.monotonic()

    def keep(self, keeper: Keeper | None) -> None:
        """Write a checkpoint, if somebody keeps them; Ctrl-C meanwhile ends the work and not the program."""
        if keeper is None:
            return
        try:
            keeper.keep(self)
        except KeyboardInterrupt:
            self.interrupted = True

    def next_end(self) -> int:
        """End of the next range of samples; `done` when there shall be none."""
        if self.under_way > self.done:
            return self.under_way  # was decided on before the work was cut off
        settings = self.settings
        end = next_range(self.done, settings.samples)
        if (
            settings.error is not None
            and self.done >= LEAST_SAMPLES_FOR_ERROR
            and self._precise(settings.error)
        ):
            return self.done
        if settings.time is not None and self.done:
            elapsed = self._seconds()
            fits = int((settings.time - elapsed) * self.done / elapsed)
            # A range that would take less than a twentieth of the time is not worth its last few samples.
            return min(end, self.done + fits) if fits >= 1 else self.done
        return min(end, MOST_SAMPLES)

    def _precise(self, target: float) -> bool:
        luminance = self.core_render.layer("xyz")[..., 1]
        fraction = standard_error_fraction(luminance, self.core_render.standard_error(), target)
        return fraction >= PIXELS_WITHIN_ERROR

    def _run(self, end: int, progress: OnProgress | None, keeper: Keeper | None) -> bool:
        """Take the samples from `done` to `end`, with stops for checkpoints; whether they are complete."""
        before, last, pausing = 0.0, 0.0, False

        def report(part: float) -> bool:
            nonlocal last, pausing
            last = part
            if self.interrupted or self.stopped:
                return False
            try:
                samples = self.done + (end - self.done) * min(1.0, before + part)
                if progress is not None and progress(self.progress_at(samples)) is False:
                    self.stopped = True
                pausing = keeper is not None and keeper.due()
                return not (self.stopped or pausing)
            except KeyboardInterrupt:
                self.interrupted = True
                return False

        while True:
            pausing = False
            try:
                complete = bool(self.core_render.run(self.done, end, report))
            except KeyboardInterrupt:
                complete, self.interrupted = False, True
            except MemoryError as error:
                raise MachineError("There is not enough memory for this image.") from error
            if complete:
                before = 0.0
                report(1.0)  # a range may be too short to have been reported at all
                return True
            if not pausing or self.stopped or self.interrupted:
                break
            self.keep(keeper)
            before += last
        if not self.stopped:
            self.interrupted = True
        return False

    def _seconds(self) -> float:
        """Time spent, that before a checkpoint included."""
        return self._spent + clock.monotonic() - self._began

    def progress_at(self, samples: float) -> Progress:
        """How far the work is with so many samples of a pixel, in the mean."""
        seconds = self._seconds()
        rate = samples * self.width * self.height / max(seconds, 1e-9) / 1e6
        settings = self.settings
        parts = []
        if settings.samples is not None:
            parts.append(samples / settings.samples)
        if settings.time is not None:
            parts.append(seconds / settings.time)
        fraction = (
            min(1.0, max(parts)) if parts and (settings.error is None or settings.time is not None) else None
        )
        left = seconds * (1 - fraction) / fraction if fraction and seconds > 0.3 else None
        return Progress(fraction, samples, seconds, rate, left)

    def image(self) -> Image:
        """What is done so far, as an image; it stands on its own and may be kept."""
        import numpy as np

        render = self.core_render
        names = [name for name in render.layers() if name not in ("xyz", "halves")]
        layers = {name: np.asarray(render.layer(name)) for name in names}
        held = np.asarray(render.samples())
        if "samples" in self.settings.layers:
            layers["samples"] = held[..., None]
        seconds = self._seconds()
        statistics = dict(render.statistics())
        statistics |= {
            "wall_seconds": seconds,
            "samples_per_pixel": float(held.mean()),
            "least_samples": int(held.min()),
            "most_samples": int(held.max()),
            "peak_memory": machine.peak_memory(),
        }
        spectra = "spectra" in layers
        order = np.argsort(render.wavelengths(), kind="stable")
        for name in [name for name in layers if name.partition(":")[0] == "spectra"]:
            layers[name] = layers[name][..., order]
        return Image(
            np.asarray(render.layer("xyz")),
            layers=layers,
            settings=self._header(int(held.max()), statistics),
            exposure=self.exposure,
            statistics=statistics,
            wavelengths_nm=np.asarray(render.wavelengths())[order] if spectra else None,
            to_xyz=np.asarray(render.to_xyz())[:, order] if spectra else None,
            basis=self._basis() if spectra else None,
        )

    def _basis(self) -> KeptSpectra:
        """What the lanes of the image mean."""
        from illuminant.kept_spectra import KeptSpectra

        description = self.scene.description
        settings = self.settings
        fog = description.get("atmosphere") is not None
        return KeptSpectra.of_render(
            self.core_render, description["range"], settings.sampling, settings.develop_for, fog
        )

    def _header(self, most: int, statistics: dict[str, Any]) -> dict[str, Any]:
        """How the image was made, with nothing in it that changes from run to run of the same image."""
        return stated(self.scene, self.source, self.settings) | {
            # Where the work was cut off within a range, some pixels hold more than all do.
            "samples": self.done if most <= self.done else [self.done, most],
            "dropped": int(statistics.get("dropped", 0)),
        }


def stated(scene: Scene, source: str, settings: Settings) -> dict[str, Any]:
    """What the header of an image says of how it is made, as far as it is known before the work."""
    import illuminant

    camera = scene.description["camera"]
    return {
        "version": illuminant.__version__,
        "scene": source,
        "scene_hash": scene.hash(),
        "size": list(camera["size"]),
        **({"crop": list(camera["crop"])} if camera.get("crop") else {}),
        "samples": settings.samples,
        **settings.to_header(),
    }


def _scene(scene: Scene | str | os.PathLike[str], allow_outside: bool) -> tuple[Scene, str]:
    """The scene, and the path that names it in a header."""
    from illuminant.scene import Scene

    if isinstance(scene, Scene):
        return scene, scene.path or ""
    return Scene.load(scene, allow_outside=allow_outside), os.fspath(scene)


def _pixels(scene: Scene) -> tuple[int, int]:
    """Width and height of what is rendered: the crop, or the whole image."""
    camera = scene.description["camera"]
    crop = camera.get("crop")
    if crop:
        return int(crop[2] - crop[0]), int(crop[3] - crop[1])
    return int(camera["size"][0]), int(camera["size"][1])


def resized(scene: Scene, size: tuple[int, int]) -> Scene:
    """The same scene with another image size.

    Raises:
        UsageError: the scene has a crop that the new image does not hold.
    """
    crop = scene.description["camera"].get("crop")
    if crop and (crop[2] > size[0] or crop[3] > size[1]):
        raise UsageError(
            f"--size {size[0]}x{size[1]}: the scene's crop ends at {crop[2]},{crop[3]}, outside this image."
        )
    return scene.replace(camera={"size": list(size)})


def _sentence(error: Exception) -> str:
    return str(error).strip().rstrip(".") + "."


def held(image: Image) -> str:
    """How many samples an image holds, as part of a sentence.

    Example:
        >>> import numpy as np
        >>> held(Image(np.zeros((1, 1, 3)), statistics={"least_samples": 16, "most_samples": 64,
        ...                                             "samples_per_pixel": 20.0}))
        'every pixel holds 16 samples or more, 20.0 on average'
    """
    least, most = int(image.statistics["least_samples"]), int(image.statistics["most_samples"])
    mean = float(image.statistics["samples_per_pixel"])
    if least == most:
        return f"every pixel holds {least} sample{'' if least == 1 else 's'}"
    if least == 0:
        return f"some pixels hold no sample yet and are black, {mean:.1f} on average"
    return f"every pixel holds {least} samples or more, {mean:.1f} on average"
