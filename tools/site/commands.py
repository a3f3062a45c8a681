"""The reference of the command line: every verb with its arguments and options, out of the program itself.

The page says what `illuminant VERB --help` says. A heading is the command as it is typed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from dialect import escaped

__all__ = ["page", "tree"]


def tree(command: Any, words: tuple[str, ...] = ("illuminant",)) -> Iterator[tuple[tuple[str, ...], Any]]:
    """Every command below one that is not hidden, itself first, with the words that call it."""
    yield words, command
    for name, below in getattr(command, "commands", {}).items():
        if not below.hidden:
            yield from tree(below, (*words, name))


def page() -> str:
    """The page, in Markdown."""
    from typer.main import get_command

    from illuminant.cli import app

    lines = [
        "# Commands",
        "",
        "Every command of the program, as its own `--help` describes it. [The command line](command-line.md) says what",
        "holds for all of them, and what the options mean.",
        "",
    ]
    commands = list(tree(get_command(app)))
    verbs = [(words, command) for words, command in commands if not getattr(command, "commands", None)]
    lines += ["| command | does |", "| --- | --- |"]
    for words, command in verbs:
        name = " ".join(words)
        lines.append(f"| [`{name}`](#{name.replace(' ', '-')}) | {escaped(_summary(command))} |")
    for words, command in commands[1:]:
        lines += ["", f"{'#' * min(len(words), 4)} {' '.join(words)}", "", *_described(words, command)]
    lines += ["", "## Options before the verb", "", *_options(commands[0][1])]
    return "\n".join(lines) + "\n"


def _summary(command: Any) -> str:
    """The first sentence or line of a command's help."""
    return re.split(r"\n\n|(?<=\.)\s(?=[A-Z])", command.help or "", maxsplit=1)[0].replace("\n", " ").strip()


def _described(words: tuple[str, ...], command: Any) -> Iterator[str]:
    """One command: its help, how it is called, its arguments and its options."""
    below = getattr(command, "commands", None)
    if not below:
        yield from ("```text", " ".join([*words, *_usage(command)]), "```", "")
    for paragraph in (command.help or "").split("\n\n"):
        # Typer lays out no paragraph that begins with \b: it holds examples.
        if paragraph.startswith("\b"):
            title, *rest = paragraph.removeprefix("\b").strip("\n").split("\n")
            code = rest if title.endswith(":") else [title, *rest]
            if title.endswith(":"):
                yield from (f"**{escaped(title.removesuffix(':'))}**", "")
            language = "sh" if any("illuminant" in line for line in code) else "text"
            indent = min((len(line) - len(line.lstrip()) for line in code if line.strip()), default=0)
            yield from (f"```{language}", *(line[indent:] for line in code), "```", "")
        else:
            yield from (escaped(" ".join(paragraph.split())), "")
    if below:
        yield from ("| command | does |", "| --- | --- |")
        for name, one in below.items():
            if not one.hidden:
                link = "-".join([*words, name])
                yield f"| [`{' '.join([*words, name])}`](#{link}) | {escaped(_summary(one))} |"
        return
    arguments = [one for one in command.params if one.param_type_name == "argument"]
    if arguments:
        yield from ("| argument | meaning |", "| --- | --- |")
        for one in arguments:
            optional = "" if one.required else " May be left out."
            many = " May be several." if one.nargs == -1 else ""
            yield f"| `{_name(one)}` | {escaped(one.help or '')}{many}{optional} |"
        yield ""
    yield from _options(command)


def _usage(command: Any) -> Iterator[str]:
    """What stands behind the name of a command: required options, arguments, `[OPTIONS]`."""
    options = [one for one in command.params if one.param_type_name == "option"]
    for one in command.params:
        if one.param_type_name == "argument":
            name = _name(one) + ("..." if one.nargs == -1 and not _name(one).endswith("...") else "")
            yield name if one.required else f"[{name}]"
    for one in options:
        if one.required:
            yield f"{one.opts[0]} {one.metavar or ''}".strip()
    if any(not one.required and one.name != "help" for one in options):
        yield "[OPTIONS]"


def _options(command: Any) -> Iterator[str]:
    """The table of a command's options; nothing where it has none."""
    options = [
        one
        for one in command.params
        if one.param_type_name == "option" and not one.hidden and one.name != "help"
    ]
    if not options:
        return
    yield from ("| option | meaning |", "| --- | --- |")
    for one in options:
        value = "" if one.is_flag else f" {one.metavar or 'VALUE'}"
        names = ", ".join(f"`{name}{value}`" for name in one.opts)
        if one.secondary_opts:
            names += ", " + ", ".join(f"`{name}`" for name in one.secondary_opts)
        yield f"| {names.replace('|', chr(92) + '|')} | {escaped(one.help or '')}{_standing(one)} |"


def _standing(option: Any) -> str:
    """Whether an option must be given, and its default where the program's help shows one."""
    said = " May be given several times." if option.multiple and "twice" not in (option.help or "") else ""
    if option.required:
        return " Required." + said
    default = option.default
    if option.is_flag or default is None or not option.show_default or callable(default):
        return said
    return f" Default: `{default}`.{said}"


def _name(argument: Any) -> str:
    """How the program calls an argument."""
    return str(argument.metavar or argument.name.upper()).replace("|", " or ")
