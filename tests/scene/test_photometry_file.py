"""Files of photometric laboratories: IES of types A, B and C, and EULUMDAT."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import illuminant
from illuminant.errors import DataError, SceneError
from illuminant.photometry_file import parse, read
from illuminant.scene import Scene


def ies(
    vertical, horizontal, table, *, kind=1, multiplier=1.0, ballast=1.0, units=2, watts=30.0, version="2002"
):
    """An IES file; `table` has a row for each horizontal angle."""
    first = [] if version == "1986" else [f"IESNA:LM-63-{version}"]
    lines = [
        *first,
        "[MANUFAC] A maker",
        "[LUMCAT] X-1",
        "[MORE] and more",
        "TILT=NONE",
        f"1 1000 {multiplier} {len(vertical)} {len(horizontal)} {kind} {units} 0.1 0.2 0.3",
        f"{ballast} 1 {watts}",
        " ".join(map(str, vertical)),
        " ".join(map(str, horizontal)),
        *(" ".join(map(str, row)) for row in table),
    ]
    return "\r\n".join(lines).encode()


def ldt(symmetry, planes, angles, table, *, flux=1000.0, factor=1.0):
    """A EULUMDAT file of one lamp."""
    lines = [
        "A maker",
        "1",
        str(symmetry),
        str(len(planes)),
        "90",
        str(len(angles)),
        "5",
        "report",
        "A lamp",
        "X-1",
        "file",
        "date",
        "100",
        "200",
        "300",
        "0",
        "0",
        "0",
        "0",
        "0",
        "0",
        "100",
        "80",
        str(factor),
        "0",
        "1",
        "1",
        "LED",
        str(flux),
        "3000",
        "90",
        "25",
        *["0.5"] * 10,
        *map(str, planes),
        *map(str, angles),
        *(str(value) for row in table for value in row),
    ]
    return "\n".join(lines).encode()


V = [0, 30, 60, 90]


def at(lamp, c, gamma):
    """The value of a plane and an angle of the table."""
    plane = int(np.flatnonzero(np.isclose(lamp.planes_deg, c))[0])
    return lamp.candela[plane, int(np.flatnonzero(np.isclose(lamp.angles_deg, gamma))[0])]


@pytest.mark.parametrize("version", ["1986", "1991", "1995", "2002", "2019"])
def test_values_are_candela(version):
    lamp = parse(ies(V, [0], [[300, 200, 100, 0]], multiplier=2.0, ballast=0.9, version=version), "a.ies")
    np.testing.assert_allclose(lamp.candela, [[540, 360, 180, 0]])
    assert lamp.watts == 30.0
    assert lamp.keywords["LUMCAT"] == "X-1 and more"
    assert lamp.size_m == (0.2, 0.1, 0.3)
    feet = parse(ies(V, [0], [[300, 200, 100, 0]], units=1), "a.ies")
    np.testing.assert_allclose(feet.size_m, np.array([0.2, 0.1, 0.3]) * 0.3048)


def test_type_c_is_written_out_over_the_circle():
    quadrant = parse(ies(V, [0, 45, 90], [[9, 1, 1, 0], [9, 2, 2, 0], [9, 3, 3, 0]]), "a.ies")
    assert quadrant.planes_deg.tolist() == [0, 45, 90, 135, 180, 225, 270, 315]
    assert [at(quadrant, c, 30) for c in quadrant.planes_deg] == [1, 2, 3, 2, 1, 2, 3, 2]
    half = parse(ies(V, [0, 90, 180], [[9, 1, 1, 0], [9, 2, 2, 0], [9, 3, 3, 0]]), "a.ies")
    assert [at(half, c, 30) for c in (0, 90, 180, 270)] == [1, 2, 3, 2]
    other = parse(ies(V, [90, 180, 270], [[9, 1, 1, 0], [9, 2, 2, 0], [9, 3, 3, 0]]), "a.ies")
    assert [at(other, c, 30) for c in (0, 90, 180, 270)] == [2, 1, 2, 3]
    whole = parse(
        ies(V, [0, 120, 240, 360], [[9, 1, 1, 0], [9, 2, 2, 0], [9, 3, 3, 0], [9, 1, 1, 0]]), "a.ies"
    )
    assert whole.planes_deg.tolist() == [0, 120, 240]


@pytest.mark.parametrize("kind", [2, 3])
def test_types_a_and_b_turn_about_other_poles(kind):
    """A beam 30 degrees to the right, and one 60 degrees up: both types agree on the axes themselves."""
    h, v = np.arange(-90, 91, 10), np.arange(-90, 91, 10)
    right = np.exp(-(((h[:, None] - 30) / 12.0) ** 2) - ((v[None, :] / 12.0) ** 2)) * 1000
    lamp = parse(ies(v.tolist(), h.tolist(), right.tolist(), kind=kind), "a.ies")
    assert np.unravel_index(lamp.candela.argmax(), lamp.candela.shape) == (0, 12)  # C = 0, γ = 30
    up = np.exp(-((h[:, None] / 12.0) ** 2) - (((v[None, :] - 60) / 12.0) ** 2)) * 1000
    lamp = parse(ies(v.tolist(), h.tolist(), up.tolist(), kind=kind), "a.ies")
    assert np.unravel_index(lamp.candela.argmax(), lamp.candela.shape) == (36, 24)  # C = 90, γ = 60


def test_types_a_and_b_differ_off_the_axes():
    """H = 40, V = 40: type A turns up from where it looks, type B to the side of where it is tilted."""
    h, v = np.arange(-90, 91, 2.5), np.arange(-90, 91, 2.5)
    beam = np.exp(-(((h[:, None] - 40) / 5.0) ** 2) - (((v[None, :] - 40) / 5.0) ** 2)) * 1000
    found = {}
    for kind in (2, 3):
        lamp = parse(ies(v.tolist(), h.tolist(), beam.tolist(), kind=kind), "a.ies")
        plane, angle = np.unravel_index(lamp.candela.argmax(), lamp.candela.shape)
        c, gamma = np.radians(lamp.planes_deg[plane]), np.radians(lamp.angles_deg[angle])
        found[kind] = np.array([np.sin(gamma) * np.cos(c), np.sin(gamma) * np.sin(c), np.cos(gamma)])
    s, co = np.sin(np.radians(40)), np.cos(np.radians(40))
    assert np.degrees(np.arccos(found[2] @ [s, co * s, co * co])) < 2.0
    assert np.degrees(np.arccos(found[3] @ [co * s, s, co * co])) < 2.0


@pytest.mark.parametrize("kind", [2, 3])
def test_a_quarter_of_type_a_or_b_is_symmetric(kind):
    h, v = [0, 30, 60, 90], [0, 30, 60, 90]
    table = (np.cos(np.radians(h))[:, None] * np.cos(np.radians(v))[None, :] * 100).tolist()
    lamp = parse(ies(v, h, table, kind=kind), "a.ies")
    for gamma in (20, 50):
        values = [at(lamp, c, gamma) for c in (30, 150, 210, 330)]
        np.testing.assert_allclose(values, values[0])


def test_eulumdat_by_its_symmetries():
    """Values are candela for a thousand lumens."""
    planes = [0, 90, 180, 270]
    rows = [[9, 1, 1, 0], [9, 2, 2, 0], [9, 3, 3, 0], [9, 4, 4, 0]]
    expected = {0: (rows, [1, 2, 3, 4]), 1: (rows[:1], [1, 1, 1, 1]), 2: (rows[:3], [1, 2, 3, 2])}
    expected |= {3: ([rows[3], rows[0], rows[1]], [1, 2, 1, 4]), 4: (rows[:2], [1, 2, 1, 2])}
    for symmetry, (table, values) in expected.items():
        lamp = parse(ldt(symmetry, planes, V, table, flux=2500.0, factor=1.1), "a.ldt")
        found = [at(lamp, c if symmetry != 1 else 0, 30) for c in (0, 90, 180, 270)]
        np.testing.assert_allclose(found, np.array(values) * 2.5 * 1.1, err_msg=str(symmetry))
        assert lamp.watts == 25.0
        assert lamp.keywords["NAME"] == "A lamp"


def test_flux_is_the_integral():
    """Of a point that shines evenly 4π I, of Lambert's surface π I."""
    even = parse(ies([0, 90, 180], [0], [[10, 10, 10]]), "a.ies")
    assert even.flux_lm() == pytest.approx(40 * np.pi, rel=1e-12)
    angles = np.arange(0, 90.5, 1.0)
    lambert = parse(ies(angles.tolist(), [0, 90], [(100 * np.cos(np.radians(angles))).tolist()] * 2), "a.ies")
    assert lambert.flux_lm() == pytest.approx(100 * np.pi, rel=1e-3)


