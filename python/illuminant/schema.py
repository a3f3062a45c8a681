"""The scene file as data: every table and key, its type, unit, meaning, default and an example.

The models are strict (a string is never a number, an unknown key is a mistake) and are the single source of three
things: the validation in `scene_file`, the reference in `docs/scene-file.md`, and what `illuminant check --schema`
prints. They check the form of one table; what joins tables (names, files, roles, quantities) is checked in
`resolution`.

Lengths are in the file's `length_unit`, angles in degrees, wavelengths in nm; every other quantity is in the SI unit
that its key names.

Example:
    >>> from illuminant.schema import Camera
    >>> Camera.model_validate({"eye": [0, 1, 4], "target": [0, 1, 0]}).field_of_view
    40.0
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field

from illuminant.animation_schema import AnimationTable, Keys
from illuminant.object_schema import Box, Disc, MeshTable, Move, Object, Rectangle, Rotation, Sphere
from illuminant.quantities import QUANTITIES
from illuminant.spectrum_schema import SpectrumTable, SpectrumValue
from illuminant.table import Crop, Fraction, Number, Positive, Range, Size, Table, Vector, key
from illuminant.texture_schema import (
    ColourValue,
    HeightValue,
    NormalImage,
    SlopeValue,
)

__all__ = [
    "KINDS_OF_ATMOSPHERE",
    "KINDS_OF_LIGHT",
    "KINDS_OF_MATERIAL",
    "MAX_PIXELS",
    "AnimationTable",
    "Box",
    "Camera",
    "CameraMove",
    "Coated",
    "Conductor",
    "Dielectric",
    "Diffuse",
    "Directional",
    "Disc",
    "Emitter",
    "Environment",
    "Filter",
    "Keys",
    "Medium",
    "MeshTable",
    "Move",
    "Named",
    "Object",
    "Point",
    "Rectangle",
    "Render",
    "Rotation",
    "SceneFile",
    "Sky",
    "SpectrumTable",
    "SpectrumValue",
    "Sphere",
    "Spot",
    "Table",
    "Translucent",
]

MAX_PIXELS = 2**26
"""The largest image, in pixels (8192 × 8192): its film with 32 lanes in f64 is 17 GB."""


def quantity(name: str, example: str) -> Any:
    """A quantity key: positive, and optional here because exactly one of those that fit is required."""
    return Field(None, gt=0, description=QUANTITIES[name], examples=[example])


Pair = Annotated[list[float], Field(min_length=2, max_length=2)]


class Quantities(Table):
    """Exactly one of the quantities that fit says how strong a source is."""

    power_w: float | None = quantity("power_w", "60.0")
    flux_lm: float | None = quantity("flux_lm", "806.0")
    intensity_cd: float | None = quantity("intensity_cd", "100.0")
    illuminance_lx: float | None = quantity("illuminance_lx", "1000.0")
    irradiance_w_m2: float | None = quantity("irradiance_w_m2", "10.0")
    luminance_cd_m2: float | None = quantity("luminance_cd_m2", "5000.0")
    radiance_scale: float | None = quantity("radiance_scale", "1.0")


class CameraMove(Table):
    """Where a camera is at the end of the time over which things move; what is not stated stays."""

    eye: Vector | None = key("position of the eye, in length units", "[0.1, 1.0, 4.0]", None)
    target: Vector | None = key(
        "a point in the middle of the image, in length units", "[0.1, 1.0, 0.0]", None
    )
    up: Vector | None = key("direction that is up in the image", "[0.0, 1.0, 0.0]", None)


class Camera(Table):
    """A perspective camera (book 1.1): the image plane is perpendicular to the direction of view."""

    eye: Vector = key("position of the eye, in length units", "[0.0, 1.0, 4.0]")
    target: Vector = key("a point in the middle of the image, in length units", "[0.0, 1.0, 0.0]")
    up: Vector | None = key(
        "direction that is up in the image; default the world's up", "[0.0, 1.0, 0.0]", None
    )
    field_of_view: Annotated[float, Field(ge=0.001, lt=180)] = key(
        "angle across the width of the image, in degrees", "40.0", 40.0
    )
    size: Size = key(
        f"width and height of the image in pixels; at most {MAX_PIXELS} pixels", "[960, 540]", [960, 540]
    )
    crop: Crop | None = key(
        "the part of the image to render: left, top, right, bottom in pixels (right and bottom excluded)",
        "[100, 50, 300, 200]",
        None,
    )
    focal_length_mm: Positive | None = key(
        "focal length of a thin lens, in millimetres (always), with `f_number`; default a pinhole: all is sharp",
        "50.0",
        None,
    )
    f_number: Positive | None = key("focal length over the diameter of the aperture", "2.8", None)
    focus_distance: Positive | None = key(
        "distance of what is sharp, along the direction of view; default that of the target", "3.0", None
    )
    blades: Annotated[int, Field(ge=3, le=64)] | None = key(
        "blades of the aperture, a regular polygon; default a circle", "7", None
    )
    blades_turned: float | None = key("how far the blades are turned, in degrees", "10.0", None)
    shutter: (
        Annotated[list[Annotated[float, Field(ge=0, le=1)]], Field(min_length=2, max_length=2)] | None
    ) = key(
        "when the shutter opens and closes, as fractions of the time over which things move; default all of it",
        "[0.0, 0.5]",
        None,
    )
    moves_to: CameraMove | None = key(
        "where the camera is at the end of that time", "{ eye = [0.1, 1.0, 4.0] }", None
    )


class Filter(Table):
    """The reconstruction filter of the film."""

    kind: Literal["gaussian", "box", "tent", "mitchell", "blackman-harris"] = key(
        "shape of the filter", '"gaussian"'
    )
    radius: Annotated[float, Field(gt=0, le=16)] | None = key(
        "radius, in pixels; default that of the kind", "1.5", None
    )


class Render(Table):
    """Defaults for the options of `illuminant render`; an option on the command line wins."""

    technique: str | None = key("how light is followed", '"path"', None)
    illumination: str | None = key("what a surface does with it", '"general"', None)
    sampling: str | None = key("how wavelengths are carried", '"fitted:8"', None)
    samples: Annotated[int, Field(ge=1, lt=2**32)] | None = key("samples of each pixel", "256", None)
    depth: Annotated[int, Field(ge=1, lt=2**16)] | None = key(
        "longest path in segments: 1 shows lamps only, 2 direct light; default no limit", "16", None
    )
    seed: Annotated[int, Field(ge=0, lt=2**63)] | None = key("seed of the random numbers", "1", None)
    sampler: Literal["sobol-owen", "random", "stratified", "jittered", "poisson-disk"] | None = key(
        "which random numbers", '"sobol-owen"', None
    )
    caustics: bool | None = key(
        "whether `path` finds from the lamps what mirrors and smooth glass make of their light", "true", None
    )
    threshold: Annotated[float, Field(ge=0, lt=1)] | None = key(
        "weight below which `raytrace` and `distributed` follow a ray no more", "0.002", None
    )
    cones: bool | None = key(
        "whether the rays of `raytrace` are cones, which see what part of them a surface covers", "true", None
    )
    light_centres: Annotated[str, Field(pattern=r"^(jittered|random|fixed:[1-9]\d{0,3})$")] | None = key(
        "where `raytrace` and `distributed` ask lamps that have an area", '"jittered"', None
    )
    ambient: Annotated[float, Field(ge=0, le=10)] | None = key(
        "ambient light of all techniques but `path`, as a fraction of what lamps would make of a white diffuser in the "
        "middle of the scene",
        "0.15",
        None,
    )
    interpolation: Literal["object", "screen"] | None = key(
        "where scanline techniques interpolate", '"object"', None
    )
    shading: Literal["full", "duff", "bishop-weimer"] | None = key(
        "how `phong` finds the illumination at a pixel: by the model, or in a fast form with eye and lamps of each "
        "polygon at infinity",
        '"full"',
        None,
    )
    shadows: Annotated[str, Field(pattern=r"^(none|rays|maps(:\d{2,5})?)$")] | None = key(
        "how scanline techniques find shadows: not at all, with rays, or in maps of so many texels",
        '"maps:1024"',
        None,
    )
    antialiasing: Literal["supersampling", "coverage"] | None = key(
        "how scanline techniques smooth edges", '"supersampling"', None
    )
    infinite: list[Literal["eye", "lights"]] | None = key(
        "what scanline techniques hold at infinity", '["eye", "lights"]', None
    )
    subdivide: Annotated[float, Field(ge=1)] | None = key(
        "area in pixels above which scanline techniques subdivide polygons", "4.0", None
    )
    elements: Annotated[int, Field(ge=1, le=4_000_000)] | None = key(
        "about how many elements `radiosity` cuts surfaces into", "20000", None
    )
    patches: Annotated[int, Field(ge=1, le=4_000_000)] | None = key(
        "about how many patches these make, which send light on; default one for each element", "2000", None
    )
    adaptive: Annotated[float, Field(gt=0, le=10)] | None = key(
        "fraction by which direct light may differ about an element before it is cut again; default never",
        "0.2",
        None,
    )
    form_factors: Annotated[str, Field(pattern=r"^(rays|hemicube|scanline|area)(:\d{1,7})?$")] | None = key(
        "how form factors are found: so many rays, a hemi-cube of so many cells along an edge by rays or scanlines, or "
        "Lambert's formula at so many places",
        '"rays:1024"',
        None,
    )
    solver: Literal["bicgstab", "gauss-seidel", "gauss", "progressive"] | None = key(
        "how radiosity is solved", '"bicgstab"', None
    )
    light_samples: Annotated[int, Field(ge=1, le=65536)] | None = key(
        "at how many places of an element each lamp is asked", "64", None
    )
    gather: Literal["none", "direct", "full"] | None = key(
        "what a pixel makes of the solution of `radiosity`: it is shown, or lamps are asked again, or a path looks "
        "around (final gather)",
        '"none"',
        None,
    )
    mechanisms: list[Literal["dd", "sd", "ds", "ss"]] | None = key(
        "ways of light that `hybrid` follows: how it arrives and how it is reflected, diffuse or specular; default all",
        '["dd", "sd"]',
        None,
    )
    frustum: Annotated[int, Field(ge=2, le=32)] | None = key(
        "rays along an edge of the frustum in which `hybrid` samples what rough surfaces mirror; default one, drawn",
        "5",
        None,
    )
    cube: Annotated[int, Field(ge=4, le=256)] | None = key(
        "cells along an edge of the cubes into which each patch of `specular-radiosity` sends light",
        "50",
        None,
    )
    exposure: Positive | None = key("factor from luminance in cd/m² to the display's 0 to 1", "0.01", None)
    filter: Filter | None = key("reconstruction filter", '{ kind = "gaussian", radius = 1.5 }', None)


BUMP = key(
    "image or pattern of heights that perturb the normal",
    '{ image = "images/dents.png", height = 0.001 }',
    None,
)
NORMAL_MAP = key("image of normals that perturb the normal", '{ image = "images/normals.png" }', None)


COEFFICIENTS = key(
    "what historical models are told instead of what the rule derives: a table for each model by its name, or `all`",
    "{ phong = { diffuse = 0.35, specular = 0.95, exponent = 330.0 } }",
    None,
)


class Diffuse(Table):
    """A surface that scatters light equally in all directions (Lambert)."""

    kind: Literal["diffuse"] = key("the kind of material", '"diffuse"')
    reflectance: ColourValue = key(
        "fraction of light reflected, 0 to 1, or an image of it", '"ColorChecker/dark skin"'
    )
    bump: HeightValue | None = BUMP
    normal_map: NormalImage | None = NORMAL_MAP
    coefficients: dict[str, Any] | None = COEFFICIENTS


# The keys of a relief, which stand in every rough material.
Height = Annotated[float, Field(ge=0, le=1e6)]
ROUGHNESS_ACROSS = key(
    "the same across the grain, where it differs; `roughness` is then along the grain", "0.3", None
)
SIGMA_NM = key(
    "root mean square height of the relief, in nm, of which part of the light stays coherent; default far above a "
    "wavelength",
    "150.0",
    None,
)
GRAIN = key(
    "direction in the world along which the grain runs, for `roughness_across`", "[1.0, 0.0, 0.0]", None
)
DISTRIBUTION = key("distribution of slopes: Gaussian, or with long tails", '"ggx"', "beckmann")
FINISH = key(
    "a finish by name instead of the keys above, such as circular mill, polished, satin",
    '"circular mill"',
    None,
)


class Conductor(Table):
    """A metal, from its measured index of refraction n and extinction k; `metal`, or `n` and `k`."""

    kind: Literal["conductor"] = key("the kind of material", '"conductor"')
    metal: str | None = key("name of a metal of the library, whose n and k are used", '"gold"', None)
    n: SpectrumValue | None = key("index of refraction", '"copper.n"', None)
    k: SpectrumValue | None = key("extinction coefficient", '"copper.k"', None)
    roughness: SlopeValue = key(
        "slope of the microfacets, Beckmann's m = 2σ/τ, or GGX's α, or an image of it; 0 is a mirror",
        "0.2",
        0.0,
    )
    roughness_across: Fraction | None = ROUGHNESS_ACROSS
    sigma_nm: Height | None = SIGMA_NM
    grain: Vector | None = GRAIN
    distribution: Literal["beckmann", "ggx"] = DISTRIBUTION
    finish: str | None = FINISH
    bump: HeightValue | None = BUMP
    normal_map: NormalImage | None = NORMAL_MAP
    coefficients: dict[str, Any] | None = COEFFICIENTS


class Dielectric(Table):
    """Glass, water, a gem: light is reflected and refracted at its surface; `medium`, or `n`."""

    kind: Literal["dielectric"] = key("the kind of material", '"dielectric"')
    medium: str | None = key("name of a medium of the library, whose n is used", '"BK7"', None)
    n: SpectrumValue | None = key("index of refraction", "1.5", None)
    roughness: SlopeValue = key("slope of the microfacets, as of a conductor; 0 is smooth", "0.1", 0.0)
    roughness_across: Fraction | None = ROUGHNESS_ACROSS
    sigma_nm: Height | None = SIGMA_NM
    grain: Vector | None = GRAIN
    distribution: Literal["beckmann", "ggx"] = DISTRIBUTION
    finish: str | None = FINISH
    bump: HeightValue | None = BUMP
    normal_map: NormalImage | None = NORMAL_MAP
    coefficients: dict[str, Any] | None = COEFFICIENTS
    absorption: SpectrumValue | None = key(
        "absorption coefficient of the inside, in 1/m (always, whatever `length_unit` is); default none",
        "{ wavelengths_nm = [380.0, 780.0], values = [2.0, 0.5] }",
        None,
    )
    dispersion: bool = key(
        "whether n changes with wavelength (false: its value at 589.3 nm is used)", "false", True
    )
    priority: Annotated[int, Field(ge=0, le=255)] = key(
        "of bodies that overlap, that of the highest priority is there, so that what touches needs no common boundary",
        "1",
        0,
    )


class Coated(Table):
    """A dielectric vehicle over a pigment or metal: paint, plastic, glaze, varnish, metal flake.

    The vehicle reflects at its surface; what enters is scattered by the pigment (`pigment`, or `reflectance` of the
    finished paint) or reflected by metal (`metal`), and returns through the surface. Paint and plastic have a pigment;
    lacquered metal has `metal` with a coverage of 1; metal flake has both.
    """

    kind: Literal["coated"] = key("the kind of material", '"coated"')
    medium: str | None = key("name of a medium of the library, whose n the vehicle has", '"water"', None)
    n: SpectrumValue | None = key("index of refraction of the vehicle; default 1.5", "1.5", None)
    roughness: SlopeValue = key(
        "slope of the facets of its surface, or an image of it; 0 is gloss", "0.1", 0.0
    )
    roughness_across: Fraction | None = ROUGHNESS_ACROSS
    sigma_nm: Height | None = SIGMA_NM
    grain: Vector | None = GRAIN
    distribution: Literal["beckmann", "ggx"] = DISTRIBUTION
    finish: str | None = FINISH
    bump: HeightValue | None = BUMP
    normal_map: NormalImage | None = NORMAL_MAP
    coefficients: dict[str, Any] | None = COEFFICIENTS
    pigment: ColourValue | None = key(
        "reflectance of the pigment for diffuse light in the vehicle, 0 to 1, or an image of it", "0.8", None
    )
    reflectance: ColourValue | None = key(
        "measured reflectance of the finished paint, surface included, 0 to 1, or an image of it, instead of "
        "`pigment` (Saunderson)",
        '"ColorChecker/red"',
        None,
    )
    absorption: SpectrumValue | None = key(
        "absorption coefficient of the vehicle, in 1/m; default none", "3000.0", None
    )
    thickness: Annotated[float, Field(ge=0, le=1e9)] | None = key(
        "thickness of the vehicle, in length units; goes with `absorption`", "0.0001", None
    )
    metal: str | None = key("name of a metal of the library, in the vehicle or under it", '"copper"', None)
    metal_roughness: Fraction = key("slope of its facets, and of how flakes lie", "0.15", 0.1)
    coverage: Fraction = key("fraction of the area that the metal covers; 1 is a sheet", "0.4", 1.0)


class Named(Table):
    """A material as people know it: a metal, glass, paint, plastic or lacquer with a finish, in words."""

    kind: Literal["named"] = key("the kind of material", '"named"')
    name: str = key("what it is, then its finish, after a comma", '"copper, circular mill"')
    coefficients: dict[str, Any] | None = COEFFICIENTS


class ThinFilter(Table):
    """A thin filter, such as a gel before a lamp: it absorbs, and neither reflects nor bends light.

    Light passes straight through, once for each sheet. Lamps of a size are seen through it; points and parallel light
    are hidden by it.
    """

    kind: Literal["filter"] = key("the kind of material", '"filter"')
    transmittance: ColourValue = key("fraction of light let through, 0 to 1, or an image of it", '"gels.csv"')
    coefficients: dict[str, Any] | None = COEFFICIENTS


class Translucent(Table):
    """A thin sheet that scatters light on both sides (Lambert): paper, a lampshade, opal acrylic, a blind.

    `reflectance` and `transmittance` add up to at most 1 at every wavelength; the rest is absorbed. An image of the
    reflectance leaves the transmittance as it is, and counts up to 1 − transmittance.
    """

    kind: Literal["translucent"] = key("the kind of material", '"translucent"')
    reflectance: ColourValue = key(
        "fraction of light scattered back to its own side, 0 to 1, or an image of it", "0.55"
    )
    transmittance: SpectrumValue = key("fraction of light scattered to the other side, 0 to 1", "0.35")
    bump: HeightValue | None = BUMP
    normal_map: NormalImage | None = NORMAL_MAP
    coefficients: dict[str, Any] | None = COEFFICIENTS


class Emitter(Quantities):
    """A surface that shines, with the same radiance in all directions unless it says otherwise, and reflects diffusely.

    Exactly one quantity; `power_w` and `flux_lm` are for each object that has the material.
    """

    kind: Literal["emitter"] = key("the kind of material", '"emitter"')
    spectrum: SpectrumValue = key("spectrum of the light", '"A"')
    cosine_power: Annotated[float, Field(ge=0, le=1000)] | None = key(
        "intensity falls as this power of the cosine of the angle from the normal; 1 is a diffuse surface, the default",
        "2.0",
        None,
    )
    distribution: Annotated[list[Pair], Field(min_length=2, max_length=10000)] | None = key(
        "intensity at angles from the normal: pairs of degrees (from 0 up) and a value to any scale, linear between",
        "[[0.0, 100.0], [30.0, 80.0], [60.0, 10.0], [90.0, 0.0]]",
        None,
    )
    sides: Literal["front", "both"] = key(
        "the sides that shine; front is where the normal points", '"both"', "front"
    )
    reflectance: SpectrumValue | None = key("fraction of light reflected; default 0", "0.78", None)
    coefficients: dict[str, Any] | None = COEFFICIENTS


class Point(Quantities):
    """A lamp without size that shines equally in all directions, or as a luminaire's measured distribution says."""

    kind: Literal["point"] = key("the kind of light", '"point"')
    position: Vector = key("position, in length units", "[0.0, 2.0, 0.0]")
    axis: Vector | None = key(
        "direction of the axis of `cosine_power` or `distribution`, away from the lamp; default down",
        "[0.0, -1.0, 0.0]",
        None,
    )
    cosine_power: Annotated[float, Field(ge=0, le=1000)] | None = key(
        "intensity falls as this power of the cosine of the angle from the axis", "2.0", None
    )
    distribution: Annotated[list[Pair], Field(min_length=2, max_length=10000)] | None = key(
        "intensity at angles from the axis: pairs of degrees (from 0 up) and a value to any scale, linear between",
        "[[0.0, 100.0], [30.0, 80.0], [60.0, 10.0], [90.0, 0.0]]",
        None,
    )
    photometry: str | None = key(
        "IES (LM-63, types A, B and C) or EULUMDAT (.ldt) file of the luminaire, which also says how much light it "
        "gives unless a quantity does; `axis` is its γ = 0, and C = 0 lies along x (along z for an axis along x)",
        '"downlight.ies"',
        None,
    )
    turn_deg: Number = key("turn of the luminaire about `axis`, in degrees, right-handed", "90.0", 0.0)
    spectrum: SpectrumValue = key("spectrum of the light", '"LED-B3"')


