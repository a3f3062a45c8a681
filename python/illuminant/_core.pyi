"""The compiled core: what crates/python offers. Descriptions cross as JSON, numbers as NumPy arrays.

Bad input is a ValueError with one sentence, trouble with the machine a RuntimeError. Long calls let go of the
interpreter. Users find all of this under friendlier names in the modules of the package.
"""

from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias, TypedDict

import numpy as np
from numpy.typing import NDArray

__version__: str

class TomlError(ValueError):
    """Text that is no TOML; `args` are the message, the line and the column, both from 1."""

class _RgbSystem(TypedDict):
    name: str
    primaries: list[list[float]]
    white: list[float]
    transfer: str
    to_xyz: list[list[float]]
    from_xyz: list[list[float]]

def parse_toml(text: str) -> tuple[dict[str, Any], dict[tuple[str | int, ...], int]]:
    """The data of a TOML text, and the line (from 1) of every key path in it."""

def load_embree(path: str) -> str:
    """Loads Embree 4.4 or a later 4.x from a file, once, and returns its version."""

def planck(wavelengths_nm: NDArray[np.float64], temperature_k: float) -> NDArray[np.float64]:
    """Spectral radiance of a blackbody, W·sr⁻¹·m⁻²·nm⁻¹ (Planck 1900)."""

def daylight(wavelengths_nm: NDArray[np.float64], cct_k: float) -> NDArray[np.float64]:
    """Relative power of CIE daylight, 1 at 560 nm, for a colour temperature of 4,000–25,000 K (CIE 15:2018)."""

def observers() -> list[str]:
    """The names of the observers, the default first."""

def matching_functions(wavelengths_nm: NDArray[np.float64], observer: str) -> NDArray[np.float64]:
    """x̄, ȳ and z̄ of an observer at any wavelengths, (n, 3); straight lines between its points, zero outside."""

def xyz(
    wavelengths_nm: Sequence[float] | NDArray[np.float64],
    values: Sequence[float] | NDArray[np.float64],
    outside: str,
    range_nm: Sequence[int] = ...,
    observer: str = ...,
) -> NDArray[np.float64]:
    """683 lm/W times the 1 nm sums of a curve with an observer's functions; `outside` is 'zero' or 'hold'."""

_Points: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64]]
_Curve: TypeAlias = tuple[Sequence[float] | NDArray[np.float64], Sequence[float] | NDArray[np.float64], str]
_Made: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64], str]

def curve_sum(a: _Curve, b: _Curve) -> _Made:
    """Sum of two curves, exact at every wavelength. A curve is its wavelengths, values and rule outside."""

def curve_difference(a: _Curve, b: _Curve) -> _Made:
    """First curve minus the second; may be negative."""

def curve_product(a: _Curve, b: _Curve) -> _Made:
    """Product of two curves, exact at their points and at every whole nm."""

def curve_area(curve: _Curve, range_nm: Sequence[int]) -> float:
    """Sum of a curve at every whole nm of a range."""

def curve_normalised(curve: _Curve, wavelength_nm: float, value: float) -> _Made:
    """A curve times what makes it `value` at a wavelength."""

def curve_between(curve: _Curve, first_nm: float, last_nm: float) -> _Made:
    """The part of a curve from one wavelength to another, with points at both."""

def curve_resampled(
    curve: _Curve,
    wavelengths_nm: Sequence[float] | NDArray[np.float64],
    interpolation: str,
    extrapolation: str,
) -> _Made:
    """A curve on other wavelengths; how it runs between and beyond its points (spectrum.INTERPOLATIONS, ...)."""

def curve_pseudo_color(curve: _Curve, band_nm: Sequence[float], visible_nm: Sequence[float]) -> _Made:
    """A curve whose band is shifted and stretched onto visible wavelengths (book III.8)."""

def correlated_color_temperature(xy: Sequence[float], observer: str) -> tuple[float, float]:
    """Temperature (K) of the nearest blackbody in (u, v) of 1960, and Duv (CIE 15:2018)."""

def dominant_wavelength(
    xy: Sequence[float], white: Sequence[float], observer: str
) -> tuple[float, bool, float, list[float]]:
    """Dominant wavelength (nm), whether it is the complementary one, excitation purity, and x, y of the boundary."""

