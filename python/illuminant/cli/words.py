"""How the words of an option are read that stand for several numbers."""

from __future__ import annotations

__all__ = ["numbers"]


def numbers(
    text: str,
    option: str,
    expected: str = "numbers with commas between them",
    *,
    count: int | tuple[int, ...] = (),
) -> list[float]:
    """The finite numbers of a list with commas.

    Args:
        text: the word.
        option: the option, for messages.
        expected: what it should be, for messages.
        count: how many there may be; none: any number of them.

    Raises:
        UsageError: one is no number, or there are not as many.

    Example:
        >>> numbers("1.8,2.2", "--gammas")
        [1.8, 2.2]
        >>> numbers("1,2", "--eye", "three numbers, such as 1,1.6,3", count=3)
        Traceback (most recent call last):
        illuminant.errors.UsageError: --eye 1,2: expected three numbers, such as 1,1.6,3.
    """
    import math

    from illuminant.errors import UsageError

    counts = (count,) if isinstance(count, int) else count
    try:
        found = [float(word) for word in text.split(",")]
    except ValueError:
        found = []
    if not found or not all(map(math.isfinite, found)) or (counts and len(found) not in counts):
        raise UsageError(f"{option} {text}: expected {expected}.")
    return found
