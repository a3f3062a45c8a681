"""The fuzz targets are no part of the package: they stand beside it."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))
