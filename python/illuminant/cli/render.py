"""`illuminant render`: a scene becomes an image."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from illuminant.cli import outcome
from illuminant.cli.look import asked_look
from illuminant.cli.options import (
    Adaptive,
    AllowOutside,
    Bits,
    DisplayName,
    DitherName,
    Elements,
    Exposure,
    FormFactors,
    GamutName,
    Gather,
    Json,
    LightSamples,
    MemoryLimit,
    Patches,
    Pipeline,
    SceneFile,
    Solver,
    ToneName,
    Transfer,
)
from illuminant.cli.work import Stop, done_by, work

if TYPE_CHECKING:
    from illuminant.checkpoint import Checkpoint, Keeper
    from illuminant.job import Job

__all__ = ["render"]


def render(
    scene: SceneFile,
    output: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--output",
            metavar="FILE",
            help="Image: .exr (absolute) or .png (for a display); may be given twice (SCENE.png).",
            show_default=False,
        ),
    ] = None,
    samples: Annotated[
        int | None,
        typer.Option("--samples", metavar="N", help="Paths for each pixel (64)."),
    ] = None,
    time: Annotated[
        str | None,
        typer.Option("--time", metavar="TIME", help="End after 30s, 5m or 1.5h."),
    ] = None,
    error: Annotated[
        str | None,
        typer.Option(
            "--error",
            metavar="E",
            help="End when 95 % of the pixels have a standard error below E (1%, say) of their luminance or the "
            "image's mean, whichever is larger.",
        ),
    ] = None,
    technique: Annotated[
        str | None,
        typer.Option(
            "--technique",
            metavar="NAME",
            help="How light is followed: constant, gouraud, phong (scanline), raytrace, distributed, path, radiosity, "
            "specular-radiosity, hybrid (path).",
        ),
    ] = None,
    illumination: Annotated[
        str | None,
        typer.Option(
            "--illumination",
            metavar="NAME",
            help="What a surface does: bouknight, phong, blinn, whitted, hall, cook-torrance, general (general).",
        ),
    ] = None,
    sampler: Annotated[
        str | None,
        typer.Option(
            "--sampler",
            metavar="NAME",
            help="Random numbers: sobol-owen, random, stratified, jittered, poisson-disk (sobol-owen).",
        ),
    ] = None,
    caustics: Annotated[
        bool,
        typer.Option(
            "--caustics",
            help="Let path follow light from the lamps too, through what mirrors and bends it.",
        ),
    ] = False,
    threshold: Annotated[
        float | None,
        typer.Option(
            "--threshold",
            metavar="W",
            help="Weight below which raytrace and distributed follow a ray no more (0.002).",
        ),
    ] = None,
    cones: Annotated[
        bool,
        typer.Option(
            "--cones",
            help="Let the rays of raytrace be cones: smooth with one sample a pixel.",
        ),
    ] = False,
    light_centres: Annotated[
        str | None,
        typer.Option(
            "--light-centres",
            metavar="HOW",
            help="Where they ask lamps with an area: jittered, random, fixed:N (jittered).",
        ),
    ] = None,
    ambient: Annotated[
        float | None,
        typer.Option(
            "--ambient",
            metavar="F",
            help="Ambient light of techniques but path, as a fraction of what lamps make of a white diffuser (0.15).",
        ),
    ] = None,
    interpolation: Annotated[
        str | None,
        typer.Option(
            "--interpolation",
            metavar="SPACE",
            help="Where scanline techniques interpolate: object or screen (object).",
        ),
    ] = None,
    shading: Annotated[
        str | None,
        typer.Option(
            "--shading",
            metavar="FORM",
            help="How phong finds the illumination at a pixel: full, duff or bishop-weimer (full).",
        ),
    ] = None,
    shadows: Annotated[
        str | None,
        typer.Option(
            "--shadows",
            metavar="HOW",
            help="How scanline techniques find shadows: none, rays, maps or maps:TEXELS (none).",
        ),
    ] = None,
    antialiasing: Annotated[
        str | None,
        typer.Option(
            "--antialiasing",
            metavar="HOW",
            help="How scanline techniques smooth edges: supersampling, or coverage at 32 places a sample "
            "(supersampling).",
        ),
    ] = None,
    infinite: Annotated[
        str | None,
        typer.Option(
            "--infinite",
            metavar="A,B",
            help="What scanline techniques hold at infinity: eye, lights (neither).",
        ),
    ] = None,
    subdivide: Annotated[
        float | None,
        typer.Option(
            "--subdivide",
            metavar="AREA",
            help="Pixels above which scanline techniques subdivide a polygon (never).",
        ),
    ] = None,
    elements: Elements = None,
    patches: Patches = None,
    adaptive: Adaptive = None,
    form_factors: FormFactors = None,
    solver: Solver = None,
    light_samples: LightSamples = None,
    gather: Gather = None,
    mechanisms: Annotated[
        str | None,
        typer.Option(
            "--mechanisms",
            metavar="A,B",
            help="Ways of light that hybrid follows, arriving and reflected: dd, sd, ds, ss (all).",
        ),
    ] = None,
    frustum: Annotated[
        int | None,
        typer.Option(
            "--frustum",
            metavar="N",
            help="Rays along an edge of the frustum in which hybrid samples gloss (one ray, drawn).",
        ),
    ] = None,
    cube: Annotated[
        int | None,
        typer.Option(
            "--cube",
            metavar="N",
            help="Cells along an edge of the cubes into which patches of specular-radiosity send light (32).",
        ),
    ] = None,
    sampling: Annotated[
        str | None,
        typer.Option(
            "--sampling",
            metavar="NAME",
            help="How wavelengths are carried: fitted:N, uniform:N, hall:N, meyer, rgb, xyz, 1nm … (fitted:8).",
        ),
    ] = None,
    size: Annotated[
        str | None,
        typer.Option("--size", metavar="WxH", help="Pixels, such as 960x540 (the camera's)."),
    ] = None,
    depth: Annotated[
        int | None,
        typer.Option(
            "--depth",
            metavar="N",
            help="Longest path in segments: 1 shows lamps only, 2 direct light (no limit).",
        ),
    ] = None,
    filter: Annotated[
        str | None,
        typer.Option(
            "--filter",
            metavar="F",
            help="Reconstruction filter: gaussian, box, tent, mitchell or blackman-harris, with its radius "
            "(gaussian:1.5).",
        ),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option("--seed", metavar="N", help="Seed of the random numbers; same seed, same bits (0)."),
    ] = None,
    threads: Annotated[
        int | None,
        typer.Option(
            "--threads", metavar="N", help="Threads; their number changes no bit of the image (all cores)."
        ),
    ] = None,
    layers: Annotated[
        str | None,
        typer.Option(
            "--layers",
            metavar="NAMES",
            help="Auxiliary images in the EXR: depth,normal,albedo,samples; terms of a scanline technique's model.",
        ),
    ] = None,
    lamps: Annotated[bool, typer.Option("--lamps", help="A layer for the light of each lamp.")] = False,
    keep_spectra: Annotated[
        bool,
        typer.Option(
            "--keep-spectra",
            help="A channel for each wavelength, in the EXR; with --lamps for each lamp too.",
        ),
    ] = False,
    develop_for: Annotated[
        str | None,
        typer.Option(
            "--develop-for",
            metavar="A,FL11",
            help="Lamps that illuminant develop shall show this image under: fitted:N serves them too.",
        ),
    ] = None,
    half: Annotated[
        bool,
        typer.Option("--half", help="16-bit floats in the EXR; their largest is 65504."),
    ] = False,
    exposure: Exposure = None,
    rgb: Annotated[
        str | None,
        typer.Option(
            "--rgb",
            metavar="SYSTEM",
            help="RGB system of an EXR, for programs that know no XYZ: sRGB, 'ACES AP1', ... (XYZ).",
        ),
    ] = None,
    display: DisplayName = None,
    transfer: Transfer = None,
    tone: ToneName = "none",
    gamut: GamutName = None,
    dither: DitherName = "none",
    bits: Bits = 8,
    pipeline: Pipeline = "ideal",
    checkpoint: Annotated[
        Path | None,
        typer.Option(
            "--checkpoint",
            metavar="FILE",
            help="Keep here what is done, to go on from after a crash or Ctrl-C.",
            show_default=False,
        ),
    ] = None,
    every: Annotated[
        str | None,
        typer.Option("--every", metavar="TIME", help="Time between checkpoints (60s)."),
    ] = None,
    resume: Annotated[
        bool,
        typer.Option("--resume", help="Go on from the checkpoint, if there is one, to the same bits."),
    ] = False,
    frames: Annotated[
        str | None,
        typer.Option(
            "--frames",
            metavar="N-M",
            help="Frames of the scene's [animation]: all, 12, 1-48, 1-48x2 or 5,7,9, into FILE with #### for the "
            "number (SCENE.####.png). Finished ones are passed over.",
        ),
    ] = None,
    again: Annotated[
        bool, typer.Option("--again", help="With --frames: render finished ones too.", show_default=False)
    ] = False,
    pixel: Annotated[
        str | None,
        typer.Option(
            "--pixel",
            metavar="X,Y",
            help="Render nothing: follow one path of this pixel again and print its vertices.",
        ),
    ] = None,
    sample: Annotated[
        int | None,
        typer.Option("--sample", metavar="K", help="Which path of that pixel (0).", show_default=False),
    ] = None,
    allow_outside: AllowOutside = False,
    memory_limit: MemoryLimit = None,
    json: Json = False,
) -> None:
    """Render a scene to an image.

    Ctrl-C ends cleanly and writes what is done. Options not given are the scene's own, in its table
    [render], or the defaults in parentheses.

    \b
    Examples:
      illuminant render room.toml -o room.png
      illuminant render room.toml -o room.exr -o room.png --time 30s
      illuminant render room.toml --samples 4096 --checkpoint room.ckpt --resume
      illuminant render turntable.toml --frames all -o turn.####.png
    """
    from illuminant.errors import UsageError
    from illuminant.image import check_output

    if scene.is_dir():
        raise UsageError(f"{scene} is a folder: name a scene file.")
    if pixel is None and sample is not None:
        raise UsageError(f"--sample {sample}: goes with --pixel, whose path it names.")
    keeper, before = _checkpoints(checkpoint, every, resume)
    if again and frames is None:
        raise UsageError("--again: goes with --frames, whose finished ones it renders too.")
    if frames is not None and checkpoint is not None:
        raise UsageError(
            "--checkpoint: goes with one image; --frames passes over the frames that are finished."
        )
    paths = list(dict.fromkeys(output or [Path(scene.stem + ".png")]))
    if checkpoint is not None and os.path.realpath(checkpoint) in map(os.path.realpath, paths):
        raise UsageError(f"--checkpoint {checkpoint}: is the file of the image too; name another.")
    if pixel is None and frames is None:
        for path in paths:
            check_output(path)
    look = asked_look(display, exposure, transfer, tone, gamut, dither, bits, seed or 0, pipeline)
    if rgb is not None:
        from illuminant import rgb_system

        rgb_system.named(rgb)
    options: dict[str, Any] = {
        "technique": technique,
        "illumination": illumination,
        "sampling": sampling,
        "samples": samples,
        "size": size,
        "depth": depth,
        "seed": seed,
        "threads": threads,
        "filter": filter,
        "layers": layers,
        "keep_spectra": keep_spectra or None,
        "lamps": lamps or None,
        "develop_for": develop_for,
        "time": time,
        "error": error,
        "sampler": sampler,
        "caustics": caustics or None,
        "threshold": threshold,
        "cones": cones or None,
        "light_centres": light_centres,
        "ambient": ambient,
        "interpolation": interpolation,
        "shading": shading,
        "shadows": shadows,
        "antialiasing": antialiasing,
        "infinite": infinite,
        "subdivide": subdivide,
        "elements": elements,
        "patches": patches,
        "adaptive": adaptive,
        "form_factors": form_factors,
        "solver": solver,
        "light_samples": light_samples,
        "gather": gather,
        "mechanisms": mechanisms,
        "frustum": frustum,
        "cube": cube,
    }
    with Stop() as stop:
        from illuminant.job import Job

        if frames is not None:
            from illuminant.cli.frames import one_frame, render_frames

            if pixel is not None:
                still = one_frame(
                    scene, frames, pixel, allow_outside=allow_outside, memory_limit=memory_limit
                )
                job = stop.watch(Job(still, memory_limit=memory_limit, **options))
                outcome.print_path(job, pixel, sample or 0, json)
                return
            saving = {"look": look, "rgb": rgb, "half": half}
            bounds: dict[str, Any] = {"allow_outside": allow_outside, "memory_limit": memory_limit}
            render_frames(scene, frames, output, options | bounds, saving, again=again, json=json, stop=stop)
            return
        job = stop.watch(
            Job(
                scene,
                checkpoint=before,
                solve_by=done_by.get().solve_by,
                keeper=keeper,
                allow_outside=allow_outside,
                memory_limit=memory_limit,
                **options,
            )
        )
        if pixel is not None:
            outcome.print_path(job, pixel, sample or 0, json)
        else:
            _render(
                job,
                paths,
                {"look": look, "rgb": rgb, "half": half},
                outcome.again_command(scene, options, allow_outside),
                json,
                keeper,
            )


def _checkpoints(
    file: Path | None, every: str | None, resume: bool
) -> tuple[Keeper | None, Checkpoint | None]:
    """What keeps checkpoints, and the one to go on from."""
    from illuminant.checkpoint import Keeper, resumed
    from illuminant.cli.report import warning
    from illuminant.errors import UsageError
    from illuminant.settings import duration

    if file is None:
        for option, given in (("--every", every is not None), ("--resume", resume)):
            if given:
                raise UsageError(f"{option}: goes with --checkpoint FILE.")
        return None, None
    seconds = 60.0 if every is None else duration(every, "--every")
    keeper = Keeper(file, seconds, lambda error: warning(f"No checkpoint: {error} The render goes on."))
    return keeper, resumed(file, resume=resume)


def _render(
    job: Job, paths: list[Path], look: dict[str, Any], again: str, json: bool, keeper: Keeper | None
) -> None:
    """Do the work, write the files, and say how it went."""
    from illuminant.cli.report import closing, emit_json, note, warning
    from illuminant.errors import Interrupted
    from illuminant.job import held

    for text in job.warnings():
        warning(text)
    settings = job.settings
    layers = settings.layers or settings.lamps or settings.keep_spectra
    if layers and not any(path.suffix.lower() == ".exr" for path in paths):
        warning("A PNG holds no layers: add -o FILE.exr to keep them.")
    image = work(job, keeper)
    interrupted = job.interrupted  # a request that comes later finds the work done
    if interrupted and image.statistics["most_samples"] == 0:
        raise Interrupted("no pixel holds a sample yet, so nothing was written.")
    saved = [outcome.save(image, path, **look) for path in paths]
    facts = outcome.facts(job, image, saved, again) | {"complete": not interrupted}
    if json:
        emit_json(facts)
    else:
        note(closing(facts))
        outcome.say_exposure(saved, image)
    outcome.say_dropped(facts)
    if interrupted:
        raise Interrupted(f"{held(image)}; the image so far is written.")
