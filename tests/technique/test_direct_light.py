"""Direct light against closed forms: form factors, the inverse square, and the real quantities of lamps.

Illuminance is measured on a small white probe (fixture `illuminance`), E = π L, and compared with radiometry:

- a Lambertian polygon of luminance L seen from a point (Lambert 1760; Baum, Rushmeier and Winget 1989):
  E = L/2 Σ Θᵢ (Γᵢ · n), with Θᵢ the angle under which edge i is seen and Γᵢ the unit normal of the plane through
  the point and the edge; the part below the horizon of the point is cut off first;
- a Lambertian sphere of radius R at distance d, wholly above the horizon: E = π L (R/d)² cos θ;
- a point source of intensity I: E = I cos θ / r²; parallel light: E = E₀ cos θ.
"""

import numpy as np
import pytest

from illuminant import spectra
from illuminant.core import core
from illuminant.scene import Scene

LUMINANCE = 1000.0

CORNER, EDGES = np.array([-0.5, 2.0, -0.5]), np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
SQUARE = np.array([CORNER, CORNER + EDGES[0], CORNER + EDGES[0] + EDGES[1], CORNER + EDGES[1]])
"""A square emitter of 1 m², 2 m above the ground; its front looks down."""


def above_horizon(polygon, normal):
    """The part of a polygon (relative to the point) on the positive side of the plane through the origin."""
    kept = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        height_a, height_b = a @ normal, b @ normal
        if height_a >= 0:
            kept.append(a)
        if height_a * height_b < 0:
            kept.append(a + (b - a) * height_a / (height_a - height_b))
    return np.array(kept)


def lambert(polygon, point, normal):
    """Illuminance from a polygon of luminance 1 (see above)."""
    normal = np.asarray(normal, float) / np.linalg.norm(normal)
    corners = above_horizon(np.asarray(polygon) - np.asarray(point), normal)
    if len(corners) < 3:
        return 0.0
    total = 0.0
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        across = np.cross(a, b)
        sine, cosine = np.linalg.norm(across), a @ b
        total += np.arctan2(sine, cosine) * (across / sine) @ normal
    return abs(total) / 2


def lamp(sides="front", **quantity):
    quantity = quantity or {"luminance_cd_m2": LUMINANCE}
    return {"lamp": {"kind": "emitter", "spectrum": "E", "sides": sides, **quantity}}


def rectangle():
    return {"lamp": {"material": "lamp", "rectangle": {"corner": CORNER, "edges": EDGES}}}


def triangles(n=6):
    """The same square as 2 n² triangles of uneven size."""
    ticks = np.linspace(0, 1, n + 1) ** 1.3
    u, v = np.meshgrid(ticks, ticks, indexing="ij")
    positions = CORNER + u[..., None] * EDGES[0] + v[..., None] * EDGES[1]
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + j).ravel()
    faces = np.concatenate(
        [np.stack([a, a + n + 1, a + n + 2], axis=1), np.stack([a, a + n + 2, a + 1], axis=1)]
    )
    return {"lamp": {"material": "lamp", "mesh": {"positions": positions.reshape(-1, 3), "faces": faces}}}


def separate(n=3):
    """The same square as n² lamps, each a rectangle."""
    return {
        f"lamp {i} {j}": {
            "material": "lamp",
            "rectangle": {"corner": CORNER + (i * EDGES[0] + j * EDGES[1]) / n, "edges": EDGES / n},
        }
        for i in range(n)
        for j in range(n)
    }


PROBES = {
    "below the middle": ([0, 0, 0], [0, 1, 0]),
    "off the axis": ([1.7, 0, 0.6], [0, 1, 0]),
    "far away": ([0, -40, 25], [0, 1, 0]),
    "tilted": ([0.4, 0.3, -0.9], [0.3, 0.8, 0.6]),
    "tilted so that the horizon cuts the lamp": ([0, 1.5, 0], [1, 0.2, 0]),
    "very near": ([0.1, 1.97, -0.2], [0, 1, 0]),
    "beside the lamp": ([2.0, 1.8, 0.3], [-1, 0.5, 0]),
}


