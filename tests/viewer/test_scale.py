"""The scale of false colours in the picture."""

import numpy as np
import pytest

from illuminant.viewer.panels import duration
from illuminant.viewer.scale import amount, marks, with_scale


def test_a_logarithmic_scale_is_marked_at_powers_of_ten():
    found = marks(3.0, 3000.0, logarithmic=True)
    assert [number for _, number in found] == ["10", "100", "1,000"]
    assert np.diff([place for place, _ in found]) == pytest.approx(1 / 3)


def test_the_bar_holds_the_colours_of_the_map_and_the_rest_of_the_picture_stays():
    from matplotlib import colormaps

    picture = np.full((200, 400, 3), 77, np.uint8)
    found = with_scale(picture, "viridis", 1.0, 1000.0, "luminance, cd/m²", logarithmic=True)
    assert (found[:100] == 77).all()
    assert (found[:, 320:] == 77).all()
    shown = {tuple(pixel) for pixel in found.reshape(-1, 3).tolist()}
    ends = colormaps["viridis"]([0.0, 0.5, 1.0], bytes=True)[:, :3].tolist()
    assert {tuple(ends[0]), tuple(ends[2])} <= shown


def test_a_picture_too_small_for_a_scale_stays_as_it_is():
    picture = np.zeros((40, 40, 3), np.uint8)
    assert with_scale(picture, "magma", 0.0, 10.0, "ΔE00", logarithmic=False) is picture


def test_times_and_amounts_are_told_as_people_write_them():
    assert [duration(s) for s in (0.6, 59, 61, 3600)] == ["1 s", "59 s", "1:01 min", "1 h 0 min"]
    assert [amount(v) for v in (0.0, 0.5, 999.94, 45678.0)] == ["0", "0.5", "999.9", "45,680"]
