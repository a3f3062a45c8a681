"""Figure 4.6: the second approximation from the light (book eq 4.5)."""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet


def draw(quick: bool) -> Sheet:
    """Every patch sends to every other once; the residual from step to step."""
    import numpy as np

    from illuminant.atlas.chapter_4.three_patches import draw_room, room

    found = room(120 if quick else 600)
    diffuse = found.diffuse
    balance = diffuse.solved()
    steps = np.array([diffuse.from_light(k) for k in range(1, 9)])
    ways: list[tuple[str, ...]] = [("light", name) for name in ("patch 1", "patch 2", "patch 3")]
    ways += [("patch 1", "patch 2"), ("patch 1", "patch 3"), ("patch 2", "patch 3")]
    ways += [("patch 2", "patch 1"), ("patch 3", "patch 1"), ("patch 3", "patch 2")]
    notes = [
        f"{1e3 * one:.2f}; in balance {1e3 * whole:.2f}" for one, whole in zip(steps[1], balance, strict=True)
    ]
    figure, _ = draw_room(
        steps[1] / balance.max(), ways, "from the light, and once from patch to patch", False, notes
    )
    missing = np.abs(balance - steps).max(axis=1)
    radius = float(np.abs(np.linalg.eigvals(diffuse.exchanged)).max())
    return Sheet(
        picture=figure,
        columns={
            "iteration": np.arange(1, 9),
            "patch 1": steps[:, 0],
            "patch 2": steps[:, 1],
            "patch 3": steps[:, 2],
            "largest part missing": missing / balance.max(),
        },
        checks=(
            Check(
                "missing after two steps over that after one",
                float(missing[1] / missing[0]),
                at_most=float(diffuse.exchanged.sum(axis=0).max()),
            ),
            Check(
                "mean factor of the last two steps over the spectral radius",
                float(np.sqrt(missing[7] / missing[5])) / radius,
                "",
                0.95,
                1.05,
            ),
            Check("coefficients: n²", float(diffuse.coefficients), at_least=9, at_most=9),
        ),
    )


PLATE = Plate(
    number="4.6",
    title="Second approximation from the light",
    shows="In the second iteration of eqs 4.5a to c every patch also has what the others sent after the first "
    "(blue). Grey is intensity; it is drawn on the scale of figure 4.5.",
    claim="From step to step what is missing shrinks by the same factor, the spectral radius of the coefficients; it "
    "is below 1, as patches absorb and see the open room too, and $n^2$ coefficients are enough.",
    today="Krylov methods (`bicgstab`, what is taken if nothing is said) take fewer steps than this iteration where "
    "patches are bright; `--solver gauss-seidel`, `gauss` and `progressive` are there to compare.",
    draw=draw,
    commands=(
        "illuminant radiosity solve scenes/cornell.toml --elements 2000 --solver gauss-seidel -o cornell.solution",
    ),
)