class Spot(Quantities):
    """A lamp without size that shines in a cone."""

    kind: Literal["spot"] = key("the kind of light", '"spot"')
    position: Vector = key("position, in length units", "[0.0, 2.0, 0.0]")
    direction: Vector = key("direction of its axis, away from the lamp", "[0.0, -1.0, 0.0]")
    half_angle_deg: Annotated[float, Field(gt=0, le=90)] = key(
        "angle from the axis to the edge of the cone", "25.0"
    )
    penumbra_deg: Annotated[float, Field(ge=0, le=90)] = key(
        "width of the soft edge, inside the cone; at most the half angle", "5.0", 0.0
    )
    spectrum: SpectrumValue = key("spectrum of the light", '"A"')


class Directional(Quantities):
    """Light from far away, such as the sun: parallel rays."""

    kind: Literal["directional"] = key("the kind of light", '"directional"')
    direction: Vector = key("direction in which the light travels", "[-1.0, -2.0, -1.0]")
    spectrum: SpectrumValue = key("spectrum of the light", '"D65"')


class Environment(Quantities):
    """Light from all around: the same from everywhere (`spectrum`), or an `image`.

    The top row of the image is the zenith; its middle column lies along -z in a y-up world and along +y in a z-up one,
    and the columns to its right towards +x.
    """

    kind: Literal["environment"] = key("the kind of light", '"environment"')
    spectrum: SpectrumValue | None = key(
        "spectrum of the light; with an image that of RGB (1, 1, 1), by default the white of `rgb_system`",
        '"D65"',
        None,
    )
    image: Any = key(
        "image of the surroundings (HDR, EXR; PNG and JPEG are decoded from sRGB), beside the scene file; its RGB is "
        "made light by upsampling",
        '"images/studio.exr"',
        None,
    )
    layout: Literal["latlong", "cube", "sphere"] | None = key(
        "how the image shows the surroundings: by latitude and longitude (default), as the faces of a cube in a row "
        "or a cross, or in a mirrored ball; see `illuminant.panoramas`",
        '"cube"',
        None,
    )
    rgb_system: str | None = key('RGB system of the image; default "sRGB"', '"ACES AP1"', None)
    up: Literal["y", "z"] | None = key("axis of the top of the image; default the scene's `up`", '"z"', None)
    rotation_deg: Number = key(
        "turn of the image about that axis, anticlockwise seen from the zenith, in degrees", "90.0", 0.0
    )


