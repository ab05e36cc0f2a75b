"""Runs of currents with and without a load, and what is true of them."""

from dataclasses import dataclass

import numpy as np

from modeler.api import load
from modeler.estimation.payload import Payload
from modeler.regression import Log, Observation, observe
from modeler.robot import replace_drive_gains
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulatedLog, SimulationSettings, parse_hidden_effect, simulate
from tests.chain import chain_of

BARE, LOADED = "bare", "loaded"


@dataclass(frozen=True, eq=False)
class Runs:
    """A bare and a loaded run of ideal sensors.

    Attributes:
        compiled: the robot.
        bare, loaded: what was simulated.
        mass: kg, of the load.
        beta: (c,) true base parameters of the bare robot.
    """

    compiled: CompiledModel
    bare: SimulatedLog
    loaded: SimulatedLog
    mass: float
    beta: np.ndarray

    def logs(self, gains: np.ndarray, noise: float, seed: int) -> list[Log]:
        """Both logs with currents tau / gains in place of torques, read with gains of 1.

        Args:
            gains: (n,) true ones.
            noise: of the torques, share of their rms.
            seed: of the noise.
        """
        rng, logs = np.random.default_rng(seed), []
        joints = tuple(joint.name for joint in self.compiled.spec.joints)
        sources = tuple(f"current{joint} x 1" for joint in joints)
        for run, name in ((self.bare, BARE), (self.loaded, LOADED)):
            rms = np.sqrt(np.mean(run.tau**2, axis=0))
            tau = run.tau + noise * rms * rng.normal(size=run.tau.shape)
            logs.append(Log(name, joints, run.time, run.q, tau / gains, torque_source=sources))
        return logs

    def seen(self, gains: np.ndarray, noise: float = 0.02, seed: int = 0) -> Observation:
        """The observation of both logs."""
        return observe(self.compiled, self.logs(gains, noise, seed))

    def payload(self, mass: float | None = None) -> Payload:
        """The load, of its true mass if no other is given."""
        return Payload((LOADED,), mass=self.mass if mass is None else mass)


def runs_of(robot: str, mass: float, duration: float, rate: float) -> Runs:
    """A bare and a loaded run of a built-in robot with drive gains of 1; the rest is drawn."""
    source = load(robot)
    ones = {joint.name: 1.0 for joint in source.coordinates}
    chain = chain_of(replace_drive_gains(source.text, ones))
    compiled = chain.compiled
    load_of = parse_hidden_effect(f"payload:mass={mass}")
    bare, loaded = (
        simulate(
            chain.derivation.robot,
            SimulationSettings(
                duration=duration, rate=rate, seed=seed, torque_noise=0.0, hidden=hidden
            ),
        )
        for seed, hidden in ((1, ()), (2, (load_of,)))
    )
    truth = bare.truth.parameters
    beta = [sum(t.value * truth[t.parameter] for t in base.terms) for base in compiled.spec.base]
    return Runs(compiled, bare, loaded, mass, np.array(beta))