# In scenes


def lit(tmp_path, data, name="lamp.ies", size=9, **light):
    """A white floor 2 m under a luminaire, seen from straight above: Y of each pixel, over a metre to each side."""
    (tmp_path / name).write_bytes(data)
    scene = Scene.build(
        camera={
            "eye": [0, 1.0, 0],
            "target": [0, 0, 0],
            "up": [0, 0, -1],
            "size": [size, size],
            "field_of_view": 90.0,
        },
        objects={
            "floor": {
                "rectangle": {"corner": [-9, 0, 9], "edges": [[18, 0, 0], [0, 0, -18]]},
                "material": "white",
            }
        },
        materials={"white": {"kind": "diffuse", "reflectance": 1.0}},
        lights={
            "lamp": {"kind": "point", "position": [0, 2, 0], "spectrum": "E", "photometry": name} | light
        },
        directory=tmp_path,
    )
    image = illuminant.render(scene, depth=2, samples=1, sampling="1nm", filter=("box", 1e-6))
    return np.asarray(image.xyz, float)[..., 1]


def place(row, column, size=9):
    """Where a pixel is on the floor: x to the right, z down the image."""
    step = 2.0 / size
    return (column + 0.5) * step - 1.0, (row + 0.5) * step - 1.0


def test_illuminance_is_that_of_the_candela_of_the_file(tmp_path):
    """E = I cos γ/r² on the floor, and its luminance E/π: a hand calculation, in real units."""
    table = [[1000, 800, 100, 0], [1000, 400, 50, 0]]
    found = lit(tmp_path, ies(V, [0, 90], table, multiplier=1.5, ballast=0.8))
    for row in range(9):
        for column in range(9):
            x, z = place(row, column)
            r = np.sqrt(x * x + z * z + 4.0)
            gamma, c = np.degrees(np.arccos(2.0 / r)), np.degrees(np.arctan2(abs(z), abs(x)))
            low, high = (np.interp(gamma, V, np.array(values) * 1.2) for values in table)
            intensity = low + (high - low) * c / 90.0
            assert found[row, column] == pytest.approx(intensity * (2.0 / r) / r**2 / np.pi, rel=2e-3)


