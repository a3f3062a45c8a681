"""Make the metameric pair in `scenes/spectra/`: two paints that match under D65 and not under A.

    python tools/make_metamers.py

The first paint is a smooth warm grey. The second is the first plus a metameric black: a smooth curve which the
CIE 1931 observer does not see under D65, that is, one in the null space of the three weighted colour matching
functions (Wyszecki 1953), here spanned by cosines of up to five periods. Of all of these, the one is taken that changes
the colour under A most for its size, as large as the second paint stays between 6 % and 90 %.

It writes `metamer_a.csv` and `metamer_b.csv` (5 nm, 380 to 780 nm) and prints CIEDE2000 of the pair under D65 and A.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from illuminant import spectra
from illuminant.core import core

FOLDER = Path(__file__).resolve().parent.parent / "scenes" / "spectra"
WAVELENGTHS = np.arange(380.0, 781.0, 5.0)
FINE = np.arange(380.0, 781.0)


def tristimulus(reflectance: np.ndarray, lamp: str) -> np.ndarray:
    """XYZ of a reflectance under a lamp, Y = 1 for the perfect diffuser, integrated at 1 nm."""
    light = spectra.load(lamp).at(FINE)
    white = core().xyz(FINE, light, "zero")
    return np.array(core().xyz(FINE, np.interp(FINE, WAVELENGTHS, reflectance) * light, "zero")) / white[1]


def delta_e(a: np.ndarray, b: np.ndarray, lamp: str) -> float:
    """CIEDE2000 of two reflectances under a lamp, whose light is the white."""
    white = tristimulus(np.ones_like(WAVELENGTHS), lamp)
    lab = [core().xyz_to_lab(tristimulus(one, lamp), white) for one in (a, b)]
    return float(core().delta_e_2000(*lab))


def pair() -> tuple[np.ndarray, np.ndarray]:
    """The two reflectances."""
    x = (WAVELENGTHS - 380.0) / 400.0
    first = 0.30 + 0.10 / (1.0 + np.exp(-(WAVELENGTHS - 560.0) / 40.0))
    basis = np.cos(np.pi * np.outer(np.arange(11), x))
    under = {lamp: np.stack([tristimulus(row, lamp) for row in basis], axis=1) for lamp in ("D65", "A")}
    _, _, rows = np.linalg.svd(under["D65"])
    unseen = rows[3:]
    seen_under_a = under["A"] @ unseen.T
    roughness = np.diag(1.0 + np.arange(11.0) ** 2 / 16.0)
    weight = np.linalg.inv(np.linalg.cholesky(unseen @ roughness @ unseen.T))
    _, _, directions = np.linalg.svd(seen_under_a @ weight.T)
    black = (weight.T @ directions[0]) @ unseen @ basis
    if np.interp(650.0, WAVELENGTHS, black) < 0:
        black = -black  # the second paint turns redder
    room = np.where(black > 0, (0.90 - first) / black, (0.06 - first) / black)
    return first, first + room.min() * black


def main() -> None:
    """Write the pair, and say how it differs."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    first, second = (one.round(5) for one in pair())
    for letter, values in (("a", first), ("b", second)):
        header = [
            f"# name: metamer {letter}",
            "# quantity: reflectance",
            "# unit: 1",
            "# source: constructed: a smooth grey"
            + (" plus a metameric black of D65" if letter == "b" else ""),
            "# outside: hold",
            "# made by: tools/make_metamers.py",
            "wavelength_nm,reflectance",
        ]
        rows = [f"{w:g},{v:g}" for w, v in zip(WAVELENGTHS, values, strict=True)]
        (FOLDER / f"metamer_{letter}.csv").write_text("\n".join([*header, *rows, ""]))
    for lamp in ("D65", "A"):
        print(f"{lamp}: {delta_e(first, second, lamp):.3f}")
    print(f"second: {second.min():.3f} to {second.max():.3f}")


if __name__ == "__main__":
    main()
