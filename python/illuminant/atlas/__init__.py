"""The atlas: the figures and tables of the book, made by our own code, each with a claim that is checked in numbers.

    plates()                 all plates, in the order of the book
    plate("2.21")            one of them: what it shows, what it claims
    plate("2.21").sheet()    drawn: a figure, its data, the numbers of the claim
    publish(plates, folder)  pictures, CSV and pages as files

The book is Roy Hall, *Illumination and Color in Computer Generated Imagery* (Springer, 1989). The quantities, ranges
and units are its own. Where it errs, the right curve is drawn, and the printed one dashed.

Example:
    >>> from illuminant import atlas
    >>> sheet = atlas.plate("2.6").sheet(quick=True)
    >>> sheet.holds
    True
"""

from __future__ import annotations

from illuminant.atlas.plate import Check, Plate, Sheet
from illuminant.atlas.publishing import publish
from illuminant.atlas.registry import plate, plates

__all__ = ["Check", "Plate", "Sheet", "plate", "plates", "publish"]
