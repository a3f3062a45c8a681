"""What holds for every conversion: there and back, any shape, type, layout, output and number of threads; NaN."""

import os
import subprocess
import sys
from collections.abc import Callable
from typing import Any

import hypothesis.extra.numpy as arrays
import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis import given

from illuminant import color

Function = Callable[..., np.ndarray]


def rgb(name: str, **options: Any) -> tuple[Function, Function]:
    """A system's conversion to XYZ and back."""
    return (
        lambda v, **more: color.rgb_to_xyz(v, name, **options, **more),
        lambda v, **more: color.xyz_to_rgb(v, name, **options, **more),
    )


def form(there: Function, back: Function, **options: Any) -> tuple[Function, Function]:
    return lambda v, **more: there(v, **options, **more), lambda v, **more: back(v, **options, **more)


PAIRS: dict[str, tuple[Function, Function]] = {
    **{name: rgb(name) for name in color.systems()},
    "sRGB encoded": rgb("sRGB", encoded=True),
    "Rec.2020 encoded": rgb("Rec.2020", encoded=True),
    "Adobe RGB under D50": rgb("Adobe RGB", white="D50", adaptation="Bradford"),
    "transfer sRGB": (color.encode, color.decode),
    "transfer gamma": form(color.encode, color.decode, transfer="gamma 2.2"),
    "transfer Rec.709": form(color.encode, color.decode, transfer="Rec.709"),
    "lab": (color.xyz_to_lab, color.lab_to_xyz),
    "lab of the book": form(color.xyz_to_lab, color.lab_to_xyz, form="book"),
    "luv": (color.xyz_to_luv, color.luv_to_xyz),
    "luv of the book": form(color.xyz_to_luv, color.luv_to_xyz, form="book"),
    "xyY": (color.xyz_to_xyy, color.xyy_to_xyz),
    "u'v'Y": (color.xyz_to_uvy, color.uvy_to_xyz),
    "AC1C2": (color.xyz_to_ac1c2, color.ac1c2_to_xyz),
    "HSV": (color.rgb_to_hsv, color.hsv_to_rgb),
    **{
        f"HSL {solid}": form(color.rgb_to_hsl, color.hsl_to_rgb, solid=solid)
        for solid in ("double hexcone", "double cone", "cylinder")
    },
    "adaptation": (
        lambda v, **more: color.adapt(v, "D65", "A", method="CAT16", **more),
        lambda v, **more: color.adapt(v, "A", "D65", method="CAT16", **more),
    ),
    "monitor to monitor": (
        lambda v, **more: color.rgb_to_rgb(v, "sRGB", "SMPTE-C", encoded=True, **more),
        lambda v, **more: color.rgb_to_rgb(v, "SMPTE-C", "sRGB", encoded=True, **more),
    ),
}
every = pytest.mark.parametrize("pair", PAIRS.values(), ids=PAIRS.keys())

SHAPES = arrays.array_shapes(min_dims=0, max_dims=3, min_side=1, max_side=5).map(lambda shape: (*shape, 3))
# Below 1e-6 nothing is left of a chromaticity; black itself is tested by name.
COLOURS = arrays.arrays(np.float64, SHAPES, elements=st.floats(1e-6, 1.0))


@every
@given(colours=COLOURS)
def test_there_and_back(pair, colours):
    back = pair[1](pair[0](colours))
    assert back.shape == colours.shape and back.dtype == np.float64
    np.testing.assert_allclose(back, colours, atol=1e-9, rtol=1e-9)


@every
def test_single_precision_stays_so_and_is_near(pair):
    colours = np.random.default_rng(2).uniform(0.02, 1, (40, 9, 3))
    double, single = pair[0](colours), pair[0](colours.astype(np.float32))
    assert single.dtype == np.float32
    largest = np.abs(double).max()
    # A hue has an error of its own, larger where the colour is nearly grey.
    assert np.abs(single - double).max() < (2e-5 if largest < 300 else 1e-4) * max(1.0, largest)
    back = pair[1](single)
    assert back.dtype == np.float32
    np.testing.assert_allclose(back, colours, atol=3e-5)


