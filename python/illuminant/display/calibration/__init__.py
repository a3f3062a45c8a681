"""Calibration of a display, from knobs and readings to a description that colours can be trusted by (book 5.4).

| module | what is in it |
| --- | --- |
| `guide` | the six steps, what they need and what must hold |
| `session` | a folder of patterns to step through, and a table for readings |
| `readings` | tables of readings |
| `fit` | black, primaries, gain, offset and γ from readings |
| `description` | the fitted display: TOML, ICC profile, `Display` |
| `report` | ΔE00 over the ColorChecker, greys, verdict |
| `adjust` | turning a monitor's knobs by readings |
| `analyzer` | comparator and colour analyzer |
| `chroma_hue` | chroma and hue of an NTSC decoder |
| `monitor` | a simulated monitor, and the instrument before it |
| `record` | the record of a monitor, and when to calibrate again |

Two ways lead to right colours. The book's turns the knobs until greys are D6500 at all levels. The modern one leaves
the monitor as it is, and corrects by its description. Both need readings, and the first is better followed by the
second.

Example:
    >>> from illuminant.display.calibration import fit, monitor, readings, report
    >>> bad = monitor.maladjusted(4)
    >>> codes = readings.plan()
    >>> found = fit.fit(readings.Readings(codes, monitor.Instrument(bad, seed=4).measure(codes)))
    >>> round(report.nominal_chart(bad.xyz).mean), report.described_chart(bad.xyz, found.model).mean < 0.5
    (9, True)
"""
