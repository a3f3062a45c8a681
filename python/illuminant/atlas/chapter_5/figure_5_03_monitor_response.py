"""Figure 5.3: the response of a monitor, intensity = code^γ (book section 5.1.2)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

GAMMAS = (2.2, 2.0, 3.0, 1.0)


def draw(quick: bool) -> Sheet:
    """γ of 2.2, the ends of the range of monitors, and a linear device; in the same axes, sRGB."""
    import numpy as np

    from illuminant.display.gamma.response import response
    from illuminant.plots.style import GREY, TODAY, line_look, new_figure

    code = np.linspace(0.0, 1.0, 256)
    curves = {f"γ = {gamma:g}": response(code, gamma) for gamma in GAMMAS}
    srgb = response(code, "sRGB")
    figure, axes = new_figure((5.2, 5.0))
    axes.plot(code, srgb, **TODAY, label="today: sRGB")
    for i, (name, curve) in enumerate(curves.items()):
        look = line_look(i) if i < 3 else {"color": GREY, "linestyle": ":"}
        axes.plot(code, curve, **look, label=name)
    axes.set(xlabel="code value", ylabel="relative intensity", xlim=(0, 1), ylim=(0, 1), aspect="equal")
    axes.grid(True)
    axes.legend(loc="upper left")
    typical = curves["γ = 2.2"]
    half = float(np.interp(0.5, code, typical))
    return Sheet(
        picture=figure,
        columns={"code value": code, **curves, "sRGB": srgb},
        checks=(
            Check("intensity at half of the code, γ = 2.2", half, at_least=0.21, at_most=0.225),
            Check("largest |sRGB − γ = 2.2|", float(np.abs(srgb - typical).max()), at_most=0.01),
            Check(
                "sRGB over γ = 2.2 at the code 8 of 255",
                float(srgb[8] / typical[8]),
                at_least=2.0,
            ),
        ),
    )


PLATE = Plate(
    number="5.3",
    title="Response of a monitor",
    shows="The luminance of a typical monitor against the value in the frame buffer, both relative: $I = v^\\gamma$, "
    "with γ = 2.2 (the NTSC signal's), 2 to 3 for monitors, and 1 for a linear device.",
    claim="A monitor with γ = 2.2 shows half of the code as little more than a fifth of the intensity.",
    today="sRGB (IEC 61966-2-1) is within 0.01 of γ = 2.2, but straight near black, where it is more than twice as "
    "bright: the two must not be mixed up in dark images.",
    draw=draw,
    commands=("illuminant gamma response --gamma 2.2 -o response.png",),
)
