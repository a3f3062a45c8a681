"""A job can take over the wavelengths of another one."""

import numpy as np
import pytest

from illuminant.image import Image
from illuminant.job import Job
from illuminant.scene import load

OPTIONS = {"samples": 4, "size": (24, 18)}


@pytest.fixture(scope="module")
def scene(repository):
    return load(repository / "scenes" / "demo.toml")


@pytest.fixture(scope="module")
def first(scene):
    return Job(scene, **OPTIONS)


def image(job: Job) -> Image:
    for _ in job.passes():
        pass
    return job.image()


def test_the_same_scene_in_the_wavelengths_of_another_job_has_the_same_bits(scene, first):
    assert np.array_equal(image(Job(scene, like=first, **OPTIONS)).xyz, image(Job(scene, **OPTIONS)).xyz)


def test_another_camera_keeps_the_wavelengths(scene, first):
    moved = scene.replace(camera={"eye": [20.0, 30.0, 80.0]})
    job = Job(moved, like=first, **OPTIONS)
    assert np.array_equal(job.core_render.wavelengths(), first.core_render.wavelengths())
    own = Job(moved, **OPTIONS)
    assert not np.array_equal(own.core_render.wavelengths(), first.core_render.wavelengths())
    # Fitted to a view from elsewhere they are nearly as good.
    assert np.allclose(image(job).xyz.mean(axis=(0, 1)), image(own).xyz.mean(axis=(0, 1)), rtol=5e-3)


def test_another_sampling_is_fitted_for_itself(scene, first):
    job = Job(scene, like=first, sampling="fitted:16", **OPTIONS)
    assert len(job.core_render.wavelengths()) == 16
    assert np.array_equal(
        job.core_render.wavelengths(), Job(scene, sampling="fitted:16", **OPTIONS).core_render.wavelengths()
    )


def test_another_number_of_lamps_is_fitted_for_itself(scene, first):
    lit = scene.replace(
        lights={"bulb": {"kind": "point", "position": [0, 50, 0], "spectrum": "FL11", "flux_lm": 500.0}}
    )
    job = Job(lit, like=first, **OPTIONS)
    own = Job(lit, **OPTIONS)
    assert np.array_equal(job.core_render.wavelengths(), own.core_render.wavelengths())
