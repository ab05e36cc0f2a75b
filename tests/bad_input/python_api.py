"""From Python: shapes, kinds and values of arguments, and robots that are mixed up."""

from collections.abc import Callable, Mapping
from functools import cache

import numpy as np

from modeler.api import compile_model, derive, fit, generate, load, observe, own_effect
from modeler.observation.settings import Processing
from modeler.runtime.model import CompiledModel
from tests.bad_input.row import Outcome, Row, row
from tests.bad_input.workdir import Workdir


@cache
def compiled(name: str = "two-link") -> CompiledModel:
    return compile_model(generate(derive(load(name))))


def arrays(rows: int = 3, joints: int = 2) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """q, qd, qdd of some samples."""
    grid = np.linspace(0.1, 0.5, rows * joints).reshape(rows, joints)
    return grid, grid + 1, grid + 2


def call(what: str, outcome: Outcome, run: Callable[[Workdir], object], *words: str) -> Row:
    """A row of a call."""
    return row(f"python: {what}", outcome, run, *words)


def _with(others: Mapping[int, np.ndarray]) -> Callable[[Workdir], object]:
    """Inverse dynamics of arguments of which some are others."""

    def run(workdir: Workdir) -> object:
        model = compiled()
        arguments = dict(enumerate([*arrays(), np.ones(len(model.spec.base))])) | others
        return model.inverse_dynamics(*arguments.values())

    return run


def _fit_mixed(workdir: Workdir) -> object:
    derivation = derive(load("two-link"))
    other = compiled("emps")
    return fit(derivation, generate(derivation), observe(other, [workdir.inputs.folder / "e.csv"]))


def _same(change: Callable[[np.ndarray], object]) -> Callable[[Workdir], object]:
    """Arguments in another kind of array give the same torques."""

    def run(workdir: Workdir) -> None:
        model = compiled()
        beta = np.ones(len(model.spec.base))
        want = model.inverse_dynamics(*arrays(), beta)
        got = model.inverse_dynamics(*(change(a) for a in arrays()), beta)
        np.testing.assert_allclose(got, want, rtol=1e-6)

    return run


ROWS = [
    call("lists for arrays", "works", _same(lambda a: a.tolist())),
    call("single precision", "works", _same(lambda a: a.astype(np.float32))),
    call("every second row of a larger array", "works",
         _same(lambda a: np.repeat(a, 2, axis=0)[::2])),
    call("q of text", "refused", _with({0: np.array([["a", "b"]] * 3)}), "q", "number"),
    call("beta too short", "refused", _with({3: np.ones(3)}), "beta"),
    call("no samples", "works", _with(dict.fromkeys(range(3), np.ones((0, 2))))),
    call("no logs", "refused", lambda w: observe(compiled(), []), "log"),
    call("an observation of another robot", "refused", _fit_mixed, "two-link|emps"),
    call("a delay of nan", "refused", lambda w: Processing(delay=float("nan")), "delay"),
    call("speed floors of one joint", "refused", lambda w: Processing(speed_floors=(0.1,)),
         "speed_floors"),
    call("an effect with a quote in its title", "works",
         lambda w: own_effect(load("two-link"), "fan", columns={"Kf": "v"},
                              title='the "fan" \\ of\tit')),
]  # fmt: skip
