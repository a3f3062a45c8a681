"""Draw the pictures of docs/way: `python tools/draw_way.py [NAME...]` writes them, or those named, into docs/images.

Everything in them is computed or rendered by illuminant; nothing is painted. All of them take about eight minutes of
one processor. A name is that of a page of docs/way: `lamps`, `finishes`, `materials`, and so on.
"""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from PIL import Image as Picture

import illuminant
from illuminant import auditing, colorimetry, finishes, optics, plots, sampling, spectra
from illuminant.comparison import pairs
from illuminant.display.look import Look
from illuminant.plots import observer as observers
from illuminant.plots.style import line_look, styled
from illuminant.plots.wavelength_axis import draw_wavelength_axis

ROOT = Path(__file__).parent.parent
IMAGES = ROOT / "docs" / "images"
SCENES = ROOT / "scenes"
WIDTH = 8.2
"""Of a figure, inches; at 100 pixels per inch about as wide as a page."""

VISIBLE = (380.0, 780.0)


def save(figure: Figure, name: str, *, spectrum: bool = False) -> None:
    """Write a figure 820 pixels wide: in 256 colours, unless a spectrum in it would show their steps."""
    path = IMAGES / name
    figure.set_dpi(100)
    plots.save(figure, path)
    reduce(path, spectrum=spectrum)
    print(f"{name}: {path.stat().st_size / 1000:.0f} kB", flush=True)


def reduce(path: Path, *, spectrum: bool = False) -> None:
    """Make a PNG as small as it may be."""
    picture = Picture.open(path).convert("RGB")
    if not spectrum:
        picture = picture.quantize(256, kmeans=4, dither=Picture.Dither.NONE)
    picture.save(path, optimize=True)


