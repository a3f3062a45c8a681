"""Figure 3.10: the RGB cube of an NTSC monitor in L*a*b* and L*u*v* (book eqs 3.4 and 3.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.atlas.plate import Check, Plate, Sheet

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

MONITOR = "book NTSC"
CORNERS = ("black", "red", "green", "blue", "yellow", "magenta", "cyan", "white")
STEPS = 33

ASIDE = {
    "K": (4.0, 12.0),
    "B": (0.0, 9.0),
    "u* M": (2.0, -9.0),
    "a K": (0.0, 16.0),
    "a B": (10.0, -6.0),
    "a R": (7.0, -7.0),
}
"""Where letters stand beside their corners, in points, seen from the side where an edge is in the way."""


def edges() -> tuple[list[str], Array]:
    """The twelve edges of the cube: from which corner to which, and linear RGB (12, STEPS, 3) along each."""
    import numpy as np

    corners = np.array(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 0, 1], [0, 1, 1], [1, 1, 1]], np.float64
    )
    names, lines = [], []
    for i, start in enumerate(corners):
        for j, end in enumerate(corners):
            if np.sum(end - start) == 1 and np.abs(end - start).sum() == 1:
                names.append(f"{CORNERS[i]} to {CORNERS[j]}")
                lines.append(start + (end - start) * np.linspace(0, 1, STEPS)[:, None] ** 2)
    return names, np.array(lines)


def mixtures() -> Array:
    """Linear RGB (3, 50, 3) from each primary almost to white, by mixing with white light."""
    import numpy as np

    share = np.linspace(0.0, 0.98, 50)[:, None]
    return np.eye(3)[:, None] * (1 - share) + share


def hue_bend(found: Array) -> float:
    """The largest change of hue, degrees, along lines (..., n, 3) of a lightness and two opponent axes."""
    import numpy as np

    hue = np.unwrap(np.arctan2(found[..., 2], found[..., 1]))
    return float(np.degrees(np.ptp(hue, axis=-1).max()))


def draw(quick: bool) -> Sheet:
    """The cube's edges from above and from the side; dotted, mixtures of its primaries with white."""
    import numpy as np
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from illuminant import color
    from illuminant.color.uniform import Form
    from illuminant.display import displays
    from illuminant.plots.style import DPI, GREY, PRINTED

    system, monitor = color.system(MONITOR), displays.named(MONITOR)

    def lab(rgb: Array, form: Form = "CIE") -> Array:
        return np.asarray(color.xyz_to_lab(color.rgb_to_xyz(rgb, system), system.white, form=form))

    def luv(rgb: Array, form: Form = "CIE") -> Array:
        return np.asarray(color.xyz_to_luv(color.rgb_to_xyz(rgb, system), system.white, form=form))

    def oklab(rgb: Array) -> Array:
        return np.asarray(monitor.oklab(rgb)) * 100.0

    names, lines = edges()
    codes = np.asarray(color.rgb_to_rgb(lines, system, "sRGB")).clip(0.0, 1.0)
    codes = np.asarray(color.encode(codes, "sRGB"))
    # White would vanish on white paper.
    codes = np.minimum(codes, 0.88)
    figure = Figure(figsize=(9.0, 6.0), dpi=DPI, layout="constrained", facecolor="white")
    panels = figure.subplots(2, 3, height_ratios=(1.35, 1.0))
    spaces = (
        ("L*a*b* (eq 3.4)", ("L*", "a*", "b*"), lab),
        ("L*u*v* (eq 3.5)", ("L*", "u*", "v*"), luv),
        ("today: Oklab × 100", ("L", "a", "b"), oklab),
    )
    as_printed = {spaces[0][1]: lab, spaces[1][1]: luv}
    columns: dict[str, Any] = {"edge": np.repeat(names, STEPS).tolist()}
    columns |= {f"linear {name}": lines[..., i].ravel() for i, name in enumerate("RGB")}
    bends = []
    for column, (title, labels, space) in enumerate(spaces):
        found, mixed = space(lines), space(mixtures())
        bends.append(hue_bend(mixed))
        for row, up in enumerate((2, 0)):
            axes = panels[row, column]
            points = found[..., [1, up]]
            pieces = np.stack([points[:, :-1], points[:, 1:]], axis=2).reshape(-1, 2, 2)
            axes.add_collection(
                LineCollection(list(pieces), colors=codes[:, 1:].reshape(-1, 3), linewidths=2.2)
            )
            if row == 0:
                for line in mixed:
                    axes.plot(line[:, 1], line[:, 2], color=GREY, linestyle=":", linewidth=1.3)
            elif printed_form := as_printed.get(labels):
                printed = printed_form(lines, "book")
                for name, line, colours in zip(names, printed, codes, strict=True):
                    if name.startswith("black"):
                        axes.plot(line[:, 1], line[:, 0], color=colours[-1], **PRINTED)
            axes.margins(0.1)
            axes.autoscale_view()
            axes.set(xlabel=labels[1], ylabel=labels[up])
            axes.grid(True)
            if row == 0:
                axes.set_title(title)
                axes.set_aspect("equal", adjustable="datalim")
            for letter, corner in zip("KRGBYMCW", CORNERS, strict=True):
                if row == 0 and corner in ("black", "white"):
                    continue
                edge = next(
                    i for i, name in enumerate(names) if name.startswith(corner) or name.endswith(corner)
                )
                end = found[edge, 0 if names[edge].startswith(corner) else -1]
                outward = np.array([end[1], end[up] - (0.0 if row == 0 else 50.0)])
                outward = 9.0 * outward / np.linalg.norm(outward)
                shift = (float(outward[0]), float(outward[1]))
                if row == 1:
                    shift = ASIDE.get(f"{labels[1]} {letter}", ASIDE.get(letter, shift))
                axes.annotate(
                    letter,
                    (end[1], end[up]),
                    shift,
                    textcoords="offset points",
                    ha="center",
                    va="center",
                    fontsize=8,
                )
        columns |= {
            f"{name} of {title.split(' (')[0].removeprefix('today: ').split(' ×')[0]}": found[..., i].ravel()
            for i, name in enumerate(labels)
        }
    entries = [
        Line2D([], [], color=GREY, linestyle=":", linewidth=1.3),
        Line2D([], [], color=GREY, **PRINTED),
    ]
    words = ["primaries mixed with white", "from black, L* as printed"]
    figure.legend(entries, words, loc="outside lower center", ncols=2)
    white = lab(np.ones(3))
    return Sheet(
        picture=figure,
        columns=columns,
        checks=(
            Check("largest change of hue towards white, L*u*v*", bends[1], "°", at_most=1e-6),
            Check("the same, L*a*b*", bends[0], "°", at_least=10.0),
            Check("the same, Oklab", bends[2], "°", at_least=10.0),
            Check(
                "L* of white by eq 3.4 as printed, less 100",
                float(lab(np.ones(3), "book")[0] - white[0]),
                "",
                0.03,
                0.05,
            ),
        ),
    )


