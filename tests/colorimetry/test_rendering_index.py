"""The colour rendering index: what CIE 15 publishes, the equations written anew, colour-science, and what has none."""

import warnings

import numpy as np
import pytest

from illuminant import colorimetry, spectra
from illuminant.core import core
from illuminant.errors import DataError, UsageError
from illuminant.spectra import Spectrum

LAMPS = (
    "A",
    "C",
    "D65",
    *(f"FL{i}" for i in range(1, 13)),
    "LED-B1",
    "LED-BH1",
    "LED-RGB1",
    "LED-V2",
    "HP1",
    "HP5",
)

# CIE 15:2004, table T.7: R_a of FL1 to FL12, and the special indices of three of them.
GENERAL = (76, 64, 57, 51, 72, 59, 90, 95, 90, 81, 83, 83)
SPECIAL = {
    "FL2": (56, 77, 90, 57, 59, 67, 74, 33, -84, 45, 46, 54, 60, 94),
    "FL7": (89, 92, 91, 91, 90, 89, 93, 87, 61, 78, 89, 87, 90, 94),
    "FL11": (98, 93, 50, 88, 87, 77, 89, 79, 25, 47, 72, 53, 97, 67),
}


def test_what_the_cie_publishes():
    for i, published in enumerate(GENERAL, start=1):
        found = colorimetry.rendering_index(f"FL{i}", step_nm=5)
        assert found.general == pytest.approx(published, abs=0.51), i
    for name, published in SPECIAL.items():
        found = colorimetry.rendering_index(name, step_nm=5)
        np.testing.assert_allclose(found.special, published, atol=0.7, err_msg=name)


def anew(name, grid):
    """CIE 13.3-1995, 5.3 to 5.9, on arrays."""
    functions = core().matching_functions(grid, "CIE 1931 2°").T
    lamp = spectra.load(name).at(grid)

    def uv(xyz):
        return np.array([4 * xyz[0], 6 * xyz[1]]) / (xyz[0] + 15 * xyz[1] + 3 * xyz[2])

    def cd(u, v):
        return np.array([4 - u - 10 * v, 1.708 * v + 0.404 - 1.481 * u]) / v

    white = functions @ lamp
    cct_k = colorimetry.correlated_color_temperature(white[:2] / white.sum()).cct_k
    reference = core().planck(grid, cct_k) if cct_k < 5000 else core().daylight(grid, cct_k)
    white_r = functions @ reference
    k, r = uv(white), uv(white_r)
    indices = []
    for i in range(1, 15):
        sample = spectra.load(f"TCS/{i}").at(grid)
        under, under_r = functions @ (lamp * sample), functions @ (reference * sample)
        c, d = cd(*r) / cd(*k) * cd(*uv(under))
        shifted = np.array([10.872 + 0.404 * c - 4 * d, 5.520]) / (16.518 + 1.481 * c - d)
        lightness = [
            25 * (100 * x[1] / w[1]) ** (1 / 3) - 17 for x, w in ((under, white), (under_r, white_r))
        ]
        a, b = 13 * lightness[0] * (shifted - r), 13 * lightness[1] * (uv(under_r) - r)
        indices.append(100 - 4.6 * np.hypot(np.hypot(*(a - b)), lightness[0] - lightness[1]))
    return indices


@pytest.mark.parametrize("step_nm", [1, 5])
@pytest.mark.parametrize("name", LAMPS)
def test_the_equations_written_anew(name, step_nm):
    found = colorimetry.rendering_index(name, step_nm=step_nm)
    expected = anew(name, np.arange(360.0, 831.0, step_nm))
    np.testing.assert_allclose(found.special, expected, atol=1e-8)
    assert found.general == pytest.approx(np.mean(expected[:8]), abs=1e-9)
    assert found.reference == ("blackbody" if found.cct_k < 5000 else "daylight")


def test_against_colour_science(monkeypatch):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
        from colour.quality import cri

        # Plain sums instead of the weights of ASTM E308, and straight lines through the test colour samples.
        monkeypatch.setattr(cri, "sd_to_XYZ", colour.colorimetry.sd_to_XYZ_integration)
        grid = np.arange(360.0, 831.0)
        samples = {
            sample.name: colour.SpectralDistribution(np.interp(grid, sample.wavelengths, sample.values), grid)
            for sample in colour.quality.SDS_TCS["CIE 1995"].values()
        }
        cmfs = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
        for name in LAMPS:
            found = colorimetry.rendering_index(name)
            lamp = colour.SpectralDistribution(spectra.load(name).at(grid), grid)
            if found.reference == "blackbody":
                reference = colour.sd_blackbody(found.cct_k, lamp.shape)
            else:
                xy = colour.temperature.CCT_to_xy_CIE_D(found.cct_k)
                reference = colour.sd_CIE_illuminant_D_series(xy, M1_M2_rounding=False).align(lamp.shape)
            # Beyond its table it would hold the ends of the lamp; here all reach as far as the sums.
            data = [
                cri.tcs_colorimetry_data(light, reference, samples, cmfs, chromatic_adaptation=shift)
                for light, shift in ((lamp, True), (reference, False))
            ]
            other = cri.colour_rendering_indexes(*data)
            expected = [other[i].Q_a for i in range(1, 15)]
            np.testing.assert_allclose(found.special, expected, atol=0.01, err_msg=name)


def test_size_does_not_matter():
    lamp = spectra.load("FL11")
    assert colorimetry.rendering_index(1e-3 * lamp).special == pytest.approx(
        colorimetry.rendering_index(lamp).special, abs=1e-6
    )


def test_what_has_none():
    lines = Spectrum("green", (500, 520, 540), (0, 1, 0), "zero", quantity="emission")
    for lamp, message in (
        (lines, "the lamp has no reference: the light is too far from any blackbody"),
        (Spectrum("heat", (900, 1000), (1, 1), "zero"), "no light that the eye sees"),
        (Spectrum("part", (400, 700), (1, 1), "error"), "known from 400 to 700 nm only, and 360 to 830 nm"),
    ):
        with pytest.raises(DataError, match=message):
            colorimetry.rendering_index(lamp)
    for step in (0, 11, 2.5, True):
        with pytest.raises(UsageError, match="whole number of nm from 1 to 10"):
            colorimetry.rendering_index("D65", step_nm=step)
