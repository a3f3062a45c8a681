"""Tables of lamps and materials, as the scene file writes them, changed by what a person chooses.

Example:
    >>> relit({"kind": "emitter", "spectrum": "A", "flux_lm": 800.0}, 0.5, "D65")
    {'kind': 'emitter', 'spectrum': 'D65', 'flux_lm': 400.0}
    >>> repainted({"kind": "conductor", "metal": "gold", "roughness": 0.1}, "finish", "satin")
    {'kind': 'conductor', 'metal': 'gold', 'finish': 'satin'}
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from illuminant.errors import UsageError
from illuminant.quantities import QUANTITIES

__all__ = ["choices_of", "lamps", "relit", "relocate", "repainted"]

NO_FINISH = "as its roughness"
_RELIEF = ("roughness", "roughness_across", "sigma_nm", "distribution")
_CURVES = {"reflectance": "reflectance", "pigment": "reflectance"}


def lamps(tables: Mapping[str, Any]) -> list[tuple[str, str, dict[str, Any]]]:
    """The lamps of a scene: `materials` or `lights`, name and table of each.

    Example:
        >>> lamps({"materials": {"bulb": {"kind": "emitter"}, "wall": {"kind": "diffuse"}}})
        [('materials', 'bulb', {'kind': 'emitter'})]
    """
    emitters = [
        ("materials", name, dict(table))
        for name, table in tables.get("materials", {}).items()
        if table.get("kind") == "emitter"
    ]
    return emitters + [("lights", name, dict(table)) for name, table in tables.get("lights", {}).items()]


def relit(table: Mapping[str, Any], factor: float, spectrum: Any = None) -> dict[str, Any]:
    """The table of a lamp with another power, and another spectrum if one is given.

    Raises:
        UsageError: the lamp states no quantity that could be multiplied.
    """
    changed = dict(table)
    stated = [key for key in QUANTITIES if key in table]
    if factor != 1.0 and not stated:
        raise UsageError("This lamp states no quantity that could be multiplied.")
    for key in stated:
        changed[key] = float(table[key]) * factor
    if spectrum is not None:
        changed["spectrum"] = spectrum
    return changed


def choices_of(table: Mapping[str, Any]) -> list[tuple[str, str, Any, Any]]:
    """What can be chosen in a material: key, `choice` or `number`, the values (or least, most, step), the value now.

    Keys whose value is an image or a table of its own are left as they are.

    Example:
        >>> [key for key, *_ in choices_of({"kind": "conductor", "metal": "gold", "roughness": 0.1})]
        ['metal', 'finish', 'roughness']
    """
    from illuminant import finishes, spectra

    found: list[tuple[str, str, Any, Any]] = []

    def choice(key: str, values: list[str], value: str) -> None:
        found.append((key, "choice", list(dict.fromkeys([value, *values])), value))

    def number(key: str, span: tuple[float, float, float], value: float) -> None:
        low, high, step = span
        found.append((key, "number", (min(low, value), max(high, value), step), value))

    for key in _CURVES:
        if isinstance(table.get(key), str):
            choice(key, spectra.names("reflectance"), table[key])
        elif isinstance(table.get(key), (int, float)):
            number(key, (0.0, 1.0, 0.01), float(table[key]))
    if isinstance(table.get("metal"), str):
        choice("metal", [name.removesuffix(".k") for name in spectra.names("k")], table["metal"])
    if isinstance(table.get("medium"), str):
        metals = spectra.names("k")
        media = [name.removesuffix(".n") for name in spectra.names("n")]
        choice("medium", [name for name in media if f"{name}.k" not in metals], table["medium"])
    for key, span in (("n", (1.0, 4.0, 0.01)), ("k", (0.0, 10.0, 0.05))):
        if isinstance(table.get(key), (int, float)):
            number(key, span, float(table[key]))
    if table.get("kind") in ("conductor", "dielectric", "coated"):
        choice("finish", [NO_FINISH, *finishes.names()], table.get("finish") or NO_FINISH)
        if isinstance(table.get("roughness", 0.0), (int, float)) and "finish" not in table:
            number("roughness", (0.0, 1.0, 0.01), float(table.get("roughness", 0.0)))
    if table.get("kind") == "named":
        base = str(table["name"]).partition(",")[0]
        values = [f"{base}, {name}" for name in finishes.names()]
        choice("name", values, str(table["name"]))
    return found


def repainted(table: Mapping[str, Any], key: str, value: Any) -> dict[str, Any]:
    """The table of a material with another value; a finish takes the place of a stated relief, and gives way to it."""
    changed = dict(table)
    if key == "finish":
        for stated in (*_RELIEF, "finish"):
            changed.pop(stated, None)
        if value == NO_FINISH:
            changed["roughness"] = float(table.get("roughness", 0.1))
            return changed
    changed[key] = value
    return changed


def relocate(node: Any, folder: Path, named: Callable[[Path], Path]) -> list[Path]:
    """Name the files in tables anew, in place.

    Args:
        node: tables, or part of them.
        folder: to which names are relative.
        named: the new name of a file.

    Returns:
        The new names.
    """
    names: list[Path] = []
    pairs: Any = (
        node.items() if isinstance(node, Mapping) else enumerate(node) if isinstance(node, list) else ()
    )
    for key, value in list(pairs):
        if not isinstance(value, str):
            names += relocate(value, folder, named)
        elif key != "material" and Path(value).suffix and _is_file(folder / value):
            names.append(named(folder / value))
            node[key] = names[-1].as_posix()
    return names


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False
