"""Which instructions the processor has, checked before compiled code that needs them is loaded.

The compiled core is built for x86-64-v3 (the level of the x86-64 psABI with AVX2, FMA and BMI2). On an older
processor it would end the process at its first such instruction, without a word; so this module looks first,
in `/proc/cpuinfo`, and says in one sentence what is missing. On another system or another architecture
nothing is checked: there the core is built for that architecture's own baseline.

Example:
    >>> from illuminant import processor
    >>> processor.missing({"avx2"})[:3]
    ['AVX', 'F16C', 'FMA']
"""

from __future__ import annotations

import platform
import sys
from collections.abc import Set
from pathlib import Path

from illuminant.errors import MachineError

__all__ = ["LEVEL", "check", "features", "missing", "model"]

LEVEL = "x86-64-v3"

# Flag in /proc/cpuinfo -> name of the feature, in the order in which a person would name them. The system lists
# `avx` only when it saves the wide registers itself, so OSXSAVE needs no line of its own.
REQUIRED = {
    "avx2": "AVX2",
    "avx": "AVX",
    "f16c": "F16C",
    "fma": "FMA",
    "bmi1": "BMI1",
    "bmi2": "BMI2",
    "abm": "LZCNT",
    "movbe": "MOVBE",
    "popcnt": "POPCNT",
    "sse4_2": "SSE4.2",
    "sse4_1": "SSE4.1",
    "ssse3": "SSSE3",
    "cx16": "CMPXCHG16B",
}

_CPUINFO = Path("/proc/cpuinfo")


def _field(text: str, key: str) -> str:
    for line in text.splitlines():
        name, _, value = line.partition(":")
        if name.strip() == key:
            return value.strip()
    return ""


def model() -> str:
    """Name of the processor as the system gives it, or of its architecture when the system gives none."""
    try:
        text = _CPUINFO.read_text(encoding="utf-8", errors="replace")
    except OSError:
        text = ""
    return _field(text, "model name") or platform.processor() or platform.machine()


def features() -> frozenset[str] | None:
    """Flags of the first processor in `/proc/cpuinfo`; None where that cannot be known (not Linux on x86-64)."""
    if not sys.platform.startswith("linux") or platform.machine().lower() not in ("x86_64", "amd64"):
        return None
    try:
        text = _CPUINFO.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return None
    return frozenset(_field(text, "flags").split()) or None


def missing(flags: Set[str]) -> list[str]:
    """Names of the features of x86-64-v3 that `flags` (words of `/proc/cpuinfo`) does not hold.

    Example:
        >>> missing({"sse4_2"})[0]
        'AVX2'
    """
    return [name for flag, name in REQUIRED.items() if flag not in flags]


def check(flags: Set[str] | None = None) -> None:
    """Refuse a processor below x86-64-v3.

    Args:
        flags: words of `/proc/cpuinfo`; None asks this machine.

    Raises:
        MachineError: one sentence that names the missing features and the oldest processors that have them.
    """
    found = features() if flags is None else flags
    if found is None:
        return
    absent = missing(found)
    if absent:
        raise MachineError(
            f"This processor lacks {', '.join(absent)}: illuminant is compiled for {LEVEL} "
            "(Intel since Haswell in 2013, AMD since Excavator in 2015), so it cannot run here."
        )
