"""How the picture is made: technique, illumination model, spectral sampling; senseless pairs are named, not offered."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from illuminant.viewer.panels.choice import answering, picked
from illuminant.viewer.state import SAMPLINGS, choices
from illuminant.viewer.wireframe import WIRES

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["PicturePanel"]


class PicturePanel:
    """The folder of technique, model and sampling, of the wireframe and of cameras."""

    def __init__(self, session: Session) -> None:
        from illuminant.comparison import pairs

        self._session = session
        state, gui = session.state, session.client.gui
        techniques = list(dict.fromkeys(pair.technique for pair in pairs()))
        with gui.add_folder("Picture"):
            self._technique = gui.add_dropdown("technique", techniques, initial_value=state.technique)
            sensible, _ = choices(state.technique)
            self._model = gui.add_dropdown("model", list(sensible), initial_value=state.illumination)
            samplings = list(dict.fromkeys([state.sampling, *SAMPLINGS]))
            self._sampling = gui.add_dropdown("sampling", samplings, initial_value=state.sampling)
            self._refused = gui.add_markdown("")
            wires = gui.add_dropdown("wireframe", WIRES, initial_value=WIRES[0])
            cameras = gui.add_button_group("camera", ("scene", "left", "right", "above"))
        self._name_refused()
        self._technique.on_update(answering(session, self._technique_chosen))
        self._model.on_update(answering(session, lambda: self._chosen(illumination=picked(self._model))))
        self._sampling.on_update(answering(session, lambda: self._chosen(sampling=picked(self._sampling))))
        wires.on_update(answering(session, lambda: session.wire(picked(wires))))
        cameras.on_click(answering(session, lambda: session.preset(picked(cameras))))

    def _technique_chosen(self) -> None:
        technique = picked(self._technique)
        sensible, _ = choices(technique)
        model = self._model.value if self._model.value in sensible else next(iter(sensible))
        # First the choice: setting the list calls back, and must find nothing to change.
        self._chosen(technique=technique, illumination=model)
        self._model.options = list(sensible)
        self._model.value = model
        self._name_refused()

    def _name_refused(self) -> None:
        _, refused = choices(self._technique.value)
        reasons: dict[str, list[str]] = {}
        for name, reason in refused.items():
            reasons.setdefault(reason, []).append(name)
        lines = [f"- {', '.join(names)}: {reason}" for reason, names in reasons.items()]
        self._refused.content = "Not with this technique:\n\n" + "\n".join(lines) if lines else ""

    def _chosen(self, **chosen: Any) -> None:
        state = self._session.state
        if any(getattr(state, key) != value for key, value in chosen.items()):
            self._session.change(replace(state, **chosen))