class Sky(Table):
    """The clear sky and the sun in it, by the spectral model of Hošek and Wilkie (2012, 2013), in its absolute units.

    Below the horizon there is nothing. The sun is a disc of 0.51°, and a lamp of its own: `NAME sun`.
    """

    kind: Literal["sky"] = key("the kind of light", '"sky"')
    elevation_deg: Annotated[float, Field(ge=0, le=90)] = key(
        "how high the sun stands above the horizon, in degrees", "35.0"
    )
    azimuth_deg: Number = key(
        "where it stands, in degrees clockwise seen from above: from -z towards +x in a y-up world, from +y towards +x "
        "in a z-up one",
        "120.0",
        0.0,
    )
    turbidity: Annotated[float, Field(ge=1, le=10)] = key(
        "how hazy the air is: 2 very clear, 3 clear, 6 warm and moist, 10 hazy", "2.5", 3.0
    )
    ground_albedo: Annotated[float, Field(ge=0, le=1)] = key(
        "what the ground around reflects back to the sky", "0.3", 0.2
    )
    sun: bool = key("whether the disc of the sun is seen and shines", "false", True)
    up: Literal["y", "z"] | None = key(
        "axis that points to the zenith; default the scene's `up`", '"z"', None
    )


class Fog(Quantities):
    """Fog that what is seen fades into, linearly from `start` to `end` (book eq 4.10).

    Distances are from the eye; beyond `end`, and where nothing is met, the fog alone is seen. Exactly one quantity.
    """

    kind: Literal["fog"] = key("the kind of atmosphere", '"fog"')
    start: Annotated[float, Field(ge=0)] = key("where fading begins, in length units", "2.0", 0.0)
    end: Positive = key("where nothing but the fog is seen, in length units", "20.0")
    spectrum: SpectrumValue = key("spectrum of the fog's light", '"D65"')


