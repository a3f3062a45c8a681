"""The material file of the book (III.7.1): its examples, round trips, and a broken file of every kind."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from illuminant import spectra
from illuminant.errors import DataError, ImageError, UsageError
from illuminant.spectra import MaterialFile, Spectrum

GLASS = """# Material: Glass - Borosilicate Crown - 3
# Type 511/634
# Source:
# reflectance: Computed from index of refraction
# n,k: Fundamentals of Optics, Jenkins and White (1976)
# Table 23B - Refractive Indices and
# Dispersions for Several Common Types of
# Optical Glass
# Conditions: polished
# Temperature:
# Incident angle: normal
# Solid angle:
#
dielectric
# index of refraction at 589.2nm
n 1.51124
399 0.043291
434 0.042757
482 0.042178
509 0.041975
533 0.041784
589 0.041445
644 0.041178
656 0.041134
"""
COPPER = """# Material: Copper
# Source:
# reflectance: Thermophysical Properties of Matter (1970)
# v.7, p.162, curve #4 (from Cook's thesis)
# n,k: Fundamentals of Optics, Jenkins and White (1976)
# table 25A, p538 (original source R.S.Minor)
# measured at 589nm
# Conditions: as received
#   Temperature:    298 K
#   Incident angle: 9
#   Solid angle:    2pi
#
conductor
n 0.617
k 2.630
380 0.070
420 0.095
460 0.140
500 0.205
540 0.265
560 0.335
580 0.490
600 0.615
620 0.670
660 0.725
700 0.755
"""
D6500 = """#
#   Light Source:    standard CIE illuminant D6500
#   Source:
#       Judd and Wyszecki
#       Color in Business, Science, and Industry
#       table 2.1 pg.108-109
#   Notes:
#       normalized to 1.00 at 560nm
#
300 0.0003
310 0.0330
320 0.2020
330 0.3710
340 0.3990
350 0.4490
"""


@pytest.fixture
def write(tmp_path):
    def write(content, name="material.mtl"):
        path = tmp_path / name
        path.write_text(content)
        return path

    return write


def test_the_glass_of_the_book(write):
    glass = spectra.read_material(write(GLASS))
    assert (glass.conductor, glass.n, glass.k) == (False, 1.51124, None)
    assert glass.curve.quantity == "reflectance"
    assert glass.curve.name == "Glass - Borosilicate Crown - 3"
    assert glass.curve.values == spectra.load("book/crown glass").values
    assert glass.comments[1] == "Type 511/634"
    # The ends hold, as the book's reader has it (R7.22).
    assert glass.curve.at([380, 780]).tolist() == [0.043291, 0.041134]


def test_the_copper_of_the_book_under_any_name(write):
    for name in ("copper.mtl", "copper", "copper.csv"):
        copper = spectra.read_material(write(COPPER, name))
        assert (copper.conductor, copper.n, copper.k) == (True, 0.617, 2.63)
        assert copper.curve.wavelengths_nm == spectra.load("book/copper").wavelengths_nm
        # `read` wants the curve alone.
        assert spectra.read(write(COPPER, name)) == copper.curve


def test_the_light_of_the_book(write):
    path = write(D6500)
    light = spectra.read_material(path, quantity="emission")
    assert (light.conductor, light.n, light.k) == (None, None, None)
    assert (light.curve.quantity, light.curve.outside) == ("emission", "zero")
    assert light.curve.name == "standard CIE illuminant D6500"
    assert spectra.read(path).quantity == "", "nothing in the file says what it is"
    # The published D65, 1 at 560 nm.
    at = spectra.load("D65").normalised(560).at(light.curve.wavelengths_nm)
    assert light.curve.values == pytest.approx(at.tolist(), abs=6e-4)


@pytest.mark.parametrize("text", [GLASS, COPPER, D6500])
def test_what_was_read_is_written_and_read(write, tmp_path, text):
    first = spectra.read_material(write(text))
    spectra.write_material(tmp_path / "again.mtl", first)
    again = spectra.read_material(tmp_path / "again.mtl")
    assert again == first or (again.curve.values == first.curve.values and again.comments == first.comments)
    assert (again.n, again.k, again.conductor) == (first.n, first.k, first.conductor)


numbers = st.floats(-1e6, 1e6)


@given(
    points=st.dictionaries(st.floats(20, 1e5), st.floats(0, 1), min_size=2, max_size=20),
    n=st.none() | numbers,
    k=st.none() | numbers,
    conductor=st.sampled_from([None, True, False]),
    comments=st.lists(st.text("abc:# ;é,1", max_size=20).map(str.rstrip), max_size=4),
)
def test_any_material_comes_back(tmp_path_factory, points, n, k, conductor, comments):
    wavelengths = sorted(points)
    curve = Spectrum("m", wavelengths, [points[w] for w in wavelengths], quantity="reflectance")
    path = tmp_path_factory.mktemp("round") / "m.mtl"
    spectra.write_material(path, MaterialFile(curve, n, k, conductor, tuple(comments)))
    back = spectra.read_material(path, quantity="reflectance")
    assert (back.curve.wavelengths_nm, back.curve.values) == (curve.wavelengths_nm, curve.values)
    assert (back.n, back.k, back.conductor) == (n, k, conductor)
    assert len(back.comments) == len(comments)


DATA = "400 0.1\n500 0.2\n"
BROKEN = {
    "descending": ("conductor\n500 0.1\n400 0.2\n", 3, "wavelength 400 nm comes after 500 nm"),
    "repeated": ("conductor\n500 0.1\n500 0.2\n", 3, "wavelength 500 nm twice"),
    "no data": ("# only words\ndielectric\nn 1.5\n", 0, "no data; expected at least two lines"),
    "one point": ("dielectric\n500 0.1\n", 2, "only one point"),
    "unknown word first": (f"condctor\nn 0.6\n{DATA}", 1, "'condctor' means nothing in a material file"),
    "unknown word later": (f"n 0.6\ndielektric\n{DATA}", 2, "'dielektric' means nothing in a material file"),
    "only an unknown word": (f"metal\n{DATA}", 1, "'metal' means nothing in a material file"),
    "n without a number": (f"n\n{DATA}", 1, "expected a number after 'n', found nothing"),
    "n is a word": (f"n glass\n{DATA}", 1, "expected a number after 'n', found 'glass'"),
    "k is not finite": (f"k inf\n{DATA}", 1, "expected a number after 'k', found 'inf'"),
    "n twice": (f"n 1.5\nn 1.6\n{DATA}", 2, "'n' after 'n' in line 1; expected one of them once"),
    "both kinds": (f"conductor\ndielectric\n{DATA}", 2, "'dielectric' after 'conductor' in line 1"),
    "a value that is no number": ("conductor\n400 0.1\n500 high\n", 3, "expected a number in column 2"),
    "a percentage": ("conductor\n400 10\n500 20\n", 2, "are these percent?"),
    "negative": ("conductor\n400 0.1\n500 -0.2\n", 3, "a reflectance that is not negative"),
    "three columns": ("conductor\n400 0.1 1\n", 2, "3 columns; expected two"),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_is_refused_with_its_line(write, kind):
    text, line, message = BROKEN[kind]
    path = write(text)
    with pytest.raises(DataError) as caught:
        spectra.read_material(path)
    assert (caught.value.file, caught.value.line) == (str(path), line)
    assert message in caught.value.message


def test_no_such_file(tmp_path):
    with pytest.raises(DataError, match=r"none\.mtl: there is no such file"):
        spectra.read_material(tmp_path / "none.mtl")


# --- writing spectra ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["D65", "gold.k", "ColorChecker/cyan", "LED-V1", "aluminium.n"])
@pytest.mark.parametrize("end", ["csv", "spd", "txt", "mtl"])
def test_a_spectrum_of_the_library_comes_back(tmp_path, name, end):
    path = tmp_path / f"curve.{end}"
    spectra.write(path, spectra.load(name))
    assert spectra.read(path) == spectra.load(name)


@given(
    points=st.dictionaries(st.floats(20, 1e6), st.floats(0, 1e300), min_size=2, max_size=20),
    name=st.text(max_size=20),
    outside=st.sampled_from(["zero", "hold", "error"]),
    quantity=st.sampled_from(["", "emission", "n", "k"]),
    form=st.sampled_from(["csv", "spd", "material"]),
)
def test_any_spectrum_comes_back(tmp_path_factory, points, name, outside, quantity, form):
    wavelengths = sorted(points)
    curve = Spectrum(name, wavelengths, [points[w] for w in wavelengths], outside, "W", "me", quantity)
    path = tmp_path_factory.mktemp("round") / "curve"
    spectra.write(path, curve, form)
    back = spectra.read(path)
    assert (back.wavelengths_nm, back.values) == (curve.wavelengths_nm, curve.values)
    assert (back.outside, back.unit, back.provenance, back.quantity) == (outside, "W", "me", quantity)
    plain = "".join(c if c.isprintable() else " " for c in name).strip()
    assert back.name == (plain or "curve")


def test_where_a_spectrum_cannot_be_written(tmp_path):
    d65 = spectra.load("D65")
    with pytest.raises(UsageError, match=r"no format for 'lamp\.xyz': expected one of csv, spd, material"):
        spectra.write(tmp_path / "lamp.xyz", d65)
    with pytest.raises(UsageError, match="no format 'json'"):
        spectra.write(tmp_path / "lamp.csv", d65, "json")
    with pytest.raises(ImageError, match="there is no folder"):
        spectra.write(tmp_path / "none" / "lamp.csv", d65)
    assert not list(tmp_path.iterdir())
