"""Motions in closed form, and logs of models whose torques they make exactly."""

import dataclasses

import numpy as np

from modeler.core.manifest import JointSpec
from modeler.regression.log import Log
from tests.oracles.numpy_model import rotor


def fourier(random, t, joints, fastest, size, slowest=0.1, falling=False):
    """Time, q, qd, qdd of three sines a joint: Hz and sizes drawn, these as 1/k if falling."""
    w = 2 * np.pi * random.uniform(slowest, fastest, (3, joints))
    a = random.uniform(*size, w.shape)
    a = a / np.arange(1, 4)[:, None] if falling else a
    angle = t[:, None, None] * w + random.uniform(0.0, 6.0, w.shape)
    sine, cosine = np.sin(angle), np.cos(angle)
    return t, (a * sine).sum(1), (a * w * cosine).sum(1), -(a * w**2 * sine).sum(1)


def motion(joints, seconds=20.0, rate=200, seed=0):
    """Sums of sines and their exact derivatives; (time, q, qd, qdd)."""
    t = np.arange(int(seconds * rate)) / rate
    return fourier(np.random.default_rng(seed), t, joints, 0.5, (0.3, 1.0))


def exact_log(model, beta, name="run", logged=True, **how):
    t, q, qd, qdd = motion(len(model.spec.joints), **how)
    tau = model.base_regressor(q, qd, qdd) @ beta
    names = tuple(joint.name for joint in model.spec.joints)
    return Log(name, names, t, q, tau, qd if logged else None, qdd if logged else None)


def some_beta(model, seed=5):
    return np.random.default_rng(seed).uniform(0.5, 2.0, len(model.spec.base))


def noisy_torque(random, model, q, qd, qdd, noise=None):
    """Torques with that share of white noise, drawn if None, and the parameters of them."""
    beta = random.uniform(0.5, 2.0, len(model.spec.base))
    tau = model.base_regressor(q, qd, qdd) @ beta
    noise = 10 ** random.uniform(-3.0, -1.0) if noise is None else noise
    return tau + noise * np.sqrt(np.mean(tau**2, axis=0)) * random.normal(size=tau.shape), beta


def root_mean_square(seen, beta):
    """Of what parameters leave."""
    return float(np.sqrt(np.mean((seen.W @ beta - seen.y) ** 2)))


def write(path, log, **more):
    """The log as a CSV file, and columns besides."""
    columns = {"time": log.time}
    for name in ("q", "qd", "qdd", "tau"):
        values = getattr(log, name)
        if values is not None:
            columns |= {f"{name}{j}": x for j, x in zip(log.joints, values.T, strict=True)}
    columns |= more
    table = np.column_stack(list(columns.values()))
    np.savetxt(path, table, delimiter=",", header=",".join(columns), comments="", fmt="%.12g")
    return str(path)


def manifest_of(names, slides=()):
    """A manifest for a log of which only the columns are known."""
    joints = tuple(
        JointSpec(
            n,
            "prismatic" if n in slides else "revolute",
            "m" if n in slides else "rad",
            "N m",
            True,
            1.0,
        )
        for n in names
    )
    return dataclasses.replace(rotor().spec, joints=joints)
