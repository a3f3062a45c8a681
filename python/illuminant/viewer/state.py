"""What a person has chosen in the viewer: scene, technique, model, sampling, look. A change is a new `State`.

Example:
    >>> state = State.of("scenes/cornell.toml")                    # doctest: +SKIP
    >>> state.with_tables(materials={"white": {"kind": "diffuse", "reflectance": 0.5}})    # doctest: +SKIP
"""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from illuminant import sources
from illuminant.animation import Animation
from illuminant.display.look import Look
from illuminant.errors import SceneError, UsageError
from illuminant.report import Report
from illuminant.scene_file import MAX_BYTES
from illuminant.sources import SourceError
from illuminant.viewer.tables import relocate

if TYPE_CHECKING:
    from illuminant.scene import Scene

__all__ = ["SAMPLINGS", "State", "choices"]

SAMPLINGS = ("fitted:8", "fitted:16", "uniform:32", "hall:4", "meyer", "rgb", "xyz", "1nm")
"""The spectral samplings that the page offers."""


@dataclass(frozen=True)
class State:
    """What is shown.

    Attributes:
        scene: with the camera of its file; the page's own camera is no part of the state.
        tables: the tables of the scene file, of an animation those of its first frame, as they stand after all changes;
            empty for a scene that is no file.
        technique, illumination, sampling: how the picture is made.
        elements: about how many elements a solution has.
        look: how it is shown; its exposure is a factor in cd/m², or None until the first picture has set it.
        stops: photographic stops added to that exposure.
    """

    scene: Scene
    tables: dict[str, Any] = field(repr=False)
    technique: str = "path"
    illumination: str = "general"
    sampling: str = "fitted:8"
    elements: int = 3000
    look: Look = field(default_factory=Look)
    stops: float = 0.0

    @classmethod
    def of(cls, scene: Scene | str | Path, *, allow_outside: bool = False, **choices: Any) -> State:
        """The state at the start.

        Args:
            scene: a `Scene`, or the path of a scene file.
            allow_outside: whether the files that it names may lie outside its folder.
            choices: attributes that are not the defaults; else the scene's `[render]` counts.

        Raises:
            SceneError: the scene has mistakes.
            UsageError: a choice is not known, or does not go with another.
        """
        from illuminant.scene import Scene

        loaded = scene if isinstance(scene, Scene) else Scene.load(scene, allow_outside=allow_outside)
        defaults = {
            key: loaded.render_defaults[key]
            for key in ("technique", "illumination", "sampling")
            if loaded.render_defaults.get(key)
        }
        given = {key: one for key, one in choices.items() if one is not None}
        # A scene in memory may differ from the file that it came from.
        tables = {} if isinstance(scene, Scene) else _tables(str(scene))
        made = cls(loaded, tables, **defaults | given)
        _check(made)
        return made

    def with_tables(
        self,
        *,
        materials: Mapping[str, Mapping[str, Any]] | None = None,
        lights: Mapping[str, Mapping[str, Any]] | None = None,
    ) -> State:
        """With other tables of materials or lights, as the scene file writes them.

        Raises:
            SceneError: a table has mistakes.
        """
        tables = copy.deepcopy(self.tables)
        for kind, changed in (("materials", materials), ("lights", lights)):
            for name, table in (changed or {}).items():
                tables.setdefault(kind, {})[name] = dict(table)
        return replace(self, scene=self.scene.replace(materials=materials, lights=lights), tables=tables)

    @property
    def exposure(self) -> float | None:
        """The factor from cd/m² to the display's white; None until it is known."""
        return None if self.look.exposure is None else self.look.exposure * 2.0**self.stops


def choices(technique: str) -> tuple[dict[str, str], dict[str, str]]:
    """The illumination models that go with a technique, and those that do not, each with the reason or "".

    Example:
        >>> sensible, refused = choices("radiosity")
        >>> "general" in sensible or "general" in refused
        True
    """
    from illuminant.comparison import pairs

    sensible: dict[str, str] = {}
    refused: dict[str, str] = {}
    for pair in pairs():
        if pair.technique == technique:
            (refused if pair.verdict == "refused" else sensible)[pair.illumination] = pair.reason
    return sensible, refused


def _check(state: State) -> None:
    """Refuse a technique and a model that are not known, or not together."""
    from illuminant.comparison import pairs

    for option, name in (("technique", state.technique), ("illumination", state.illumination)):
        known = list(dict.fromkeys(getattr(pair, option) for pair in pairs()))
        if name not in known:
            raise UsageError(f"--{option} {name}: known are {', '.join(known)}.")
    _, refused = choices(state.technique)
    if state.illumination in refused:
        raise UsageError(
            f"{state.technique} does not go with {state.illumination}: {refused[state.illumination]}."
        )


def _tables(path: str | None) -> dict[str, Any]:
    if not path or Path(path).suffix != ".toml":
        return {}
    try:
        tables = tomllib.loads(sources.read(path, MAX_BYTES).decode("utf-8-sig"))
    except SourceError as error:
        raise SceneError(f"{path}: {error.message}") from None
    except (OSError, ValueError) as error:
        raise SceneError(f"{path}: {error}") from None
    # `Scene.replace` knows no folder that names of files are relative to.
    if "animation" in tables:
        # The scene at hand is the first frame, of which a key may stand in the keyframes alone.
        animation = Animation.read(tables, Report(path), Path(path).parent)
        tables = copy.deepcopy(animation.data(animation.time(animation.first)))
    relocate(tables, Path(path).parent, Path.absolute)
    return tables
