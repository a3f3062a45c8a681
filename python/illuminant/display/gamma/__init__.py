"""Gamma: the response of monitors, its correction, and what is lost on the way (book 5.1.2, docs/gamma.md).

| module | what is in it |
| --- | --- |
| `response` | I = v^γ, and v = I^(1/γ) (eq 5.1) |
| `lookup_table`, `table_file` | tables of any bits, logarithmic storage; as CSV, .cube and .spi1d |
| `levels` | codes that a table never uses, and codes that it merges |
| `readings`, `fitting` | luminances from a file, and the γ, floor or gain that fits them |
| `phosphors` | primaries and white from a manufacturer or a meter |
| `drift` | the ColorChecker through a wrong γ (figure 5.5) |
| `brightness` | perceived brightness (figure 5.6) |
| `storage`, `banding` | correction before storage or at display, and the bands of each (figure 5.7) |
| `remapping` | an image for one display, mapped to another from its stored codes |

Example:
    >>> from illuminant.display.gamma.lookup_table import correction_table
    >>> correction_table(2.2, rounding="truncate")([3, 4]).tolist()
    [33, 38]
"""
