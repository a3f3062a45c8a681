"""Notebooks as pages: each is executed in a kernel of its own, and written as Markdown beside its pictures.

Text cells stay as they are (formulas in `$...$`), links between notebooks become links between pages. A code cell
becomes a fenced block; what it printed stands below it, and its pictures are PNG files in a folder with the name of
the notebook.

Notebooks are kept without outputs; nothing here changes them.

Example:
    >>> from pathlib import Path
    >>> pages(Path("notebooks"), Path("site/docs/notebooks"))     # doctest: +SKIP
"""

from __future__ import annotations

import base64
import re
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nbformat import NotebookNode

__all__ = ["executed", "markdown", "pages"]

TIMEOUT_S = 300
"""The longest that one cell may take."""
STREAMS = ("stdout",)
"""What is shown of what a cell prints; warnings and notes go to stderr."""


def executed(notebook: Path) -> NotebookNode:
    """A notebook with its outputs, run in the folder in which it lies.

    Args:
        notebook: an .ipynb file.

    Raises:
        nbclient.exceptions.CellExecutionError: a cell ends with an error, whose traceback it holds.
    """
    import nbformat
    from nbclient import NotebookClient

    found = nbformat.read(notebook, as_version=4)
    client = NotebookClient(
        found,
        timeout=TIMEOUT_S,
        kernel_name="python3",
        resources={"metadata": {"path": str(notebook.parent)}},
    )
    client.execute()
    return found


def markdown(notebook: NotebookNode, name: str) -> tuple[str, dict[str, bytes]]:
    """An executed notebook as Markdown, and its pictures by file name.

    Args:
        notebook: with its outputs.
        name: of the folder of its pictures, as links have it.
    """
    parts: list[str] = []
    pictures: dict[str, bytes] = {}
    for cell in notebook.cells:
        if cell.cell_type == "markdown":
            parts.append(re.sub(r"\]\((?!\w+:)([^)\s]+)\.ipynb\)", r"](\1.md)", cell.source))
            continue
        shown = "\n".join(line for line in cell.source.splitlines() if not line.startswith("%"))
        parts.append(f"```python\n{shown}\n```")
        printed = ""
        for output in cell.outputs:
            if output.output_type == "stream":
                printed += output.text if output.name in STREAMS else ""
                continue
            data = output.get("data", {})
            if "image/png" in data:
                file = f"{len(pictures) + 1}.png"
                pictures[file] = base64.b64decode(data["image/png"])
                parts.append(f"![What the code above shows]({name}/{file})")
            elif "text/plain" in data:
                printed += data["text/plain"] + "\n"
        if printed.strip():
            parts.append(f"```text\n{printed.rstrip()}\n```")
    return "\n\n".join(part.strip("\n") for part in parts) + "\n", pictures


def pages(source: Path, target: Path) -> list[Path]:
    """Execute every notebook of a folder and write each as a page.

    Args:
        source: the folder of the notebooks.
        target: the folder of the pages; it is made where it is missing.

    Returns:
        The pages, in the order of their names.
    """
    written = []
    target.mkdir(parents=True, exist_ok=True)
    for notebook in sorted(source.glob("*.ipynb")):
        text, pictures = markdown(executed(notebook), notebook.stem)
        folder = target / notebook.stem
        folder.mkdir(exist_ok=True)
        for file, content in pictures.items():
            (folder / file).write_bytes(content)
        page = target / f"{notebook.stem}.md"
        page.write_text(text, encoding="utf-8")
        written.append(page)
    return written