@pytest.mark.parametrize("shape", [rectangle, triangles, separate])
@pytest.mark.parametrize("probe", PROBES.values(), ids=PROBES.keys())
def test_a_square_emitter_has_the_form_factor_of_lambert(illuminance, shape, probe):
    """E = L/2 Σ Θᵢ (Γᵢ · n) within 0.2 %, whether the lamp is one rectangle, many triangles, or many lamps."""
    result = illuminance(*probe, objects=shape(), materials=lamp())
    assert result == pytest.approx(LUMINANCE * lambert(SQUARE, *probe), rel=0.002)


def test_lamberts_formula_itself():
    """The form factor of a point below the centre of a square of side s at height h (Howell, catalogue C-1).

    F = (4 / 2π) · 2 · a/√(1 + a²) · atan(a/√(1 + a²)) with a = s / (2h).
    """
    a = 0.25
    slant = a / np.sqrt(1 + a * a)
    factor = 4 / (2 * np.pi) * 2 * slant * np.arctan(slant)
    assert lambert(SQUARE, [0, 0, 0], [0, 1, 0]) == pytest.approx(np.pi * factor, rel=1e-12)


def test_only_the_sides_that_shine_give_light(illuminance):
    """From behind, a one-sided lamp gives nothing, and a two-sided one as much as in front."""
    behind = ([0.3, 4.0, -0.2], [0, -1, 0])
    assert illuminance(*behind, objects=rectangle(), materials=lamp(), samples=16) == 0
    for shape in (rectangle, triangles):
        for probe in (behind, PROBES["off the axis"]):
            result = illuminance(*probe, objects=shape(), materials=lamp("both"))
            assert result == pytest.approx(LUMINANCE * lambert(SQUARE, *probe), rel=0.002)


@pytest.mark.parametrize(
    ("center", "radius", "normal"),
    [
        ([0, 2, 0], 0.5, [0, 1, 0]),
        ([1, 2, -0.5], 0.7, [0, 1, 0]),
        ([1, 2, -0.5], 0.7, [0.4, 1, 0.3]),
        ([0, 1.05, 0], 1.0, [0, 1, 0]),
        ([30, 90, 20], 0.5, [0, 1, 0]),
    ],
    ids=["above", "off the axis", "tilted", "nearly touching", "far away"],
)
def test_a_spherical_lamp_has_its_form_factor(illuminance, center, radius, normal):
    """E = π L (R/d)² cos θ."""
    center, normal = np.array(center, float), np.array(normal) / np.linalg.norm(normal)
    distance = np.linalg.norm(center)
    expected = np.pi * LUMINANCE * (radius / distance) ** 2 * (center @ normal) / distance
    objects = {"lamp": {"material": "lamp", "sphere": {"center": center, "radius": radius}}}
    result = illuminance([0, 0, 0], normal, objects=objects, materials=lamp())
    assert result == pytest.approx(expected, rel=0.002)


def test_inside_a_spherical_lamp_the_illuminance_is_that_of_the_full_sky(illuminance):
    """E = π L anywhere inside a luminous sphere, for any normal."""
    objects = {"lamp": {"material": "lamp", "sphere": {"radius": 1.0}}}
    materials = lamp("both")
    for probe in (([0, 0, 0], [0, 1, 0]), ([0.5, -0.3, 0.4], [1, 1, -1])):
        result = illuminance(*probe, objects=objects, materials=materials)
        assert result == pytest.approx(np.pi * LUMINANCE, rel=0.002)


