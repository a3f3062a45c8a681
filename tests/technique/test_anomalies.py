"""The anomalies of incremental shading, in numbers (book 4.2.1, 4.2.4, figures 4.7 and 4.9 to 4.12)."""

import numpy as np
import pytest

import illuminant

SCENE = """
[camera]
eye = [0, 0, 6]
target = [0, 0, 0]
field_of_view = 30
size = [65, 65]

[lights.key]
kind = "point"
position = {light}
spectrum = "D65"
intensity_cd = 2000

[materials]
"paint" = {{ kind = "coated", roughness = 0.12, pigment = 0.3 }}
"chalk" = {{ kind = "diffuse", reflectance = 0.8 }}

[objects]
"thing" = {{ material = "{material}", mesh = "thing.obj" }}
"""


def grid(n, tilt=0.0):
    """A square of side 2 cut into n x n squares, tipped backwards by an angle in degrees."""
    c, s = np.cos(np.radians(tilt)), np.sin(np.radians(tilt))
    lines = []
    for j in range(n + 1):
        for i in range(n + 1):
            x, y = 2 * i / n - 1, 2 * j / n - 1
            lines.append(f"v {x} {y * c} {-y * s}")
    lines.append(f"vn 0 {s} {c}")
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i + 1
            b, d = a + 1, a + n + 1
            lines += [f"f {a}//1 {b}//1 {d + 1}//1", f"f {a}//1 {d + 1}//1 {d}//1"]
    return "\n".join(lines)


@pytest.fixture
def shown(tmp_path):
    def render(mesh, material="chalk", light="[0, 0, 3]", **options):
        (tmp_path / "thing.obj").write_text(mesh, encoding="utf-8")
        path = tmp_path / "scene.toml"
        path.write_text(SCENE.format(material=material, light=light), encoding="utf-8")
        options = {"illumination": "phong", "samples": 1, "ambient": 0.0, "filter": ("box", 0.5)} | options
        return illuminant.render(path, **options).xyz[..., 1]

    return render


def test_gouraud_misses_a_highlight_inside_a_polygon(shown):
    """Book figure 4.11."""
    missed = shown(grid(1), "paint", technique="gouraud")
    found = shown(grid(1), "paint", technique="phong")
    assert found[32, 32] > 1.3 * found[20, 20]  # a highlight
    assert missed[32, 32] < 0.6 * found[32, 32]
    fine = shown(grid(64), "paint", technique="gouraud")
    assert abs(fine[32, 32] / found[32, 32] - 1) < 0.03  # subdivided to pixels it is there (book 4.2.4)


def test_a_tipped_square_is_distorted_on_the_screen(shown):
    """Book figure 4.12: under a local light both interpolations differ, and less so on small squares."""

    def apart(n):
        screen, world = (
            shown(grid(n, 60), technique="phong", interpolation=space) for space in ("screen", "object")
        )
        return np.abs(screen - world).max() / world.max()

    assert apart(1) > 0.01
    assert apart(16) < 0.1 * apart(1)


def test_interpolation_in_the_world_gives_the_value_of_a_ray(shown):
    """Normals and positions interpolated in the world are those that a ray meets."""
    scan = shown(grid(1, 60), technique="phong", interpolation="object", illumination="bouknight", samples=64)
    ray = shown(grid(1, 60), technique="path", illumination="general", depth=2, samples=256)
    inside = ray > 0
    inside[:, :2] = inside[:, -2:] = False
    both = inside & (scan > 0)
    assert both.sum() > 300
    assert np.median(np.abs(scan[both] / ray[both] - 1)) < 0.01


def test_the_slope_of_brightness_jumps_where_polygons_meet(shown, cylinder):
    """Book figure 4.9: what the eye makes Mach bands of. Interpolated normals leave little of it."""

    def jump(technique):
        row = shown(cylinder(12), light="[0, 0, 40]", technique=technique, size=(401, 401))[200]
        # Away from the silhouette, where the slope of a cylinder is steep itself.
        bright = row[row > 0.75 * row.max()]
        second = np.abs(np.diff(bright / bright.max(), 2))
        return np.sort(second)[-4:].mean()

    assert jump("gouraud") > 2.5 * jump("phong")


def test_a_polygon_has_one_colour_by_constant_shading(shown, cylinder):
    image = shown(cylinder(12), light="[0, 0, 40]", technique="constant")
    assert 4 <= len(np.unique(np.round(image[32][image[32] > 0], 3))) <= 8
