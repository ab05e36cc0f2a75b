"""The command to go on with, after each page, with the files of the one that was given."""

import shlex
from collections.abc import Sequence
from pathlib import Path

from modeler.diagnose import Diagnosis


def after_fit(model: str) -> list[str]:
    """Judge the model on other data, and look for what it lacks."""
    own = _listed([model])
    return [
        f"modeler compare {own} OTHER_LOG --report compare.html",
        f"modeler diagnose {own} LOG --holdout OTHER_LOG --report diagnosis.html",
    ]


def after_compare(model: str, fitted: Sequence[str], logs: Sequence[str], held_out: bool) -> str:
    """Look for what is missing; after training data, look at other data first.

    Args:
        model: file of the model.
        fitted: logs that it was fitted on.
        logs: logs that were compared.
        held_out: False if some of them were fitted.
    """
    if not held_out:
        return f"modeler compare {_listed([model])} HELD_OUT_LOG"
    return f"modeler diagnose {_listed([model, *fitted])} --holdout {_listed(logs)}"


def after_diagnosis(
    model: str, logs: Sequence[str], holdout: Sequence[str], diagnosis: Diagnosis
) -> list[str]:
    """Add the first effect that has columns; nothing where none was found."""
    first = next((f for f in diagnosis.effects if f.pick is not None), None)
    if first is None:
        return []
    joint = f" --joint {shlex.quote(first.joint)}" if first.joint else ""
    held = f" --holdout {_listed(holdout)}" if holdout else ""
    effect = shlex.quote(first.effect)
    words = f"modeler add {_listed([model])} {effect}{joint} {_listed(logs)}{held}"
    return [f"{words} --out {_listed([_better(model)])}"]


def after_add(model: str, holdout: Sequence[str]) -> list[str]:
    """Judge the new model on what was never fitted, and take it to the controller."""
    own = _listed([model])
    logs = _listed(holdout) if holdout else "HELD_OUT_LOG"
    return [f"modeler compare {own} {logs}", f"modeler generate {own} --out {_folder(model)}"]


def _better(model: str) -> str:
    path = Path(model)
    return str(path.with_name(f"{path.name.partition('.')[0]}-improved{''.join(path.suffixes)}"))


def _folder(model: str) -> str:
    return _listed([f"{Path(model).name.partition('.')[0]}_c"])


def _listed(words: Sequence[str]) -> str:
    return " ".join(shlex.quote(word) for word in words)
