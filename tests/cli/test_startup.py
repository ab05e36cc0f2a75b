"""What answers at once loads nothing that takes long; an interrupt ends the program in one line."""

import json
import subprocess
import sys
from typing import get_args

import pytest

from modeler.cli.derive import _COMMENT
from modeler.cli.parser import Form, read_commands
from modeler.effects.catalogue import CATALOGUE
from modeler.simulation import HIDDEN
from tests.rotation import rotating

LONG = set(
    """
    sympy numpy scipy casadi pyarrow matplotlib plotly rich jinja2 cffi threadpoolctl flint
""".split()
)

# Runs commands one after the other in one process: what one of them loads, the next ones have.
_TRACED = """
import contextlib, io, json, sys
from modeler.cli import main
told = []
for words in json.loads(sys.argv[1]):
    out = io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
        try:
            status = main(words)
        except SystemExit as stop:
            status = stop.code
    found = {name.split(".")[0] for name in sys.modules}
    found |= {name for name in sys.modules if name.startswith("scipy.") and name.count(".") == 1}
    told.append((status, bool(out.getvalue()), sorted(found)))
print(json.dumps(told))
"""


def loaded(*commands: tuple[str, ...]) -> list[tuple[int, bool, set[str]]]:
    """Of each run in a new process: status, whether it said something, all that is loaded by now:
    top-level packages and those of scipy.
    """
    command = [sys.executable, "-c", _TRACED, json.dumps(commands)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    return [(status, said, set(names)) for status, said, names in json.loads(done.stdout)]


SHORT = [
    *(((word,), 0) for word in ("--help", "--version", "robots", "effects")),
    *((words.split(), 0) for words in ("effects load_friction", "robots wrist")),
    *(((name, "--help"), 0) for name in read_commands()),
    ((), 2),
    (("dance",), 2),
    (("fit",), 2),
    (("fit", "emps", "--method", "x"), 2),
    (("derive", "arm", "--no-such-option"), 2),
    (("demo", "--duration", "long"), 2),
    (("derive", "wrist", "--json", "."), 1),
]


def test_what_answers_at_once_loads_nothing_long() -> None:
    result = loaded(*(words for words, _ in SHORT))
    for (words, status), (ended, said, packages) in zip(SHORT, result, strict=True):
        assert ended == status and said == (status == 0), words
        assert not packages & LONG, words


PICTURES = {"matplotlib", "rich", "h5py", "rosbags", "IPython"}
SLOW = {"scipy.signal", "scipy.stats", "scipy.interpolate", "scipy.optimize", "scipy.io"}
NUMBERS = {"scipy", "pyarrow", "cffi", "pandas", "threadpoolctl", "clarabel"}
SYMBOLS = {"sympy", "casadi", "jinja2", "flint"}


# Commands of one process, each with what it has no use for.
LONGER = [
    [("derive scara", PICTURES | NUMBERS | {"jinja2"})],
    [
        ("generate scara --out {out}/c", PICTURES | NUMBERS | {"casadi"}),
        ("home five-bar", PICTURES | NUMBERS),
    ],
    [("show wrist --out {out}/w.html", PICTURES | NUMBERS | SYMBOLS - {"jinja2"})],
    [("log {}/a.parquet", PICTURES | {"pandas", "casadi", "clarabel", "threadpoolctl"})],
    [
        ("fit two-link {}/a.parquet --out {out}/n.json", PICTURES | SLOW | {"pandas", "casadi"}),
        ("compare {0}/m.json {0}/a.parquet", PICTURES | {"pandas", "casadi"}),
        ("diagnose {0}/m.json {0}/a.parquet", PICTURES | {"pandas", "casadi"}),
    ],
]


@pytest.mark.parametrize(
    "commands", [LONGER[0], *rotating(*LONGER[1:])], ids=lambda each: each[0][0].split()[0]
)
def test_a_command_loads_nothing_long_that_it_has_no_use_for(two_link, tmp_path, commands) -> None:
    lines = (words.format(two_link, out=tmp_path).split() for words, _ in commands)
    result = loaded(*map(tuple, lines))
    for (words, unused), (status, _, packages) in zip(commands, result, strict=True):
        assert status == 0 and not packages & unused, words
        if words == "derive scara":  # long packages would be noticed
            assert packages >= {"sympy", "numpy", "flint"}


def test_choices_are_those_that_commands_know() -> None:
    for forms in (_COMMENT,):
        assert set(forms) == set(get_args(Form))
    simulated = {effect.id for effect in CATALOGUE} - {"torque_lag"}  # filters of drives are not
    assert set(HIDDEN) == simulated  # what --hide offers


# Plays a user who presses Ctrl-C while the last package of the command is loaded, and a package
# that swallows what is raised in it.
_INTERRUPTED = """
import os, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # a background job may have it ignored
wanted = sys.argv.pop(1)
class Slow:
    def find_spec(self, name, path=None, target=None):
        if name == wanted:
            try:
                os.kill(os.getpid(), signal.SIGINT)
                for _ in range(1000): pass
            except BaseException:
                pass
sys.meta_path.insert(0, Slow())
from modeler.cli import main
sys.exit(main())
"""


@pytest.mark.parametrize("package", ["argparse", "sympy"])
def test_an_interrupt_while_loading_is_one_line(package: str) -> None:
    command = [sys.executable, "-c", _INTERRUPTED, package, "derive", "two-link"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr == "modeler: interrupted\n"
