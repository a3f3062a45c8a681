"""How the picture is shown: exposure, display, gamut, dither, false colours and marks; nothing is rendered again."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from illuminant.viewer.composition import MODES
from illuminant.viewer.panels.choice import answering, picked

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["DisplayPanel"]


class DisplayPanel:
    """The folder of the look."""

    def __init__(self, session: Session) -> None:
        from illuminant.display import displays, dither, gamut

        self._session = session
        gui, look = session.client.gui, session.state.look
        with gui.add_folder("Display", expand_by_default=False):
            self._stops = gui.add_slider("exposure, stops", -8.0, 8.0, 0.1, session.state.stops)
            self._mode = gui.add_dropdown("show", list(MODES), initial_value=session.mode)
            self._display = gui.add_dropdown("display", displays.names(), initial_value=str(look.display))
            self._gamut = gui.add_dropdown("gamut", gamut.methods(), initial_value=look.method)
            self._dither = gui.add_dropdown("dither", dither.names(), initial_value=look.dither)
        for control in (self._stops, self._mode, self._display, self._gamut, self._dither):
            control.on_update(answering(session, self._chosen))

    def _chosen(self) -> None:
        session = self._session
        look = session.state.look
        chosen = replace(
            look, display=picked(self._display), gamut=picked(self._gamut), dither=picked(self._dither)
        )
        state = replace(session.state, look=chosen, stops=float(picked(self._stops)))
        session.choose_mode(picked(self._mode), state)
