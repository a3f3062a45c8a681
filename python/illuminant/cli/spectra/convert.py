"""`illuminant spectra convert`: a spectrum to a file, resampled and scaled when asked for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from illuminant.cli.spectra.argument import Column, FileQuantity
from illuminant.cli.words import numbers

if TYPE_CHECKING:
    from illuminant.spectra import MaterialFile, Quantity, Spectrum

__all__ = ["convert", "regridded", "scaled"]


def convert(
    first: Annotated[
        str | None,
        typer.Argument(metavar="IN", help="A name or a file; none with --rgb.", show_default=False),
    ] = None,
    second: Annotated[
        str | None,
        typer.Argument(metavar="OUT", help="The .csv, .spd or .mat to write.", show_default=False),
    ] = None,
    wavelengths: Annotated[
        str | None,
        typer.Option("--range", metavar="A-B", help="Wavelengths to keep, nm.", show_default=False),
    ] = None,
    step: Annotated[
        float | None,
        typer.Option("--step", metavar="NM", help="Resample to this distance.", show_default=False),
    ] = None,
    interpolation: Annotated[
        str | None,
        typer.Option(
            "--interpolation",
            metavar="NAME",
            help="Between samples: linear, pchip, cubic or sprague.",
            show_default=False,
        ),
    ] = None,
    normalise: Annotated[
        float | None,
        typer.Option("--normalise", metavar="NM", help="Make the curve 1 there.", show_default=False),
    ] = None,
    scale: Annotated[
        float | None,
        typer.Option("--scale", metavar="F", help="Multiply the values, after that.", show_default=False),
    ] = None,
    quantity: FileQuantity = None,
    column: Column = None,
    rgb: Annotated[
        str | None,
        typer.Option(
            "--rgb",
            metavar="R,G,B",
            help="In place of IN: a smooth curve of this colour.",
            show_default=False,
        ),
    ] = None,
    role: Annotated[
        str | None,
        typer.Option("--role", metavar="NAME", help="What --rgb is: albedo or emission.", show_default=False),
    ] = None,
    system: Annotated[
        str | None,
        typer.Option("--system", metavar="NAME", help="RGB system of --rgb: sRGB.", show_default=False),
    ] = None,
) -> None:
    """Write a spectrum as CSV (.csv), in two columns (.spd), or as a material file of the book (.mat).

    \b
    Example:
      illuminant spectra convert FL11 fl11.csv --range 380-780 --step 1
      illuminant spectra convert percent.txt paint.csv --scale 0.01
      illuminant spectra convert --rgb 0.8,0.2,0.1 --role albedo red.csv
    """
    from illuminant.cli.report import note, warning
    from illuminant.cli.spectra.argument import material_of, quantity_of, range_of
    from illuminant.errors import UsageError

    source, target = _two([word for word in (first, second) if word is not None], rgb)
    _check_target(target)
    if interpolation is not None and step is None:
        raise UsageError("--interpolation goes with --step.")
    spacing = None if step is None else _positive(step, "--step")
    factor = None if scale is None else _positive(scale, "--scale")
    material = None
    if rgb is None:
        _refuse({"--role": role, "--system": system}, "goes with --rgb")
        spectrum, done = _read(source, quantity, column, scaled=scale is not None or normalise is not None)
        material = material_of(source)
    else:
        _refuse({"--quantity": quantity, "--column": column}, "goes with a file, not with --rgb")
        spectrum, done = _from_rgb(rgb, role, system or "sRGB")
    spectrum, change = regridded(spectrum, range_of(wavelengths), spacing, interpolation or "linear")
    done += change
    spectrum, change = scaled(spectrum, normalise, factor, quantity_of(quantity))
    done += change
    if not _store(target, spectrum, material):
        done.append("n, k, conductor and dielectric are kept by .mat only")
    start, end = spectrum.range_nm
    note(
        "; ".join(
            [f"{target}: {spectrum.name}, {len(spectrum.values)} points from {start:g} to {end:g} nm", *done]
        )
    )
    if rgb is not None:
        warning(
            "RGB does not determine a curve, so its colour under another light is a guess: mixing it with measured "
            "curves in one scene misleads."
        )


def _refuse(options: dict[str, str | None], why: str) -> None:
    """Refuse those of the options that are given."""
    from illuminant.errors import UsageError

    for option, value in options.items():
        if value is not None:
            raise UsageError(f"{option} {why}.")


def _check_target(target: Path) -> None:
    """Refuse a file that cannot be written, before the work."""
    from illuminant import output, spectra
    from illuminant.errors import UsageError

    if not any(target.suffix.casefold() in ends for ends in spectra.FORMATS.values()):
        raise UsageError(f"{target}: expected a file that ends in .csv, .spd or .mat.")
    output.check(target)


def _two(words: list[str], rgb: str | None) -> tuple[str, Path]:
    """The input (empty with --rgb) and the output."""
    from illuminant.errors import UsageError

    wanted = 1 if rgb is not None else 2
    if len(words) != wanted:
        expected = "--rgb R,G,B" if rgb is not None else "a name or a file"
        count = f"{len(words)} argument{'' if len(words) == 1 else 's'}"
        raise UsageError(f"{count}: expected {expected}, and the file to write.")
    return ("" if rgb is not None else words[0]), Path(words[-1])


def _read(word: str, quantity: str | None, column: str | None, scaled: bool) -> tuple[Spectrum, list[str]]:
    """The spectrum to convert; what a scaled file holds is checked after the scaling, so percents can be read."""
    from dataclasses import replace

    from illuminant.cli.spectra.argument import check_file_options, load, quantity_of
    from illuminant.errors import UsageError

    check_file_options([word], quantity, column)
    spectrum = load(word, None if scaled else quantity, column)
    given = quantity_of(quantity)
    if given and spectrum.quantity not in ("", given):
        raise UsageError(f"--quantity {given}: {word} says that it holds {spectrum.quantity}.")
    if given == "emission" and not spectrum.quantity:
        spectrum = replace(spectrum, outside="zero", unit="relative")
    return spectrum, []


def _from_rgb(text: str, role: str | None, system: str) -> tuple[Spectrum, list[str]]:
    """A smooth spectrum of a colour, and how well it gives the colour back."""
    from illuminant import rgb_system, spectra
    from illuminant.errors import DataError, UsageError

    if role not in ("albedo", "emission"):
        found = f"--role {role}" if role is not None else "--rgb without --role"
        raise UsageError(f"{found}: expected --role albedo for a surface, or --role emission for light.")
    rgb = numbers(text, "--rgb", "three numbers, such as 0.8,0.2,0.1", count=3)
    name = str(rgb_system.named(system)["name"])
    make = spectra.rgb_albedo if role == "albedo" else spectra.rgb_emission
    try:
        spectrum, delta_e = make(rgb, name)
    except DataError as mistake:
        raise UsageError(f"--rgb {text}: {mistake.message}.") from None
    return spectrum, [f"round trip of the colour ΔE00 {delta_e:.2g}"]


def _positive(value: float, option: str) -> float:
    import math

    from illuminant.errors import UsageError

    if not (math.isfinite(value) and value > 0):
        raise UsageError(f"{option} {value:g}: expected a number above zero.")
    return value


def regridded(
    spectrum: Spectrum,
    range_nm: tuple[float, float] | None,
    step_nm: float | None,
    interpolation: str = "linear",
) -> tuple[Spectrum, list[str]]:
    """The curve on another range, another grid or both, and what was done, in words.

    With a range alone its samples stay, and the ends of the range are added by the straight line there, or by the
    rule outside of the curve. With a step the values are those between the samples at the new wavelengths: multiples
    of the step when there is no range, else the range from its start on.

    Args:
        spectrum: a curve.
        range_nm: first and last wavelength; None: its own.
        step_nm: distance of the new samples; None: its own samples.
        interpolation: see `Spectrum.resampled`.

    Raises:
        UsageError: fewer than two wavelengths, or more than a million, would be left; no such interpolation.
        DataError: the range is wider than the curve, whose rule outside is an error; see `Spectrum.resampled`.

    Example:
        >>> from illuminant.spectra import Spectrum
        >>> curve, done = regridded(Spectrum("ramp", [400, 500], [0, 1]), (380, 500), 40)
        >>> curve.wavelengths_nm, [round(v, 9) for v in curve.values]
        ((380.0, 420.0, 460.0, 500.0), [0.0, 0.2, 0.6, 1.0])
        >>> done
        ['resampled to 40 nm from 400-500 nm, 100 nm', 'beyond 400-500 nm the value of the nearer end']
    """
    import numpy as np

    from illuminant.errors import UsageError

    if range_nm is None and step_nm is None:
        return spectrum, []
    own = np.array(spectrum.wavelengths_nm)
    first, last = range_nm or spectrum.range_nm
    was = f"{own[0]:g}-{own[-1]:g} nm, {_spacing(own)}"
    if step_nm is None:
        found = spectrum.between(first, last)
        done = [f"cut from {was}"]
    else:
        start = first if range_nm is not None else float(np.ceil(first / step_nm - 1e-9)) * step_nm
        count = int(np.floor((last - start) / step_nm + 1e-9)) + 1
        if not 2 <= count <= 1_000_000:
            raise UsageError(f"--step {step_nm:g} leaves {count} wavelengths from {first:g} to {last:g} nm.")
        grid = np.round(start + step_nm * np.arange(count), 9)
        found = spectrum.resampled(grid, interpolation)  # type: ignore[arg-type]
        how = "" if interpolation == "linear" else f" by {interpolation}"
        done = [f"resampled{how} to {step_nm:g} nm from {was}"]
        if step_nm > 1.0001 * float(np.diff(own).min()):
            done.append("wider apart than before, so what lies between is lost")
        if range_nm is not None and grid[-1] < last - 1e-6:
            done.append(f"the last wavelength is {grid[-1]:g} nm, as the step does not reach {last:g} nm")
    if found.range_nm[0] < own[0] or found.range_nm[1] > own[-1]:
        rule = "zero" if spectrum.outside == "zero" else "the value of the nearer end"
        done.append(f"beyond {own[0]:g}-{own[-1]:g} nm {rule}")
    return found, done


def _spacing(wavelengths: object) -> str:
    """`5 nm`, or `49 points` where the distances differ."""
    import numpy as np

    own = np.asarray(wavelengths)
    steps = np.diff(own)
    return f"{steps[0]:g} nm" if np.allclose(steps, steps[0], rtol=1e-6) else f"{len(own)} points"


def scaled(
    spectrum: Spectrum, normalise_nm: float | None, factor: float | None, quantity: Quantity | None
) -> tuple[Spectrum, list[str]]:
    """The curve times factors, and what was done, in words; then it is checked to be what it is said to be.

    Args:
        spectrum: a curve.
        normalise_nm: where it becomes 1; a lamp is relative then, and a reflectance is none any more.
        factor: by which its values are multiplied, after that.
        quantity: what the values are in the end; None: what they were.

    Raises:
        UsageError: the curve is not known or not above zero at `normalise_nm`.
        DataError: the values are none of that quantity, as a reflectance above 1.

    Example:
        >>> from illuminant.spectra import Spectrum
        >>> percent = Spectrum("percent", [400, 700], [20, 50])
        >>> scaled(percent, None, 0.01, "reflectance")[0].values
        (0.2, 0.5)
    """
    from dataclasses import replace

    from illuminant.plots.spectral_curves import value_for_normalising

    done = []
    total, unit, kept = 1.0, spectrum.unit, spectrum.quantity
    if normalise_nm is not None:
        total /= value_for_normalising(spectrum, normalise_nm)
        done.append(f"normalised to 1 at {normalise_nm:g} nm")
        unit, kept = ("relative", kept) if kept == "emission" else ("1", "")
    if factor is not None:
        total *= factor
        done.append(f"scaled by {factor:g}")
    values = tuple(total * value for value in spectrum.values)
    return replace(spectrum, values=values, unit=unit, quantity=quantity or kept), done


def _store(target: Path, spectrum: Spectrum, material: MaterialFile | None) -> bool:
    """Write the file; whether it holds all that was known of the material."""
    from dataclasses import replace

    from illuminant import spectra

    if material is not None and target.suffix.casefold() in spectra.FORMATS["material"]:
        spectra.write_material(target, replace(material, curve=spectrum))
        return True
    spectra.write(target, spectrum)
    return material is None
