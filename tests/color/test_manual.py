"""The page on colour is whole."""

from pathlib import Path


def test_the_page_and_the_module_name_every_system(repository: Path):
    from illuminant import color

    page = (repository / "docs" / "color.md").read_text(encoding="utf-8")
    about = str(color.rgb.__doc__)
    for name in color.systems():
        assert f"`{name}`" in page
        assert name in about
