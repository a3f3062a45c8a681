"""Names beside points, placed so that they cover neither each other nor the points.

Places around a point are tried in order, first those nearest to it, and the first one free is taken. All lengths are in
typographic points on the paper; the width of a name is estimated from its letters.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

__all__ = ["Box", "around", "extent", "free", "place"]

Box = tuple[float, float, float, float]

# Directions in which a name may stand, most readable first.
_DIRECTIONS = ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (-1, 1), (1, -1), (-1, -1))


def place(
    points: Sequence[tuple[float, float]],
    texts: Sequence[str],
    obstacles: Sequence[Box] = (),
    size: float = 8.0,
) -> list[tuple[float, float]]:
    """Where the centre of each text goes.

    Args:
        points: centres of the marks, in points of 1/72 inch.
        texts: what stands beside each.
        obstacles: boxes (left, bottom, right, top) that are taken already.
        size: size of type.

    Returns:
        Centres, in the order of `points`.

    Example:
        >>> place([(0, 0), (12, 0)], ["a", "b"])
        [(-7.5, 0.0), (19.5, 0.0)]
    """
    taken: list[Box] = [*around(points, 3.5), *obstacles]
    centres = []
    for (x, y), text in zip(points, texts, strict=True):
        width, height = extent(text, size)
        best: tuple[float, float, float] | None = None
        for distance in (5.0, 11.0, 18.0, 27.0):
            for dx, dy in _DIRECTIONS:
                at = (x + dx * (distance + width / 2 - 0.5), y + dy * (distance + height / 2 - 2.0))
                box = (at[0] - width / 2, at[1] - height / 2, at[0] + width / 2, at[1] + height / 2)
                covered = sum(_overlap(box, other) for other in taken)
                if best is None or covered < best[0]:
                    best = (covered, *at)
            if best is not None and best[0] == 0:
                break
        assert best is not None
        _, cx, cy = best
        taken.append((cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2))
        centres.append((cx, cy))
    return centres


def extent(text: str, size: float) -> tuple[float, float]:
    """Estimated width and height of a text in type of a size."""
    return 0.6 * size * len(text) + 1.2, 1.25 * size


def around(points: Iterable[tuple[float, float]], radius: float) -> list[Box]:
    """Squares around points, which a name shall not cover.

    Example:
        >>> around([(2, 3)], 1)
        [(1, 2, 3, 4)]
    """
    return [(x - radius, y - radius, x + radius, y + radius) for x, y in points]


def free(box: Box, taken: Iterable[Box]) -> bool:
    """Whether a box shares no area with any other."""
    return not any(_overlap(box, other) for other in taken)


def _overlap(a: Box, b: Box) -> float:
    """Area that two boxes share."""
    return max(0.0, min(a[2], b[2]) - max(a[0], b[0])) * max(0.0, min(a[3], b[3]) - max(a[1], b[1]))
