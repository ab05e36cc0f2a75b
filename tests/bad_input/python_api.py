"""From Python: shapes, kinds and values of arguments, and robots that are mixed up."""

from collections.abc import Callable
from functools import cache

import numpy as np

from modeler.api import compile_model, derive, diagnose, fit, generate, load, observe, own_effect
from modeler.estimation.model_file import IdentifiedModel, load_model
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


def _with(edit: Callable[[list[np.ndarray]], object]) -> Callable[[Workdir], object]:
    """Inverse dynamics of arguments that are edited in place."""

    def run(workdir: Workdir) -> object:
        model = compiled()
        arguments = [*arrays(), np.ones(len(model.spec.base))]
        edit(arguments)
        return model.inverse_dynamics(*arguments)

    return run


def _put(index: int, value: object) -> Callable[[Workdir], object]:
    return _with(lambda arguments: arguments.__setitem__(index, value))  # type: ignore


def _model(workdir: Workdir) -> IdentifiedModel:
    return load_model(workdir.inputs.folder / "m.json")


def _log(workdir: Workdir, name: str = "b.csv") -> str:
    return str(workdir.inputs.folder / name)


def _own(**definition: object) -> Callable[[Workdir], object]:
    return lambda workdir: own_effect(load("two-link"), "fan", **definition)


def _fit_mixed(workdir: Workdir) -> object:
    derivation = derive(load("two-link"))
    other = compiled("emps")
    return fit(derivation, generate(derivation), observe(other, [_log(workdir, "e.csv")]))


def _observed(**processing: object) -> Callable[[Workdir], object]:
    def run(workdir: Workdir) -> object:
        how = Processing(**processing)  # type: ignore
        return observe(compiled(), [_log(workdir, "a.csv")], how)

    return run


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
    call("columns first in memory", "works", _same(np.asfortranarray)),
    call("every second row of a larger array", "works",
         _same(lambda a: np.repeat(a, 2, axis=0)[::2])),
    call("read-only arrays", "works", _same(lambda a: np.frombuffer(a.tobytes()).reshape(a.shape))),
    call("q turned round", "refused", _put(0, np.ones((2, 3))), "q", "(2, 3)"),
    call("q of text", "refused", _put(0, np.array([["a", "b"]] * 3)), "q", "number"),
    call("q complex", "refused", _put(0, np.ones((3, 2)) * 1j), "q", "complex|real"),
    call("qd of other samples", "refused", _put(1, np.ones((4, 2))), "qd"),
    call("beta too short", "refused", _put(3, np.ones(3)), "beta"),
    call("beta of text", "refused", _put(3, ["x"] * 10), "beta"),
    call("no samples", "works", _with(lambda a: [
        a.__setitem__(k, np.ones((0, 2))) for k in range(3)])),
    call("a robot that is none", "refused", lambda w: load("ghost"), "ghost"),
    call("a log that is none", "refused", lambda w: observe(compiled(), ["no.csv"]), "no.csv"),
    call("no logs", "refused", lambda w: observe(compiled(), []), "log"),
    call("the log twice", "refused", lambda w: observe(compiled(), [_log(w), _log(w)]), "again"),
    call("the log of another robot", "refused", lambda w: observe(compiled(), [_log(w, "e.csv")]),
         "q2"),
    call("diagnose what no robot has", "refused",
         lambda w: diagnose(_model(w), [_log(w)], without=["ghost"]), "ghost"),
    call("held-out log is the log", "refused", lambda w: diagnose(_model(w), [_log(w)], [_log(w)]),
         "b.csv"),
    call("an observation of another robot", "refused", _fit_mixed, "two-link|emps"),
    call("a cut-off nan", "refused", _observed(position_cutoff=float("nan")), "position_cutoff"),
    call("a decimation of 0", "refused", _observed(decimation=0), "decimation"),
    call("derivatives of a wrong word", "refused", _observed(derivatives="both"), "derivatives"),
    call("a delay of nan", "refused", _observed(delay=float("nan")), "delay"),
    call("speed floors of one joint", "refused", _observed(speed_floors=(0.1,)), "speed_floors"),
    call("an effect with a quote in its title", "works",
         _own(columns={"Kf": "v"}, title='the "fan" \\ of\tit')),
    call("a generated folder below a log", "refused",
         lambda w: generate(derive(load("two-link")), w.inputs.folder / "a.csv" / "c"), "a.csv"),
]  # fmt: skip
