"""Plots of an audit: shares of power against angle and wavelength.

Example:
    >>> from illuminant.auditing import audit
    >>> import tempfile
    >>> found = audit("gold, satin", angles_deg=(0, 60), draws=200)
    >>> [path.name for path in save(found, tempfile.mkdtemp())]
    ['gold-satin.png']
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path

from illuminant.auditing import Audit

__all__ = ["save"]

PARTS = (
    ("coherent_reflection", "coherent reflection"),
    ("scattered_reflection", "scattered reflection"),
    ("coherent_transmission", "coherent transmission"),
    ("scattered_transmission", "scattered transmission"),
    ("absorbed", "absorption"),
)


def save(found: Sequence[Audit], directory: str | os.PathLike[str]) -> list[Path]:
    """Draw one picture for each material: mean shares against angle, and those at the first angle against wavelength.

    Args:
        found: what `illuminant.audit` gave.
        directory: made if it is not there.

    Returns:
        The files.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for one in found:
        figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
        layers = [getattr(one, name) for name, _ in PARTS]
        labels = [label for _, label in PARTS]
        left.stackplot(one.angles_deg, [layer.mean(axis=1) for layer in layers], labels=labels)
        left.set(xlabel="angle of incidence, degrees", ylabel="share of power", ylim=(0, 1.05))
        left.axhline(1.0, color="black", linewidth=0.5)
        left.legend(loc="lower left", fontsize="small")
        for layer, label in zip(layers, labels, strict=True):
            right.plot(one.wavelengths_nm, layer[0], marker=".", label=label)
        right.set(xlabel="wavelength, nm", ylabel=f"share of power at {one.angles_deg[0]:g}°", ylim=(0, 1.05))
        figure.suptitle(one.material)
        path = folder / (re.sub(r"[^A-Za-z0-9]+", "-", one.material).strip("-").lower() + ".png")
        figure.savefig(path, dpi=100)
        pyplot.close(figure)
        files.append(path)
    return files