def rendering_index(
    wavelengths_nm: Sequence[float] | NDArray[np.float64],
    values: Sequence[float] | NDArray[np.float64],
    outside: str,
    step_nm: int,
) -> tuple[float, list[float], float, float, float]:
    """R_a, R_1 to R_14, CCT (K), Duv, and the distance from the reference in (u, v) of 1960 (CIE 13.3-1995)."""

def fidelity_index(
    lamp: _Curve, samples: Sequence[_Curve], step_nm: int
) -> tuple[float, list[float], float, float]:
    """R_f, the index of each sample, CCT (K) and Duv (CIE 224:2017)."""

def metamer(
    reflectance: _Curve,
    lamp: _Curve,
    observer: str,
    range_nm: Sequence[int],
    seed: int,
    distance: float | None,
) -> tuple[_Points, float, float]:
    """Wavelengths and values of a reflectance of the same colour, its distance, and the largest for this seed."""

def fundamental(reflectance: _Curve, lamp: _Curve, observer: str, range_nm: Sequence[int]) -> _Points:
    """Wavelengths and values of the part of a reflectance that makes its colour (Cohen and Kappauf 1982)."""

def rgb_systems() -> list[str]:
    """The names of the RGB systems."""

def rgb_system(name: str) -> _RgbSystem:
    """Primaries, white, transfer and matrices of an RGB system."""

def rgb_system_of(
    name: str, primaries: Sequence[Sequence[float]], white: Sequence[float], transfer: str
) -> _RgbSystem:
    """An RGB system from x, y of its primaries and white; transfer: 'sRGB', 'Rec.709', 'linear', 'gamma 2.2'."""

def published_matrices() -> list[str]:
    """The names of the matrices that standards print."""

def published_matrix(name: str) -> list[list[float]]:
    """A matrix as its standard prints it, as rows."""

def matrix_product(second: Sequence[Sequence[float]], first: Sequence[Sequence[float]]) -> list[list[float]]:
    """The matrix that does `first`, and then `second`."""

def matrix_inverse(rows: Sequence[Sequence[float]]) -> list[list[float]]:
    """The inverse of a 3×3 matrix; a singular one is a ValueError that says in which column."""

def adaptation_matrix(
    method: str, white_from: Sequence[float], white_to: Sequence[float]
) -> list[list[float]]:
    """XYZ under one white to XYZ under another; method: 'von Kries', 'Bradford', 'CAT16'."""

class Conversion:
    """A conversion of three values to three others: one step of `convert`."""

    @staticmethod
    def matrix(rows: Sequence[Sequence[float]]) -> Conversion:
        """The product with a 3×3 matrix."""
    @staticmethod
    def encode(transfer: str) -> Conversion:
        """Linear values to code values."""
    @staticmethod
    def decode(transfer: str) -> Conversion:
        """Code values to linear values."""
    @staticmethod
    def xyz_to_lab(white: Sequence[float], form: str) -> Conversion:
        """XYZ to L*a*b* beside a white; form: 'CIE' or 'book'."""
    @staticmethod
    def lab_to_xyz(white: Sequence[float], form: str) -> Conversion:
        """L*a*b* to XYZ."""
    @staticmethod
    def xyz_to_luv(white: Sequence[float], form: str) -> Conversion:
        """XYZ to L*u*v* beside a white; form: 'CIE' or 'book'."""
    @staticmethod
    def luv_to_xyz(white: Sequence[float], form: str) -> Conversion:
        """L*u*v* to XYZ."""
    @staticmethod
    def rgb_to_hsl(solid: str) -> Conversion:
        """RGB to HSL; solid: 'double hexcone', 'double cone', 'cylinder'."""
    @staticmethod
    def hsl_to_rgb(solid: str) -> Conversion:
        """HSL to RGB."""
    @staticmethod
    def named(name: str) -> Conversion:
        """One without parameters: xyz_to_xyy, xyy_to_xyz, xyz_to_uvy, uvy_to_xyz, project, rgb_to_hsv, hsv_to_rgb,
        rgb_to_yiq, yiq_to_rgb, xyz_to_ac1c2, ac1c2_to_xyz."""

def convert(
    chain: Sequence[Conversion],
    values: NDArray[np.float64] | NDArray[np.float32],
    out: NDArray[np.float64] | NDArray[np.float32],
) -> None:
    """A chain of conversions over (..., 3) into `out`, which is `values` itself or does not overlap it; both lie in
    one piece and have one type."""

