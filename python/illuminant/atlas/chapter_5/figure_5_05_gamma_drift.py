"""Figure 5.5: the colours of the ColorChecker through corrections of a wrong gamma (book section 5.1.2).

A correction for γ' on a monitor of γ shows linear^(γ/γ') of each primary; 0 and 1 stay.
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Traces of the 24 chromaticities for γ' from 1.4 to 3.0 on a monitor of 2.2; difference and contrast beside."""
    import numpy as np

    from illuminant.display.gamma.drift import shown, study
    from illuminant.plots import gamma_drift

    found = study()
    figure = gamma_drift.drift(found)
    saturation = np.nanmean(found.saturation, axis=1)
    place = {float(gamma): i for i, gamma in enumerate(found.gammas)}
    # The book's example: (0, 127, 255), whose green alone moves.
    green = {gamma: float(shown(127 / 255, gamma, found.monitor_gamma)) for gamma in (1.8, 2.6)}
    count = len(found.gammas)
    return Sheet(
        picture=figure,
        columns={
            "γ' of the correction": np.repeat(found.gammas, 24),
            "patch": list(found.names) * count,
            "x": found.xy[..., 0].ravel(),
            "y": found.xy[..., 1].ravel(),
            "ΔE00": found.difference.ravel(),
            "saturation over that of the right display": found.saturation.ravel(),
            "contrast over that of the right display": np.repeat(found.contrast, 24),
        },
        checks=(
            Check("mean saturation with γ' = 2.6", float(saturation[place[2.6]]), at_most=0.95),
            Check("mean saturation with γ' = 1.8", float(saturation[place[1.8]]), at_least=1.05),
            Check(
                "largest |contrast − γ/γ'|",
                float(np.abs(found.contrast - found.monitor_gamma / found.gammas).max()),
                at_most=0.02,
            ),
            Check(
                "green of (0, 127, 255) with γ' = 2.6 over that with 1.8",
                green[2.6] / green[1.8],
                at_least=1.2,
            ),
        ),
    )


PLATE = Plate(
    number="5.5",
    title="Shift of chromaticity with gamma",
    shows="The 24 colours of the ColorChecker on a monitor with NTSC primaries and γ = 2.2, corrected for γ' from 1.4 "
    "to 3.0: traces in the xy diagram, black points where the colours belong; beside, the difference and the contrast.",
    claim="With γ' too high colours lose saturation and contrast, with γ' too low they run to the primaries and gain "
    "contrast, which is γ/γ'.",
    today="The loss has a number: ΔE00, where a γ' of 2.6 in place of 2.2 costs more than 4 in the mean. Pictures "
    "carry the curve for which they were made, so no one has to guess it.",
    draw=draw,
    commands=(
        "illuminant gamma drift -o drift.png",
        'illuminant gamma remap old.png new.png --from "book NTSC" --to sRGB',
    ),
)
