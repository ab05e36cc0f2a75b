"""The command to go on with, after each page, with the files of the one that was given."""

import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # the sentence after a fit needs no diagnosis loaded
    from modeler.diagnose import Diagnosis
    from modeler.fit import FitResult


def after_fit(model: str, logs: Sequence[str], robot: str, fit: "FitResult") -> list[str]:
    """Judge the model on other data, and look for what it lacks; first what the fit asks for.

    Args:
        model: its file.
        logs: that were fitted.
        robot: as it was given.
        fit: judged.
    """
    own = _listed([model])
    judge = f"modeler compare {own} HELD_OUT_LOG --report compare.html"
    look = f"modeler diagnose {_listed([model, *logs])} --report diagnosis.html"
    verdict = fit.verdict
    if verdict is not None and not verdict.usable:
        return [f"modeler log {_listed(logs[:1])} --robot {_listed([robot])}", look]
    lacks = verdict is not None and verdict.usable_for != "physics"
    lacks = lacks or any("`modeler diagnose`" in line for line in fit.sentences)
    return [look, judge] if lacks else [judge, look]


def after_compare(
    model: str, fitted: Sequence[str], logs: Sequence[str], held_out: bool, noise: bool = False
) -> str:
    """Look for what is missing; if nothing is, look at other data, or go to the controller.

    Args:
        model: file of the model.
        fitted: logs that it was fitted on.
        logs: logs that were compared.
        held_out: False if some of them were fitted.
        noise: True if nothing else is left on any joint.
    """
    if noise:
        return f"modeler compare {_listed([model])} HELD_OUT_LOG" if not held_out else _taken(model)
    if not held_out:
        return f"modeler diagnose {_listed([model, *logs])}"
    return f"modeler diagnose {_listed([model, *fitted])} --holdout {_listed(logs)}"


def after_diagnosis(
    model: str, logs: Sequence[str], holdout: Sequence[str], diagnosis: "Diagnosis"
) -> list[str]:
    """Add the first effect that has columns; without any, see what is left, or take the model."""
    first = next((f for f in diagnosis.effects if f.pick is not None), None)
    if first is None and diagnosis.verdict == "nothing significant":
        return [_taken(model)]
    if first is None:
        return [f"modeler compare {_listed([model, *(holdout or logs)])} --report compare.html"]
    joint = f" --joint {shlex.quote(first.joint)}" if first.joint else ""
    held = f" --holdout {_listed(holdout)}" if holdout else ""
    effect = shlex.quote(first.effect)
    words = f"modeler add {_listed([model])} {effect}{joint} {_listed(logs)}{held}"
    return [f"{words} --out {_listed([_better(model)])}"]


def after_add(model: str, holdout: Sequence[str]) -> list[str]:
    """Judge the new model on what was never fitted, and take it to the controller."""
    own = _listed([model])
    logs = _listed(holdout) if holdout else "HELD_OUT_LOG"
    return [f"modeler compare {own} {logs}", _taken(model)]


def _taken(model: str) -> str:
    """To the controller."""
    return f"modeler generate {_listed([model])} --out {_folder(model)}"


def _better(model: str) -> str:
    path = Path(model)
    return str(path.with_name(f"{path.name.partition('.')[0]}-improved{''.join(path.suffixes)}"))


def _folder(model: str) -> str:
    return _listed([f"{Path(model).name.partition('.')[0]}_c"])


def _listed(words: Sequence[str]) -> str:
    return " ".join(shlex.quote(word) for word in words)
