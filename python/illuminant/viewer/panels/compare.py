"""Two settings side by side, and how far they are apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.viewer.panels.choice import answering, picked

if TYPE_CHECKING:
    from illuminant.viewer.session import Session

__all__ = ["ComparePanel"]

MAPS = ("none", "ΔE00", "FLIP")


class ComparePanel:
    """The folder of the split view and of difference maps."""

    def __init__(self, session: Session) -> None:
        gui = session.client.gui
        with gui.add_folder("Compare", expand_by_default=False):
            hold = gui.add_checkbox("hold at the left", False)
            divider = self.divider = gui.add_slider("divider", 0.0, 1.0, 0.005, session.divider)
            maps = gui.add_dropdown("difference", list(MAPS), initial_value="none")
            self._mean = gui.add_markdown("")

        def moved() -> None:
            session.divider, session.map = float(picked(divider)), picked(maps)
            session.show()

        hold.on_update(answering(session, lambda: session.hold(bool(hold.value))))
        divider.on_update(answering(session, moved))
        maps.on_update(answering(session, moved))

    def mean(self, kind: str, value: float) -> None:
        """Tell the mean of a map."""
        self._mean.content = f"mean {kind} {value:.3g}" if kind != "none" else ""