def difference(
    formula: str,
    first: NDArray[np.float64] | NDArray[np.float32],
    second: NDArray[np.float64] | NDArray[np.float32],
    out: NDArray[np.float64] | NDArray[np.float32],
) -> None:
    """Colour differences of (..., 3) into `out` (...); formula: '1976', '1994 graphic arts', '1994 textiles', '2000'.

    Either input may be a single colour, for all of the other."""

def xyz_to_lab(xyz: NDArray[np.float64], white: Sequence[float] | NDArray[np.float64]) -> NDArray[np.float64]:
    """CIE 1976 L*a*b* of XYZ beside a white in the same unit; any shape (..., 3)."""

def delta_e_2000(lab_a: NDArray[np.float64], lab_b: NDArray[np.float64]) -> NDArray[np.float64]:
    """CIEDE2000 between two arrays of L*a*b* of one shape (..., 3)."""

class SpectralWeights:
    """Weights from the bands of a spectrum to XYZ."""

    def __init__(
        self,
        bands_nm: Sequence[float],
        observer: tuple[Sequence[float] | NDArray[np.float64], NDArray[np.float64]],
        illuminant: tuple[Sequence[float], Sequence[float], str] | None,
        range_nm: Sequence[float],
        outside: str,
        interpolation: str,
        scale: str,
    ) -> None:
        """Weights for n bands. The observer is wavelengths (m,) and a table (m, 3); the illuminant wavelengths, values
        and 'zero' or 'hold'; interpolation 'linear' or 'none'; scale 'relative' or 'absolute'."""
    @property
    def rows(self) -> list[list[float]]:
        """The weights of X, Y and Z, n each."""
    def xyz(
        self,
        spectra: NDArray[np.float64] | NDArray[np.float32],
        out: NDArray[np.float64] | NDArray[np.float32],
    ) -> None:
        """XYZ of spectra (..., n) into `out` (..., 3), which has the same type."""

