"""Form factors between the objects of a scene, as radiosity finds them (book eqs 4.29, 4.32).

F(i, j) is the part of the light that leaves object i, on the side that is lit, and reaches object j. The book's own,
for intensities, is π times that, with the order of its indices turned.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from illuminant.radiosity import Solution

__all__ = ["between_objects"]


def between_objects(solution: Solution) -> NDArray[np.float64]:
    """F of all objects of a solution, (n, n): means over the elements of i, sums over those of j."""
    import numpy as np

    mesh = solution.mesh()
    parts = solution._core.parts()
    starts = np.asarray(parts["starts"], int)
    rows = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    columns = np.asarray(parts["columns"], int)
    count = len(solution.scene.description["objects"])
    objects, areas = np.asarray(mesh.objects, int), np.asarray(mesh.areas, float)
    exchanged = np.zeros((count, count))
    np.add.at(exchanged, (objects[rows], objects[columns]), areas[rows] * np.asarray(parts["values"], float))
    total = np.bincount(objects, areas, count)
    return np.asarray(exchanged / np.where(total > 0.0, total, 1.0)[:, None])
