"""Displays: standards, descriptions, the same picture on two of them, and mistakes."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant.display import displays
from illuminant.errors import DataError, UsageError

STANDARDS = [name for name in displays.names() if not name.startswith("ACES")]


@pytest.mark.parametrize("name", STANDARDS)
def test_code_values_come_back_from_light(name: str) -> None:
    display = displays.named(name)
    codes = np.random.default_rng(1).uniform(0.0, 0.7, (500, 3))
    np.testing.assert_allclose(display.encode(display.from_xyz(display.to_xyz(codes))), codes, atol=2e-6)
    white = display.to_xyz(display.encode([1.0, 1.0, 1.0]))
    assert white[1] == pytest.approx(display.peak, rel=1e-6)
    np.testing.assert_allclose(white[:2] / white.sum(), display.white, atol=1e-6)


def test_transfer_functions_are_those_of_another_implementation() -> None:
    import colour

    codes = np.linspace(0.0, 1.0, 257)
    greys = np.repeat(codes[:, None], 3, axis=1)
    for name, expected in (
        ("sRGB", colour.models.eotf_sRGB(codes)),
        ("Rec.709", colour.models.eotf_BT1886(codes, L_B=0, L_W=1)),
        ("Rec.2020 PQ", colour.models.eotf_ST2084(codes) / 1000.0),
        ("Rec.2020 HLG", colour.models.eotf_BT2100_HLG(greys, 0, 1000)[:, 1] / 1000.0),
    ):
        found = displays.named(name).decode(greys)[:, 1]
        np.testing.assert_allclose(found, expected, rtol=2e-5, atol=1e-6, err_msg=name)


def test_a_studio_display_is_lifted_to_its_black() -> None:
    import colour

    lit = displays.described(
        {"name": "a", "primaries": [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]], "white": [0.3127, 0.329]}
        | {"response": "BT.1886", "peak": 100.0, "black": 0.1},
        "here",
    )
    codes = np.linspace(0.0, 1.0, 33)
    found = lit.to_xyz(np.repeat(codes[:, None], 3, axis=1))[:, 1]
    np.testing.assert_allclose(found, colour.models.eotf_BT1886(codes, L_B=0.1, L_W=100.0), rtol=1e-12)


def test_a_picture_looks_the_same_on_two_displays() -> None:
    first = displays.named("SMPTE-C")
    second = displays.Display(
        "wide", ((0.69, 0.31), (0.2, 0.72), (0.14, 0.05)), (0.31, 0.32), "gamma 1.8", 250.0, 0.02
    )
    codes = np.random.default_rng(2).uniform(0.1, 1.0, (200, 3))
    xyz = first.to_xyz(codes)
    linear = second.from_xyz(xyz)
    assert linear.min() > 0 and linear.max() < 1
    np.testing.assert_allclose(second.to_xyz(second.encode(linear)), xyz, rtol=1e-12)


def test_a_description_is_read_back(tmp_path) -> None:
    table = tuple(float(v) for v in np.linspace(0, 1, 17) ** 2.1)
    for response in ("gamma 2.35", ("gamma 2.3", "gamma 2.4", "gain-offset-gamma 0.98 0.01 2.2"), table):
        display = displays.Display(
            "left", ((0.641, 0.334), (0.298, 0.602), (0.151, 0.062)), (0.3121, 0.3297), response, 118.0, 0.21
        )
        assert (
            displays.described(json.loads(json.dumps(display.to_dict())), "here").to_dict()
            == display.to_dict()
        )
    path = tmp_path / "a.toml"
    path.write_text(
        'name = "left"\nprimaries = [[0.64, 0.33], [0.3, 0.6], [0.15, 0.06]]\n'
        'white = [0.31, 0.33]\nresponse = "gamma 2.3"\n'
    )
    assert displays.named(path).gamma == 2.3


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("name = 3 = 4", "is no TOML"),
        ('name = "a"', "describes no display: 'primaries' is missing."),
        ('name = "a"\nprimaries = [[1, 2]]\nwhite = [0.3, 0.3]', "expected three pairs of numbers"),
        (
            'name = "a"\nprimaries = [[0.6, 0.3], [0.3, 0.6], [0.1, 0.1]]\nwhite = [0.3, 0.3]\ngamma = 2.2',
            "unknown key 'gamma'",
        ),
        (
            'name = "a"\nprimaries = [[0.1, 0.1], [0.2, 0.2], [0.3, 0.3]]\nwhite = [0.3, 0.3]',
            "lie on one line",
        ),
        (
            'name = "a"\nprimaries = [[0.6, 0.3], [0.3, 0.6], [0.1, 0.1]]\nwhite = [0.3, 0.3]\nresponse = "gamma -2"',
            "no response",
        ),
        (
            'name = "a"\nprimaries = [[0.6, 0.3], [0.3, 0.6], [0.1, 0.1]]\nwhite = [0.3, 0.3]\n'
            "response = [0.0, 0.6, 0.5, 1.0]",
            "does not rise",
        ),
        (
            'name = "a"\nprimaries = [[0.6, 0.3], [0.3, 0.6], [0.1, 0.1]]\nwhite = [0.3, 0.3]\npeak = 1\nblack = 2',
            "brighter than its black",
        ),
        ('name = "a"\nprimaries = [[0.6, 0.3], [0.3, 0.6], [0.1, nan]]\nwhite = [0.3, 0.3]', "not finite"),
    ],
)
def test_a_description_that_is_none_is_one_sentence(tmp_path, text: str, sentence: str) -> None:
    path = tmp_path / "a.toml"
    path.write_text(text)
    with pytest.raises(DataError) as caught:
        displays.named(path)
    said = str(caught.value)
    assert sentence in said and said.startswith(str(path)) and said.endswith(".") and "\n" not in said


def test_a_name_that_is_none_is_refused() -> None:
    with pytest.raises(UsageError, match=r"There is no display 'CRT': known are sRGB, Rec\.709, "):
        displays.named("CRT")
    with pytest.raises(DataError, match=r"none\.toml cannot be read"):
        displays.named("none.toml")


@given(st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=3, max_size=3))
def test_any_number_has_a_code(values: list[float]) -> None:
    for name in ("sRGB", "Rec.2020 PQ", "Rec.2020 HLG"):
        codes = displays.named(name).encode(np.array(values))
        assert ((codes >= 0) & (codes <= 1)).all()
