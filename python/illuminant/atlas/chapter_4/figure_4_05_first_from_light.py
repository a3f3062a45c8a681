"""Figure 4.5: the first approximation from the light (book eq 4.5)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """What all patches have of the light alone, and how far that is from balance."""
    import numpy as np

    from illuminant.atlas.chapter_4.three_patches import draw_room, room

    found = room(120 if quick else 600)
    diffuse = found.diffuse
    balance = diffuse.solved()
    first = diffuse.from_light(1)
    ways = [("light", name) for name in ("patch 1", "patch 2", "patch 3")]
    notes = [
        f"{1e3 * one:.2f}; in balance {1e3 * whole:.2f}" for one, whole in zip(first, balance, strict=True)
    ]
    figure, _ = draw_room(first / balance.max(), ways, "straight from the light", False, notes)
    # A corner-to-corner independent number: radiosity solved with many elements, averaged over the patches.
    apart = float(np.abs(balance / found.solved - 1.0).max())
    bound = float(diffuse.exchanged.sum(axis=0).max())
    return Sheet(
        picture=figure,
        columns={
            "patch": [1, 2, 3],
            "first approximation": first,
            "in balance": balance,
            "radiosity of many elements": found.solved,
            "form factor to the light": found.form_factors[:3, 3],
        },
        checks=(
            Check(
                "largest part missing after the first step",
                float((1 - first / balance).max()),
                at_least=0.01,
                at_most=0.6,
            ),
            Check(
                "first step, patches that shine more than in balance",
                float((first > balance).sum()),
                at_most=0.0,
            ),
            Check("largest share of the others' light that a patch sends on", bound, at_most=0.99),
            Check("balance of three patches, from radiosity of many elements", apart, at_most=0.05),
        ),
    )


PLATE = Plate(
    number="4.5",
    title="First approximation from the light",
    shows="The light (intensity 1) sends to all patches; they send nothing yet: the first iteration of "
    "$I_p = \\xi_{light,p} I_{light} + \\sum_q \\xi_{q,p} I_q$ (eqs 4.5a to c) from $I_q = 0$. Grey is intensity. "
    "The coefficients are reflectances times form factors.",
    claim="One step from the light gives every patch at once what it has of the light alone, always less than in "
    "balance; as every patch sends on less than it gets, further steps must converge, to what radiosity finds.",
    today="`radiosity` solves the same equations for thousands of elements, wavelength by wavelength, with BiCGSTAB "
    "in some ten steps; three large patches are off by less than 5 % in their means here.",
    draw=draw,
    commands=("illuminant radiosity solve scenes/cornell.toml --elements 2000 -o cornell.solution",),
)