@every
def test_layout_and_output_change_nothing(pair):
    there = pair[0]
    whole = np.random.default_rng(4).uniform(0.01, 1, (61, 47, 3))
    wanted = there(whole)
    np.testing.assert_array_equal(there(np.asfortranarray(whole)), wanted)
    np.testing.assert_array_equal(there(whole[::-2, 3:, :]), wanted[::-2, 3:])
    np.testing.assert_array_equal(there(whole.tolist()), wanted)
    np.testing.assert_array_equal(there(whole.astype(">f8")), wanted)

    out = np.full_like(whole, 7.0)
    assert there(whole, out=out) is out
    np.testing.assert_array_equal(out, wanted)
    strided = np.full((61, 47, 6), 7.0)[..., ::2]
    assert there(whole, out=strided) is strided
    np.testing.assert_array_equal(strided, wanted)

    for view in (lambda a: a, lambda a: a[...], lambda a: np.asfortranarray(a)):
        itself = view(whole.copy())
        assert there(itself, out=itself) is itself
        np.testing.assert_array_equal(itself, wanted)
    shifted = whole.copy()
    there(shifted[:-1], out=shifted[1:])
    np.testing.assert_array_equal(shifted[1:], wanted[:-1])
    halves = np.concatenate([whole, whole])
    there(halves[:61], out=halves[61:])
    np.testing.assert_array_equal(halves, np.concatenate([whole, wanted]))


@every
def test_nan_goes_through_to_its_own_colour(pair):
    colours = np.random.default_rng(6).uniform(0.1, 0.9, (300, 3))
    for dtype in (np.float64, np.float32):
        broken = colours.astype(dtype)
        broken[150] = np.nan
        for function in pair:
            found, whole = function(broken), function(colours.astype(dtype))
            assert np.isnan(found[150]).all()
            np.testing.assert_array_equal(np.delete(found, 150, 0), np.delete(whole, 150, 0))


@every
def test_whole_numbers_are_taken_as_double(pair):
    found = pair[0](np.array([[1, 0, 1], [1, 1, 1]], np.uint8))
    assert found.dtype == np.float64
    np.testing.assert_array_equal(found, pair[0]([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0]]))
    assert pair[0](np.zeros((0, 3))).shape == (0, 3)


def test_nothing_is_clamped():
    wide = np.array([[-0.3, 1.7, 40.0]])
    for name in color.systems():
        np.testing.assert_allclose(color.xyz_to_rgb(color.rgb_to_xyz(wide, name), name), wide, atol=1e-9)
        code = color.encode(wide, name)
        assert code[0, 0] < 0 and code[0, 1] > 1
        np.testing.assert_allclose(color.decode(code, name), wide, atol=1e-9)


def test_black_comes_back_from_everywhere():
    black = np.zeros((2, 3))
    for name, (there, back) in PAIRS.items():
        np.testing.assert_allclose(back(there(black)), 0.0, atol=1e-12, err_msg=name)


def test_full_colours_of_the_solids():
    corners = np.array([[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]], float)
    hues = np.arange(0.0, 360.0, 60.0)
    np.testing.assert_allclose(color.rgb_to_hsv(corners), np.stack([hues, *np.ones((2, 6))], 1))
    for solid in ("double hexcone", "double cone", "cylinder"):
        wanted = np.stack([hues, np.ones(6), np.full(6, 0.5)], 1)
        np.testing.assert_allclose(color.rgb_to_hsl(corners, solid=solid), wanted, atol=1e-12)


def test_the_systems_meet_at_their_whites():
    for name in color.systems():
        x, y = color.system(name).white
        np.testing.assert_allclose(color.xyz_to_xyy(color.rgb_to_xyz([1, 1, 1], name)), [x, y, 1], atol=1e-12)
    there = color.rgb_to_rgb_matrix("NTSC 1953", "sRGB")
    back = color.rgb_to_rgb_matrix("sRGB", "NTSC 1953")
    np.testing.assert_allclose(color.concatenate(there, back), np.eye(3), atol=1e-13)
    assert np.abs(there.sum(axis=1) - 1).max() > 0.01, "no white is adapted unasked"


