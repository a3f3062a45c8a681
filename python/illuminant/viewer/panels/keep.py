"""Keeping what was found: image, scene, spectrum and solution as files of the output folder, and the command line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from illuminant.errors import Error

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["KeepPanel"]


OUTSIDE = "It names files outside its folder, so it needs `--allow-outside`."


class KeepPanel:
    """The folder of what can be kept."""

    def __init__(self, session: Session) -> None:
        from illuminant.viewer import keeping

        gui = session.client.gui
        self._session = session
        with gui.add_folder("Keep", expand_by_default=False):
            buttons = {
                "image (PNG and EXR)": keeping.image,
                "scene (TOML)": keeping.scene,
                "spectrum of the last reading (CSV)": keeping.spectrum,
                "solution of radiosity": keeping.solution,
            }
            for label, write in buttons.items():
                gui.add_button(label).on_click(lambda _, write=write: self._write(write))
            gui.add_button("command line").on_click(lambda _: self._command())
            self._told = gui.add_markdown("")

    def _write(self, write: Callable[[Session], list[Path]]) -> None:
        from illuminant.viewer import keeping

        try:
            with keeping.LOCK:
                files = write(self._session)
                outside = write is keeping.scene and keeping.names_outside(self._session, files[0].parent)
            told = "Written: " + ", ".join(f"`{file.name}`" for file in files)
            self._told.content = f"{told}. {OUTSIDE}" if outside else told
        except Error as error:
            self._told.content = f"**{error}**"
        except Exception as error:  # the scene file may have been edited meanwhile
            self._told.content = f"**{type(error).__name__}: {error}**"

    def _command(self) -> None:
        from illuminant.viewer.keeping import command

        try:
            self._told.content = f"```sh\n{command(self._session)}\n```"
        except Error as error:
            self._told.content = f"**{error}**"
