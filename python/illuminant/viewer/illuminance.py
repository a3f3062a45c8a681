"""A map of illuminance: the light that arrives at what the page's camera sees, lx, on grids that become finer.

With `radiosity` and `hybrid` the solution tells it (`Solution.illuminance`) at a point of each cell, for the side that
is seen, whatever the surface is made of. With a technique that follows rays, a matt surface of one paint tells it by
what it sends, wavelength by wavelength:

    E = π ∫ L(λ) / ρ(λ) · V(λ) dλ · 683 lm/W

Glossy surfaces, glass and textures say nothing of that kind, and are left without a number, as lamps and
surroundings are. The other techniques have no illuminance: theirs is a constant, or depends on how surfaces are cut.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from illuminant.job import Job
from illuminant.viewer.camera import limited

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.radiosity import Solution
    from illuminant.scene import Scene
    from illuminant.viewer.state import State

    Array = NDArray[np.float64]

__all__ = ["by_paint", "by_solution", "maps", "obstacle", "paint"]

BY_SOLUTION = ("radiosity", "hybrid")
BY_PAINT = ("path", "distributed", "raytrace")

POINTS = (1000, 4000, 16_000, 64_000)
"""Of the grids, one after the other."""

LOOKS = 64
"""At how many places of each lamp, and in how many directions, a point looks."""

AT_ONCE = 500
"""Points between two questions whether to go on."""

SAMPLES = 64
SAMPLING = "fitted:16"


def obstacle(state: State) -> str:
    """Why there is no map of illuminance with a technique and a model; "" where there is one.

    Example:
        >>> from types import SimpleNamespace
        >>> obstacle(SimpleNamespace(technique="path", illumination="general"))
        ''
        >>> obstacle(SimpleNamespace(technique="gouraud", illumination="phong"))[:40]
        'gouraud has no map of illuminance: choos'
    """
    if state.technique in BY_SOLUTION or (state.technique in BY_PAINT and state.illumination == "general"):
        return ""
    with_model = f" with {state.illumination}" if state.technique in BY_PAINT else ""
    known = ", ".join(BY_SOLUTION) + f", or {', '.join(BY_PAINT)} with general"
    return f"{state.technique}{with_model} has no map of illuminance: choose {known}."


def maps(
    state: State, camera: Mapping[str, Any], solution: Solution | None, goes_on: Callable[[], bool]
) -> Iterator[Array]:
    """Illuminance (h, w), lx, on finer and finer grids; nan where there is none.

    Args:
        state: what is shown.
        camera: of the page.
        solution: of the state, where its technique has one.
        goes_on: whether the map is still wanted; asked again and again.
    """
    width, height = camera["size"]
    done = (0, 0)
    for points in POINTS:
        size = limited(width, height, points)
        if size == done:
            return
        done = size
        scene = state.scene.replace(camera=dict(camera) | {"size": list(size)})
        found = (
            by_solution(scene, solution, goes_on)
            if solution is not None and state.technique in BY_SOLUTION
            else by_paint(scene, state, goes_on)
        )
        if found is None:
            return
        yield found


@dataclass(frozen=True)
class _Seen:
    """What the first ray of each pixel meets: things (h, w) by number, and -1 where there is none."""

    things: NDArray[np.int64]
    pairs: list[tuple[str, str]]
    places: Array
    normals: Array


def _seen(scene: Scene, goes_on: Callable[[], bool]) -> _Seen | None:
    """Objects, materials, places and normals towards the camera, pixel by pixel."""
    import numpy as np

    width, height = scene.description["camera"]["size"]
    job = Job(
        scene, technique="path", sampling="uniform:4", samples=1, depth=1, layers="normal", filter="box:0.5"
    )
    for _ in job.passes():
        pass
    normals = np.asarray(job.image().layers["normal"], float)
    things = np.full((height, width), -1)
    places = np.full((height, width, 3), np.nan)
    numbers: dict[tuple[str, str], int] = {}
    for y in range(height):
        if not goes_on():
            return None
        for x in range(width):
            vertices: list[Any] = next(iter(job.core_render.replay(x, y, 0)["passes"]), [])
            if vertices and vertices[0]["object"]:
                first = vertices[0]
                pair = first["object"], first["material"]
                things[y, x] = numbers.setdefault(pair, len(numbers))
                places[y, x] = first["position"]
    towards = np.asarray(scene.description["camera"]["eye"], float) - places
    away = np.einsum("hwc,hwc->hw", towards, normals) < 0
    normals[away] *= -1.0
    return _Seen(things, list(numbers), places, normals)


def by_solution(scene: Scene, solution: Solution, goes_on: Callable[[], bool]) -> Array | None:
    """Illuminance of the side that is seen, from a solution; None if it is wanted no more.

    Args:
        scene: with the camera whose pixels are the grid.
        solution: of that scene.
        goes_on: whether the map is still wanted.
    """
    import numpy as np

    seen = _seen(scene, goes_on)
    if seen is None:
        return None
    lamps = _lamps(scene)
    dark = np.array([name not in lamps for name, _ in seen.pairs] + [False])
    wanted = np.flatnonzero(
        dark[seen.things].reshape(-1) & (np.abs(seen.normals).sum(axis=2) > 0).reshape(-1)
    )
    found = np.full(seen.things.size, np.nan)
    places, normals = seen.places.reshape(-1, 3), seen.normals.reshape(-1, 3)
    for start in range(0, len(wanted), AT_ONCE):
        if not goes_on():
            return None
        own = wanted[start : start + AT_ONCE]
        found[own] = solution.illuminance(places[own], normals[own], samples=LOOKS)
    return found.reshape(seen.things.shape)


def by_paint(scene: Scene, state: State, goes_on: Callable[[], bool]) -> Array | None:
    """Illuminance of matt surfaces, from what they send; None if it is wanted no more.

    Args:
        scene: with the camera whose pixels are the grid.
        state: whose technique and model count.
        goes_on: whether the map is still wanted.
    """
    import numpy as np

    seen = _seen(scene, goes_on)
    if seen is None:
        return None
    job = Job(
        scene,
        technique=state.technique,
        illumination=state.illumination,
        sampling=SAMPLING,
        samples=SAMPLES,
        keep_spectra=True,
        filter="box:0.5",
    )
    for _ in job.passes(lambda _: goes_on()):
        pass
    if not goes_on():
        return None
    image = job.image()
    assert image.wavelengths_nm is not None and image.to_xyz is not None
    radiance = np.asarray(image.layers["spectra"], float)
    found = np.full(seen.things.shape, np.nan)
    for number, (name, material) in enumerate(seen.pairs):
        reflectance = paint(scene, name, material, image.wavelengths_nm)
        if reflectance is not None:
            own = seen.things == number
            found[own] = np.pi * (radiance[own] / reflectance) @ np.asarray(image.to_xyz, float)[1]
    return found


def paint(scene: Scene, thing: str, material: str, wavelengths: Any) -> Array | None:
    """Reflectances of a matt surface of one paint; None of any other, of lamps, and where air scatters.

    Args:
        scene: that it is in.
        thing, material: what it is.
        wavelengths: nm.
    """
    import numpy as np

    description = scene.description
    if thing in _lamps(scene) or description["atmosphere"] or description["medium"]:
        return None
    surface = next(one["surface"] for one in description["materials"] if one["name"] == material)
    if surface["kind"] != "diffuse" or not isinstance(surface["reflectance"], int):
        return None
    curve = description["curves"][surface["reflectance"]]
    reflectance = np.interp(wavelengths, curve["wavelengths"], curve["values"])
    return reflectance if (reflectance > 0).all() else None


def _lamps(scene: Scene) -> set[str]:
    return {thing["name"] for thing in scene.description["objects"] if thing["emission"]}
