"""A paper's machine in simulation: its compiled model, and what is logged of its runs."""

import numpy as np

from modeler.codegen.workflow import Derivation, generate
from modeler.observation.log import Log
from modeler.runtime.model import CompiledModel, load
from modeler.simulation import SimulatedLog


def compiled_robot(derivation: Derivation) -> CompiledModel:
    """The robot as its C says."""
    emitted = generate(derivation)
    return load(emitted.spec, emitted.code)


def logged(
    run: SimulatedLog, joints: tuple[str, ...], tau: np.ndarray, source: str = "tau{}"
) -> Log:
    """A simulated run as a log of some joints, with torques (samples, joints) of its own."""
    at = [run.joints.index(joint) for joint in joints]
    sources = tuple(source.format(joint) for joint in joints)
    name = f"run{run.settings.seed}"
    return Log(name, joints, run.time, run.q[:, at], tau, torque_source=sources)
