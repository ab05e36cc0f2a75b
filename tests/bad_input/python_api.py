"""From Python: shapes, kinds and values of arguments, and robots that are mixed up."""

from collections.abc import Callable

import numpy as np

from modeler.api import (
    compare,
    compile_model,
    derive,
    diagnose,
    fit,
    generate,
    load,
    observe,
    own_effect,
)
from modeler.estimation.model_file import IdentifiedModel, load_model
from modeler.observation.settings import Processing
from modeler.runtime.model import CompiledModel
from tests.bad_input.row import Outcome, Row, row
from tests.bad_input.yard import Yard


def compiled(name: str = "two-link") -> CompiledModel:
    """The compiled robot; from the cache after the first time."""
    return compile_model(generate(derive(load(name))))


def arrays(rows: int = 3, joints: int = 2) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """q, qd, qdd of some samples."""
    grid = np.linspace(0.1, 0.5, rows * joints).reshape(rows, joints)
    return grid, grid + 1, grid + 2


def call(what: str, outcome: Outcome, run: Callable[[Yard], object], *words: str) -> Row:
    """A row of a call."""
    return row(f"python: {what}", outcome, run, *words)


def _with(edit: Callable[[list[np.ndarray]], object]) -> Callable[[Yard], object]:
    """Inverse dynamics of arguments that are edited in place."""

    def run(yard: Yard) -> object:
        model = compiled()
        arguments = [*arrays(), np.ones(len(model.spec.base))]
        edit(arguments)
        return model.inverse_dynamics(*arguments)

    return run


def _put(index: int, value: object) -> Callable[[Yard], object]:
    return _with(lambda arguments: arguments.__setitem__(index, value))  # type: ignore


def _model(yard: Yard) -> IdentifiedModel:
    return load_model(yard.ground.folder / "m.json")


def _log(yard: Yard, name: str = "b.csv") -> str:
    return str(yard.ground.folder / name)


def _own(**definition: object) -> Callable[[Yard], object]:
    return lambda yard: own_effect(load("two-link"), "fan", **definition)


def _fit_mixed(yard: Yard) -> object:
    derivation = derive(load("two-link"))
    other = compiled("emps")
    return fit(derivation, generate(derivation), observe(other, [_log(yard, "e.csv")]))


def _fit_mixed_emitted(yard: Yard) -> object:
    observation = observe(compiled(), [_log(yard, "a.csv")])
    return fit(derive(load("two-link")), generate(derive(load("emps"))), observation)


def _observed(**processing: object) -> Callable[[Yard], object]:
    def run(yard: Yard) -> object:
        how = Processing(**processing)  # type: ignore
        return observe(compiled(), [_log(yard, "a.csv")], how)

    return run


def _vector(yard: Yard) -> object:
    model = compiled()
    tau = model.inverse_dynamics(*arrays(), np.ones(len(model.spec.base)))
    assert np.isfinite(tau).all()
    return tau


def _same(change: Callable[[np.ndarray], object]) -> Callable[[Yard], object]:
    """Arguments in another kind of array give the same torques."""

    def run(yard: Yard) -> None:
        model = compiled()
        beta = np.ones(len(model.spec.base))
        want = model.inverse_dynamics(*arrays(), beta)
        got = model.inverse_dynamics(*(change(a) for a in arrays()), beta)
        np.testing.assert_allclose(got, want, rtol=1e-6)

    return run


