"""Mistakes get one sentence that says what was expected."""

import subprocess
import sys

import numpy as np
import pytest

from illuminant import color
from illuminant.errors import DataError, Error, MachineError, UsageError

GREY = np.full((4, 3), 0.5)
FROZEN = np.zeros((4, 3))
FROZEN.flags.writeable = False


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: color.xyz_to_lab(np.zeros((3, 4))), "a last axis of length 3, and the shape is (3, 4)"),
        (lambda: color.xyz_to_lab(1.0), "a last axis of length 3, and the shape is ()"),
        (lambda: color.xyz_to_lab([[1, 2, 3], [1]]), "the rows differ in length"),
        (lambda: color.xyz_to_lab(["a", "b", "c"]), "must be real numbers"),
        (lambda: color.xyz_to_lab([1j, 0, 0]), "must be real numbers, not complex128"),
        (lambda: color.xyz_to_lab([None, {}, 0]), "The colours must be real numbers."),
        (lambda: color.xyz_to_lab(GREY, out=np.zeros(3)), "out must be an array of shape (4, 3)"),
        (lambda: color.xyz_to_lab(GREY, out=np.zeros((4, 3), np.float32)), "not (4, 3) of float32"),
        (lambda: color.xyz_to_lab(GREY, out=[0.0]), "not list"),
        (lambda: color.xyz_to_lab(GREY, out=FROZEN), "out cannot be written"),
        (
            lambda: color.xyz_to_lab(GREY, form="hunter"),
            'No form of lightness "hunter"; known are CIE and book.',
        ),
        (lambda: color.xyz_to_lab(GREY, (0.3, 0.0)), "must lie in the triangle"),
        (lambda: color.xyz_to_lab(GREY, (0.9, -1.0, 1.0)), "must be above 0"),
        (lambda: color.xyz_to_lab(GREY, (1.0,)), "not 1 numbers"),
        (lambda: color.xyz_to_lab(GREY, 5), "name, x and y, or X, Y and Z"),
        (lambda: color.xyz_to_lab(GREY, "gold.n"), "is no lamp"),
        (lambda: color.rgb_to_xyz(GREY, "sRBG"), "There is no RGB system 'sRBG'"),
        (lambda: color.encode(GREY, "log"), 'No transfer function "log"'),
        (lambda: color.xyz_to_rgb(GREY, white="D50"), "An adaptation needs both"),
        (
            lambda: color.rgb_to_rgb(GREY, "sRGB", "XYZ", adaptation="Hunt"),
            "known are von Kries, Bradford, CAT16",
        ),
        (lambda: color.rgb_to_hsl(GREY, solid="sphere"), "double hexcone, double cone and cylinder"),
        (lambda: color.monitor([(0.1, 0.1), (0.2, 0.2), (0.3, 0.3)], (0.3, 0.3)), "lie on one line"),
        (lambda: color.monitor([(0.6, 0.3), (0.3, 0.6), (0.1, 0.1)], (0.3, 0.0)), "the white has y = 0"),
        (lambda: color.monitor([(0.6, 0.3)], (0.3, 0.3)), "x and y of three primaries"),
        (lambda: color.published_matrix("NTSC to XYZ"), 'No printed matrix "NTSC to XYZ"'),
        (lambda: color.inverse([[1, 2, 3], [2, 4, 6], [0, 0, 1]]), "The matrix is singular"),
        (lambda: color.inverse([[1, 2, 3], [2, np.nan, 6], [0, 0, 1]]), "not finite"),
        (lambda: color.inverse(np.eye(4)), "the shape (3, 3), not (4, 4)"),
        (lambda: color.delta_e_2000(GREY, np.zeros((5, 3))), "do not go together"),
        (lambda: color.delta_e_2000(GREY, np.zeros((4, 2))), "a last axis of length 3"),
        (lambda: color.delta_e_1994(GREY, GREY, constants="wood"), '"1994 wood"'),
        (lambda: color.spectra_to_xyz(GREY, [400, 500]), "Spectra of 2 bands need a last axis"),
        (lambda: color.spectra_to_xyz(GREY, [400, 300, 500]), "ncrease"),
        (lambda: color.spectra_to_xyz([1.0], [400]), "at least two"),
        (lambda: color.spectra_to_xyz(GREY, [400, 500, 600], observer="CIE 1930"), "There is no observer"),
        (lambda: color.spectra_to_xyz(GREY, [400, 500, 600], observer=([1, 2], [1, 2])), "(m,) and (m, 3)"),
        (lambda: color.spectra_to_xyz(GREY, [400, 500, 600], range_nm=(700, 400)), "whole nm"),
        (lambda: color.spectra_to_xyz(GREY, [400, 500, 600], range_nm=5), "first and its last"),
        (lambda: color.spectra_to_xyz(GREY, [400, 500, 600], outside="wrap"), 'No rule outside "wrap"'),
        (lambda: color.spectra_to_xyz(GREY, [1, 2, 3], illuminant=([900, 950], [1, 1])), "no luminance"),
        (lambda: color.parse_munsell("5X 4/14"), "is no Munsell notation"),
        (lambda: color.parse_munsell("N 11/"), "runs from 0 to 10"),
        (lambda: color.munsell_to_xyz("5R 9/40"), "outside the Munsell renotation data"),
    ],
)
def test_a_mistake_is_one_sentence(call, sentence):
    with pytest.raises(UsageError) as caught:
        call()
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_lamp_suggests_a_near_one():
    with pytest.raises(DataError, match="did you mean"):
        color.white_xyz("D66")


def test_munsell_without_its_package_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "colour", None)
    with pytest.raises(MachineError, match=r"illuminant\[munsell\]") as caught:
        color.munsell_to_xyz("5R 4/14")
    assert isinstance(caught.value, Error)
    assert color.parse_munsell("5R 4/14").value == 4, "reading a notation needs no package"


def test_munsell_leaves_the_printing_of_numbers_alone():
    program = "import numpy as np; from illuminant import color; color.munsell_to_xyz('N 5/'); print(np.ones(2) / 2)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "[0.5 0.5]\n"
