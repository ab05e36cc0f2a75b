"""What Python users hold goes to other processes and machines, and is copied: joblib, Dask."""

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import modeler.api as api
from tests.notebook.session import session

KINDS = (
    "robot", "derivation", "emitted", "compiled", "simulated", "log", "observation", "model", "fit",
    "better", "comparison", "diagnosis", "fleet", "free run", "contest", "estimators", "modes",
    "motion", "physical",
)  # fmt: skip


def torque(compiled: api.CompiledModel, beta: np.ndarray) -> np.ndarray:
    motion = np.random.default_rng(3).normal(size=(3, 40, len(compiled.spec.joints)))
    return compiled.inverse_dynamics(*motion, beta)


@pytest.mark.parametrize("copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
@pytest.mark.parametrize("kind", KINDS)
def test_it_is_pickled_and_copied(kind: str, copied: Any) -> None:
    thing = session()[kind]
    again = copied(thing)
    assert again is not thing and repr(again) == repr(thing)
    assert again.summary() == thing.summary()


@pytest.mark.parametrize("copied", [lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy])
def test_what_was_copied_computes_the_same(copied: Any) -> None:
    made = session()
    beta = made["model"].beta
    np.testing.assert_array_equal(
        torque(copied(made["compiled"]), beta), torque(made["compiled"], beta)
    )
    seen = copied(made["observation"])  # its regressor is evaluated by the copy's compiled robot
    fresh = api.observe(made["compiled"], [made["log"]])
    np.testing.assert_array_equal(seen.W, fresh.W)
    error = api.compare(copied(made["model"]), [copied(made["log"])]).relative_error
    assert error == api.compare(made["model"], [made["log"]]).relative_error
    assert api.generate(copied(made["derivation"])).code == made["emitted"].code


def elsewhere(compiled: api.CompiledModel, seen: api.Observation, model: Any, log: Any) -> Any:
    """What another process makes of them."""
    return torque(compiled, model.beta), float(seen.W.sum()), api.compare(model, [log]).samples


def check(found: Any) -> None:
    made = session()
    values, total, samples = found
    np.testing.assert_array_equal(values, torque(made["compiled"], made["model"].beta))
    assert total == float(made["observation"].W.sum())
    assert samples == api.compare(made["model"], [made["log"]]).samples


@pytest.mark.slow  # some seconds
def test_through_joblib() -> None:
    joblib = pytest.importorskip("joblib")
    made = session()
    given = [made[name] for name in ("compiled", "observation", "model", "log")]
    jobs = joblib.Parallel(n_jobs=2)(joblib.delayed(elsewhere)(*given) for _ in range(2))
    for found in jobs:
        check(found)


@pytest.mark.slow  # a cluster starts in some seconds
def test_through_dask() -> None:
    distributed = pytest.importorskip("distributed")
    made = session()
    given = [made[name] for name in ("compiled", "observation", "model", "log")]
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as own,
        distributed.Client(own) as client,
    ):
        check(client.submit(elsewhere, *given, pure=False).result(timeout=120))