@given(scale=st.floats(1e-3, 1e3), seed=st.integers(0, 99))
def test_spectra_to_xyz_is_linear(scale, seed):
    first, second = np.random.default_rng(seed).random((2, 3, 12))
    bands = np.linspace(385.5, 741.0, 12)
    options = {"illuminant": "FL11"} if seed % 2 else {}
    together = color.spectra_to_xyz(first + scale * second, bands, **options)
    apart = [color.spectra_to_xyz(part, bands, **options) for part in (first, second)]
    np.testing.assert_allclose(together, apart[0] + scale * apart[1], rtol=1e-12)


def test_spectra_of_an_image_in_both_precisions_and_any_layout():
    bands = np.arange(380, 781, 5)
    image = np.random.default_rng(8).random((31, 29, 81))
    wanted = image @ color.spectral_weights(bands, illuminant="D65")
    found = color.spectra_to_xyz(image, bands, illuminant="D65")
    np.testing.assert_allclose(found, wanted, rtol=1e-13)
    single = color.spectra_to_xyz(image.astype(np.float32), bands, illuminant="D65")
    assert single.dtype == np.float32
    np.testing.assert_allclose(single, wanted, rtol=1e-6)
    out = np.empty((31, 29, 3))
    assert color.spectra_to_xyz(np.asfortranarray(image), bands, illuminant="D65", out=out) is out
    np.testing.assert_array_equal(out, found)
    broken = image.copy()
    broken[3, 4, 40] = np.nan
    assert np.argwhere(np.isnan(color.spectra_to_xyz(broken, bands))).tolist() == [
        [3, 4, c] for c in range(3)
    ]


def test_weights_are_the_sums_of_one_nanometre():
    """The product of an image is what the core's sum over a curve gives for each pixel."""
    from illuminant.core import core

    bands = [400.0, 431.5, 520.0, 610.25, 700.0]
    values = [0.1, 0.9, 0.3, 0.7, 0.2]
    for outside in ("zero", "hold"):
        wanted = core().xyz(bands, values, outside)
        found = color.spectra_to_xyz(values, bands, scale="absolute", outside=outside)
        np.testing.assert_allclose(found, wanted, rtol=1e-12)


def test_differences_broadcast():
    image = np.random.default_rng(9).uniform(-50, 50, (5, 4, 3))
    one = np.array([50.0, 1.0, -3.0])
    for function in (color.delta_e_1976, color.delta_e_1994, color.delta_e_2000, color.delta_e_luv):
        wanted = function(np.broadcast_to(one, image.shape).copy(), image)
        np.testing.assert_array_equal(function(one, image), wanted)
        np.testing.assert_array_equal(function(one, image[2, 3]), wanted[2, 3])
        np.testing.assert_array_equal(function(image[:, :1], image)[:, 0], 0.0)
        out = np.empty((5, 4))
        assert function(one, image, out=out) is out
        assert function(one, image.astype(np.float32)).dtype == np.float64
        single = function(one.astype(np.float32), image.astype(np.float32))
        assert single.dtype == np.float32
        np.testing.assert_allclose(single, wanted, rtol=1e-5)


_BITS = """
import hashlib, numpy as np
from illuminant import color
image = np.random.default_rng(1).random((300, 200, 3))
found = [color.xyz_to_rgb(image, encoded=True), color.delta_e_2000(image * 100, image[::-1] * 100),
         color.spectra_to_xyz(np.random.default_rng(2).random((5000, 31)), np.linspace(400, 700, 31))]
print(hashlib.sha256(b"".join(part.tobytes() for part in found)).hexdigest())
"""


def test_the_number_of_threads_changes_no_bit():
    def run(threads: int) -> str:
        env = os.environ | {"RAYON_NUM_THREADS": str(threads)}
        return subprocess.run(
            [sys.executable, "-c", _BITS], env=env, capture_output=True, text=True, check=True
        ).stdout

    assert run(1) == run(2) == run(7)


_FORK = """
import os, numpy as np
from illuminant import color
image = np.random.default_rng(1).random((300, 200, 3))
wanted = color.xyz_to_lab(image)
child = os.fork()
if child == 0:
    os._exit(0 if (color.xyz_to_lab(image) == wanted).all() else 1)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


def test_a_forked_process_has_threads_of_its_own():
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", _FORK], capture_output=True, text=True, check=True, timeout=60
    )
    assert done.stdout == "0\n"
