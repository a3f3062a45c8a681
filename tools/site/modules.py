"""What a Python module offers, read from its source without running it: the names of its `__all__`.

A module is public when neither it nor a package around it begins with `_`. The package `illuminant.cli` is left out:
what it offers is the command, and that has a reference of its own.
"""

from __future__ import annotations

import ast
import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

__all__ = ["Member", "Module", "public_modules", "read"]

WIDTH = 88
"""Characters of a signature on one line; longer ones have a line for each parameter."""

LEFT_OUT = {"illuminant.cli"}


@dataclass
class Member:
    """A name of a module, or of a class.

    Attributes:
        name: the name; `Class.method` for what belongs to a class.
        kind: "function", "class", "property", "constant", or "import" for a name of another module.
        signature: how it is called or what it is, as Python text.
        doc: its docstring.
        members: what belongs to a class.
        origin: for an import, the dotted name of what it stands for.
    """

    name: str
    kind: str
    signature: str = ""
    doc: str = ""
    members: list[Member] = field(default_factory=list)
    origin: str = ""


@dataclass
class Module:
    """A module or package: its dotted name, its docstring, and what it offers."""

    name: str
    package: bool
    doc: str
    members: list[Member]


def public_modules(source: Path, root: str = "illuminant") -> Iterator[tuple[str, Path]]:
    """The dotted name and the file of every public module, packages before what is in them.

    Args:
        source: the folder that holds the package.
        root: the package.
    """
    folder = source / root.replace(".", "/")
    yield root, folder / "__init__.py"
    for path in sorted(folder.iterdir()):
        name = f"{root}.{path.stem}"
        if path.name.startswith("_") or name in LEFT_OUT:
            continue
        if path.is_dir() and (path / "__init__.py").is_file():
            yield from public_modules(source, name)
        elif path.suffix == ".py":
            yield name, path


