"""Rendering a scene to an image: the calls that make a `Job` and follow it to its end.

Ctrl-C ends the work between tiles: `render` raises `RenderInterrupted` with the partial image in its attribute
`image`.

Example:
    >>> from illuminant import render
    >>> image = render("scenes/cornell.toml", samples=64, size=(256, 256))    # doctest: +SKIP
    >>> image.statistics["samples_per_pixel"]                                # doctest: +SKIP
    64.0
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from illuminant.checkpoint import Keeper, resumed
from illuminant.errors import Interrupted, UsageError
from illuminant.job import MOST_SAMPLES, Job, OnProgress, held
from illuminant.settings import SCANLINE, duration

if TYPE_CHECKING:
    from illuminant.image import Image
    from illuminant.scene import Scene

__all__ = ["RenderInterrupted", "progressive", "render", "replay", "replay_job"]


class RenderInterrupted(Interrupted):
    """Ctrl-C ended a render.

    Attributes:
        image: what was done until then.
    """

    def __init__(self, message: str, image: Image) -> None:
        super().__init__(message)
        self.image = image


def keeper_of(checkpoint: str | os.PathLike[str] | None, every: str | float) -> Keeper | None:
    """What keeps the checkpoints of a render; one that cannot be written goes to the log."""
    if checkpoint is None:
        return None
    log = logging.getLogger("illuminant")
    return Keeper(checkpoint, duration(every, "every"), lambda error: log.warning(str(error)))


def log_warnings(job: Job) -> None:
    """Say in the log `illuminant` what does not suit the scene; Python shows it on stderr if nobody listens."""
    for text in job.warnings():
        logging.getLogger("illuminant").warning(text)


def progressive(
    scene: Scene | str | os.PathLike[str], *, progress: OnProgress | None = None, **options: Any
) -> Iterator[Image]:
    """Render a scene and yield the image after each range of samples; the last one is the whole.

    Args:
        scene: a `Scene`, or the path of a scene file.
        progress: as for `render`.
        options: as for `render`.

    Yields:
        Images that hold 1, 4, 16, 64, 128, ... samples of each pixel. After Ctrl-C the last one is what is
        done.

    Example:
        >>> for image in progressive("scenes/cornell.toml", samples=256):     # doctest: +SKIP
        ...     image.save("preview.png")
    """
    job = Job(scene, **options)
    log_warnings(job)
    for _ in job.passes(progress):
        yield job.image()
    if job.interrupted or job.stopped:
        yield job.image()


def render(
    scene: Scene | str | os.PathLike[str],
    *,
    technique: str | None = None,
    illumination: str | None = None,
    sampling: str | None = None,
    samples: int | None = None,
    size: str | tuple[int, int] | None = None,
    depth: int | None = None,
    seed: int | None = None,
    threads: int | None = None,
    filter: str | tuple[str, float] | None = None,
    layers: str | tuple[str, ...] | list[str] | None = None,
    keep_spectra: bool | None = None,
    lamps: bool | None = None,
    develop_for: str | Sequence[str] | None = None,
    time: str | float | None = None,
    error: str | float | None = None,
    sampler: str | None = None,
    caustics: bool | None = None,
    threshold: float | None = None,
    cones: bool | None = None,
    light_centres: str | None = None,
    ambient: float | None = None,
    interpolation: str | None = None,
    shading: str | None = None,
    shadows: str | None = None,
    antialiasing: str | None = None,
    infinite: str | Sequence[str] | None = None,
    subdivide: float | None = None,
    elements: int | None = None,
    patches: int | None = None,
    adaptive: float | None = None,
    form_factors: str | None = None,
    solver: str | None = None,
    light_samples: int | None = None,
    gather: str | None = None,
    mechanisms: str | Sequence[str] | None = None,
    frustum: int | None = None,
    cube: int | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    every: str | float = 60.0,
    resume: bool = False,
    allow_outside: bool = False,
    memory_limit: int | str | None = None,
    progress: OnProgress | None = None,
    on_partial: Callable[[Image], object] | None = None,
) -> Image:
    """Render a scene.

    Options that are not given are the scene's own (its table `[render]`), else the defaults named here. What in them
    does not suit the scene (an even sampling for a lamp with lines, say) goes to the log `illuminant`.

    Args:
        scene: a `Scene`, or the path of a scene file.
        technique: how light is followed; default `path`.
        illumination: what a surface does; default `general`.
        sampling: how wavelengths are carried; default `fitted:8`; `1nm` is the reference.
        samples: paths for each pixel; default 64, or no limit with `time` or `error`.
        size: `(width, height)` in pixels, or `"960x540"`; default the camera's.
        depth: longest path in segments, default no limit; 1 shows lamps only, 2 direct light.
        seed: of the random numbers; default 0. The same seed gives the same bits, whatever the number of
            threads.
        threads: default 0, one for each processor.
        filter: reconstruction filter and its radius in pixels; default `("gaussian", 1.5)`.
        layers: auxiliary images: `depth`, `normal`, `albedo`, `samples`; of scanline techniques also `terms`, the
            parts `ambient`, `diffuse`, `specular`, `transmitted`, `emitted`.
        keep_spectra: keep the spectral lanes of every pixel as the layer `spectra`; with `lamps` those of the light of
            each lamp as well, as layers `spectra:NAME`.
        lamps: a layer `lamp:NAME` for the light of each lamp.
        develop_for: lamps under which `illuminant.display.develop` shall show the image later, which `fitted:N` is
            then to serve too: names of the library, files, or `2856K`.
        time: end when this time is up: seconds, or `"30s"`, `"5m"`.
        error: end at this relative standard error: a fraction, or `"1%"`.
        sampler: which random numbers; default `sobol-owen`, or `random`, `stratified`, `jittered`, `poisson-disk`.
        caustics: let `path` follow light from the lamps too, where mirrors and smooth glass send it on surfaces that
            scatter it; without, it finds such light by chance, and that of lamps without size never. Default False.
        threshold: weight below which `raytrace` and `distributed` follow a ray no more; default 0.002.
        cones: let the rays of `raytrace` be cones, which see how much of a pixel, of a lamp and of a mirror's image a
            surface covers; one sample a pixel is then smooth, and more are the same. Default False.
        light_centres: where they ask lamps that have an area; default `jittered`, or `random`, or `fixed:N`.
        ambient: ambient light of all techniques but `path`; default 0.15 of what lamps make of a white diffuser.
        interpolation: where scanline techniques interpolate; default `object`, or `screen`.
        shading: how `phong` finds the illumination at a pixel; default `full`, or `duff` or `bishop-weimer`.
        shadows: how scanline techniques find shadows; default `none`, or `rays`, or `maps:N` of N texels.
        antialiasing: how they smooth edges; default `supersampling`, or `coverage`: 32 places a sample, and each
            polygon shaded once in a pixel, so that one sample does.
        infinite: what they hold at infinity: `eye`, `lights` or both; default neither.
        subdivide: area in pixels above which they subdivide polygons; default never.
        elements: about how many elements `radiosity` cuts surfaces into; default 6000, of
            `specular-radiosity` 1000.
        patches: about how many patches these make, which send light on; default one for each element.
        adaptive: fraction by which direct light may differ about an element before it is cut again; default never.
        form_factors: how they are found; default `rays:1024`, or `hemicube:N`, `scanline:N`, `area:N`.
        solver: default `bicgstab`, or `gauss-seidel`, `gauss`, `progressive`.
        light_samples: at how many places of an element each lamp is asked; default 64.
        gather: what a pixel makes of the solution; default `none`, which shows it, or `direct`, which asks lamps again,
            or `full`, which looks around from every pixel (final gather).
        mechanisms: ways of light that `hybrid` follows, how it arrives and how it is reflected: `dd`, `sd`, `ds`, `ss`
            (d diffuse, s specular); default all.
        frustum: rays along an edge of the frustum in which `hybrid` samples what rough surfaces mirror; default one
            ray, drawn.
        cube: cells along an edge of the cubes into which each patch of `specular-radiosity` sends light; default 32.
        checkpoint: file from which the render can go on after a crash; one is also written at the end.
        every: time between checkpoints: seconds, or `"60s"`, `"5m"`. One that cannot be written goes to the log.
        resume: go on from that file, if there is one, to the bits of a render that was never cut off. More `samples`
            than before may be asked for.
        allow_outside: let a scene file name files outside its folder: only for scenes that you trust. Default False.
        memory_limit: refuse the work if it would take more memory than this: bytes, or `"4GB"`; default what is free.
        progress: called about ten times a second with a `Progress`; returning False ends the render with what
            is done.
        on_partial: called after each range with the image so far.

    Returns:
        The image, in absolute XYZ, with its layers, settings and statistics.

    Raises:
        SceneError: the scene has mistakes; all of them are in `problems`.
        UsageError: an option cannot be, or does not go with the scene; or the checkpoint is of another render.
        DataError: the checkpoint is damaged.
        MachineError: there is not enough memory, or no Embree.
        RenderInterrupted: Ctrl-C; its attribute `image` holds what was done.

    Example:
        >>> image = render("scenes/cornell.toml", samples=256, layers="depth,normal")     # doctest: +SKIP
        >>> image.layers["depth"].shape                                                   # doctest: +SKIP
        (512, 512, 1)
    """
    keeper = keeper_of(checkpoint, every)
    job = Job(
        scene,
        checkpoint=None if checkpoint is None else resumed(checkpoint, resume=resume),
        technique=technique,
        illumination=illumination,
        sampling=sampling,
        samples=samples,
        size=size,
        depth=depth,
        seed=seed,
        threads=threads,
        filter=filter,
        layers=layers,
        keep_spectra=keep_spectra,
        lamps=lamps,
        develop_for=develop_for,
        time=time,
        error=error,
        sampler=sampler,
        caustics=caustics,
        threshold=threshold,
        cones=cones,
        light_centres=light_centres,
        ambient=ambient,
        interpolation=interpolation,
        shading=shading,
        shadows=shadows,
        antialiasing=antialiasing,
        infinite=infinite,
        subdivide=subdivide,
        elements=elements,
        patches=patches,
        adaptive=adaptive,
        form_factors=form_factors,
        solver=solver,
        light_samples=light_samples,
        gather=gather,
        mechanisms=mechanisms,
        frustum=frustum,
        cube=cube,
        keeper=keeper,
        allow_outside=allow_outside,
        memory_limit=memory_limit,
    )
    log_warnings(job)
    for _ in job.passes(progress, keeper):
        if on_partial is not None:
            on_partial(job.image())
    image = job.image()
    if job.interrupted:
        raise RenderInterrupted(f"The render was interrupted; {held(image)}.", image)
    return image


def replay(
    scene: Scene | str | os.PathLike[str], pixel: tuple[int, int], sample: int, **options: Any
) -> dict[str, Any]:
    """Follow one path again, with its vertices.

    Args:
        scene: a `Scene`, or the path of a scene file.
        pixel: column and row, from the top left.
        sample: number of the sample, from 0.
        options: as for `render`; those that change random numbers (seed, size, filter, technique, error) must
            be the same.

    Returns:
        `passes`, for each pass (only `1nm` has more than one) the vertices in order, each with `object`, `material`,
        `primitive`, `position`, `throughput` and `added`; and what the path brought: `xyz`, and `spectrum`, its lanes.

    Raises:
        UsageError: the pixel lies outside the image, or the sample is negative.
    """
    return replay_job(Job(scene, **options), pixel, sample)


def replay_job(job: Job, pixel: tuple[int, int], sample: int) -> dict[str, Any]:
    """As `replay`, for a job that exists already."""
    if job.settings.technique in SCANLINE:
        raise UsageError(f"--pixel: {job.settings.technique} follows no paths; path does.")
    x, y = pixel
    camera = job.scene.description["camera"]
    left, top, right, bottom = camera.get("crop") or [0, 0, *camera["size"]]
    if not (left <= x < right and top <= y < bottom):
        raise UsageError(
            f"--pixel {x},{y}: the pixels of this image run from {left},{top} to {right - 1},{bottom - 1}."
        )
    if not 0 <= sample <= MOST_SAMPLES:
        raise UsageError(f"--sample {sample}: expected a whole number from 0 to {MOST_SAMPLES}.")
    return dict(job.core_render.replay(x, y, sample))
