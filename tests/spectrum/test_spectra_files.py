"""Spectra from files: every form that is read, and a broken file of every kind, matched on line and sentence."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from illuminant import spectra
from illuminant.errors import DataError, Error


@pytest.fixture
def write(tmp_path):
    def write(content, name="curve.csv"):
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    return write


# --- what is read -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "content",
    [
        "400,0.5\n500,1\n",
        "400 0.5\n500 1",
        "400\t0.5\n500\t1\n",
        "  400   0.5  \r\n\r\n  500   1.0E+00\r\n",
        "400 0.5\r500 1\r",
        "wavelength_nm,value\n400, 0.5\n500, 1\n",
        '"nm","power"\n"400","0.5"\n"500","1"\n',
        "Wavelength (nm)   Relative power\n400 0.5\n500 1\n",
        "\ufeff# a comment\n; another\n400 0.5 # the first\n500 1\n",
        "# instrument at 20 \xb0C\n400 0.5\n500 1\n".encode("latin-1"),
        "+4.0e2 .5\n500. 1\n",
    ],
)
def test_forms_that_are_read(write, content):
    curve = spectra.read(write(content))
    assert curve.wavelengths_nm == (400.0, 500.0)
    assert curve.values == (0.5, 1.0)
    assert (curve.name, curve.outside, curve.unit, curve.quantity) == ("curve", "hold", "1", "")


def test_header_lines_are_heeded_and_arguments_win(write):
    path = write("# name: lamp\n# Quantity: Emission\n# unit: W nm-1\n# source: me\n400,1\n500,2\n")
    curve = spectra.read(path)
    assert (curve.name, curve.quantity, curve.unit, curve.provenance) == ("lamp", "emission", "W nm-1", "me")
    assert curve.outside == "zero"
    curve = spectra.read(path, name="mine", quantity="n", outside="error")
    assert (curve.name, curve.quantity, curve.outside) == ("mine", "n", "error")


def test_a_file_without_a_source_is_its_own_provenance(write):
    path = write("400,1\n500,2\n")
    assert spectra.read(path).provenance == str(path)


def test_a_column_by_name(write):
    path = write("wavelength_nm,patch 1,patch 2\n400,0.1,0.2\n500,0.3,0.4\n")
    assert spectra.read(path, column="Patch_2").values == (0.2, 0.4)
    with pytest.raises(DataError, match="no column 'patch 3'; expected 'patch 1' or 'patch 2'"):
        spectra.read(path, column="patch 3")


def test_columns_named_by_numbers(write):
    path = write("wavelength,1,2\n400,0.1,0.2\n500,0.3,0.4\n")
    assert spectra.read(path, column="2").values == (0.2, 0.4)


def test_n_and_k_may_have_any_sign(write):
    path = write("400,-0.5\n500,1.5\n")
    assert spectra.read(path, quantity="k").values == (-0.5, 1.5)
    assert spectra.read(path, quantity="n").outside == "hold"


increasing = st.lists(st.floats(1e-3, 1e6), min_size=2, max_size=40, unique=True).map(sorted)


@settings(max_examples=60, deadline=None)
@given(
    wavelengths=increasing.filter(lambda nm: nm[-1] >= 20),
    data=st.data(),
    separator=st.sampled_from([",", " ", "\t", ", "]),
    head=st.sampled_from(["", "# comment\n", "; comment\n\n", "wavelength_nm,value\n", "nm value\n"]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
)
def test_what_is_written_is_read(tmp_path_factory, wavelengths, data, separator, head, end):
    values = data.draw(st.lists(st.floats(0, 1e300), min_size=len(wavelengths), max_size=len(wavelengths)))
    rows = "".join(f"{nm!r}{separator}{value!r}\n" for nm, value in zip(wavelengths, values, strict=True))
    path = tmp_path_factory.mktemp("round") / "curve.txt"
    path.write_bytes((head + rows).replace("\n", end).encode())
    curve = spectra.read(path)
    assert curve.wavelengths_nm == tuple(wavelengths)
    assert curve.values == tuple(values)


@settings(max_examples=200, deadline=None)
@given(
    content=st.one_of(st.binary(max_size=80), st.text("0123456789.,; -e#\n\tn", max_size=80).map(str.encode))
)
def test_anything_is_read_or_refused_in_one_sentence(tmp_path_factory, content):
    path = tmp_path_factory.mktemp("any") / "curve.txt"
    path.write_bytes(content)
    refused = None
    try:
        spectra.read(path)
    except DataError as error:
        refused = error
    assert refused is None or (refused.file == str(path) and "\n" not in refused.message)


# --- what is refused ----------------------------------------------------------------------------------------

BROKEN = {
    "out of order": (
        "400,0.1\n500,0.2\n450,0.3\n",
        3,
        "wavelength 450 nm comes after 500 nm; expected increasing wavelengths",
    ),
    "repeated wavelength": (
        "# c\n400,0.1\n400,0.2\n500,0.3\n",
        3,
        "wavelength 400 nm twice; expected increasing wavelengths",
    ),
    "one point": ("nm,power\n400,0.1\n", 2, "only one point; expected at least two"),
    "NaN": ("400,0.1\n500,nan\n", 2, "value nan at 500 nm; expected a finite number"),
    "infinite": ("400,0.1\n500,1e999\n", 2, "value inf at 500 nm; expected a finite number"),
    "NaN wavelength": ("nan,0.1\n500,0.2\n", 1, "wavelength nan; expected a finite number of nm"),
    "wavelength below zero": ("-400,0.1\n500,0.2\n", 1, "wavelength -400 nm; expected one above zero"),
    "negative": (
        "400,0.1\n500,-0.002\n600,0.3\n",
        2,
        "value -0.002 at 500 nm; expected a spectrum (other than of n or k) that is not negative",
    ),
    "negative emission": (
        "# quantity: emission\n400,0.1\n500,-1\n",
        3,
        "value -1 at 500 nm; expected an emission that is not negative",
    ),
    "percent": (
        "# quantity: reflectance\n400,4\n500,31\n",
        2,
        "value 4 at 400 nm; expected a reflectance from 0 to 1; are these percent?",
    ),
    "no number": ("400,0.1\n500,abc\n", 2, "expected a number in column 2, found 'abc'"),
    "mistyped first row": ("4OO,0.1\n500,0.2\n", 1, "expected a wavelength in nm, found '4OO'"),
    "two headers": ("nm,power\nnm,power\n400,1\n", 2, "expected a wavelength in nm, found 'nm'"),
    "words later": ("400,0.1\nend of file\n", 2, "expected a wavelength in nm, found 'end'"),
    "empty field": ("400,0.1\n500,\n", 2, "expected a number in column 2, found nothing"),
    "semicolons": (
        "400;0.1\n500;0.2\n",
        1,
        "expected a wavelength in nm, found '400;0.1' (separate numbers by a comma, a tab or blanks)",
    ),
    "python number": ("400,1_0\n500,2\n", 1, "expected a number in column 2, found '1_0'"),
    "one column": ("400\n500\n", 1, "1 number; expected 2 (a wavelength and a value)"),
    "ragged": ("400,1\n500,1,2\n", 2, "3 numbers; expected 2 (a wavelength and a value)"),
    "three columns": (
        "nm,x,y\n400,1,2\n500,1,2\n",
        2,
        "3 columns (x, y); expected two, a wavelength and a value, or a choice of column",
    ),
    "decimal commas": (
        "400,5,0,1\n500,5,0,2\n",
        1,
        "4 columns; expected two, a wavelength and a value, or a choice of column",
    ),
    "micrometres": (
        "# n of glass\n0.4,1.53\n0.7,1.51\n",
        2,
        "wavelengths from 0.4 to 0.7 look like micrometres; expected nm",
    ),
    "empty": ("", 0, "no data; expected at least two lines with a wavelength and a value"),
    "comments only": (
        "# nothing\n; here\n",
        0,
        "no data; expected at least two lines with a wavelength and a value",
    ),
    "header only": ("nm,power\n", 0, "no data; expected at least two lines with a wavelength and a value"),
    "binary": (
        b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR",
        0,
        "is a binary file; expected text with a wavelength and a value on each line",
    ),
    "UTF-16": ("400,1\n500,2\n".encode("utf-16"), 0, "is text in UTF-16; expected UTF-8"),
    "rule outside": (
        "# a lamp\n# outside: mirror\n400,1\n500,2\n",
        2,
        "outside is 'mirror'; expected 'zero', 'hold' or 'error'",
    ),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_names_its_line(write, kind):
    content, line, message = BROKEN[kind]
    path = write(content)
    with pytest.raises(DataError) as caught:
        spectra.read(path)
    assert caught.value.line == line
    assert caught.value.message == message
    assert str(caught.value) == (f"{path}:{line}: {message}" if line else f"{path}: {message}")
    assert isinstance(caught.value, Error | ValueError)


def test_a_file_that_is_too_large(write):
    path = write(b"400,1\n" * (spectra.MAX_BYTES // 6 + 1))
    with pytest.raises(DataError, match="is larger than 10 MB; expected a spectrum as text"):
        spectra.read(path)


def test_files_that_are_none(tmp_path):
    with pytest.raises(DataError, match=r"none\.csv: there is no such file"):
        spectra.read(tmp_path / "none.csv")
    with pytest.raises(DataError, match="is a folder; expected a spectrum file"):
        spectra.read(tmp_path)
    with pytest.raises(DataError, match="cannot be read"):
        spectra.read(tmp_path / "a\0b")
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(DataError, match="is a pipe, and only regular files are read"):
        spectra.read(tmp_path / "pipe")
