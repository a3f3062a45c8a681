"""Power and spectrum of each lamp."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from illuminant.viewer.keeping import received
from illuminant.viewer.panels.choice import answering, picked
from illuminant.viewer.tables import lamps, relit

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["LampPanel"]

OWN = "its own"
BLACKBODY = "black body"
UPLOADED = "the file sent"


class LampPanel:
    """The folder of lamps."""

    def __init__(self, session: Session) -> None:
        self._session = session
        found = lamps(session.start.tables)
        if not found:
            return
        with session.client.gui.add_folder("Lamps", expand_by_default=False):
            for kind, name, table in found:
                self._lamp(kind, name, table)

    def _lamp(self, kind: str, name: str, table: dict[str, Any]) -> None:
        from illuminant import spectra

        gui = self._session.client.gui
        with gui.add_folder(name):
            power = gui.add_slider("power, ×", 0.0, 4.0, 0.05, 1.0)
            spectrum: Any = None
            if "spectrum" in table:
                spectrum = gui.add_dropdown(
                    "spectrum", [OWN, BLACKBODY, *spectra.names("emission")], initial_value=OWN
                )
                kelvin = gui.add_slider("temperature, K", 1500, 12000, 50, 2856, visible=False)
                upload = gui.add_upload_button("spectrum from a file …", mime_type="text/csv,.csv,.spd,.txt")
        files: list[str] = []

        def chosen() -> None:
            word: Any = None
            if spectrum is not None:
                named = picked(spectrum)
                kelvin.visible = named == BLACKBODY
                if named == BLACKBODY:
                    word = {"blackbody_k": float(picked(kelvin))}
                elif named == UPLOADED:
                    word = {"file": files[-1]}
                elif named != OWN:
                    word = named
            changed = {name: relit(table, float(picked(power)), word)}
            self._session.change(self._session.state.with_tables(**{kind: changed}))

        def sent() -> None:
            files.append(str(received(self._session, upload.value.content)))
            if UPLOADED not in spectrum.options:
                spectrum.options = [*spectrum.options, UPLOADED]
            spectrum.value = OWN  # setting a value calls back, but only when it is another one
            spectrum.value = UPLOADED

        if spectrum is not None:
            upload.on_upload(answering(self._session, sent))
        for control in (power, spectrum, kelvin) if spectrum is not None else (power,):
            control.on_update(answering(self._session, chosen))