ROWS = [
    call("good arrays", "works", _vector),
    call("lists for arrays", "works", _same(lambda a: a.tolist())),
    call("single precision", "works", _same(lambda a: a.astype(np.float32))),
    call("columns first in memory", "works", _same(np.asfortranarray)),
    call("every second row of a larger array", "works",
         _same(lambda a: np.repeat(a, 2, axis=0)[::2])),
    call("read-only arrays", "works", _same(lambda a: np.frombuffer(a.tobytes()).reshape(a.shape))),
    call("arrays of the other byte order", "works", _same(lambda a: a.astype(">f8"))),
    call("q of three joints", "refused", _put(0, np.ones((3, 3))), "q", "(3, 3)", "2"),
    call("q turned round", "refused", _put(0, np.ones((2, 3))), "q", "(2, 3)"),
    call("q of one dimension", "refused", _put(0, np.ones(5)), "q"),
    call("q of three dimensions", "refused", _put(0, np.ones((3, 2, 1))), "q"),
    call("q of text", "refused", _put(0, np.array([["a", "b"]] * 3)), "q", "number"),
    call("q of objects", "refused", _put(0, np.array([[None, {}]] * 3, dtype=object)), "q",
        "number"),
    call("q complex", "refused", _put(0, np.ones((3, 2)) * 1j), "q", "complex|real"),
    call("qd of other samples", "refused", _put(1, np.ones((4, 2))), "qd"),
    call("beta too short", "refused", _put(3, np.ones(3)), "beta"),
    call("beta too long", "refused", _put(3, np.ones(99)), "beta"),
    call("beta of two dimensions", "refused", _put(3, np.ones((10, 10))), "beta"),
    call("beta of text", "refused", _put(3, ["x"] * 10), "beta"),
    call("no samples", "works", _with(lambda a: [
        a.__setitem__(k, np.ones((0, 2))) for k in range(3)])),
    call("a robot that is none", "refused", lambda y: load("ghost"), "ghost"),
    call("a robot from a folder", "refused", lambda y: load(str(y.work)), "folder"),
    call("a log that is none", "refused", lambda y: observe(compiled(), ["no.csv"]), "no.csv"),
    call("no logs", "refused", lambda y: observe(compiled(), []), "log"),
    call("the log twice", "refused", lambda y: observe(compiled(), [_log(y), _log(y)]), "again"),
    call("the log of another robot", "refused", lambda y: observe(compiled(), [_log(y, "e.csv")]),
         "q2"),
    call("diagnose without logs", "refused", lambda y: diagnose(_model(y), []), "log"),
    call("compare with the log of another robot", "refused",
         lambda y: compare(_model(y), [_log(y, "e.csv")]), "q2"),
    call("diagnose what no robot has", "refused",
         lambda y: diagnose(_model(y), [_log(y)], without=["ghost"]), "ghost"),
    call("held-out log is the log", "refused", lambda y: diagnose(_model(y), [_log(y)], [_log(y)]),
         "b.csv"),
    call("an observation of another robot", "refused", _fit_mixed, "two-link|emps"),
    call("C of another robot", "refused", _fit_mixed_emitted, "two-link|emps"),
    call("a cut-off nan", "refused", _observed(position_cutoff=float("nan")), "position_cutoff"),
    call("a cut-off negative", "refused", _observed(position_cutoff=-1.0), "position_cutoff"),
    call("a cut-off of text", "refused", _observed(position_cutoff="fast"), "position_cutoff"),
    call("a decimation of 0", "refused", _observed(decimation=0), "decimation"),
    call("derivatives of a wrong word", "refused", _observed(derivatives="both"), "derivatives"),
    call("a delay of nan", "refused", _observed(delay=float("nan")), "delay"),
    call("a delay of an hour", "refused", _observed(delay=3600.0), "delay"),
    call("speed floors of one joint", "refused", _observed(speed_floors=(0.1,)), "speed_floors"),
    call("an edge below zero", "refused", _observed(edge=-1.0), "edge"),
    call("an effect with a quote in its title", "works",
         _own(columns={"Kf": "v"}, title='the "fan" \\ of\tit')),
    call("an effect with a number for a column", "works", _own(columns={"Kf": 3})),
    call("a generated folder below a log", "refused",
         lambda y: generate(derive(load("two-link")), y.ground.folder / "a.csv" / "c"), "a.csv"),
]  # fmt: skip
