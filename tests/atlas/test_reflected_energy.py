"""The energies of chapter 2 against the general integrator, against their limits, and against the model `general`."""

import numpy as np
import pytest

from illuminant import optics, verify
from illuminant.atlas.chapter_2.reflected_energy import (
    SLOPES,
    WAVELENGTH_NM,
    coherent,
    directions,
    equilibrium,
    incoherent,
)


@pytest.mark.parametrize("m", SLOPES)
@pytest.mark.parametrize("theta_deg", [0.0, 45.0, 85.0])
@pytest.mark.parametrize("masked", [True, False])
def test_the_crowded_rule_agrees_with_the_general_integrator(m, theta_deg, masked):
    sin, cos = np.sin(np.radians(theta_deg)), np.cos(np.radians(theta_deg))

    def reflected(out):
        half = out + np.array([sin, 0.0, cos])
        half /= np.linalg.norm(half, axis=1, keepdims=True)
        cos_out = out[:, 2].clip(0.0, 1.0)
        g = optics.apparent_roughness(100.0, WAVELENGTH_NM, cos, cos_out)
        density = optics.wave_distribution(half[:, 2].clip(0.0, 1.0), m, g, book=True)
        return density * (optics.masking_sancer(cos, cos_out, m) if masked else 1.0) / cos

    expected = verify.integrate(reflected, tolerance=1e-4)
    assert incoherent(theta_deg, m, 100.0, masked, book=True)[0] == pytest.approx(
        expected, rel=1e-3, abs=1e-4
    )


@pytest.mark.parametrize("theta_deg", [0.0, 30.0, 80.0, 89.0])
@pytest.mark.parametrize("m", [0.02, 0.5, 5.0])
def test_directions_stand_for_the_hemisphere(theta_deg, m):
    at = directions(theta_deg, m)
    assert at.weight.sum() == pytest.approx(2.0 * np.pi, rel=2e-3)
    assert (at.weight * at.cos_out).sum() == pytest.approx(np.pi, rel=2e-3)


def test_a_smooth_surface_is_all_coherent_and_a_high_gentle_relief_all_scattered():
    assert coherent(30.0, 0.0) == 1.0
    assert incoherent(30.0, 0.1, 0.0)[0] == 0.0
    assert coherent(0.0, 1000.0) < 1e-30
    assert incoherent(0.0, 0.02, 1000.0)[0] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("distribution", ["beckmann", "ggx"])
def test_general_returns_all(distribution):
    found = equilibrium(0.5, None, (0.0, 60.0), 8_000, distribution)
    np.testing.assert_allclose(found.total, 1.0, atol=0.01)
    np.testing.assert_allclose(found.coherent, 0.0, atol=1e-12)