def test_a_turn_turns_the_pattern(tmp_path):
    data = ies(
        V, [0, 90, 180, 270, 360], [[9, 9, 0, 0], [9, 3, 0, 0], [9, 1, 0, 0], [9, 3, 0, 0], [9, 9, 0, 0]]
    )
    still, turned = lit(tmp_path, data), lit(tmp_path, data, turn_deg=90.0)
    # C = 0 lies along x; a right-handed turn about the axis, which looks down, takes it to +z: down the image.
    assert still[4, 8] > 2 * still[4, 0]
    np.testing.assert_allclose(turned, np.rot90(still, -1), rtol=1e-3)


def test_a_quantity_wins_over_the_file(tmp_path):
    data = ies([0, 90, 180], [0], [[10, 10, 10]])
    own = lit(tmp_path, data)
    assert lit(tmp_path, data, flux_lm=400 * np.pi)[4, 4] == pytest.approx(10 * own[4, 4], rel=1e-4)
    assert lit(tmp_path, data, intensity_cd=30.0)[4, 4] == pytest.approx(3 * own[4, 4], rel=1e-4)


def test_eulumdat_lights_a_scene(tmp_path):
    found = lit(tmp_path, ldt(1, [0], V, [[500, 400, 100, 0]], flux=2000.0), "lamp.ldt")
    assert found[4, 4] == pytest.approx(1000 / 4 / np.pi, rel=2e-3)