def test_a_lamp_half_behind_a_screen(illuminance):
    """An opaque screen takes away just the part of the lamp that lies behind it.

    A screen above z = 0 reaches beyond the lamp towards +z, so the probe sees the lamp's part with z < 0 after
    projection through the screen's edge; Lambert's formula of that part is the answer.
    """
    screen = {"material": "black", "rectangle": {"corner": [-9, 1, 0.1], "edges": [[0, 0, 9], [18, 0, 0]]}}
    result = illuminance(
        [0.2, 0, 0],
        [0, 1, 0],
        objects=rectangle() | {"screen": screen},
        materials=lamp() | {"black": {"kind": "diffuse", "reflectance": 0.0}},
    )
    visible = SQUARE.copy()
    visible[:, 2] = np.minimum(visible[:, 2], 0.2)  # the edge at height 1 and z = 0.1, seen at height 2
    expected = LUMINANCE * lambert(visible, [0.2, 0, 0], [0, 1, 0])
    assert result == pytest.approx(expected, rel=0.002)


# --- points, spots, parallel light ------------------------------------------------------------------------------------


@pytest.mark.parametrize("position", [[0, 1, 0], [2, 3, -1], [0.01, 0.002, 0], [300, 50, -700]])
@pytest.mark.parametrize("normal", [[0, 1, 0], [0.5, 1, -0.3]])
def test_a_point_source_obeys_cosine_over_distance_squared(illuminance, position, normal):
    """E = I cos θ / r² within 0.1 %."""
    lights = {"bulb": {"kind": "point", "position": position, "spectrum": "E", "intensity_cd": 100.0}}
    d, n = np.array(position, float), np.array(normal) / np.linalg.norm(normal)
    expected = 100.0 * max(0.0, d @ n) / np.linalg.norm(d) ** 3
    result = illuminance([0, 0, 0], normal, lights=lights, samples=16)
    # The probe is not a point: over its 0.1 mm a lamp 1 cm away is nearer and farther.
    assert result == pytest.approx(expected, rel=0.001)


def test_two_points_add_up(illuminance):
    """Illuminances add, whichever lamp a path asks."""
    lights = {
        "a": {"kind": "point", "position": [0, 1, 0], "spectrum": "E", "intensity_cd": 50.0},
        "b": {"kind": "point", "position": [1, 1, 0], "spectrum": "E", "intensity_cd": 300.0},
    }
    result = illuminance([0, 0, 0], [0, 1, 0], lights=lights)
    assert result == pytest.approx(50.0 + 300.0 / 2**1.5, rel=0.002)


def spot_scene(**spot):
    """A white plane 1 m before a spot, seen from the spot itself."""
    light = {"kind": "spot", "position": [0, 0, 0], "direction": [0, 0, -1], "spectrum": "E", **spot}
    return Scene.build(
        camera={"eye": [0, 0, 0], "target": [0, 0, -1], "size": [64, 64], "field_of_view": 110},
        objects={
            "plane": {
                "material": "white",
                "rectangle": {"corner": [-3, -3, -1], "edges": [[6, 0, 0], [0, 6, 0]]},
            }
        },
        materials={"white": {"kind": "diffuse", "reflectance": 1.0}},
        lights={"spot": light},
    )


SPOTS = [(30.0, 0.0), (40.0, 15.0), (50.0, 50.0)]


@pytest.mark.parametrize(("half_angle", "penumbra"), SPOTS)
def test_the_flux_of_a_spot_is_the_integral_of_its_illuminance(measure, half_angle, penumbra):
    """Φ = ∫ E dA over a plane that catches the whole cone, within 0.2 %."""
    scene = spot_scene(half_angle_deg=half_angle, penumbra_deg=penumbra, flux_lm=800.0)
    result = measure(scene, samples=64, depth=2, sampling="uniform:4", filter="box")
    width = 2 * np.tan(np.radians(55))
    assert np.pi * result.Y * width**2 == pytest.approx(800.0, rel=0.002)


