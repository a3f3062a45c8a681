"""Numbers of standards that several tests of the display need."""

import pytest


@pytest.fixture(scope="session")
def eia() -> dict[str, tuple[float, ...]]:
    """Luminance (IRE), carrier (IRE peak to peak), angle (°) of 75 % bars with 7.5 IRE of setup (EIA RS-189-A)."""
    return {
        "white": (76.9, 0.0, 0.0),
        "yellow": (69.0, 62.1, 167.1),
        "cyan": (56.1, 87.7, 283.5),
        "green": (48.2, 81.9, 240.7),
        "magenta": (36.2, 81.9, 60.7),
        "red": (28.2, 87.7, 103.5),
        "blue": (15.4, 62.1, 347.1),
        "black": (7.5, 0.0, 0.0),
    }