class Distance(Table):
    """Radiance that falls as a power of the distance to the eye: (unit / distance)^power.

    A power of 1 is Warnock's (1969), 2 and 4 are Romney's (1969). What surrounds the scene has no distance.
    """

    kind: Literal["distance"] = key("the kind of atmosphere", '"distance"')
    power: Annotated[float, Field(gt=0, le=16)] = key("exponent", "2.0", 1.0)
    unit: Positive = key("distance at which nothing is lost or gained, in length units", "3.0", 1.0)


class Medium(Table):
    """What is in the air: particles and gas that absorb and scatter light, everywhere or in a box.

    `path` follows the light in it, with all scattering; bodies of glass keep it out. Other techniques do not see it.
    """

    absorption: SpectrumValue | None = key("absorption coefficient, in 1/m (always)", "0.02", None)
    scattering: SpectrumValue | None = key(
        "scattering coefficient, in 1/m (always)",
        "{ wavelengths_nm = [380.0, 780.0], values = [0.4, 0.03] }",
        None,
    )
    phase: Literal["henyey-greenberg", "rayleigh"] = key(
        "how scattered light is spread: by its mean cosine, or as by particles much smaller than a wavelength",
        '"rayleigh"',
        "henyey-greenberg",
    )
    mean_cosine: Annotated[float, Field(gt=-1, lt=1)] | None = key(
        "of `henyey-greenberg`: above 0 forwards, 0 evenly", "0.6", None
    )
    box: Box | None = key(
        "where it is; default everywhere", "{ min = [-2.0, 0.0, -2.0], max = [2.0, 3.0, 2.0] }", None
    )
    density: Any = key(
        "what both coefficients are multiplied by over the box: a NumPy file (.npy) of a number for each cell along "
        "x, y and z",
        '"smoke.npy"',
        None,
    )