@pytest.mark.parametrize(("half_angle", "penumbra"), SPOTS)
def test_the_intensity_of_a_spot_is_that_on_its_axis(illuminance, half_angle, penumbra):
    """E = I cos θ / r² inside the full cone, nothing outside the half angle."""
    light = {
        "kind": "spot",
        "position": [0, 2, 0],
        "direction": [0, -1, 0],
        "half_angle_deg": half_angle,
        "penumbra_deg": penumbra,
        "spectrum": "E",
        "intensity_cd": 100.0,
    }
    up = [0, 1, 0]
    on_axis = illuminance([0, 0, 0], up, lights={"spot": light}, samples=16)
    assert on_axis == pytest.approx(25.0, rel=0.001)
    edge = 2 * np.tan(np.radians(half_angle))
    assert illuminance([1.02 * edge, 0, 0], up, lights={"spot": light}, samples=16) == 0
    full = 2 * np.tan(np.radians(half_angle - penumbra))
    if full:
        inside = illuminance([0, 0, 0.97 * full], up, lights={"spot": light}, samples=16)
        assert inside == pytest.approx(100.0 * 2 / (4 + (0.97 * full) ** 2) ** 1.5, rel=0.001)


@pytest.mark.parametrize("normal", [[0, 1, 0], [1, 1, 0], [0.2, 0.1, -1]])
def test_parallel_light_obeys_the_cosine_law(illuminance, normal):
    """E = E₀ cos θ."""
    direction = np.array([-1.0, -2.0, 0.5])
    lights = {"sun": {"kind": "directional", "direction": direction, "spectrum": "E", "illuminance_lx": 1e5}}
    cosine = -(np.array(normal) / np.linalg.norm(normal)) @ direction / np.linalg.norm(direction)
    result = illuminance([0, 0, 0], normal, lights=lights, samples=16)
    assert result == pytest.approx(1e5 * max(0.0, cosine), rel=0.001)


# --- quantities -------------------------------------------------------------------------------------------------------

PHOTOMETRIC = {"sampling": "1nm", "samples": 4, "depth": 1}


def radiant_per_luminous(name):
    """W per lm of a spectrum of the library: ∫ E dλ / (683 ∫ E ȳ dλ), sums at 1 nm over the scene's range."""
    wavelengths = np.arange(380.0, 781.0)
    values = np.asarray(spectra.load(name).at(wavelengths))
    return values.sum() / core().xyz(wavelengths, values, "zero")[1]


CLOSE_UP = {"eye": [0, 0, 0], "target": [0, 1, 0], "up": [0, 0, 1], "size": [4, 4], "field_of_view": 20}


def seen_square(**quantity):
    """A camera that looks at nothing but a square emitter of 1 m², under illuminant A."""
    spectrum = {"spectrum": "A"} | quantity
    return Scene.build(
        camera=CLOSE_UP,
        objects=rectangle(),
        materials={"lamp": {"kind": "emitter", **spectrum}},
    )


def test_the_luminance_of_an_emitter_is_the_one_stated(measure):
    """L = 683 ∫ L_λ ȳ dλ."""
    luminance = measure(seen_square(luminance_cd_m2=250.0), **PHOTOMETRIC).Y
    assert luminance == pytest.approx(250.0, rel=1e-5)


@pytest.mark.parametrize(("sides", "number"), [("front", 1), ("both", 2)])
def test_flux_and_power_of_an_emitter(measure, sides, number):
    """L = Φ / (π A) for each side that shines; the power in W is that of the lumens."""
    flux = measure(seen_square(flux_lm=500.0, sides=sides), **PHOTOMETRIC).Y
    assert flux == pytest.approx(500.0 / (np.pi * number), rel=1e-5)
    watts = 500.0 * radiant_per_luminous("A")
    power = measure(seen_square(power_w=watts, sides=sides), **PHOTOMETRIC).Y
    assert power == pytest.approx(flux, rel=1e-5)


def test_an_absolute_spectrum_is_taken_as_it_is(measure):
    """Y = 683 Σ L_λ ȳ at 1 nm; a black body has its luminance by Planck's law."""
    scene = seen_square(spectrum={"blackbody_k": 2856.0}, radiance_scale=2.0)
    wavelengths = np.arange(380.0, 781.0)
    c1, c2, meters = 3.741771852e-16, 1.438776877e-2, wavelengths * 1e-9
    radiance = 1e-9 * c1 / np.pi / meters**5 / np.expm1(c2 / (meters * 2856.0))
    expected = 2 * core().xyz(wavelengths, radiance, "zero")
    assert measure(scene, **PHOTOMETRIC).xyz == pytest.approx(expected, rel=1e-4)