def read(name: str, path: Path) -> Module:
    """Read one module."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    package = path.name == "__init__.py"
    offered = _offered(tree)
    imported = _imported(tree, name if package else name.rpartition(".")[0])
    # What only a type checker sees stands in an `if`.
    seen = [part for node in tree.body if isinstance(node, ast.If) for part in node.body]
    found = {member.name: member for member in _members([*tree.body, *seen], offered.__contains__)}
    for one in sorted(offered - found.keys()):
        if one in imported:
            found[one] = Member(one, "import", origin=imported[one])
    return Module(name, package, ast.get_docstring(tree) or "", list(found.values()))


def _offered(tree: ast.Module) -> set[str]:
    """The names in `__all__`."""
    for node in tree.body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__":
            return {str(part.value) for part in ast.walk(node.value) if isinstance(part, ast.Constant)}
    return set()


def _imported(tree: ast.Module, package: str) -> dict[str, str]:
    """The dotted name behind each name that is imported from this project."""
    names: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom):
            home = node.module or ""
            if node.level:
                home = ".".join([*package.split(".")[: len(package.split(".")) - node.level + 1], home])
            if home.startswith("illuminant"):
                for one in node.names:
                    names.setdefault(one.asname or one.name, f"{home.rstrip('.')}.{one.name}")
    return names


def _members(body: list[ast.stmt], wanted: Callable[[str], bool], owner: str = "") -> Iterator[Member]:
    """The functions, classes and constants of a module or class, in the order of the source."""
    prefix = f"{owner}." if owner else ""
    for node, after in zip(body, [*body[1:], None], strict=True):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)) and wanted(node.name):
            marks = {ast.unparse(one) for one in node.decorator_list}
            if any("overload" in mark or mark.endswith(".setter") for mark in marks):
                continue
            doc = ast.get_docstring(node) or ""
            if marks & {"property", "cached_property", "functools.cached_property"}:
                returns = f": {ast.unparse(node.returns)}" if node.returns else ""
                yield Member(prefix + node.name, "property", f"{node.name}{returns}", doc)
            else:
                yield Member(prefix + node.name, "function", _signature(node, bool(owner), marks), doc)
        elif isinstance(node, ast.ClassDef) and wanted(node.name):
            inside = list(_members(node.body, lambda name: not name.startswith("_"), prefix + node.name))
            yield Member(prefix + node.name, "class", _class(node), ast.get_docstring(node) or "", inside)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            target = node.target if isinstance(node, ast.AnnAssign) else node.targets[0]
            if isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple):
                pairs = zip(target.elts, node.value.elts, strict=True)
                for name, value in ((ast.unparse(left), right) for left, right in pairs):
                    if wanted(name):
                        one = ast.Assign([ast.Name(name)], value)
                        yield Member(prefix + name, "constant", _constant(name, one), _text_below(after))
            elif isinstance(target, ast.Name) and wanted(target.id):
                doc = _text_below(after)
                # A field of a class stands in the signature; one with words of its own stands by itself as well.
                if owner and not doc:
                    continue
                yield Member(prefix + target.id, "constant", _constant(target.id, node), doc)


def _text_below(node: ast.stmt | None) -> str:
    """The docstring of a constant: the text below it."""
    if (
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
    ):
        return inspect.cleandoc(node.value.value)
    return ""


def _constant(name: str, node: ast.Assign | ast.AnnAssign) -> str:
    """A constant with its type, and its value where that is short."""
    annotation = f": {ast.unparse(node.annotation)}" if isinstance(node, ast.AnnAssign) else ""
    value = f" = {ast.unparse(node.value)}" if node.value is not None else ""
    return name + annotation + (value if len(name + annotation + value) <= WIDTH else " = …")


def _signature(node: ast.FunctionDef | ast.AsyncFunctionDef, method: bool, marks: set[str]) -> str:
    """How a function is called."""
    arguments = _parameters(node.args)
    if method and "staticmethod" not in marks:
        arguments = arguments[1:]
    returns = f" -> {ast.unparse(node.returns)}" if node.returns else ""
    before = "".join(f"@{mark}\n" for mark in sorted(marks & {"classmethod", "staticmethod"}))
    return before + _call(node.name, arguments, returns)


def _call(name: str, arguments: list[str], returns: str = "") -> str:
    """A call on one line, or on a line for each parameter."""
    line = f"{name}({', '.join(arguments)}){returns}"
    if len(line) <= WIDTH or not arguments:
        return line
    return f"{name}(\n" + "".join(f"    {one},\n" for one in arguments) + f"){returns}"


def _parameters(arguments: ast.arguments) -> list[str]:
    """The parameters as they are written."""

    def one(argument: ast.arg, default: ast.expr | None, stars: str = "") -> str:
        annotation = f": {ast.unparse(argument.annotation)}" if argument.annotation else ""
        equals = " = " if annotation else "="
        return f"{stars}{argument.arg}{annotation}" + (equals + ast.unparse(default) if default else "")

    positional = [*arguments.posonlyargs, *arguments.args]
    defaults = [None] * (len(positional) - len(arguments.defaults)) + arguments.defaults
    texts = [one(*pair) for pair in zip(positional, defaults, strict=True)]
    if arguments.posonlyargs:
        texts.insert(len(arguments.posonlyargs), "/")
    if arguments.vararg:
        texts.append(one(arguments.vararg, None, "*"))
    elif arguments.kwonlyargs:
        texts.append("*")
    texts += [one(*pair) for pair in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)]
    if arguments.kwarg:
        texts.append(one(arguments.kwarg, None, "**"))
    return texts


def _class(node: ast.ClassDef) -> str:
    """How an object of a class is made: by its `__init__`, else by its fields."""
    for inside in node.body:
        if isinstance(inside, ast.FunctionDef) and inside.name == "__init__":
            return "class " + _call(node.name, _parameters(inside.args)[1:])
    bases = [ast.unparse(base) for base in node.bases]
    marks = [ast.unparse(mark) for mark in node.decorator_list]
    if not any(mark.split("(")[0].endswith("dataclass") for mark in marks) and "NamedTuple" not in bases:
        return f"class {node.name}" + (f"({', '.join(bases)})" if bases else "")
    fields = []
    for inside in node.body:
        if isinstance(inside, ast.AnnAssign) and isinstance(inside.target, ast.Name):
            value = ast.unparse(inside.value) if inside.value is not None else ""
            if "init=False" in value or "ClassVar" in ast.unparse(inside.annotation):
                continue
            if value.startswith("field("):
                value = "…" if "default" in value else ""
            equals = f" = {value}" if value else ""
            fields.append(f"{inside.target.id}: {ast.unparse(inside.annotation)}{equals}")
    if any("kw_only=True" in mark for mark in marks):
        fields.insert(0, "*")
    return "class " + _call(node.name, fields)
