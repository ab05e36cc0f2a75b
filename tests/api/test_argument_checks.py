"""Arguments of a wrong kind are refused in one line before a function of the API begins."""

import inspect
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import modeler.api as api
from modeler.api.arguments import fitting
from modeler.core.errors import DataError

FUNCTIONS = {name: f for name in api.__all__ if inspect.isfunction(f := getattr(api, name))}
SOME: Any = inspect.Parameter.empty


def arguments(function: Any) -> list[inspect.Parameter]:
    every = inspect.signature(function).parameters.values()
    return [p for p in every if p.kind is not inspect.Parameter.VAR_KEYWORD]


@pytest.mark.parametrize("name", [n for n, f in FUNCTIONS.items() if arguments(f)])
def test_every_function_refuses_what_is_of_no_kind(name: str) -> None:
    """Of every function that there is, so of one that is added later too."""
    needed = {p.name: object() for p in arguments(FUNCTIONS[name]) if p.default is SOME}
    if not needed:
        needed = {arguments(FUNCTIONS[name])[0].name: object()}
    with pytest.raises(DataError, match=rf"^{name}: got a object as {next(iter(needed))}; exp"):
        FUNCTIONS[name](**needed)


@pytest.mark.parametrize(
    ("name", "given", "message"),
    [
        ("compare", ("arm.model.json", []), r"the text 'arm\.model\.json' as model; expected a mo"),
        ("simulate", ("demo-arm", "z.parquet"), r"the text 'demo-arm' as robot; .*load gives one"),
        ("save", (3, "x"), "got 3 as thing; expected a model .* or a robot"),
        ("contest", ([1, 2], []), "got 1 as models; expected a mapping of names, each to a model"),
        ("open_model", (None,), "got None as path; expected a text or a path"),
        ("derive", (Path("arm.toml"),), r"got the path arm\.toml as robot"),
        ("Load", (3, 2.0), "got 3 as logs; expected a list, each a text or a path or a log"),
    ],
)
def test_the_line_says_what_was_got_and_what_was_expected(
    name: str, given: Any, message: str
) -> None:
    with pytest.raises(DataError, match=message) as error:
        getattr(api, name)(*given)
    assert str(error.value).startswith(f"{name}: ") and "\n" not in str(error.value)


def test_one_log_alone_is_a_list_of_it(tmp_path: Path) -> None:
    """A text was once taken for a list of letters."""
    robot = api.load("two-link")
    place = tmp_path / "run.parquet"
    run = api.simulate(robot, place, duration=2.0, seed=1)
    compiled = api.compile_model(api.generate(api.derive(robot)))
    for alone in (str(place), place, run, api.read_logs(compiled, [place])[0]):
        (log,) = api.read_logs(compiled, alone)  # type: ignore[arg-type]
        np.testing.assert_array_equal(log.q, run.q)
    assert api.Load(str(place), 2.0).logs == [str(place)]


def test_what_fits_is_left_as_it_is() -> None:
    """Numbers of numpy are numbers, and any series of things is a list of them."""
    given = {"1": np.array([0.0, 1.0])}
    hint = api.excite.__wrapped__.__annotations__["limits"]  # type: ignore[attr-defined]
    assert fitting("f", "limits", hint, given) is given
    assert fitting("f", "x", float, np.float32(2.0)) == 2.0
    with pytest.raises(DataError, match="got the text '2' as x; expected a number"):
        fitting("f", "x", float, "2")