def upsample_albedo(
    rgb: Sequence[float], system: str, range_nm: Sequence[int] = ...
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Wavelengths and values of a smooth reflectance of colour `rgb` in [0, 1], and the ΔE00 of its round trip."""

def upsample_emission(
    rgb: Sequence[float], system: str, range_nm: Sequence[int] = ...
) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Wavelengths and values of an emission of colour `rgb`; RGB (1, 1, 1) is the system's white with Y = 1."""

def sampling_names() -> list[tuple[str, str]]:
    """Every form of the name of a spectral sampling, with what it means."""

def sampling_error(
    sampling: str,
    lamps: Sequence[_Curve],
    fitted_on: Sequence[_Curve],
    judged_on: Sequence[_Curve],
    depth: int,
    most_fitted: int,
    most_judged: int,
    seed: int,
    range_nm: Sequence[int],
) -> dict[str, Any]:
    """ΔE00 of a sampling against 1 nm on the products of up to `depth` reflectances under lamps.

    Curves are (wavelengths, values, 'zero' or 'hold'). A fitted sampling sees at most `most_fitted` products of
    `fitted_on` for each lamp; it is judged on at most `most_judged` of `judged_on`. Gives `wavelengths_nm`, and
    `by_lamp` for each lamp the number of `products` and the errors `exposed` and `lit` to half the white: mean,
    p95, max, and the numbers of the reflectances of the largest.
    """

class Display:
    """A display: primaries, white, the response of each channel, and the luminances of white and black in cd/m²."""

    def __new__(
        cls,
        name: str,
        primaries: Sequence[Sequence[float]],
        white: Sequence[float],
        responses: Sequence[str | Sequence[float]],
        peak: float,
        black: float,
    ) -> Display: ...
    def to_xyz_matrix(self) -> list[list[float]]:
        """The matrix from linear RGB to XYZ with Y = 1 for white."""

    def from_xyz_matrix(self) -> list[list[float]]:
        """The matrix from XYZ to linear RGB."""

    def decode(self, code: NDArray[np.float64]) -> NDArray[np.float64]:
        """Linear RGB of code values (..., 3), flat."""

    def encode(self, light: NDArray[np.float64]) -> NDArray[np.float64]:
        """Code values of linear RGB (..., 3), flat."""

    def to_xyz(self, code: NDArray[np.float64]) -> NDArray[np.float64]:
        """XYZ in cd/m² of code values (..., 3), flat."""

    def from_xyz(self, xyz: NDArray[np.float64]) -> NDArray[np.float64]:
        """Linear RGB of XYZ in cd/m² (..., 3), flat."""

    def map_gamut(self, light: NDArray[np.float64], method: str) -> NDArray[np.float64]:
        """Linear RGB (..., 3) brought into the gamut, flat."""

    def oklab(self, light: NDArray[np.float64]) -> NDArray[np.float64]:
        """L, a, b of Oklab of linear RGB (..., 3), flat."""

    def apply_tone(self, light: NDArray[np.float64], operator: str) -> NDArray[np.float64]:
        """Linear RGB (..., 3) after a tone operator, flat."""

    def develop(
        self,
        xyz: NDArray[np.float64] | NDArray[np.float32],
        *,
        exposure: float,
        reference: float,
        tone: str,
        gamut: str,
    ) -> tuple[NDArray[np.float32], dict[str, int]]:
        """Code values 0 to 1 of an image (h, w, 3), and how many pixels lay outside, by kind."""

    def show(
        self,
        xyz: NDArray[np.float64] | NDArray[np.float32],
        *,
        exposure: float,
        reference: float,
        tone: str,
        gamut: str,
        bits: int,
        dither: str,
        seed: int,
    ) -> tuple[NDArray[np.uint8] | NDArray[np.uint16], dict[str, int]]:
        """Codes of an image (h, w, 3), and how many pixels lay outside, by kind."""

def gamut_methods() -> list[str]:
    """The names of the gamut methods."""

def tone_operators() -> list[str]:
    """The names of the tone operators."""

def encode_png(
    pixels: NDArray[np.uint8] | NDArray[np.uint16],
    *,
    chromaticities: Sequence[float] | None = None,
    gamma: float | None = None,
    cicp: Sequence[int] | None = None,
    srgb: bool = False,
    icc: tuple[str, bytes] | None = None,
    significant_bits: int | None = None,
    text: Sequence[tuple[str, str]] = ...,
) -> bytes:
    """A PNG with exactly the chunks asked for; `chromaticities` are x, y of white, red, green and blue."""

def encode_icc(
    description: str,
    rights: str,
    primaries: Sequence[Sequence[float]],
    white: Sequence[float],
    curves: Sequence[tuple[str, Sequence[float]]],
    *,
    peak: float | None = None,
    cicp: Sequence[int] | None = None,
    version: int = 4,
) -> bytes:
    """An ICC profile. A curve is 'gamma' with γ, 'parametric' with g a b c d e f, 'table' with 2 to 4096 values that
    rise to 1, or 'sRGB' or 'Rec.709' with nothing; `peak` is in cd/m²."""

class _Profile(TypedDict):
    description: str
    rights: str
    version: int
    primaries: list[list[float]]
    white: list[float]
    peak: float | None
    cicp: tuple[int, int, int, int] | None
    table: NDArray[np.float64]
    curves: list[tuple[str, list[float]]]

def decode_icc(content: bytes, samples: int) -> _Profile:
    """The display that an ICC profile describes, with its own white and primaries; `table` is (3, samples)."""

def dithers() -> list[str]:
    """The names of the dithers."""

def dither(
    values: NDArray[np.float32] | NDArray[np.float64],
    bits: int,
    name: str,
    seed: int = 0,
    *,
    channels_alike: bool = False,
) -> NDArray[np.uint8] | NDArray[np.uint16]:
    """Codes of 1 to 16 bits (uint8 up to 8) of values 0..1 in an array (h, w, c), of the same shape.

    What is no number counts as 0, what lies outside 0..1 is clamped. `seed` matters to `random` only. Tiles of
    `bayer-N` and `blue-noise` are shifted from channel to channel unless `channels_alike`. A float32 array in one
    piece is not copied.
    """

def dither_thresholds(name: str) -> NDArray[np.float32] | None:
    """The tile (h, w) of thresholds of a dither that has one: code = floor(value (2^bits - 1) + threshold)."""

def patterning(
    values: NDArray[np.float32] | NDArray[np.float64], bits: int, cell: tuple[int, int], *, enlarge: bool
) -> NDArray[np.uint8] | NDArray[np.uint16]:
    """Codes of an array (h, w, c) in cells of width × height pixels.

    Every pixel becomes a cell, or, in an image of the same size, every cell shows the mean of its pixels.
    """

def patterning_turns(cell: tuple[int, int]) -> NDArray[np.uint32]:
    """When each pixel (h, w) of a cell of width × height is switched on, 0 first."""

def audit_material(
    scene: Scene,
    material: int,
    illumination: str,
    wavelengths_nm: list[float],
    angles_deg: list[float],
    draws: int,
) -> dict[str, Any]:
    """What becomes of the light that reaches a material of a scene, and by how much laws are broken."""

def chi_square_p_value(statistic: float, degrees_of_freedom: int) -> float:
    """The chance of so large a chi-square."""

def sidak_significance(significance: float, tests: int) -> float:
    """The significance of each of several tests."""

def hemisphere_directions(increments: int) -> list[tuple[list[float], float]]:
    """The directions of the book's hemispherical integrator and the solid angle of each."""

def optics(name: str, arguments: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """A function of the room optics by name, for each row of arrays of one length."""

def rough_profile(count: int, spacing: float, sigma: float, tau: float, seed: int) -> NDArray[np.float64]:
    """The heights of a rough profile."""

def copper_spheres() -> list[tuple[float, list[float], list[float]]]:
    """N_s of the copper spheres of book figure II.5, and C_Kd and C_Ks without and with a reflection map."""

def fraunhofer_lines() -> list[tuple[str, float]]:
    """The lines by which glasses are measured, in nm."""

def sellmeier(terms: list[tuple[float, float]], wavelengths_nm: list[float]) -> list[float]:
    """The index of Sellmeier's formula; NaN at a resonance."""

def cauchy(coefficients: list[float], wavelengths_nm: list[float]) -> list[float]:
    """The index of Cauchy's formula."""

class Geometry:
    """The ray structure: shapes and where they stand."""

    def __init__(
        self,
        shapes: Sequence[dict[str, Any]],
        placements: Sequence[tuple[int, NDArray[np.float64]]],
        threads: int = 0,
    ) -> None:
        """Builds it. A shape is {"kind": "mesh", "positions", "indices", "normals", "uvs"} or {"kind": "sphere",
        "center", "radius"}; a placement is the number of a shape and its transforms (keys, 3, 4) to the world."""
    @property
    def bounds(self) -> tuple[list[float], list[float]]:
        """Two corners of the box around everything."""
    @property
    def triangles(self) -> int:
        """Triangles placed, instances counted each time."""

class Scene:
    """A scene ready for rendering."""

    def __init__(self, geometry: Geometry, description: str, images: dict[str, NDArray[np.float32]]) -> None:
        """A scene from geometry, a description (JSON) and images (h, w, 3) of linear RGB."""
    @property
    def lamps(self) -> list[str]:
        """The names of the lamps."""
    def viewing_distance(self, picture_width: float) -> float:
        """From how far a picture of this width shows what the camera saw."""
    def project(self, point: Sequence[float]) -> list[float] | None:
        """Where a point of the world appears, in pixels; None behind the eye."""
    def sees_anything(self) -> bool:
        """Whether any object or surroundings lie in the camera's view."""

def pairs() -> list[tuple[str, str, Literal["sensible", "warned", "refused"], str]]:
    """Every technique with every illumination model: names, verdict, reason."""

class Cancelled(Exception):
    """A solution was cancelled."""

class Cancel:
    """Tells a solution under way that nobody waits for it any more."""

    def cancel(self) -> None:
        """Asks the work to stop; from any thread."""
    @property
    def cancelled(self) -> bool:
        """Whether it was asked to."""

class RowFinder:
    """Finds rows of form factors of `radiosity`, for work that is shared out."""

    def __init__(self, scene: Scene, settings: str) -> None:
        """Cuts the surfaces of a scene as settings (JSON) say."""
    def __len__(self) -> int:
        """How many rows there are."""
    @property
    def width(self) -> int:
        """How long they are."""
    def find(
        self, first: int, last: int
    ) -> tuple[NDArray[np.uint64], NDArray[np.uint32], NDArray[np.float32]]:
        """Rows first..last: where each begins, columns, values."""

class Solution:
    """The light between the surfaces of a scene (`illuminant.radiosity`)."""

    def __init__(
        self, scene: Scene, settings: str, cancel: Cancel | None = None, rows: dict[str, Any] | None = None
    ) -> None:
        """Solves for it, as settings (JSON) say; with all rows of form factors (`starts`, `columns`, `values`,
        `width`), if they are known. Raises `Cancelled` when it is told to stop."""
    @staticmethod
    def restored(scene: Scene, settings: str, fitted_to: Scene, parts: dict[str, Any]) -> Solution:
        """A solution from its `parts`; `fitted_to` is the scene to which its spectral samples were fitted."""
    def parts(self) -> dict[str, Any]:
        """What of it cannot be found again without much work."""
    def repainted(self, scene: Scene, settings: str, cancel: Cancel | None = None) -> Solution:
        """The solution of the same surfaces with the materials of another scene."""
    def moved(
        self, scene: Scene, settings: str, objects: list[int], cancel: Cancel | None = None
    ) -> tuple[Solution, int]:
        """The solution after objects have moved, and how many rows of form factors were found again."""
    def illuminance(
        self, scene: Scene, points: NDArray[np.float64], normals: NDArray[np.float64], samples: int
    ) -> NDArray[np.float64]:
        """XYZ of the irradiance at points that face normals, (n, 3); Y in lx."""
    def mesh(self, scene: Scene) -> dict[str, Any]:
        """The elements as a mesh, with what their sides and corners send."""
    def report(self) -> dict[str, Any]:
        """How it came about."""

class Render:
    """A render under way: runs follow each other, and the film accumulates."""

    def __init__(self, scene: Scene, settings: str, solution: Solution | None = None) -> None:
        """A render of a scene with settings (JSON), and an empty film; with light between surfaces, if it is known."""
    def again(self, scene: Scene, settings: str, solution: Solution | None = None) -> Render:
        """A render of a scene that differs in its camera, or by other settings, in the same wavelengths."""
    def solution(self) -> Solution | None:
        """The light between surfaces, if the technique has solved for it."""
    def run(
        self,
        first: int,
        last: int,
        progress: Callable[[float], object] | None = None,
        *,
        tiles: tuple[int, int] | None = None,
        from_lamps: bool = True,
    ) -> bool:
        """Renders samples first..last of every pixel, or of a range of tiles; False when `progress` returned False and
        so cancelled it. `from_lamps`: with the paths from lamps of these samples, where the settings ask for such."""
    def tiles(self) -> list[list[int]]:
        """x₀, y₀, x₁, y₁ of each tile."""
    def part(self) -> bytes:
        """All that the film holds, for `join`."""
    def join(self, part: bytes) -> None:
        """Adds what another render of the same scene with the same settings has found; all of it, or ValueError."""
    def clear(self) -> None:
        """Forgets all samples, but nothing that was prepared for them."""
    def spectral_error(self) -> dict[str, Any]:
        """ΔE00 of the spectral sampling against 1 nm in this scene: mean, p95, max, the lamp and material of the
        largest, and how many pixels were `judged`."""
    def warnings(self) -> list[str]:
        """Sentences on what to know before rendering."""
    def layers(self) -> list[str]:
        """The names of the layers."""
    def layer(self, name: str) -> NDArray[np.float64]:
        """The mean of a layer, (h, w, channels)."""
    def samples(self) -> NDArray[np.uint32]:
        """Samples that each pixel holds, (h, w)."""
    def standard_error(self) -> NDArray[np.float64]:
        """Standard error of Y from two halves, (h, w); needs replicates = 2."""
    def statistics(self) -> dict[str, Any]:
        """Seconds, samples, rays, dropped samples."""
    def wavelengths(self) -> NDArray[np.float64]:
        """The wavelength that stands for each spectral sample, nm."""
    def to_xyz(self, lamp: int = 0) -> NDArray[np.float64]:
        """The map from spectral samples to XYZ for light of a lamp, (3, N)."""
    def lamp_spectra(self) -> list[tuple[str, NDArray[np.float64], NDArray[np.float64]]]:
        """Each lamp: its name, its spectrum at each nm of the scene's range, and its light in the spectral samples."""
    def reflectances(self) -> list[NDArray[np.float64]]:
        """The reflectances of what stands in the scene at each nm of its range: each once, if it has a colour."""
    def replay(self, x: int, y: int, sample: int) -> dict[str, Any]:
        """The vertices of one path, pass by pass, and what it brought."""
    def ray_rate(self, first: int, last: int) -> dict[str, float]:
        """The queries of these samples again, without shading: their number and the seconds they take."""
