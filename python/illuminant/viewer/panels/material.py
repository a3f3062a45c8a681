"""The material that was clicked or chosen: its curve, finish, roughness, n and k by name."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from illuminant.viewer.panels.choice import answering, picked
from illuminant.viewer.tables import choices_of, repainted

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["MaterialPanel"]


class MaterialPanel:
    """The folder of one material at a time."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._controls: list[Any] = []
        names = list(session.start.tables.get("materials", {}))
        if not names:
            return
        gui = session.client.gui
        self._folder = gui.add_folder("Material", expand_by_default=False)
        with self._folder:
            self._name = gui.add_dropdown("material", names, initial_value=names[0])
        self._name.on_update(answering(session, self._build))
        self._build()

    def select(self, name: str) -> None:
        """Show the controls of a material."""
        if name in self._session.start.tables.get("materials", {}) and self._name.value != name:
            self._name.value = name

    def _build(self) -> None:
        for control in self._controls:
            control.remove()
        gui, name = self._session.client.gui, picked(self._name)
        table = self._session.state.tables["materials"][name]
        self._controls = []
        with self._folder:
            for key, kind, values, value in choices_of(table):
                if kind == "choice":
                    control = gui.add_dropdown(key, values, initial_value=value)
                else:
                    control = gui.add_slider(key, values[0], values[1], values[2], value)
                control.on_update(answering(self._session, partial(self._chosen, name, key, control)))
                self._controls.append(control)

    def _chosen(self, name: str, key: str, control: Any) -> None:
        state = self._session.state
        table = repainted(state.tables["materials"][name], key, picked(control))
        self._session.change(state.with_tables(materials={name: table}))
