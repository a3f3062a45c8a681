"""Build the documentation site: `python tools/site/build.py build/site` writes it into `build/site/html`.

The pages come together in `build/site/pages`: the manual (`docs`), what it links to, the atlas where it has been drawn
(`--atlas`), the notebooks, which are executed (`--notebooks`), and the references of the commands and of the Python
package, written from the code. Zensical makes the site of them, and any warning of it ends the build; then every link
of the result is followed (`inspection.py`).
"""

from __future__ import annotations

import argparse
import subprocess
import sys
from pathlib import Path

import commands
import navigation
import notebooks
from inspection import mistakes
from links import DeadLinkError
from python_reference import Reference
from staging import Stage

REPOSITORY = Path(__file__).resolve().parent.parent.parent


def build(folder: Path, atlas: Path | None = None, with_notebooks: bool = False) -> Path:
    """Build the site in a folder, and return the folder of its HTML."""
    pages, html = folder / "pages", folder / "html"
    folder.mkdir(parents=True, exist_ok=True)
    made = {} if atlas is None else {"docs/atlas": atlas}
    if with_notebooks:
        made["notebooks"] = folder / "notebooks"
        notebooks.pages(REPOSITORY / "notebooks", made["notebooks"])
    stage = Stage(REPOSITORY, pages, made)
    stage.make("commands.md", commands.page())
    reference = Reference(REPOSITORY / "python")
    for path, text in reference.pages():
        stage.make(path, text)
    stage.fill()
    order = navigation.toml(navigation.navigation(pages, reference))
    found = f'[project]\ndocs_dir = "{pages.name}"\nsite_dir = "{html.name}"\nnav = {order}\n'
    settings = (REPOSITORY / "zensical.toml").read_text(encoding="utf-8")
    configuration = folder / "zensical.toml"
    configuration.write_text(settings.replace("[project]\n", found, 1), encoding="utf-8")
    program = [sys.executable, "-m", "zensical", "build", "--strict", "--clean", "--config-file"]
    done = subprocess.run([*program, str(configuration)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"illuminant: Zensical refuses the site.\n{done.stdout}{done.stderr}")
    found_wrong = mistakes(html)
    if found_wrong:
        raise SystemExit("\n".join(["illuminant: the site has mistakes.", *found_wrong]))
    return html


def main() -> None:
    """Read the command line and build."""
    parser = argparse.ArgumentParser(description="Build the documentation site.")
    parser.add_argument("folder", type=Path, help="folder for the site and what it is made of")
    parser.add_argument("--atlas", type=Path, help="folder that `illuminant atlas --all` has drawn")
    parser.add_argument("--notebooks", action="store_true", help="execute the notebooks and show them")
    options = parser.parse_args()
    try:
        atlas = options.atlas.resolve() if options.atlas else None
        html = build(options.folder.resolve(), atlas, options.notebooks)
    except DeadLinkError as error:
        raise SystemExit(f"illuminant: {error}") from error
    print(f"illuminant: {len(list(html.rglob('*.html')))} pages, no dead link, nothing from outside")
    print(f"illuminant: the site is {html / 'index.html'}")


if __name__ == "__main__":
    main()