def test_a_lamp_gives_the_same_luminance_by_every_route(measure):
    """The same emitter by W, lm, cd/m² and its own radiance."""
    wavelengths = np.arange(380.0, 781.0)
    values = np.asarray(spectra.load("A").at(wavelengths))
    luminous = core().xyz(wavelengths, values, "zero")[1]
    flux = np.pi * 250.0
    routes = [
        {"luminance_cd_m2": 250.0},
        {"flux_lm": flux},
        {"power_w": flux * radiant_per_luminous("A")},
        {"radiance_scale": 250.0 / luminous},
    ]
    results = [measure(seen_square(**route), **PHOTOMETRIC).xyz for route in routes]
    for result in results[1:]:
        assert result == pytest.approx(results[0], rel=1e-5)


@pytest.mark.parametrize("name", ["A", "FL11"])
def test_point_quantities(illuminance, name):
    """E = I / r² with I = Φ / 4π, and W by the lamp's own efficacy, for smooth light and for lines."""
    routes = [
        {"intensity_cd": 80.0},
        {"flux_lm": 80.0 * 4 * np.pi},
        {"power_w": 80.0 * 4 * np.pi * radiant_per_luminous(name)},
    ]
    for route in routes:
        lights = {"bulb": {"kind": "point", "position": [0, 2, 0], "spectrum": name, **route}}
        result = illuminance([0, 0, 0], [0, 1, 0], lights=lights, samples=4, sampling="1nm")
        assert result == pytest.approx(20.0, rel=0.001)


def test_spot_power_is_that_of_its_lumens(measure):
    """The same spot by W and by lm."""
    watts = 800.0 * radiant_per_luminous("E")
    options = {"samples": 16, "depth": 2, "sampling": "uniform:4"}
    flux = measure(spot_scene(half_angle_deg=30, penumbra_deg=10, flux_lm=800.0), **options)
    power = measure(spot_scene(half_angle_deg=30, penumbra_deg=10, power_w=watts), **options)
    assert power.xyz == pytest.approx(flux.xyz, rel=1e-5)


def test_parallel_light_by_irradiance(illuminance):
    """E in lx is that of the W/m²."""
    irradiance = 500.0 * radiant_per_luminous("D65")
    light = {"kind": "directional", "direction": [0, -1, 0], "spectrum": "D65", "irradiance_w_m2": irradiance}
    result = illuminance([0, 0, 0], [0, 1, 0], lights={"sun": light}, samples=4, sampling="1nm")
    assert result == pytest.approx(500.0, rel=0.001)


def test_surroundings_by_illuminance_and_luminance(illuminance):
    """A uniform sky of luminance L gives the ground E = π L."""
    for quantity in ({"luminance_cd_m2": 100.0}, {"illuminance_lx": 100.0 * np.pi}):
        lights = {"sky": {"kind": "environment", "spectrum": "E", **quantity}}
        result = illuminance([0, 0, 0], [0, 1, 0], lights=lights, samples=16)
        assert result == pytest.approx(100.0 * np.pi, rel=1e-5)


def test_lengths_in_other_units_do_not_change_light(measure):
    """Flux of a lamp in mm: its area is in m² once the scene is resolved."""
    scene = Scene.build(
        camera=CLOSE_UP,
        objects={"lamp": {"material": "lamp", "rectangle": {"corner": 1000 * CORNER, "edges": 1000 * EDGES}}},
        materials={"lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 500.0}},
        length_unit="mm",
    )
    luminance = measure(scene, **PHOTOMETRIC).Y
    assert luminance == pytest.approx(500.0 / np.pi, rel=1e-5)
