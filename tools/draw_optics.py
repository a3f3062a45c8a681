"""Draw the plots of docs/optics.md: `python tools/draw_optics.py` writes them into docs/images."""

from __future__ import annotations

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot

from illuminant import auditing
from illuminant.atlas.chapter_2.reflected_energy import HEIGHTS_NM, coherent, equilibrium, incoherent

IMAGES = Path(__file__).parent.parent / "docs" / "images"

ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 84.0, 87.0, 89.0)


def balance() -> None:
    """Sections of book figure 2.21, as the atlas computes them, beside the balance of `general`."""
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 4), sharey=True, layout="constrained")
    for ax, m in zip(axes, (0.1, 1.0), strict=True):
        scattered = np.stack([incoherent(angle, m, HEIGHTS_NM) for angle in ANGLES], axis=1)
        for sigma, part, colour in zip(
            HEIGHTS_NM, scattered, ("tab:blue", "tab:orange", "tab:green"), strict=True
        ):
            ax.plot(ANGLES, coherent(ANGLES, sigma, m) + part, "--", color=colour)
            ax.plot(
                ANGLES, equilibrium(m, sigma, ANGLES, 50_000).total, color=colour, label=f"σ = {sigma:g} nm"
            )
        ax.axhline(1.0, color="black", linewidth=0.5)
        ax.set(title=f"m = {m:g}", xlabel="angle of incidence, degrees", ylim=(0, 1.25))
    axes[0].set_ylabel("reflected with F = 1 at 580 nm")
    axes[0].legend(title="solid: general; dashed: the theory", fontsize="small")
    figure.savefig(IMAGES / "optics-balance.png", dpi=90)


def colour() -> None:
    """What multiple scattering does to copper."""
    figure, ax = pyplot.subplots(figsize=(6.4, 4), layout="constrained")
    wavelengths = list(range(400, 701, 20))
    for m in (0.1, 0.5, 1.0):
        copper = {"kind": "conductor", "metal": "copper", "roughness": m}
        found = auditing.audit(copper, angles_deg=[30.0], wavelengths_nm=wavelengths, draws=50_000)[0]
        ax.plot(wavelengths, found.scattered_reflection[0], label=f"m = {m:g}")
    ax.set(xlabel="wavelength, nm", ylabel="reflectance of copper at 30°", ylim=(0, 1))
    ax.legend()
    figure.savefig(IMAGES / "optics-copper.png", dpi=90)


def glass() -> None:
    """What of the light ground glass lets through coherently, by height."""
    figure, ax = pyplot.subplots(figsize=(6.4, 4), layout="constrained")
    heights = (*range(0, 200, 20), *range(200, 500, 50), 600, 800)
    shares = []
    for sigma in heights:
        ground = {"kind": "dielectric", "n": 1.5, "roughness": 0.2, "sigma_nm": sigma}
        found = auditing.audit(ground, angles_deg=[0.0], wavelengths_nm=[550.0], draws=50_000)[0]
        parts = (
            "coherent_reflection",
            "scattered_reflection",
            "coherent_transmission",
            "scattered_transmission",
        )
        shares.append([float(getattr(found, part)[0, 0]) for part in parts])
    names = ("mirrored", "reflected diffusely", "clear", "haze")
    ax.stackplot(heights, np.array(shares).T, labels=names)
    ax.set(xlabel="σ, nm", ylabel="share of power at 550 nm, normal incidence", ylim=(0, 1), xlim=(0, 800))
    ax.legend(loc="center right")
    figure.savefig(IMAGES / "optics-glass.png", dpi=90)


if __name__ == "__main__":
    balance()
    colour()
    glass()
