"""Predictions with a known defect: smooth motion, a made-up torque, white noise, one flaw."""

import dataclasses
from collections.abc import Callable

import numpy as np

from modeler.validation.prediction import JointInfo, Prediction

Defect = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray], np.ndarray]
PERIOD = 0.01  # s
NOISE = 0.5  # N m


def prediction(defect=None, on=1, noise=NOISE, seed=0, rows=6000):
    """Three joints, two logs of rows/2 samples, one segment each.

    The predicted torque is exact but for `defect(q, qd, qdd, tau, time)` of joint `on`, which
    only the measurement has; `time` runs on over both logs here, so it is unique.
    """
    rng = np.random.default_rng(seed)
    time = np.arange(rows) * PERIOD
    q, qd, qdd = (np.zeros((rows, 3)) for _ in range(3))
    run = np.arange(rows) * 2 // rows
    for log in (0, 1):
        part = run == log
        for joint in range(3):
            for harmonic in range(1, 7):
                w = 2 * np.pi * 0.1 * harmonic * (1 + 0.07 * joint)
                a, b = rng.normal(size=2) / harmonic
                s, c = np.sin(w * time[part]), np.cos(w * time[part])
                q[part, joint] += a * s + b * c
                qd[part, joint] += w * (a * c - b * s)
                qdd[part, joint] -= w * w * (a * s + b * c)
    tau = 2.0 * qdd + 8.0 * np.cos(q) + 3.0 * qd + 2.0 * np.sign(qd)
    measured = tau + noise * rng.normal(size=tau.shape)
    if defect is not None:
        measured[:, on] += defect(q[:, on], qd[:, on], qdd[:, on], tau[:, on], time)
    return Prediction(
        robot="three",
        joints=tuple(JointInfo(name, "rad", "N m") for name in ("1", "2", "3")),
        logs=("one.parquet", "two.parquet"),
        run=run,
        segment=run.copy(),
        time=time,
        q=q,
        qd=qd,
        qdd=qdd,
        measured=measured,
        predicted=tau,
        used=np.ones((rows, 3), dtype=bool),
    )


def first_joint(whole: Prediction) -> Prediction:
    """The prediction of the first joint alone."""
    names = ("q", "qd", "qdd", "measured", "predicted", "used")
    columns = {name: getattr(whole, name)[:, :1] for name in names}
    return dataclasses.replace(whole, joints=whole.joints[:1], **columns)


def judged_alone(whole: Prediction, joint: int = 1) -> Prediction:
    """The same, and only one joint is looked at."""
    used = np.zeros_like(whole.used)
    used[:, joint] = whole.used[:, joint]
    return dataclasses.replace(whole, used=used)
