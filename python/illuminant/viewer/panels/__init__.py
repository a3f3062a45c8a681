"""The controls of a page, one module for each folder of them, and the lines that tell how things stand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from illuminant.viewer.panels.compare import ComparePanel
from illuminant.viewer.panels.display import DisplayPanel
from illuminant.viewer.panels.keep import KeepPanel
from illuminant.viewer.panels.lamps import LampPanel
from illuminant.viewer.panels.material import MaterialPanel
from illuminant.viewer.panels.measure import MeasurePanel
from illuminant.viewer.panels.picture import PicturePanel

if TYPE_CHECKING:
    from illuminant.viewer.composition import Composed
    from illuminant.viewer.refinement import Frame
    from illuminant.viewer.session import Session

__all__ = ["Panels", "duration"]


class Panels:
    """All controls of one page.

    Args:
        session: whose state they show and change.
    """

    def __init__(self, session: Session) -> None:
        gui = session.client.gui
        self._status = gui.add_markdown("Starting …")
        self._trouble = gui.add_markdown("")
        self._facts = gui.add_markdown("")
        self.picture = PicturePanel(session)
        self.measure = MeasurePanel(session)
        self.display = DisplayPanel(session)
        self.lamps = LampPanel(session)
        self.material = MaterialPanel(session)
        self.compare = ComparePanel(session)
        self.keep = KeepPanel(session)

    def progress(self, frame: Frame) -> None:
        """Tell how far a picture is."""
        if frame.illuminance is not None:
            down, across = frame.illuminance.shape
            self._status.content = f"illuminance at {across} × {down} points"
            return
        height, width = frame.image.xyz.shape[:2]
        plural = "" if frame.samples == 1 else "s"
        parts = [f"{width} × {height}", f"{frame.samples} sample{plural}", f"{frame.mrays:.1f} Mrays/s"]
        if frame.error is not None:
            parts.append(f"noise {100 * frame.error:.2g} %")
        if frame.left is not None and frame.left > 0.5:
            parts.append(f"at most {duration(frame.left)} left")
        self._status.content = ", ".join(parts)

    def facts(self, made: Composed) -> None:
        """Tell what the look did to the picture."""
        if made.scale is not None:
            what = made.title.partition(",")[0].capitalize()
            grey = " Grey has no number." if what == "Illuminance" else ""
            self._facts.content = f"{what} on a logarithmic scale; darker than its end is violet.{grey}"
        else:
            self._facts.content = f"{100 * made.outside:.2g} % of the pixels are out of gamut."

    def say(self, text: str, wrong: bool) -> None:
        """Show a sentence in place of the progress; one on a mistake beside it, until something else is chosen."""
        if text and wrong:
            self._trouble.content = f"**{text}**"
        elif text:
            self._status.content = text

    def forgive(self) -> None:
        """Take away the sentence on a mistake."""
        if self._trouble.content:
            self._trouble.content = ""


def duration(seconds: float) -> str:
    """Seconds as people say them.

    Example:
        >>> duration(7.2), duration(95), duration(9130)
        ('7 s', '1:35 min', '2 h 32 min')
    """
    minutes, rest = divmod(round(seconds), 60)
    if minutes >= 60:
        return f"{minutes // 60} h {minutes % 60} min"
    return f"{minutes}:{rest:02d} min" if minutes else f"{rest} s"