def sheet(tiles: Sequence[tuple[str, Any]], columns: int, name: str, exposure: float, height: float) -> None:
    """Images side by side, each under its title, with a caption below where the title has a second line."""
    rows = -(-len(tiles) // columns)
    with styled():
        figure = Figure(figsize=(WIDTH, rows * height), layout="constrained")
        for number, (title, image) in enumerate(tiles):
            axes = figure.add_subplot(rows, columns, number + 1)
            codes = image if isinstance(image, np.ndarray) else image.shown(exposure=exposure).picture.codes
            axes.imshow(codes, interpolation="antialiased")
            first, _, second = title.partition("\n")
            axes.set_title(first, fontsize=8.5, loc="center", pad=4)
            axes.set_xticks([])
            axes.set_yticks([])
            for spine in axes.spines.values():
                spine.set_visible(False)
            if second:
                axes.set_xlabel(second, fontsize=7.5, labelpad=3)
    save(figure, name)


# --- lamps, materials, surfaces ---------------------------------------------------------------------------------


def lamps() -> None:
    """Smooth sources and sources with lines, each with the same luminance."""
    names = (
        (("blackbody 2856 K", "A"), ("daylight 6504 K", "D65"), ("white LED 4103 K", "LED-B3")),
        (
            ("fluorescent, broad", "FL2"),
            ("fluorescent, three bands", "FL11"),
            ("sodium, high pressure", "HP1"),
        ),
    )
    with styled():
        figure = Figure(figsize=(WIDTH, 3.3), layout="constrained")
        for number, group in enumerate(names):
            axes = figure.add_subplot(1, 2, number + 1)
            for index, (label, name) in enumerate(group):
                lamp = spectra.load(name)
                at = np.arange(380, 781)
                luminance = 683.0 * (lamp * colorimetry.matching_functions()[1]).area()
                axes.plot(at, 1e6 * lamp.at(at) / luminance, label=label, **line_look(index))
            axes.set_ylim(0, 36 if number == 0 else 95)
            axes.set_ylabel("mW·nm⁻¹ for each 1000 lm" if number == 0 else "")
            axes.legend(loc="upper left" if number == 0 else "upper right")
            draw_wavelength_axis(axes, VISIBLE, observers.named())
    save(figure, "way-lamps.png", spectrum=True)


def materials() -> None:
    """Reflectance of metals at normal incidence from n and k, of paints as measured, and dispersion of media."""
    at = np.arange(380, 781, 5)
    with styled():
        figure = Figure(figsize=(WIDTH, 3.1), layout="constrained")
        axes = figure.subplots(1, 3)
        for number, metal in enumerate(("silver", "aluminium", "gold", "copper", "iron", "chromium")):
            n, k = (spectra.load(f"{metal}.{part}").at(at) for part in "nk")
            axes[0].plot(at, optics.normal_reflectance(n, k), label=metal, **line_look(number))
        axes[0].set_title("metals, from n and k")
        axes[0].set_ylabel("reflectance")
        for number, patch in enumerate(("white 9.5", "orange", "foliage", "blue", "black 2")):
            axes[1].plot(at, spectra.load(f"ColorChecker/{patch}").at(at), label=patch, **line_look(number))
        axes[1].set_title("paints, as measured")
        for number, medium in enumerate(("BK7", "fused silica", "water")):
            axes[2].plot(at, spectra.load(f"{medium}.n").at(at), label=medium, **line_look(number))
        axes[2].set_title("media: n")
        for one in axes:
            one.legend(fontsize=7.5, loc="best")
            draw_wavelength_axis(one, VISIBLE, observers.named())
            one.xaxis.set_ticks([400, 500, 600, 700])
        axes[0].set_ylim(0, 1.02)
        axes[1].set_ylim(0, 1.02)
    save(figure, "way-materials.png", spectrum=True)


def balls() -> None:
    """One copper ball for each finish, with the slope and height that it stands for."""
    # Gloss is for paint, and looks like a mirror; sandblasted has the slope of matte.
    names = [name for name in finishes.names() if name not in ("gloss", "sandblasted")]
    names = sorted(names, key=lambda name: finishes.finish(name).slope[1])
    rows: list[Any] = []
    objects: dict[str, Any] = {
        "floor": {
            "material": "floor",
            "rectangle": {"corner": [-20.0, 0.0, -20.0], "edges": [[0.0, 0.0, 40.0], [40.0, 0.0, 0.0]]},
        },
        "lamp": {
            "material": "lamp",
            "rectangle": {"corner": [-4.0, 6.0, 2.0], "edges": [[2.5, 0.0, 0.0], [0.0, 0.0, 2.5]]},
        },
        "ball": {"material": "ball", "sphere": {"center": [0.0, 1.0, 0.0], "radius": 1.0}},
    }
    for name in names:
        scene = illuminant.Scene.build(
            camera={
                "eye": [0.0, 2.2, 8.0],
                "target": [0.0, 0.96, 0.0],
                "field_of_view": 17.0,
                "size": [110, 110],
            },
            objects=objects,
            materials={
                "floor": {"kind": "diffuse", "reflectance": "ColorChecker/neutral 6.5"},
                "lamp": {"kind": "emitter", "spectrum": "D65", "luminance_cd_m2": 20000.0},
                "ball": {"kind": "named", "name": f"copper, {name}"},
            },
            lights={"sky": {"kind": "environment", "spectrum": "D65", "luminance_cd_m2": 300.0}},
        )
        found = finishes.finish(name)
        m = "–".join(f"{one:g}" for one in dict.fromkeys(found.slope))
        height = "" if found.sigma_nm is None else f", σ {max(found.sigma_nm):.0f} nm"
        rows.append((f"{name}\nm {m}{height}", illuminant.render(scene, samples=128)))
    sheet(rows, 6, "way-finishes.png", 1 / 900.0, 1.75)


def surfaces() -> None:
    """Fresnel's equations, masking, and coherence over the angle."""
    theta = np.linspace(0.0, 89.9, 300)
    cos = np.cos(np.radians(theta))
    with styled():
        figure = Figure(figsize=(WIDTH, 3.1), layout="constrained")
        axes = figure.subplots(1, 3)
        boundaries: dict[str, Callable[[str], Any]] = {
            "glass, n = 1.5": lambda p: optics.fresnel_dielectric(cos, 1.5, p),
            "copper, 0.617 + 2.63i": lambda p: optics.fresnel_conductor(cos, 0.617, 2.63, p),
        }
        for number, (name, reflectance) in enumerate(boundaries.items()):
            colour = line_look(number)["color"]
            axes[0].plot(theta, reflectance("parallel"), ":", color=colour, linewidth=1.0)
            axes[0].plot(theta, reflectance("perpendicular"), "--", color=colour, linewidth=1.0)
            axes[0].plot(theta, reflectance(""), color=colour, label=name)
        axes[0].set_title("Fresnel (dotted ∥, dashed ⊥)")
        axes[0].set_ylabel("reflected fraction")
        radians = np.radians(theta)
        axes[1].plot(
            theta,
            optics.masking_torrance_sparrow(np.radians(60.0), radians, np.pi),
            label="V-grooves (2.21)",
            **line_look(1),
        )
        for number, m in enumerate((0.2, 0.5, 1.0)):
            axes[1].plot(
                theta,
                optics.masking_smith(0.5, cos, m),
                label=f"Smith, m = {m:g}",
                color=line_look(0)["color"],
                linestyle=("-", (0, (5, 1.5)), (0, (1.2, 1.2)))[number],
            )
        axes[1].set_title("masking, light at 60°")
        for number, sigma in enumerate((20.0, 50.0, 150.0)):
            g = optics.apparent_roughness(sigma, 580.0, cos)
            axes[2].plot(theta, optics.coherent_fraction(g), label=f"σ = {sigma:g} nm", **line_look(number))
        axes[2].set_title("coherent part at 580 nm")
        for one, below in zip(axes, (0.62, 0.35, 0.78), strict=True):
            one.set(xlim=(0, 90), ylim=(0, 1.02), xlabel="angle, degrees", xticks=[0, 30, 60, 90])
            one.legend(fontsize=7.5, loc="upper left", bbox_to_anchor=(0.0, below))
            one.grid(True)
    save(figure, "way-surfaces.png")


def balance() -> None:
    """What rough copper returns with and without what its facets send to each other."""
    angles = (0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 80.0, 87.0, 89.0)
    with styled():
        figure = Figure(figsize=(WIDTH, 3.0), layout="constrained")
        axes = figure.subplots(1, 2, sharey=True)
        for one, m in zip(axes, (0.3, 1.0), strict=True):
            perfect = {"kind": "conductor", "n": 1.0, "k": 1e4, "roughness": m}
            for number, model in enumerate(("general", "cook-torrance")):
                found = auditing.audit(
                    perfect, illumination=model, angles_deg=angles, wavelengths_nm=[580.0], draws=20_000
                )[0]
                total = (found.coherent_reflection + found.scattered_reflection)[:, 0]
                one.plot(angles, total, label=model, **line_look(number))
            one.axhline(1.0, color="black", linewidth=0.6)
            one.set(title=f"m = {m:g}", xlabel="angle of incidence, degrees", ylim=(0, 1.15), xlim=(0, 90))
            one.grid(True)
        axes[0].set_ylabel("reflected of 1, with F = 1")
        axes[0].legend(loc="lower left")
    save(figure, "way-balance.png")


# --- models, techniques, radiosity ------------------------------------------------------------------------------


SMALL = (220, 165)
AMBIENT = 0.05
"""Ambient light of the techniques that follow no light between surfaces; about right for so open a scene."""


@functools.cache
def small_scene() -> Any:
    """Copper, glass and glossy paint on tiles, between two walls, under one lamp: a scene for every model."""
    return illuminant.Scene.build(
        camera={
            "eye": [0.0, 2.1, 6.2],
            "target": [0.0, 0.72, 0.0],
            "field_of_view": 34.0,
            "size": list(SMALL),
        },
        materials={
            "tiles": {"kind": "diffuse", "reflectance": {"image": "images/tiles.png", "repeat": [5.0, 5.0]}},
            "wall": {"kind": "diffuse", "reflectance": "ColorChecker/neutral 8"},
            "red wall": {"kind": "diffuse", "reflectance": "ColorChecker/moderate red"},
            "copper": {"kind": "named", "name": "copper, satin"},
            "glass": {"kind": "dielectric", "medium": "BK7", "dispersion": False},
            "paint": {"kind": "named", "name": "ColorChecker/blue paint, gloss"},
            "lamp": {"kind": "emitter", "spectrum": "D65", "flux_lm": 9000.0},
        },
        objects={
            "floor": {
                "material": "tiles",
                "rectangle": {"corner": [-4.0, 0.0, 5.0], "edges": [[8.0, 0.0, 0.0], [0.0, 0.0, -7.0]]},
            },
            "back": {
                "material": "wall",
                "rectangle": {"corner": [-4.0, 0.0, -2.0], "edges": [[8.0, 0.0, 0.0], [0.0, 4.0, 0.0]]},
            },
            "left": {
                "material": "red wall",
                "rectangle": {"corner": [-2.4, 0.0, 5.0], "edges": [[0.0, 0.0, -7.0], [0.0, 4.0, 0.0]]},
            },
            "copper": {"material": "copper", "sphere": {"center": [-1.3, 0.65, -0.4], "radius": 0.65}},
            "glass": {"material": "glass", "sphere": {"center": [0.05, 0.55, 0.75], "radius": 0.55}},
            "paint": {"material": "paint", "sphere": {"center": [1.35, 0.65, -0.5], "radius": 0.65}},
            "lamp": {
                "material": "lamp",
                "rectangle": {"corner": [1.0, 3.6, 1.4], "edges": [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]},
            },
        },
        directory=SCENES,
    )


@functools.cache
def right() -> Any:
    """That scene by all its light."""
    return illuminant.render(
        small_scene(), technique="path", illumination="general", samples=128, caustics=True
    )


def models() -> None:
    """The same scene by every illumination model."""
    scene, best = small_scene(), right()
    exposure = best.auto_exposure()
    tiles: list[Any] = []
    years = {
        "bouknight": 1970,
        "phong": 1975,
        "blinn": 1977,
        "whitted": 1980,
        "cook-torrance": 1982,
        "hall": 1983,
        "general": "today",
    }
    for name, year in years.items():
        image = illuminant.render(
            scene, technique="distributed", illumination=name, samples=64, ambient=AMBIENT
        )
        apart = illuminant.diff(best, image, exposure=exposure)
        tiles.append((f"{name} ({year})\nΔE00 {apart.mean:.1f}", image))
    tiles.append(("general, by path\nthe reference", best))
    sheet(tiles, 4, "way-models.png", exposure, 1.95)


def transport() -> None:
    """The same scene by every technique that needs no solution, each with the model that suits it."""
    scene, best = small_scene(), right()
    exposure = best.auto_exposure()
    tiles: list[Any] = []
    for technique, model, samples in (
        ("constant", "bouknight", 16),
        ("gouraud", "bouknight", 16),
        ("phong", "phong", 16),
        ("raytrace", "whitted", 16),
        ("distributed", "hall", 64),
    ):
        image = illuminant.render(
            scene, technique=technique, illumination=model, samples=samples, ambient=AMBIENT
        )
        apart = illuminant.diff(best, image, exposure=exposure)
        tiles.append((f"{technique} × {model}\nΔE00 {apart.mean:.1f}", image))
        print(technique, model, f"{image.statistics['seconds']:.2f} s, ΔE00 {apart.mean:.2f}", flush=True)
    print("path", f"{best.statistics['seconds']:.2f} s")
    tiles.append(("path × general\nthe reference", best))
    sheet(tiles, 3, "way-transport.png", exposure, 2.5)


def radiosity() -> None:
    """One room by path, radiosity, hybrid, and what they differ in."""
    scene = illuminant.load(SCENES / "reading-room.toml")
    size = (220, 165)
    common: dict[str, Any] = {"size": size, "elements": 6000}
    best = illuminant.render(scene, size=size, technique="path", samples=64)
    exposure = float(scene.render_defaults["exposure"])
    tiles: list[Any] = []
    for technique, options in (
        ("radiosity", {"samples": 16}),
        ("hybrid", {"samples": 32}),
    ):
        image = illuminant.render(scene, technique=technique, **common, **options)
        apart = illuminant.diff(best, image, exposure=exposure)
        tiles.append((f"{technique}\nΔE00 {apart.mean:.1f}", image))
        print(technique, f"{image.statistics['seconds']:.2f} s, ΔE00 {apart.mean:.2f}", flush=True)
    tiles.append(("path, 64 samples\nthe reference", best))
    sheet(tiles, 3, "way-radiosity.png", exposure, 2.5)


# --- sampling, eye, display -------------------------------------------------------------------------------------


def wavelengths() -> None:
    """What each sampling costs under two lamps, over the number of its samples."""
    families = {
        "uniform": (
            "uniform:4",
            "uniform:6",
            "uniform:8",
            "uniform:12",
            "uniform:16",
            "uniform:24",
            "uniform:32",
        ),
        "hall": ("hall:4", "hall:6", "hall:9", "hall:12", "hall:16"),
        "fitted": ("fitted:4", "fitted:6", "fitted:8", "fitted:10", "fitted:12", "fitted:16"),
    }
    points = {"rgb": 3, "xyz": 3, "meyer": 4}
    names = [name for family in families.values() for name in family] + list(points)
    lights = ("D65", "FL11")
    found = {study.sampling: study.by_lamp for study in sampling.compare(names, list(lights))}
    with styled():
        figure = Figure(figsize=(WIDTH, 3.3), layout="constrained")
        axes = figure.subplots(1, 2, sharey=True)
        for one, lamp in zip(axes, lights, strict=True):
            for number, (family, members) in enumerate(families.items()):
                counts = [int(name.split(":")[1]) for name in members]
                one.plot(
                    counts,
                    [found[name][lamp].mean for name in members],
                    marker="o",
                    markersize=3.5,
                    label=f"{family}:N",
                    **line_look(number),
                )
            for number, (name, count) in enumerate(points.items()):
                one.plot(
                    [count],
                    [found[name][lamp].mean],
                    linestyle="",
                    marker="sDv"[number],
                    markersize=5,
                    label=name,
                    color=line_look(number + 3)["color"],
                )
            one.axhline(1.0, color="black", linewidth=0.6)
            one.set(title=f"under {lamp}", xlabel="samples N", yscale="log", ylim=(0.005, 25), xlim=(2, 33))
            one.grid(True)
        axes[0].set_ylabel("mean ΔE00 against 1 nm")
        axes[1].text(32.5, 0.93, "just seen side by side", ha="right", va="top", fontsize=7.5)
        axes[0].legend(loc="upper right", ncols=2, fontsize=7.5)
    save(figure, "way-sampling.png")


def eye() -> None:
    """The observer's functions beside the diagram, with blackbodies and gamuts."""
    left = plots.matching_functions("1931", size=(3.9, 3.9))
    right = plots.chromaticity("xy", gamuts=["sRGB", "Rec.2020"], planckian=True, size=(4.5, 3.9))
    parts = []
    for number, figure in enumerate((left, right)):
        figure.set_dpi(100)
        path = IMAGES / f"way-eye-{number}.part.png"
        plots.save(figure, path)
        parts.append(Picture.open(path).convert("RGB"))
        path.unlink()
    whole = Picture.new(
        "RGB", (sum(part.width for part in parts), max(part.height for part in parts)), "white"
    )
    for number, part in enumerate(parts):
        whole.paste(part, (number * parts[0].width, whole.height - part.height))
    path = IMAGES / "way-eye.png"
    whole.save(path, optimize=True)
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


def display() -> None:
    """One render on its way to a display: each tile shows what one step does, or what is seen without it."""
    image = illuminant.render(SCENES / "demo.toml", size=(260, 146), samples=128)
    exposure = image.auto_exposure()
    tiles: list[Any] = []
    for title, look in (
        ("linear values as codes\nno transfer function", Look(transfer="gamma 1")),
        ("clamped, sRGB\neach channel cut at 0 and 1", Look(gamut="clamp")),
        ("cook, sRGB\nthe default", Look()),
        ("filmic tone\nfour times the exposure", Look(tone="filmic", exposure=4 * exposure)),
        ("3 bits, rounded\nbands", Look(bits=3)),
        ("3 bits, blue noise\nthe mean is kept", Look(bits=3, dither="blue-noise")),
    ):
        codes = image.shown(look, exposure=look.exposure or exposure).picture
        values = np.round(255.0 * codes.codes.astype(float) / codes.top).astype(np.uint8)
        tiles.append((title, values))
    sheet(tiles, 3, "way-display.png", exposure, 1.95)


def verdicts() -> None:
    """Which techniques and illumination models belong together."""
    every = pairs()
    rows = list(dict.fromkeys(pair.technique for pair in every))
    columns = list(dict.fromkeys(pair.illumination for pair in every))
    values = {"sensible": 0, "warned": 1, "refused": 2}
    table = np.full((len(rows), len(columns)), np.nan)
    for pair in every:
        table[rows.index(pair.technique), columns.index(pair.illumination)] = values[pair.verdict]
    with styled():
        figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
        axes = figure.add_subplot()
        axes.imshow(
            table, cmap=ListedColormap(["#BFE3D5", "#F6E0A8", "#EBB9A5"]), vmin=0, vmax=2, aspect="auto"
        )
        axes.set_xticks(range(len(columns)), columns)
        axes.set_yticks(range(len(rows)), rows)
        axes.tick_params(length=0)
        axes.xaxis.tick_top()
        for row in range(len(rows)):
            for column in range(len(columns)):
                word = next(word for word, value in values.items() if value == table[row, column])
                axes.text(column, row, word, ha="center", va="center", fontsize=8)
        for spine in axes.spines.values():
            spine.set_visible(False)
        axes.set_xticks(np.arange(-0.5, len(columns)), minor=True)
        axes.set_yticks(np.arange(-0.5, len(rows)), minor=True)
        axes.grid(which="minor", color="white", linewidth=2)
        axes.tick_params(which="minor", length=0)
    save(figure, "way-choosing.png")


DRAWN: dict[str, Callable[[], None]] = {
    "lamps": lamps,
    "materials": materials,
    "finishes": balls,
    "surfaces": surfaces,
    "balance": balance,
    "models": models,
    "transport": transport,
    "radiosity": radiosity,
    "sampling": wavelengths,
    "eye": eye,
    "display": display,
    "choosing": verdicts,
}

if __name__ == "__main__":
    for wanted in sys.argv[1:] or DRAWN:
        DRAWN[wanted]()