@pytest.mark.parametrize(
    ("data", "name", "message"),
    [
        (b"", "a.ies", "is empty"),
        (b"\0\1\2" * 50, "a.ies", "is no text"),
        (b"hello\nworld", "a.ies", "has no line TILT="),
        (b"TILT=WHAT\n1", "a.ies", "expected TILT=NONE"),
        (ies(V, [0], [[1, 2, 3]]), "a.ies", "ends before candela"),
        (ies([0, 30, 30, 90], [0], [[1, 2, 3, 4]]), "a.ies:8", "do not grow"),
        (ies(V, [0], [[1, -2, 3, 4]]), "a.ies", "negative intensity"),
        (ies(V, [0], [[0, 0, 0, 0]]), "a.ies", "no intensity above 0"),
        (ies(V, [0], [[1, "x", 3, 4]]), "a.ies:10", "expected candela"),
        (ies(V, [0], [[1, 2, 3, 4]], kind=4), "a.ies:6", "photometric type"),
        (ies(V, [0], [[1, 2, 3, 4]], multiplier=0.0), "a.ies", "expected above 0"),
        (ies(V, [10, 50], [[1, 2, 3, 4]] * 2), "a.ies", "horizontal angles from 10 to 50"),
        (ies([0, 100, 200], [0], [[1, 2, 3]]), "a.ies", "type C has 0 to 180"),
        (ies([-95, 0], [0], [[1, 2]], kind=2), "a.ies", "beyond 90"),
        (ldt(1, [0], V, [[1, 2, 3]]), "a.ldt", "ends before intensity"),
        (ldt(7, [0], V, [[1, 2, 3, 4]]), "a.ldt:3", "symmetry indicator"),
        (ldt(1, [0], V, [[1, 2, 3, 4]], flux=0.0), "a.ldt", "expected above 0"),
    ],
)
def test_broken_files_say_where_and_what(data, name, message):
    file, _, _line = name.partition(":")
    with pytest.raises(DataError, match=message) as caught:
        parse(data, file)
    assert str(caught.value).startswith(name)


@settings(max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.sampled_from([ies(V, [0, 90], [[1, 2, 3, 4]] * 2), ldt(4, [0, 90, 180, 270], V, [[1, 2, 3, 4]] * 2)]),
    st.integers(0, 400),
    st.binary(max_size=12),
    st.sampled_from(["a.ies", "a.ldt"]),
)
def test_no_file_is_more_than_refused(data, at_byte, junk, name):
    at_byte = min(at_byte, len(data))
    try:
        lamp = parse(data[:at_byte] + junk + data[at_byte + len(junk) :], name)
    except DataError:
        return
    assert np.isfinite(lamp.candela).all()
    assert (np.diff(lamp.planes_deg) > 0).all()
    assert lamp.flux_lm() >= 0


def test_scenes_name_their_mistakes(tmp_path):
    with pytest.raises(SceneError, match="no such file"):
        lit(tmp_path, b"", "lamp.ies", photometry="missing.ies")
    with pytest.raises(SceneError, match=r"lamp\.ies: is empty"):
        lit(tmp_path, b"", "lamp.ies")
    with pytest.raises(SceneError, match="photometry says it too"):
        lit(tmp_path, ies(V, [0], [[1, 2, 3, 4]]), cosine_power=2.0)
    with pytest.raises(DataError, match="no such file"):
        read(tmp_path / "nothing.ies")
