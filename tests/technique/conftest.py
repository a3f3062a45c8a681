"""What the tests of the techniques share: means over an image, illuminance at a point, and the core's own render.

No test here chooses its seed: all take the default, 0, unless the seed is what is tested.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import illuminant
from illuminant.core import core
from illuminant.image import Image
from illuminant.scene import Scene

WHITE_PROBE = {"kind": "diffuse", "reflectance": 1.0}


@dataclass(frozen=True)
class Measured:
    """Means over the pixels of an image.

    Attributes:
        wavelengths_nm: of the lanes, (N,).
        lanes: mean radiance in each lane, (N,), W/(sr m² nm).
        xyz: mean absolute XYZ, (3,).
        image: the image itself.
    """

    wavelengths_nm: np.ndarray
    lanes: np.ndarray
    xyz: np.ndarray
    image: Image

    @property
    def Y(self) -> float:  # noqa: N802
        """Mean luminance, cd/m²."""
        return float(self.xyz[1])


@pytest.fixture(scope="session")
def measure() -> Callable[..., Measured]:
    """Renders a scene with its lanes kept, and takes the mean over all pixels, or those that `where` is true for.

    `where` gets the image and gives a (h, w) array of weights or booleans; other arguments go to
    `illuminant.render`.
    """

    def measured(
        scene: Scene, where: Callable[[Image], np.ndarray] | None = None, **options: Any
    ) -> Measured:
        image = illuminant.render(scene, keep_spectra=True, **options)
        weights = np.ones(image.xyz.shape[:2]) if where is None else np.asarray(where(image), np.float64)
        weights = weights / weights.sum()
        assert image.wavelengths_nm is not None
        return Measured(
            image.wavelengths_nm,
            np.einsum("hw,hwn->n", weights, image.layers["spectra"]),
            np.einsum("hw,hwn->n", weights, image.xyz),
            image,
        )

    return measured


@pytest.fixture(scope="session")
def illuminance(measure: Callable[..., Measured]) -> Callable[..., float]:
    """Illuminance in lx on a small white probe: E = π L / ρ with ρ = 1, direct light only (paths of two segments).

    Arguments: `point` and `normal` of the probe, then `objects`, `materials` and `lights` as `Scene.build` takes
    them. The camera looks at the probe along its normal from 2 cm away; as a pinhole it casts no shadow.
    """

    def measured(
        point: Any,
        normal: Any,
        *,
        objects: Mapping[str, Any] | None = None,
        materials: Mapping[str, Any] | None = None,
        lights: Mapping[str, Any] | None = None,
        samples: int = 1024,
        size: int = 8,
        sampling: str = "uniform:4",
    ) -> float:
        point = np.asarray(point, float)
        normal = np.asarray(normal, float) / np.linalg.norm(normal)
        across = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        across /= np.linalg.norm(across)
        along = np.cross(normal, across)
        corner = point - 0.005 * (across + along)
        probe = {
            "material": "probe",
            "rectangle": {"corner": corner, "edges": [0.01 * across, 0.01 * along]},
        }
        scene = Scene.build(
            camera={
                "eye": point + 0.02 * normal,
                "target": point,
                "up": along,
                "field_of_view": 1.0,
                "size": [size, size],
            },
            objects={"probe": probe, **(objects or {})},
            materials={"probe": WHITE_PROBE, **(materials or {})},
            lights=lights,
        )
        return np.pi * measure(scene, samples=samples, depth=2, sampling=sampling).Y

    return measured


@pytest.fixture(scope="session")
def core_render() -> Callable[..., Any]:
    """A render of the core, with any of its settings (`tile`, `threads`, `layers` and so on) and an empty film."""

    def made(scene: Scene, **settings: Any) -> Any:
        return core().Render(scene.core(settings.get("threads", 0)), json.dumps(settings))

    return made


@pytest.fixture(scope="session")
def cylinder() -> Callable[..., str]:
    """Writes a cylinder of radius 1 along y, its axis at `x`, as an OBJ of n faces with the normals of a round one."""

    def written(n: int, x: float = 0.0) -> str:
        lines = []
        for i in range(n):
            sin, cos = np.sin(2 * np.pi * i / n), np.cos(2 * np.pi * i / n)
            lines += [f"v {sin + x} -1 {cos}", f"v {sin + x} 1 {cos}", f"vn {sin} 0 {cos}"]
        for i in range(n):
            a, b = i, (i + 1) % n
            lines.append(f"f {2 * a + 1}//{a + 1} {2 * b + 1}//{b + 1} {2 * b + 2}//{b + 1}")
            lines.append(f"f {2 * a + 1}//{a + 1} {2 * b + 2}//{b + 1} {2 * a + 2}//{a + 1}")
        return "\n".join(lines)

    return written
