"""The command `illuminant`: one module for each verb, and here what they share.

Exit codes: 0 success; 1 a check that was asked for fails; 2 wrong input; 3 the machine fails; 130 after
Ctrl-C, with the partial image written. An error is one sentence on stderr; its traceback comes only with
`--debug`.

Only Typer is imported here: NumPy, the core and everything else wait until a verb needs them.
"""

from __future__ import annotations

import functools
import os
import re
import sys
from collections.abc import Sequence
from typing import Annotated, Any, NoReturn

import typer

from illuminant.cli import (
    atlas,
    audit,
    calibrate,
    check,
    compare,
    develop,
    diff,
    display,
    dither,
    farm,
    gamma,
    gamut,
    info,
    new,
    pattern,
    radiosity,
    render,
    spectra,
    video,
    view,
)
from illuminant.cli.report import sentence

__all__ = ["app", "main", "run"]

# Typer's words for an option that cannot be read, and ours.
_PLAINER = (
    (r"^Invalid value for '(-[^']+)': Input should be a valid integer\b.*", r"\1: expected a whole number"),
    (r"^Invalid value for '(-[^']+)': Input should be a valid number\b.*", r"\1: expected a number"),
    (r"^Got unexpected extra argument(?:s|\(s\))? \((.*)\)", r"One argument is enough, and \1 is more"),
)

app = typer.Typer(
    name="illuminant",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command("new", short_help="Write a commented starter scene.")(new.new)
app.command("check", short_help="Report every mistake of a scene.")(check.check)
app.command("render", short_help="Render a scene to an image.")(render.render)
app.command("develop", short_help="Show an image under other lamps, or other eyes.")(develop.develop)
app.command("compare", short_help="Render by every technique and model.")(compare.compare)
app.command("display", short_help="Show an image on a display.")(display.display)
app.command("diff", short_help="Compare two images: ΔE00 and FLIP.")(diff.diff)
app.command("audit", short_help="Test the physics of a material.")(audit.audit)
app.command("view", short_help="Walk through a scene in a browser.")(view.view)
app.command("atlas", short_help="Draw the figures and tables of the book.")(atlas.atlas)
app.command("info", short_help="Say what was found here, or in an image.")(info.info)
app.add_typer(farm.app, name="farm", short_help="Render on many machines.")
app.add_typer(gamma.app, name="gamma", short_help="Tables, fits and studies of a monitor's gamma.")
app.command("pattern", short_help="Draw a test pattern for a display.")(pattern.pattern)
app.add_typer(calibrate.app, name="calibrate", short_help="Adjust, measure and describe a display.")
app.add_typer(gamut.app, name="gamut", short_help="Compare what becomes of colours out of gamut.")
app.add_typer(dither.app, name="dither", short_help="Compare dithers; patterns and halftones.")
app.add_typer(radiosity.app, name="radiosity", short_help="Solve for light between surfaces, relight.")
app.add_typer(spectra.app, name="spectra", short_help="List, show, plot, convert measured spectra.")
app.add_typer(video.app, name="video", short_help="Send pictures through NTSC, and check them.")


def _version(wanted: bool) -> None:
    if wanted:
        import illuminant

        typer.echo(f"illuminant {illuminant.__version__}")
        raise typer.Exit


@app.callback(invoke_without_command=True)
def _start(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
    debug: Annotated[
        bool, typer.Option("--debug", help="Show the traceback of an error; may stand anywhere.")
    ] = False,
) -> None:
    """Images whose colours can be trusted: from measured lamps and materials to a calibrated display.

    \b
    Start with:
      illuminant new room.toml
      illuminant render room.toml -o room.png
    """
    if context.invoked_subcommand is None:
        typer.echo(context.get_help(), nl=False)


def main(prog_name: str = "illuminant") -> NoReturn:
    """The entry point of the command: run it and leave the process with its exit code."""
    sys.exit(run(sys.argv[1:], prog_name))


@functools.cache
def _command() -> Any:
    """All verbs as Click's command, which takes a quarter of a second to make and does not change."""
    return typer.main.get_command(app)


def run(arguments: Sequence[str], prog_name: str = "illuminant") -> int:
    """Run the command and return its exit code.

    Args:
        arguments: what stands after the name of the command.
        prog_name: how help calls the command.

    Example:
        >>> run(["--version"])        # doctest: +SKIP
        illuminant 0.1.0
        0
    """
    from illuminant.errors import Error, Interrupted

    debug = "--debug" in arguments
    arguments = [argument for argument in arguments if argument != "--debug"]
    try:
        code = _command()(list(arguments), prog_name=prog_name, standalone_mode=False)
        if code == 130:  # Typer's word for Ctrl-C that no verb has dealt with
            sentence("Interrupted", "nothing was written.")
        return code if isinstance(code, int) else 0
    except Error as error:
        if debug:
            raise
        sentence("Interrupted" if isinstance(error, Interrupted) else "Error", str(error))
        return error.exit_code
    except MemoryError:
        if debug:
            raise
        sentence("Error", "There is not enough memory.")
        return 3
    except Exception as error:
        if debug:
            raise
        if isinstance(error, OSError) and error.errno is not None:
            return _refused(error)
        return _foreign(error, prog_name)
    except KeyboardInterrupt:  # before the command has begun
        sentence("Interrupted", "nothing was written.")
        return 130
    except BaseException as error:  # a panic of the core is no Exception
        if debug or isinstance(error, (SystemExit, GeneratorExit)):
            raise
        return _unexpected(error)


def _refused(error: OSError) -> int:
    """Report what the operating system refused: a path that cannot be, or an output that takes no more."""
    import errno

    if error.errno == errno.EPIPE:  # whoever read the output has had enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 3
    reason = (error.strerror or str(error)).lower()
    name = str(error.filename or "The output cannot be written")
    sentence("Error", f"{name if len(name) <= 80 else name[:77] + '...'}: {reason}.")
    return 2 if error.filename else 3


def _foreign(error: Exception, prog_name: str) -> int:
    """Report an error that is not ours: a mistake in the command line, or a defect."""
    message: Any = getattr(error, "format_message", None)
    if message is None:
        return _unexpected(error)
    context = getattr(error, "ctx", None)
    path = getattr(context, "command_path", prog_name) or prog_name
    text = " ".join(str(message()).split()).rstrip(".")
    for theirs, plain in _PLAINER:
        text = re.sub(theirs, plain, text)
    sentence("Error", f"{text} (see `{path} --help`).")
    return 2


def _unexpected(error: BaseException) -> int:
    text = " ".join(str(error).split()).rstrip(".")
    sentence("Error", f"{type(error).__name__}: {text}. This should not happen; --debug shows where it did.")
    return 3
