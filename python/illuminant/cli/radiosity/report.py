"""What the verbs of `illuminant radiosity` say of a solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from illuminant.radiosity import Solution

__all__ = ["closing", "facts"]

STAGES = ("cutting", "direct", "form_factors", "solving")


def facts(solution: Solution) -> dict[str, Any]:
    """The report of a solution, with sums."""
    report = dict(solution.report)
    report["steps"] = len(report["history"])
    report["residual"] = report["history"][-1] if report["history"] else 0.0
    report["seconds"] = sum(report[f"seconds_{stage}"] for stage in STAGES)
    return report


def closing(name: str, found: dict[str, Any]) -> str:
    """The closing line: what was solved, how long it took, and how good it is."""
    from illuminant.machine import size

    parts = [
        f"{found['elements']:,} elements, {found['patches']:,} patches",
        f"{found['form_factors']:,} form factors ({size(found['memory'])})",
        f"{found['steps']} steps" if found["steps"] != 1 else "1 step",
        f"closure {found['closure_mean']:.2g}",
        f"reciprocity {found['reciprocity']:.2g}",
        f"energy {found['imbalance']:.2g}",
        f"{found['seconds']:.1f} s",
    ]
    return f"{name}: " + ", ".join(parts)
