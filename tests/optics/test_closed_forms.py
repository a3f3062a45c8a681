"""The closed forms of `illuminant.optics` against limits, and the testers of `illuminant.verify`."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant import optics, verify
from illuminant.errors import DataError

cosines = st.floats(0.0, 1.0)
indices = st.floats(1.0, 4.0)


@given(cos=cosines, n=indices)
def test_a_boundary_reflects_the_same_from_both_sides(cos: float, n: float) -> None:
    inside = np.sqrt(1 - (1 - cos * cos) / (n * n))
    assert optics.fresnel_dielectric(cos, n) == pytest.approx(
        optics.fresnel_dielectric(inside, 1 / n), abs=1e-6
    )


@given(cos=cosines, n=st.floats(0.05, 5.0), k=st.floats(0.0, 10.0))
def test_reflectances_are_fractions(cos: float, n: float, k: float) -> None:
    mean = optics.fresnel_conductor(cos, n, k)
    parts = [optics.fresnel_conductor(cos, n, k, p) for p in ("parallel", "perpendicular")]
    assert 0 <= mean <= 1 + 1e-12
    if cos > 1e-6:
        assert mean == pytest.approx(np.mean(parts), abs=1e-6)


def test_grazing_normal_brewster_and_total_reflection() -> None:
    assert optics.fresnel_dielectric(0.0, 1.5) == 1.0
    assert optics.fresnel_dielectric(1.0, 1.5) == pytest.approx(0.04)
    assert optics.fresnel_dielectric(np.cos(np.arctan(1.5)), 1.5, "parallel") < 1e-20
    assert optics.fresnel_dielectric(np.cos(np.radians(42.0)), 1 / 1.5) == 1.0
    assert optics.fresnel_conductor(0.0, 0.617, 2.63) == pytest.approx(1.0)


@given(beta=st.floats(0.05, 0.7), name=st.sampled_from(["blinn", "gaussian", "trowbridge-reitz"]))
def test_lobes_fall_to_half_at_beta(beta: float, name: str) -> None:
    value = optics.lobe_value(name, np.cos(beta), optics.lobe_coefficient(name, beta))
    assert value == pytest.approx(0.5, rel=1e-6)


@pytest.mark.parametrize("m", [0.1, 0.5, 1.0])
def test_facets_cover_the_surface(m: float) -> None:
    for density in (optics.beckmann, optics.ggx):
        area = verify.integrate(lambda d, f=density: f(np.clip(d[:, 2], 0, 1), m) * d[:, 2], tolerance=1e-5)
        assert area == pytest.approx(1.0, abs=1e-3)


@given(m=st.floats(0.01, 1.0), cos=st.floats(0.05, 1.0), g=st.floats(1e-9, 1e12))
def test_the_series_is_finite_for_any_roughness(m: float, cos: float, g: float) -> None:
    assert np.isfinite(optics.wave_distribution(cos, m, g))


def test_the_series_meets_its_three_regimes() -> None:
    cos, m = 0.95, 0.4
    rough = optics.beckmann(cos, m) / 4
    assert optics.wave_distribution(cos, m, 1e6) == pytest.approx(rough, rel=1e-4)
    for g in (0.01, 1.0, 4.9, 20.0):
        exact, book = optics.wave_distribution(cos, m, g), optics.wave_distribution(cos, m, g, book=True)
        assert exact == pytest.approx(book, rel=0.05, abs=1e-4)


@given(pigment=st.floats(0.0, 1.0), n=st.floats(1.0, 2.5))
def test_paint_and_pigment_are_inverse(pigment: float, n: float) -> None:
    paint = optics.paint_reflectance(pigment, n)
    assert 0 <= paint <= 1 + 1e-12
    assert optics.pigment_reflectance(min(paint, 1.0), n) == pytest.approx(pigment, abs=1e-9)


def test_masking_of_torrance_has_a_kink_and_that_of_sancer_none() -> None:
    theta = np.radians(np.linspace(0, 89, 357))
    v_grooves = optics.masking_torrance_sparrow(np.radians(60), theta, np.pi)
    gauss = optics.masking_sancer(0.5, np.cos(theta), 0.5)
    assert np.abs(np.diff(v_grooves, 2)).max() > 10 * np.abs(np.diff(gauss, 2)).max()


def test_glasses_disperse_as_the_catalogue_says() -> None:
    assert optics.abbe_number("BK7") == pytest.approx(64.17, abs=0.1)
    assert optics.abbe_number("BK7", "eF'C'") == pytest.approx(63.96, abs=0.1)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: optics.fresnel_dielectric(1.2, 1.5), "cos must lie between 0 and 1"),
        (lambda: optics.fresnel_dielectric(float("nan"), 1.5), "cos must lie"),
        (lambda: optics.fresnel_dielectric(0.5, 1.5, "circular"), "polarisation must be"),
        (lambda: optics.fresnel_conductor([0.1, 0.2], [1, 2, 3], 1.0), "do not fit each other"),
        (lambda: optics.lobe_value("ward", 0.5, 1.0), "a lobe is one of"),
        (lambda: optics.abbe_number("BK7", "abc"), "lines must be"),
        (lambda: optics.profile(0, 1.0, 1.0, 1.0), "a profile needs"),
        (lambda: verify.integrate(lambda d: d), "gave an array of shape"),
        (lambda: verify.albedo(lambda v, _: np.full(len(v), np.nan), 0.0), "not finite"),
        (lambda: verify.albedo(lambda v, _: np.ones(len(v)), 90.0), "an angle lies"),
    ],
)
def test_what_is_out_of_range_is_told(call: object, says: str) -> None:
    with pytest.raises(DataError, match=says):
        call()  # type: ignore[operator]


def test_the_integrator_of_the_book() -> None:
    for increments, value in ((32, 3.142539), (64, 3.141829), (128, 3.141652)):
        assert verify.integrate(lambda d: d[:, 2], increments=increments) == pytest.approx(value, abs=1e-6)


def test_the_testers_find_what_is_wrong() -> None:
    def phong(v: np.ndarray, light: np.ndarray) -> np.ndarray:
        mirrored = v * [-1, -1, 1]
        return np.maximum(0, (mirrored * light).sum(axis=1)) ** 20 / light[:, 2]

    assert not verify.reciprocity(phong).passes
    shares = verify.furnace(phong)
    assert max(shares.values()) / min(shares.values()) > 1.2
    uniform = verify.chi_square(
        lambda u: np.stack(
            [
                np.sqrt(1 - u[:, 0] ** 2) * np.cos(2 * np.pi * u[:, 1]),
                np.sqrt(1 - u[:, 0] ** 2) * np.sin(2 * np.pi * u[:, 1]),
                u[:, 0],
            ],
            axis=-1,
        ),
        lambda d: np.where(d[:, 2] > 0, 0.5 / np.pi, 0.0),
    )
    assert uniform.passes
