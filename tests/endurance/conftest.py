"""What equal images are."""

from collections.abc import Callable

import pytest

import illuminant


@pytest.fixture(scope="session")
def same() -> Callable[[illuminant.Image, illuminant.Image], None]:
    """Asserts that two images agree in every bit and every word, and that the same was done for them."""

    def same(one: illuminant.Image, other: illuminant.Image) -> None:
        assert one.xyz.tobytes() == other.xyz.tobytes()
        assert one.layers.keys() == other.layers.keys()
        for name, layer in one.layers.items():
            assert layer.tobytes() == other.layers[name].tobytes(), name
        assert one.settings == other.settings
        for count in ("samples", "rays", "dropped"):
            assert one.statistics[count] == other.statistics[count], count

    return same
