"""Figure 3.11: box functions that sample and rebuild spectra, for 4 samples (Hall 1983; book 3.5.2)."""

from __future__ import annotations

import itertools

from illuminant.atlas.plate import Check, Plate, Sheet

COUNT = 4
RANGE_NM = (380, 780)
CURVE = "ColorChecker/orange"


def draw(quick: bool) -> Sheet:
    """The sampling functions, the reconstruction functions, and a reflectance sampled and built again."""
    import numpy as np

    from illuminant import sampling, spectra
    from illuminant.plots.sketch import new_sketches
    from illuminant.plots.style import INK, TODAY, line_look

    products = 300 if quick else 3000
    boxes, fitted = sampling.compare(
        [f"hall:{COUNT}:even", f"fitted:{COUNT}"], ["D65"], products=products, range_nm=RANGE_NM
    )
    # A box from a to b (b not in it) has its sample in the middle, (a + b − 1)/2.
    bounds = [float(RANGE_NM[0])]
    for middle in boxes.wavelengths_nm["D65"]:
        bounds.append(2.0 * middle + 1.0 - bounds[-1])
    wavelengths = np.arange(RANGE_NM[0] - 20.0, RANGE_NM[1] + 21.0)
    inner = np.array(bounds[1:-1])
    box = np.searchsorted(inner, wavelengths, side="right")
    sampled = [(wavelengths >= a) & (wavelengths < b) for a, b in itertools.pairwise(bounds)]
    heights = [1.0 / one.sum() for one in sampled]
    curve = np.asarray(spectra.load(CURVE).at(wavelengths))
    means = np.array([curve[one].mean() for one in sampled])
    rebuilt = means[box]
    flat = np.array([np.full_like(curve, 0.6)[one].mean() for one in sampled])[box]

    figure, axes = new_sketches((7.4, 5.6), 1, 3)
    for k in range(COUNT):
        first, last = bounds[k : k + 2]
        outline = [first, first, last, last], [0.0, heights[k], heights[k], 0.0]
        axes[0].plot(*outline, **line_look(k), label=f"sample {k + 1}")
        # The first and the last go on beyond the visible.
        ends = (first if k else wavelengths[0], last if k < COUNT - 1 else wavelengths[-1])
        axes[1].plot(ends, (1.0, 1.0), **line_look(k))
    axes[0].set(ylabel="sampling, 1/nm", ylim=(0, 1.5 * max(heights)))
    axes[0].legend(ncols=4, loc="upper center")
    axes[1].set(ylabel="reconstruction", ylim=(0, 1.3))
    axes[2].plot(wavelengths, curve, color=INK, linewidth=1.0, label=CURVE.replace("/", ", "))
    axes[2].step(wavelengths, rebuilt, **line_look(1), where="post", label="sampled and built again")
    points = np.array(fitted.wavelengths_nm["D65"])
    dots = TODAY | {"linestyle": "", "marker": "o", "markersize": 6.0}
    axes[2].plot(points, spectra.load(CURVE).at(points), **dots, label=f"today: fitted:{COUNT} samples here")
    axes[2].set(ylabel="reflectance", xlabel="wavelength, nm", ylim=(0, 0.9))
    axes[2].legend(loc="center left", bbox_to_anchor=(0.0, 0.68))
    for k, (first, last) in enumerate(itertools.pairwise(bounds)):
        axes[0].text(
            (first + last) / 2, 0.5 * heights[k], f"{first:.0f} to {last:.0f} nm", ha="center", fontsize=8
        )
    for panel in axes:
        panel.set_xlim(wavelengths[0], wavelengths[-1])
        for bound in bounds:
            panel.axvline(bound, color="#c9c9c9", linewidth=0.6, zorder=0)
    areas = [height * one.sum() for height, one in zip(heights, sampled, strict=True)]
    error, today = boxes.by_lamp["D65"], fitted.by_lamp["D65"]
    return Sheet(
        picture=figure,
        columns={
            "wavelength, nm": wavelengths,
            **{f"sampling {k + 1}, 1/nm": np.where(one, heights[k], 0.0) for k, one in enumerate(sampled)},
            **{f"reconstruction {k + 1}": (box == k).astype(float) for k in range(COUNT)},
            CURVE: curve,
            "built again": rebuilt,
        },
        checks=(
            Check(
                "area of each sampling function, largest difference from 1",
                float(np.abs(np.array(areas) - 1).max()),
                at_most=1e-12,
            ),
            Check("error of a flat curve built again", float(np.abs(flat - 0.6).max()), at_most=1e-12),
            Check(
                "mean ΔE00 of products by boxes over that of as many fitted samples",
                error.mean / today.mean,
                at_least=2.0,
            ),
        ),
    )


PLATE = Plate(
    number="3.11",
    title="Box functions for four samples",
    shows="Above the sampling functions, of area 1, side by side and without gaps from $\\lambda_{n,s}$ to "
    "$\\lambda_{n,e}$; in the middle the reconstruction functions, of height 1, whose first and last go on beyond the "
    "visible; below a reflectance that was sampled and built again. The boxes are of one width here; the book "
    "moves their bounds by search.",
    claim="A flat curve is sampled and built again exactly; any other becomes steps, and products of reflectances "
    "under D65 come out at least twice as wrong as with four fitted samples.",
    today="`fitted:N` chooses wavelengths and weights for the lamps and materials of a scene; `hall:N` is this method "
    "with the bounds searched, `hall:N:even` with boxes of one width.",
    draw=draw,
    commands=("illuminant spectra compare --help",),
)
