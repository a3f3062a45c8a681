"""The page on colour tells the truth."""

import contextlib
import io
import re
from pathlib import Path


def test_the_programs_of_the_page_print_what_it_says(repository: Path):
    page = (repository / "docs" / "color.md").read_text(encoding="utf-8")
    programs = re.findall(
        r"^```python runnable\n(.*?)^```\n(?:\n```text output\n(.*?)^```)?", page, re.MULTILINE | re.DOTALL
    )
    assert len(programs) >= 4
    for program, wanted in programs:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(program, "color.md", "exec"), {})
        assert not wanted or printed.getvalue() == wanted


def test_the_page_and_the_module_name_every_system(repository: Path):
    from illuminant import color

    page = (repository / "docs" / "color.md").read_text(encoding="utf-8")
    about = str(color.rgb.__doc__)
    for name in color.systems():
        assert f"`{name}`" in page
        assert name in about
