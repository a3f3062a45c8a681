"""How much memory an image and its shadow maps take while it is rendered, and whether that is free."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from illuminant import machine
from illuminant.settings import SCANLINE, Settings

__all__ = ["check_memory", "check_shadow_maps", "lanes", "memory_needed", "shadow_map_memory"]


def memory_needed(settings: Settings, pixels: int, lamps: int = 1) -> int:
    """Bytes that the film and its image take, without the scene.

    The film holds 16 bytes a channel (exact sums); an image and its copy on the way to a file take 20 more.

    Args:
        settings: which layers there are.
        pixels: of the image.
        lamps: how many lamps the scene has.

    Example:
        >>> memory_needed(Settings(), 960 * 540) // 1_000_000
        76
    """
    channels = 4 + 2 * (settings.replicates > 1)
    channels += sum({"depth": 2, "samples": 1, "terms": 15}.get(name, 3) for name in settings.layers)
    channels += 3 * lamps if settings.lamps else 0
    if settings.keep_spectra:
        channels += lanes(settings.sampling) * (1 + lamps * settings.lamps)
    # Paths from lamps have sums of their own.
    return pixels * ((36 + 16 * settings.caustics) * channels + 4 * (1 + settings.caustics))


def lanes(sampling: str) -> int:
    """Roughly how many samples a spectral sampling has."""
    name, _, rest = sampling.partition(":")
    numbers = [int(part) for part in rest.replace(":", ",").split(",") if part.isdigit()]
    if name == "hall" and len(numbers) > 1:
        return len(numbers) - 1
    return {"rgb": 3, "xyz": 3, "meyer": 4}.get(name) or sum(numbers) or 401


def check_memory(settings: Settings, pixels: int, lamps: int = 1) -> None:
    """Refuse an image that does not fit into the memory that is free.

    Raises:
        MachineError: one sentence with both amounts.
    """
    machine.refuse(
        f"An image of {pixels:,} pixels with these layers",
        memory_needed(settings, pixels, lamps),
        "choose a smaller --size or fewer layers",
    )


def shadow_map_memory(settings: Settings, description: Mapping[str, Any]) -> int:
    """Bytes that the shadow maps of a scene take at most: 4 a texel.

    Parallel light has one map, a lamp without size the six sides of a cube, and a surface such a cube at four places.

    Args:
        settings: how shadows are found.
        description: of the scene, with its `lights` and `objects`.

    Example:
        >>> scene = {"lights": [{"kind": "point"}, {"kind": "directional"}], "objects": [{"emission": None}]}
        >>> shadow_map_memory(Settings(technique="phong", shadows="maps:1024"), scene) // 2**20
        28
    """
    kind, _, texels = settings.shadows.partition(":")
    if kind != "maps" or settings.technique not in SCANLINE:
        return 0
    maps = sum(
        {"directional": 1, "environment": 0, "sky": int(bool(light.get("sun")))}.get(light["kind"], 6)
        for light in description["lights"]
    )
    maps += sum(4 * 6 for thing in description["objects"] if thing["emission"] is not None)
    return maps * 4 * int(texels) ** 2


def check_shadow_maps(settings: Settings, description: Mapping[str, Any]) -> None:
    """Refuse shadow maps that do not fit into the memory that is free.

    Raises:
        MachineError: one sentence with both amounts.
    """
    machine.refuse(
        "The set of shadow maps of this scene",
        shadow_map_memory(settings, description),
        "choose smaller ones, such as --shadows maps:512, or --shadows rays",
    )