PLATE = Plate(
    number="3.10",
    title="RGB colour cube in L*a*b* and L*u*v*",
    shows="The twelve edges of the RGB cube of a monitor with NTSC phosphors and a white of D6500 (book section "
    "5.1.1), linear along each edge, in L*a*b* (eq 3.4) and L*u*v* (eq 3.5) beside the monitor's white: from above "
    "and from the side. Letters name the corners (K black, W white); dotted are mixtures of the primaries with white.",
    claim="Neither space keeps the cube, nor do they agree on hue: a primary that is mixed with white keeps its hue "
    "exactly in L*u*v*, and changes it by more than 10° in L*a*b*.",
    printed="Eqs 3.4 and 3.5 give L* as $25 (100 Y/Y_o)^{1/3} - 16$, an older form: white has 100.04, and black −16 "
    "where the CIE's straight part ends at 0; where L* is negative, u* and v* change sign (dashed).",
    today="Differences are judged by CIEDE2000 on L*a*b*; where a hue is to be kept, as when colours are brought into "
    "a gamut, Oklab (Ottosson 2020) is fitted to what eyes call one hue. Blue, which bends by 30° there when mixed "
    "with white, shows how much: eyes see it turn purple (Abney 1909).",
    draw=draw,
    commands=("illuminant gamut deviation -o deviation.png",),
)
