"""`illuminant calibrate simulate`: readings of a simulated monitor, to practise on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

__all__ = ["simulate"]


def simulate(
    output: Annotated[
        Path,
        typer.Option("-o", "--output", metavar="FILE", help="Table to write (.csv).", show_default=False),
    ],
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Which maladjusted monitor.")] = 1,
    table: Annotated[
        Path | None,
        typer.Option(
            "--codes", metavar="FILE", help="Read the code values of this table.", show_default=False
        ),
    ] = None,
    adjusted: Annotated[
        bool, typer.Option("--adjusted", help="Turn its knobs by readings first (steps 2-4).")
    ] = False,
    ideal: Annotated[bool, typer.Option("--ideal", help="A monitor without faults.")] = False,
    minutes: Annotated[
        float | None,
        typer.Option("--minutes", metavar="M", help="Since it was switched on (warm).", show_default=False),
    ] = None,
    noise: Annotated[
        float, typer.Option("--noise", metavar="F", help="Error of a reading, as a fraction.")
    ] = 0.003,
) -> None:
    """Measure a simulated monitor that is out of adjustment, to practise on.

    \b
    Example:
      illuminant calibrate simulate --seed 4 -o practice.csv
      illuminant calibrate fit practice.csv -o practice.toml
    """
    import math

    from illuminant.cli.report import note, warning
    from illuminant.display.calibration import adjust, monitor, readings
    from illuminant.errors import UsageError
    from illuminant.output import check

    if seed < 0:
        raise UsageError(f"--seed {seed}: expected a whole number from 0 up.")
    if not 0.0 <= noise <= 0.2:
        raise UsageError(f"--noise {noise:g}: expected a fraction from 0 to 0.2.")
    if minutes is not None and not 0.0 <= minutes < math.inf:
        raise UsageError(f"--minutes {minutes:g}: expected minutes from 0 up.")
    check(output)
    plan, bits, about = readings.plan(), 8, {"monitor": "ideal" if ideal else f"simulated, seed {seed}"}
    if table is not None:
        import numpy as np

        given = readings.read(table, empty=True)
        plan = np.concatenate([given.codes, given.unread]) if given.unread is not None else given.codes
        bits, about = given.bits, {**given.about, **about}
    bench = monitor.Instrument(
        monitor.Monitor() if ideal else monitor.maladjusted(seed),
        relative=noise,
        floor=0.005 if noise else 0.0,
        minutes=math.inf if minutes is None else minutes,
        seed=seed,
    )
    if adjusted:
        done = adjust.adjust(bench, tracking=True)
        for number, one in enumerate(done.rounds, 1):
            note(
                f"round {number:2d}: off by {100 * one.low:.1f} % low, {100 * one.middle:.1f} % middle, "
                f"{100 * one.white:.1f} % white"
            )
        if not done.converged:
            warning("The knobs did not settle: the readings err more than there is left to turn.")
    found = readings.Readings(plan, bench.measure(plan), about)
    found.save(output, bits=bits)
    note(f"{output}: {len(plan)} readings of {about['monitor']}")
