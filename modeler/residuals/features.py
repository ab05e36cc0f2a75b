"""What the flexible rival reads: functions of all that was measured, whatever their cause."""

from dataclasses import dataclass

import numpy as np

from modeler.residuals.smooth import curve

SLIPS = (0.001, 0.01, 0.1)
"""Ways in which the friction of a joint turns round, of its range of motion."""

OWN = ("own", "surface")
"""Sets of functions of the motion of the joint itself."""

_KNOTS = {"q": 16, "v": 20, "a": 10, "load": 12, "torque": 12}
_OTHER = {"q": 14, "v": 12, "a": 6}
_SUM = 7  # knots
_OWN, _BENT, _PAIR, _WIDE, _PAIRS = 60, 30, 30, 60, 150  # random features


@dataclass(frozen=True, eq=False)
class Measured:
    """What was measured beside the residual of a joint; n rows, J joints.

    Attributes:
        joint: index of the joint.
        q, v, a: (n, J) motion.
        load: (n, J) torque of the links, inertia and gravity, N m or N.
        torque: (n, J) torque of the whole model.
        direction: (n,) sign of the joint's speed, through the filter of the rows.
        slips: (n, ...) bristle states of the joint.
        further: (n, ...) sets of columns besides, by name: waves, what rings.
    """

    joint: int
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    load: np.ndarray
    torque: np.ndarray
    direction: np.ndarray
    slips: np.ndarray
    further: dict[str, np.ndarray]


def functions(measured: Measured) -> dict[str, np.ndarray]:
    """Sets of functions by name: "own" and "surface" of the joint, "0", "1", ... of others, "wide".

    Curves are sums of hats over one coordinate, with and without the direction of the joint:
    friction and other torques of any shape. Surfaces are random Fourier features (Rahimi and Recht
    2007) of several coordinates.
    """
    generator = np.random.default_rng(5)
    m, j = measured, measured.joint
    way = m.direction[:, None]
    own = np.column_stack([x[:, j] for x in (m.q, m.v, m.a, m.load)])
    sets = {
        "own": _own(m, way),
        "surface": np.column_stack(
            [_fourier(own, _OWN, generator), _fourier(own[:, :2], _BENT, generator) * way]
        ),
    }
    for k in range(m.q.shape[1]):
        if k != j:
            sets[str(k)] = _other(m, k, way, generator)
    near = np.column_stack([m.q, m.v])
    sets["sum"] = np.hstack([curve(x, _SUM) for x in (*m.q.T, *m.v.T)])
    sets["wide"] = np.column_stack([near, m.a, m.load, m.torque, _fourier(near, _WIDE, generator)])
    sets["pairs"] = _fourier(near, _PAIRS, generator, few=2)
    return sets | m.further


def _own(m: Measured, way: np.ndarray) -> np.ndarray:
    parts = [m.slips, way]
    for name, knots in _KNOTS.items():
        hats = curve(getattr(m, name)[:, m.joint], knots)
        parts += [hats] if name == "v" else [hats, hats * way]
    return np.hstack(parts)


def _other(m: Measured, k: int, way: np.ndarray, generator: np.random.Generator) -> np.ndarray:
    curves = [curve(getattr(m, name)[:, k], knots) for name, knots in _OTHER.items()]
    plain = np.column_stack([x[:, k] for x in (m.v, m.a, m.load, m.torque)])
    both = np.column_stack([m.q[:, k], m.v[:, k]])
    return np.hstack([*curves, curves[0][:, ::2] * way, plain, np.abs(plain) * way,
                      np.sign(m.v[:, [k]]), _fourier(both, _PAIR, generator)])  # fmt: skip


def _fourier(x: np.ndarray, count: int, generator: np.random.Generator, few: int = 0) -> np.ndarray:
    """(n, count) cosines of random directions, lengths of order one in standard deviations.

    Args:
        x: (n, d) coordinates.
        count: of features.
        generator: of directions.
        few: coordinates that each feature reads; 0: all.
    """
    spread = x.std(axis=0)
    scaled = x / np.where(spread > 0.0, spread, 1.0)
    turn = generator.normal(size=(x.shape[1], count))
    if few:
        order = np.argsort(generator.uniform(size=turn.shape), axis=0)
        turn = np.where(order < few, turn, 0.0)
    width = generator.uniform(0.5, 3.0, count) / np.sqrt(few or x.shape[1])
    return np.cos(scaled @ (turn * width) + generator.uniform(0.0, 2.0 * np.pi, count))
