"""The examples in docstrings of what Python users are offered print what they say."""

import doctest
import importlib
import inspect
from pathlib import Path
from typing import Any

import pytest

import modeler.api as api

OFFERED = {name: thing for name in api.__all__ if inspect.isroutine(thing := getattr(api, name))}
MODULES = sorted(
    {
        "modeler.core.table",
        "modeler.logs.readers",
        "modeler.api.model",
        *(thing.__module__ for thing in OFFERED.values()),
    }
)
WITHOUT = {
    "load_on_gpu": "needs a graphics processor",
    "discriminating_motion": "takes long; docs/how-to/excitation.md has one",
    "fit_gains": "needs logs of currents with a load; docs/how-to/drive-gains.md has one",
}


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """What examples have before they begin: a robot in its steps, two runs, a model.

    Its first joint has a spring that the robot file lacks.
    """
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("examples"))
        Path("arm.toml").write_text("# of somebody else\n", encoding="utf-8")
        robot = api.load("two-link")
        for seed, name in enumerate(("mon.parquet", "tue.parquet"), start=1):
            api.simulate(robot, name, hide=["spring@1"], duration=6.0, seed=seed)
        derivation = api.derive(robot)
        emitted = api.generate(derivation)
        yield {
            **{name: getattr(api, name) for name in api.__all__},
            "robot": robot,
            "derivation": derivation,
            "emitted": emitted,
            "compiled": api.compile_model(emitted),
            "model": api.identify(robot, "mon.parquet", "tue.parquet"),
        }


def examples(module: str, names: dict[str, Any] | None = None) -> list[doctest.DocTest]:
    result = doctest.DocTestFinder().find(importlib.import_module(module), extraglobs=names)
    return [example for example in result if example.examples]


def test_every_function_has_an_example() -> None:
    there = {example.name for module in MODULES for example in examples(module)}
    lacking = {n for n, f in OFFERED.items() if f"{f.__module__}.{f.__name__}" not in there}
    assert lacking == WITHOUT.keys()
    methods = [
        n
        for n, f in vars(api.Model).items()
        if not n.startswith("_") and f.__doc__ and (inspect.isroutine(f) or isinstance(f, property))
    ]
    lacking = {n for n in methods if f"modeler.api.model.Model.{n}" not in there}
    assert lacking <= {"from_identified", "find_logs", "fittedvalues"} and len(methods) > 12


ROTATE = tuple(f"modeler.api.{name}" for name in "motion checks fitting fleets workflow".split())
MARKS = {
    **dict.fromkeys(("modeler.api.improve", "modeler.api.model"), pytest.mark.slow),  # diagnose
    **dict.fromkeys(ROTATE, pytest.mark.rotating),
}


@pytest.mark.parametrize(
    "module", [pytest.param(name, marks=MARKS.get(name, ())) for name in MODULES if examples(name)]
)
def test_examples_print_what_they_say(module: str, names: dict[str, Any]) -> None:
    for example in examples(module, names):
        said: list[str] = []
        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        assert runner.run(example, out=said.append).failed == 0, "".join(said)
    assert Path("mon.parquet").is_file()
