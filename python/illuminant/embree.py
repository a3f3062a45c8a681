"""Where the ray-query library Embree 4 is.

Embree comes inside the wheel `embreex`, in the folder `embreex.libs` beside the package (`embreex/.dylibs` on
macOS). The package itself is never imported: only its shared library is needed, and the compiled core loads
that at run time. The environment variable `ILLUMINANT_EMBREE` names another library, for example one built
for this very machine.

Example:
    >>> from illuminant import embree
    >>> embree.find().name.startswith("libembree4")   # doctest: +SKIP
    True
"""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path

from illuminant.errors import MachineError

__all__ = ["REMEDY", "VARIABLE", "find"]

VARIABLE = "ILLUMINANT_EMBREE"
REMEDY = (
    f"install it with `pip install embreex`, or set {VARIABLE} to the path of a libembree4 shared library"
)


def _beside_package() -> list[Path]:
    """Embree libraries shipped by the package `embreex`, found without importing it."""
    spec = importlib.util.find_spec("embreex")
    if spec is None or not spec.submodule_search_locations:
        return []
    package = Path(next(iter(spec.submodule_search_locations)))
    folders = (package.with_name("embreex.libs"), package / ".dylibs")
    return sorted(path for folder in folders for path in folder.glob("libembree4*"))


def find() -> Path:
    """Path of the Embree library: `ILLUMINANT_EMBREE` if it is set, else the one in the wheel `embreex`.

    Raises:
        MachineError: there is none; the sentence says what to install.
    """
    named = os.environ.get(VARIABLE)
    if named:
        path = Path(named)
        if not path.is_file():
            raise MachineError(
                f"{VARIABLE} names {named}, which is not a file: set it to the path of a libembree4 shared library, "
                "or unset it to use the one in the package embreex."
            )
        return path
    found = _beside_package()
    if not found:
        raise MachineError(f"Embree 4, which traces the rays, was not found: {REMEDY}.")
    return found[0]
