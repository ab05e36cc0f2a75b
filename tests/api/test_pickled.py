"""What Python users hold goes to other processes and machines, and is copied: joblib."""

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import modeler.api as api
from tests.notebook.session import session
from tests.rotation import rotating

KINDS = (
    *("robot", "derivation", "emitted", "compiled", "simulated", "log", "observation", "model"),
    *rotating("better", "diagnosis", "fleet", "free run", "contest", "estimators", "modes"),
    *rotating("comparison", "motion", "physical"),
)


def by_pickle(thing: Any) -> Any:
    return pickle.loads(pickle.dumps(thing))


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_pickled_and_copied(kind: str) -> None:
    thing = session()[kind]
    for again in (by_pickle(thing), copy.deepcopy(thing)):
        assert again is not thing and repr(again) == repr(thing)
        assert again.summary() == thing.summary()


def torque(compiled: api.CompiledModel, beta: np.ndarray) -> np.ndarray:
    motion = np.random.default_rng(3).normal(size=(3, 40, len(compiled.spec.joints)))
    return compiled.inverse_dynamics(*motion, beta)


def computed(compiled: api.CompiledModel, seen: api.Observation, model: Any, log: Any) -> list[Any]:
    """What another process makes of them; a regressor is evaluated by the compiled robot."""
    error = api.compare(model, [log]).relative_error
    return [torque(compiled, model.beta), seen.W, np.array(error)]


GIVEN = ("compiled", "observation", "model", "log")


@pytest.mark.parametrize("copied", [by_pickle, copy.deepcopy])
def test_what_was_copied_computes_the_same(copied: Any) -> None:
    made = session()
    fresh = api.observe(made["compiled"], [made["log"]])
    expected = computed(made["compiled"], fresh, made["model"], made["log"])
    for one, other in zip(computed(*(copied(made[n]) for n in GIVEN)), expected, strict=True):
        np.testing.assert_array_equal(one, other)
    assert api.generate(copied(made["derivation"])).code == made["emitted"].code


@pytest.mark.slow  # some seconds
def test_through_joblib() -> None:
    joblib = pytest.importorskip("joblib")
    inputs = [session()[name] for name in GIVEN]
    results = joblib.Parallel(n_jobs=2)(joblib.delayed(computed)(*inputs) for _ in range(2))
    for result in results:
        for one, other in zip(result, computed(*inputs), strict=True):
            np.testing.assert_array_equal(one, other)
