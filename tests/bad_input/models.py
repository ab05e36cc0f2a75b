"""Model files: edited, damaged, of another kind."""

import json
from collections.abc import Callable
from typing import Any

from tests.bad_input.row import Outcome, Row, row
from tests.bad_input.workdir import Workdir

Raw = dict[str, Any]
COMPARE = "compare bad.json b.csv --json c.json"


def model(
    what: str, outcome: Outcome, edit: Callable[[Raw], object], *words: str, run: str = COMPARE,
    of: str = "m.json",
) -> Row:  # fmt: skip
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


def gone(*path: Any) -> Callable[[Raw], None]:
    """Takes the entry at a path of keys out."""

    def edit(raw: Raw) -> None:
        node: Any = raw
        for key in path[:-1]:
            node = node[key]
        del node[path[-1]]

    return edit


def text(change: Callable[[str], str | bytes]) -> Callable[[Raw], str | bytes]:
    """The file's own text, changed."""
    return lambda raw: change(json.dumps(raw, indent=1))


VALUE = ("fit", "parameters", 0, "value")
CHANGED = "changed|damaged|checksum"

DAMAGED = [
    model("empty", "refused", lambda r: "", "bad.json", "not a model|empty"),
    model("cut off", "refused", text(lambda t: t[: len(t) // 2]), "bad.json", "cut off"),
    model("random bytes", "refused", lambda r: bytes(range(256)), "bad.json"),
    model("a list", "refused", lambda r: "[]", "bad.json", "not a model file"),
    model("an integer of 10000 digits", "refused",
          text(lambda t: t.replace('"format": 2', f'"format": {"9" * 10000}', 1)), "bad.json"),
    model("a key twice", "ends", text(lambda t: t.replace('"format"', '"kind": "x",\n"format"', 1)),
          "bad.json"),
    model("a lone surrogate", "ends", text(lambda t: t.replace("two-link", "\\ud800", 1)), ""),
    model("a robot file", "told", lambda r: r["robot_text"], "values that the robot file"),
    row("model: a log", "refused", "compare a.csv b.csv", "a.csv", "not a model file"),
    row("model: Parquet", "refused", "compare c.parquet b.csv", "c.parquet", "not a model file"),
    row("model: none", "refused", "compare nowhere.json b.csv", "nowhere.json"),
    row("model: a folder", "refused", "compare c_code b.csv", "c_code", "folder|directory"),
    row("model: a built-in robot", "told", "compare two-link b.csv", "values that the robot file"),
    row("model: of another robot than the log", "told", "compare e.json d.csv", "unexplained"),
    row("model: of a robot with other joints", "refused", "compare m.json e.csv", "e.csv", "q2"),
    row("model: logs before it", "refused", "compare b.csv m.json", "b.csv", "not a model file"),
    row("model: twice, no log", "refused", "compare m.json m.json", "m.json", ".csv"),
]  # fmt: skip

GENERATE = "generate bad.json --out c"

EMITTED = [
    row("model: its C", "works", "generate m.json --out c"),
    model("its C, cut off", "refused", text(lambda t: t[: len(t) // 2]), "bad.json", run=GENERATE),
    model("its C, of another robot text", "refused",
          set_at("robot_text", to=lambda t: t.replace("9.81", "1.62")), CHANGED, run=GENERATE),
    row("model: its C with other effects", "refused", "generate m.json --effects offset --out c",
        "--effects"),
    row("model: a log for C", "refused", "generate a.csv --out c", "a.csv"),
]  # fmt: skip

EDITED = [
    model("format 1", "refused", set_at("format", to=1), "bad.json", "format 1"),
    model("format 99", "refused", set_at("format", to=99), "bad.json", "format 99"),
    model("signature", "refused", set_at("signature", to="0" * 16), "bad.json", CHANGED),
    model("a value 1 % larger", "refused", set_at(*VALUE, to=lambda v: 1.01 * v), "bad.json",
        CHANGED),
    model("a sigma null", "ends", set_at("fit", "parameters", 0, "sigma", to=None),
        "bad.json|error"),
    model("a parameter missing", "refused", gone("fit", "parameters", 3), "bad.json",
        "10 base|changed"),
    model("fit missing", "refused", gone("fit"), "bad.json", "fit"),
    model("covariance not a number", "refused", set_at("covariance", 0, 0, to=float("nan")),
          "bad.json"),
    model("robot text with another length", "refused",
          lambda r: r.update(robot_text=r["robot_text"].replace("L1 = 0.40", "L1 = 0.80")),
          CHANGED),
    model("sources that climb out of the folder", "refused",
          set_at("sources", to=lambda s: {**s, "../../evil.c": "int x;"}), "bad.json",
          run=COMPARE + " --run-embedded-c"),
    model("saved anew with other spaces", "works", lambda r: json.dumps(r, indent=4)),
    model("saved anew with keys sorted", "ends", lambda r: json.dumps(r, sort_keys=True),
          "error|checksum"),
    model("with line ends of Windows", "works", text(lambda t: t.replace("\n", "\r\n"))),
    model("edited, then diagnosed", "refused", set_at(*VALUE, to=5.0), "bad.json", CHANGED,
          run="diagnose bad.json b.csv --json d.json"),
    model("edited, then added to", "refused", set_at(*VALUE, to=5.0), "bad.json", CHANGED,
          run="add bad.json offset a.csv --out n.json"),
    model("undo of nothing", "refused", lambda r: None, "undo",
          run="add bad.json undo a.csv --out n.json"),
    model("history edited, then undone", "refused",
          set_at("history", 0, "robot_text", to=lambda t: t.replace("0.40", "0.9")), CHANGED,
          run="add bad.json undo a.csv --out n.json", of="added.json"),
]  # fmt: skip

ROWS = [*DAMAGED, *EMITTED, *EDITED]
