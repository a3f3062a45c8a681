"""The mirrored environment: flat mirrors as windows into the reflected scene show what rays meet (book IV.4)."""

import numpy as np
import pytest

from illuminant import Scene, radiosity
from illuminant.errors import UsageError


def room(**objects: object) -> Scene:
    """A room with a lamp, and mirrors that face each other."""

    def wall(*corners: tuple[float, float, float], material: str = "white") -> dict[str, object]:
        return {"rectangle": {"corners": [list(c) for c in corners]}, "material": material}

    walls = {
        "floor": wall((0, 0, 0), (0, 0, 2), (2, 0, 2), (2, 0, 0)),
        "ceiling": wall((0, 2, 0), (2, 2, 0), (2, 2, 2), (0, 2, 2)),
        "back": wall((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), material="red"),
        "left": wall((0, 0, 0), (0, 2, 0), (0, 2, 2), (0, 0, 2)),
        "right": wall((2, 0, 0), (2, 0, 2), (2, 2, 2), (2, 2, 0)),
        "front": wall((0, 0, 2), (0, 2, 2), (2, 2, 2), (2, 0, 2)),
        "lamp": wall((0.7, 1.9, 0.7), (1.3, 1.9, 0.7), (1.3, 1.9, 1.3), (0.7, 1.9, 1.3), material="lamp"),
        "one mirror": wall(
            (1.98, 0.3, 0.4), (1.98, 0.3, 1.6), (1.98, 1.5, 1.6), (1.98, 1.5, 0.4), material="mirror"
        ),
        "another mirror": wall(
            (0.02, 0.3, 0.4), (0.02, 1.5, 0.4), (0.02, 1.5, 1.6), (0.02, 0.3, 1.6), material="mirror"
        ),
    }
    return Scene.build(
        camera={"eye": [1, 1, 1.9], "target": [1.3, 0.9, 0], "field_of_view": 80, "size": [64, 64]},
        materials={
            "white": {"kind": "diffuse", "reflectance": 0.7},
            "red": {"kind": "diffuse", "reflectance": "Cornell/red"},
            "lamp": {"kind": "emitter", "spectrum": "E", "luminance_cd_m2": 1000.0},
            "mirror": {"kind": "conductor", "metal": "Ag"},
            "glass": {"kind": "dielectric", "medium": "BK7", "dispersion": False},
        },
        objects=walls | objects,
    )


def test_windows_into_the_reflected_scene_show_what_rays_meet() -> None:
    means = {}
    for method in ("hemicube:48", "scanline:48"):
        found = radiosity.solve(
            room(), technique="hybrid", elements=700, form_factors=method, sampling="uniform:8"
        )
        means[method] = found.mesh()
        assert found.report["form_factors"] > 0
    rays, windows = means["hemicube:48"], means["scanline:48"]
    # What patches send, everywhere: the lamp seen in both mirrors again and again included.
    assert np.allclose(windows.xyz.mean(axis=0), rays.xyz.mean(axis=0), rtol=2e-3)
    bright = rays.xyz[:, 1] > 0.05 * rays.xyz[:, 1].mean()
    relative = windows.xyz[bright, 1] / rays.xyz[bright, 1] - 1
    assert np.sqrt((relative**2).mean()) < 0.01, np.sqrt((relative**2).mean())


def test_what_is_no_flat_mirror_is_refused_as_a_window() -> None:
    scene = room(ball={"sphere": {"center": [1, 0.5, 1], "radius": 0.3}, "material": "glass"})
    with pytest.raises(UsageError, match=r'"ball" is no flat mirror'):
        radiosity.solve(
            scene, technique="hybrid", elements=50, form_factors="scanline:8", sampling="uniform:8"
        )
