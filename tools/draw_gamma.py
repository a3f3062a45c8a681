"""Draw the plots of docs/gamma.md: `python tools/draw_gamma.py` writes them into docs/images."""

from __future__ import annotations

from pathlib import Path

from PIL import Image

from illuminant import plots
from illuminant.display.gamma.drift import study
from illuminant.display.gamma.fitting import fit_gamma
from illuminant.display.gamma.readings import Measured, read_readings
from illuminant.plots import banding_sheet, gamma_curves, gamma_drift

DOCS = Path(__file__).parent.parent / "docs"
DPI = 96
"""Pixels per inch: about 800 pixels across a page."""


def readings() -> dict[str, Measured]:
    """Those of the page, between the lines that hold a file."""
    import re
    import tempfile

    text = (DOCS / "gamma.md").read_text(encoding="utf-8")
    found = re.search(r"^```text crt\.csv\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    assert found, "gamma.md has no readings"
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "crt.csv"
        path.write_text(found[1], encoding="utf-8")
        return read_readings(path)


def main() -> None:
    """Draw them all."""
    read = readings()
    fits = {name: fit_gamma(*column, "offset") for name, column in read.items()}
    figures = {
        "gamma-response.png": gamma_curves.response_and_correction(2.2),
        "gamma-fit.png": gamma_curves.fitted(read, fits),
        "gamma-drift.png": gamma_drift.drift(study()),
        "gamma-brightness.png": gamma_curves.perceived(),
        "gamma-steps.png": banding_sheet.staircase((8, 10)),
    }
    for name, figure in figures.items():
        figure.set_dpi(DPI)
        path = DOCS / "images" / name
        plots.save(figure, path)
        # 256 colours are enough for lines, and make the file less than half as large.
        Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)
    # Its pixels are code values, and stay as they are.
    plots.save(banding_sheet.sheet(size=230), DOCS / "images" / "gamma-banding.png")


if __name__ == "__main__":
    main()
