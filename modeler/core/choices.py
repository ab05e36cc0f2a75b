"""Choices that a user is offered, where parsers and the stages that make them both can look."""

from typing import Literal

Method = Literal[
    "weighted", "ordinary", "robust", "ridge", "iv", "iv-direct", "didim", "consistent",
]  # fmt: skip
"""Estimators; `core.estimators` says what each is."""

ModelKind = Literal["torque", "energy"]
"""What a row of the fit states: a joint's torque, or the energy balance of a window."""

Precision = Literal["double", "single"]
"""Of the emitted C: its numbers are `double`, or `float`."""

GAIN_METHOD = "tls"
"""Total least squares, for drive gains besides."""

TWO_STEPS = "two-step"
"""Each joint that moves alone, then the parameters."""

Derivatives = Literal["auto", "log", "position"]
"""Whether velocities are taken from the log or differentiated; auto: the quieter."""

LOW_SPEED = 0.02
"""Rows below this share of a joint's top speed are left out, where friction depends on its sign."""
