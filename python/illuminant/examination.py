"""What only the core finds wrong in a scene whose tables are right, and what it warns of.

- The camera sees nothing.
- A word of `[render]` names no technique, illumination model or spectral sampling that there is.

Example:
    >>> from illuminant.scene import Scene
    >>> scene = Scene.build(
    ...     camera={"eye": [0, 0, 3], "target": [0, 0, 9], "size": [64, 64]},
    ...     materials={"lamp": {"kind": "emitter", "spectrum": "A", "flux_lm": 800}},
    ...     objects={"ball": {"sphere": {"radius": 1.0}, "material": "lamp"}},
    ... )
    >>> [problem.kind for problem in problems(scene)]
    ['camera']
"""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from illuminant.errors import Problem, SceneError
from illuminant.report import Report

if TYPE_CHECKING:
    from illuminant.scene import Scene

__all__ = ["WORDS", "problems", "refuse", "warnings"]

WORDS = ("technique", "illumination", "sampling")
"""The keys of `[render]` whose values the core knows."""


def problems(scene: Scene, threads: int = 0, words: Collection[str] = WORDS) -> list[Problem]:
    """The mistakes that only the core finds.

    Args:
        scene: any scene.
        threads: for building the ray structure; 0 for one a processor.
        words: the keys of `[render]` that count; the others are overruled by options.

    Returns:
        The mistakes, with the lines of the scene's file where it has one.

    Raises:
        SceneError, MachineError: as `Scene.core`.
    """
    from illuminant import visibility

    found: list[tuple[tuple[str, str], str, str]] = []
    if visibility.blind(scene, threads):
        found.append(
            (
                ("camera", "eye"),
                "the camera sees nothing from here towards target: no object lies in its view, and there is no "
                "environment",
                "camera",
            )
        )
    found += [(("render", word), text, "choice") for word, text in _unknown_words(scene, words)]
    if not found:
        return []
    report = _report(scene)
    for path, message, kind in found:
        report.add(path, message, kind=kind)
    return sorted(report.problems, key=lambda problem: problem.line)


def refuse(scene: Scene, threads: int = 0, words: Collection[str] = WORDS) -> None:
    """Raise the mistakes that only the core finds.

    Raises:
        SceneError: there is at least one; all of them are in `problems`.
        MachineError: as `Scene.core`.
    """
    mistakes = problems(scene, threads, words)
    if mistakes:
        raise SceneError(mistakes)


def warnings(scene: Scene) -> list[str]:
    """Sentences on what was accepted but may surprise, with the options that `[render]` names."""
    from illuminant.core import core
    from illuminant.settings import resolve

    settings = resolve(scene.render_defaults)
    return [*scene.warnings, *core().Render(scene.core(), settings.to_core()).warnings()]


def _unknown_words(scene: Scene, words: Collection[str]) -> list[tuple[str, str]]:
    """Keys of `[render]` whose value the core refuses, with its sentence."""
    from illuminant.core import core
    from illuminant.settings import resolve

    given = [word for word in WORDS if word in words and word in scene.render_defaults]
    if not given:
        return []
    camera = {key: value for key, value in scene.description["camera"].items() if key != "crop"}
    smallest = scene.replace(camera=camera | {"size": [1, 1]}).core()
    found = []
    for word in given:
        settings = resolve({word: scene.render_defaults[word]})
        try:
            core().Render(smallest, settings.to_core())
        except ValueError as error:
            found.append((word, str(error).strip().rstrip(".")))
    return found


def _report(scene: Scene) -> Report:
    """A report that knows the lines of the scene's file, where there is one."""
    from illuminant import scene_file

    if scene.path:
        try:
            return scene_file.parse(scene.path)[1]
        except SceneError:
            pass  # the file is no TOML, or is gone
    return Report(scene.path or "")
