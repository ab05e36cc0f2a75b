"""Model files: edited, damaged, of another kind."""

import json
from collections.abc import Callable
from typing import Any

from modeler.api import compile_model, derive, fit, generate, load, observe
from tests.bad_input.row import row
from tests.bad_input.workdir import Workdir

Raw = dict[str, Any]
COMPARE = "compare bad.json b.csv --json c.json"


def model(what, outcome, edit, *words, run=COMPARE, of="m.json"):
    """A row of a model file that is edited in place, or replaced by the text that `edit` gives."""

    def make(workdir: Workdir) -> None:
        workdir.model("bad.json", edit, of)

    return row(f"model: {what}", outcome, run, *words, make=make)


def set_at(*path: Any, to: Any) -> Callable[[Raw], None]:
    """Puts `to` at a path of keys; a function of the old value is called."""

    def edit(raw: Raw) -> None:
        node: Any = raw
        for key in path[:-1]:
            node = node[key]
        node[path[-1]] = to(node[path[-1]]) if callable(to) else to

    return edit


def text(change: Callable[[str], str | bytes]) -> Callable[[Raw], str | bytes]:
    """The file's own text, changed."""
    return lambda raw: change(json.dumps(raw, indent=1))


def mixed_up(workdir: Workdir) -> object:
    """A fit to an observation of another robot."""
    derivation = derive(load("two-link"))
    other = compile_model(generate(derive(load("emps"))))
    return fit(derivation, generate(derivation), observe(other, [workdir.inputs.folder / "e.csv"]))


CHANGED = "changed|damaged|checksum"

DAMAGED = [
    model("cut off", "refused", text(lambda t: t[: len(t) // 2]), "bad.json", "cut off"),
    row("model: of an observation of another robot", "refused", mixed_up, "two-link|emps"),
    row("model: a log", "refused", "compare a.csv b.csv", "a.csv", "not a model file"),
    row("model: none", "refused", "compare nowhere.json b.csv", "nowhere.json"),
    row("model: a built-in robot", "told", "compare two-link b.csv", "values that the robot file"),
    row("model: of another robot than the log", "told", "compare e.json d.csv", "unexplained"),
]

EDITED = [
    model("its C, of another robot text", "refused",
          set_at("robot_text", to=lambda t: t.replace("9.81", "1.62")), CHANGED,
          run="generate bad.json --out c"),
    model("sources that climb out of the folder", "refused",
          set_at("sources", to=lambda s: {**s, "../../evil.c": "int x;"}), "bad.json",
          run=COMPARE + " --run-embedded-c"),
    model("history edited, then undone", "refused",
          set_at("history", 0, "robot_text", to=lambda t: t.replace("0.40", "0.9")), CHANGED,
          run="add bad.json undo a.csv --out n.json", of="added.json"),
]  # fmt: skip

ROWS = [*DAMAGED, *EDITED]
