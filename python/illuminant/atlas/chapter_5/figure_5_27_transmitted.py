"""Figure 5.27: a picture, and what is received of it through NTSC (book 5.5)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet

DECODERS = ("low-pass", "notch", "comb")


def draw(quick: bool) -> Sheet:
    """The original, and the pictures of a simple receiver, of one with a notch, and of one with a comb filter."""
    import numpy as np

    from illuminant.atlas.chapter_5.still_life import seen, still_life
    from illuminant.color import rgb_to_yiq
    from illuminant.display.video.transmission import transmit
    from illuminant.plots import picture_sheet

    values = still_life(quick)
    received = {decoder: transmit(values, decoder=decoder) for decoder in DECODERS}
    before = np.asarray(rgb_to_yiq(values))
    errors = {d: np.asarray(rgb_to_yiq(one)) - before for d, one in received.items()}
    rms = {d: np.sqrt((error**2).mean(axis=(0, 1))) for d, error in errors.items()}
    # Edges of colour in the original, and the middles of its fields.
    step = np.abs(np.diff(before[..., 1:], axis=1, append=before[:, -1:, 1:])).sum(axis=-1)
    wide = np.stack([np.roll(step, shift, axis=1) for shift in range(-6, 7)]).max(axis=0)
    edges, fields = step > 0.2, wide < 0.02
    colour = np.abs(errors["comb"][..., 1:]).sum(axis=-1)
    smear = float(colour[edges].mean() / colour[fields].mean())
    grey = np.repeat(values.mean(axis=(1, 2), keepdims=True), values.shape[1], axis=1).repeat(3, axis=2)
    # Beside the picture the signal is black, which the filters carry 2 µs into it.
    inner = slice(values.shape[1] // 12, -values.shape[1] // 12)
    plain = float(np.abs(transmit(grey, decoder="notch") - grey)[:, inner].max())
    table = {
        f"root mean square error of {axis}": [float(rms[d][k]) for d in DECODERS]
        for k, axis in enumerate("YIQ")
    }
    finer = float(rms["comb"][0] / rms["low-pass"][0])
    captions = [
        "the original",
        "received: simple set, Y to 3 MHz",
        "received: notch filter",
        "received: comb filter",
    ]
    return Sheet(
        picture=picture_sheet([seen(values), *(seen(one) for one in received.values())], captions, columns=2),
        columns={"decoder": list(DECODERS), **table},
        checks=(
            Check("error of colour at edges of colour over that in fields", smear, at_least=4.0),
            Check("error of Y with a comb over that of a simple set", finer, at_most=0.8),
            Check("largest error of rows of one grey each, notch", plain, at_most=1e-6),
        ),
    )


PLATE = Plate(
    number="5.27",
    title="A picture before and after NTSC",
    shows="The original, and what receivers make of its composite signal: encoded with bands of 4.2, 1.3 and 0.5 MHz "
    "on a subcarrier of 3.58 MHz, decoded again.",
    claim="Flat fields come back, and edges between saturated colours smear: there the error of colour is at least "
    "four times that within fields.",
    today="A comb filter, which compares lines, keeps the fineness of Y that simple sets gave up, and trades the "
    "false colours of fine detail for dots at horizontal edges; `video check` names what is in danger before "
    "it is sent.",
    draw=draw,
    commands=("illuminant video transmit room.png both.png --beside", "illuminant video check room.png"),
)