MaterialValue = Diffuse | Conductor | Dielectric | Coated | Named | ThinFilter | Translucent | Emitter
LightValue = Point | Spot | Directional | Environment | Sky

KINDS_OF_MATERIAL: dict[str, type[Table]] = {
    "diffuse": Diffuse,
    "conductor": Conductor,
    "dielectric": Dielectric,
    "coated": Coated,
    "named": Named,
    "filter": ThinFilter,
    "translucent": Translucent,
    "emitter": Emitter,
}
KINDS_OF_LIGHT: dict[str, type[Table]] = {
    "point": Point,
    "spot": Spot,
    "directional": Directional,
    "environment": Environment,
    "sky": Sky,
}

KINDS_OF_ATMOSPHERE: dict[str, type[Table]] = {"fog": Fog, "distance": Distance}


class SceneFile(Table):
    """The top of the file."""

    title: str = key("what the scene shows", '"Three metals under a lamp"', "")
    length_unit: Literal["m", "cm", "mm", "in", "ft"] = key("unit of all lengths in the file", '"mm"', "m")
    up: Literal["y", "z"] = key("axis of the world that is up", '"z"', "y")
    range_nm: Range = key(
        "first and last wavelength that light is carried at, in whole nm", "[360.0, 830.0]", [380.0, 780.0]
    )
    camera: Camera = key("where the image is taken from", "")
    render: Render = key("defaults of the options of `illuminant render`", "", Render())
    spectra: dict[str, SpectrumValue] = key("spectra by name", '{ paint = "ColorChecker/red" }', {})
    materials: dict[str, MaterialValue] = key("materials by name", "", {})
    objects: dict[str, Object] = key("objects by name", "", {})
    lights: dict[str, LightValue] = key("lights by name", "", {})
    atmosphere: Fog | Distance | None = key("what becomes of light on its way to the eye", "", None)
    medium: Medium | None = key("what is in the air", "", None)
    animation: AnimationTable | None = key("what moves and changes", "", None)
