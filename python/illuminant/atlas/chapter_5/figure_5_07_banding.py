"""Figure 5.7: bands of an image that is corrected for gamma at display, and before storage (book 5.1.2, eq 5.1)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

BITS = (8, 6)
GAMMA = 2.2


def draw(quick: bool) -> Sheet:
    """Shaded spheres over a dark ramp at 8 and 6 bits: a table at display, γ before storage, and dithered besides."""
    import numpy as np

    from illuminant.display import dither
    from illuminant.display.gamma.banding import COLOUR, compared, gradation, shaded_sphere
    from illuminant.display.gamma.response import correction
    from illuminant.display.gamma.storage import WAYS
    from illuminant.plots import picture_sheet
    from illuminant.plots.banding_sheet import tile

    size = 96 if quick else 288
    low = np.linspace(0.0, 0.1, size)[None, :, None] * np.asarray(COLOUR)
    image = np.concatenate([shaded_sphere(size, COLOUR), np.repeat(low, size // 6, axis=0)])
    pictures, captions = [], []
    for bits in BITS:
        for way in reversed(WAYS):
            pictures.append(tile(image, way, bits, GAMMA))
            captions.append(f"corrected {way}, {bits} bits")
        dithered = dither.quantise(correction(image, GAMMA), bits, "blue-noise")
        top = (1 << bits) - 1
        pictures.append((dithered.astype(np.float64) * (255.0 / top) + 0.5).astype(np.uint8))
        captions.append(f"before storage, blue noise, {bits} bits")

    smooth = gradation()
    rows = [
        (bits, way, found) for bits in BITS for way, found in zip(WAYS, compared(smooth, bits), strict=True)
    ]
    (before, at), (before6, at6) = (compared(smooth, bits) for bits in BITS)
    return Sheet(
        picture=picture_sheet(pictures, captions, columns=3),
        columns={
            "bits": [bits for bits, _, _ in rows],
            "corrected": [way for _, way, _ in rows],
            "colours": [found.colours for _, _, found in rows],
            "colours below 10 %": [found.low_colours for _, _, found in rows],
            "largest step, L*": [found.largest_step for _, _, found in rows],
            "largest jump of chromaticity, ΔE00": [found.largest_colour_step for _, _, found in rows],
        },
        checks=(
            Check(
                "step of L* at display over that before storage, 8 bits",
                at.largest_low_step / before.largest_low_step,
                at_least=3.0,
            ),
            Check("step of L* at display, 6 bits", at6.largest_low_step, "L*", at_least=5.0),
            Check(
                "jump of chromaticity at display over that before storage, 6 bits",
                at6.largest_colour_step / before6.largest_colour_step,
                at_least=1.5,
            ),
            Check(
                "colours before storage over those at display, 8 bits",
                before.colours / at.colours,
                at_least=1.3,
            ),
        ),
    )


PLATE = Plate(
    number="5.7",
    title="Correction for gamma before storage and at display",
    shows="A smooth gradation, stored as linear bytes and corrected by the table of $v = I^{1/\\gamma}$ at display "
    "(eq 5.1), beside one that is corrected before it is stored; γ = 2.2, at 8 bits and, so that it is seen in "
    "print, at 6. Under each sphere lies a ramp of the darkest tenth of its colour.",
    claim="Correction at display makes dark steps of lightness at least three times as large as correction before "
    "storage with the same 8 bits, and jumps of hue besides, since red, green and blue step at different "
    "places.",
    today="Every picture is corrected before it is stored, and a dither of blue noise can break up what steps "
    "remain: in the third column even 6 bits show no band. The largest dark step of 8 bits falls from 2.2 to "
    "0.4 in L*.",
    draw=draw,
    commands=(
        "illuminant gamma banding -o banding.png",
        "illuminant display room.exr room.png --dither blue-noise",
    ),
)
