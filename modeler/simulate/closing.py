"""The joints that follow: closed postures along a commanded motion, speeds, and what ties cost."""

from collections.abc import Callable, Iterator

import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.robot import Robot
from modeler.simulate.constraints import Constraints, sampled

_CLOSED = 1e-11  # sizes of the robot, and of direction cosines
_ITERATIONS = 40
_LONGEST = 0.2  # rad or m, of one Newton step
_JUMP = 0.8  # rad or m: a joint that moves so far at once is in another assembly mode
_APART = 0.02  # rad or m, between postures found one after the other; those between, all at once
_STRIDE = 0.1  # rad or m, of the coordinates between two postures found one after the other
_RANK = 1e-10  # of singular values
_SINGULAR = 1e-6  # of the sizes of the passive joints' columns, one after the other
_CHUNK = 2000  # samples


def followed(
    robot: Robot,
    constraints: Constraints,
    q: np.ndarray,
    progress: Callable[[float], None] | None = None,
) -> np.ndarray:
    """(n, moving rows) closed postures along (n, coordinates) positions, led there from `home`.

    Raises:
        RobotError: `home` does not close, or leaves joints undetermined.
        DataError: the loops do not close on the way; says where.
    """
    v = _at_home(robot, constraints)
    v = _led(robot, constraints, v, q[0], "on the way from [home] to the first sample")
    out = np.empty((len(q), len(v)))
    for part in _chunks(len(q)):
        out[part] = _between(robot, constraints, v, q[part], part.start)
        v = out[part.stop - 1]
        if progress is not None:
            progress(part.stop / len(q))
    return out


def rates(
    constraints: Constraints, v: np.ndarray, qd: np.ndarray, qdd: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(n, moving rows) speeds and accelerations that the constraints allow.

    J vd = 0 and J vdd + J' vd = 0 at closed postures v, for those of the coordinates.
    """
    given, others = constraints.given, constraints.others
    vd, vdd = np.zeros_like(v), np.zeros_like(v)
    vd[:, given], vdd[:, given] = qd, qdd
    for part in _chunks(len(v)):
        J = sampled(constraints.slope, v[part])
        Q, R = np.linalg.qr(J[:, :, others])
        driven = J[:, :, given]
        vd[part, others] = -_least(Q, R, np.einsum("nij,nj->ni", driven, qd[part]))
        bend = sampled(constraints.curvature, v[part], vd[part])[:, :, 0]
        vdd[part, others] = -_least(Q, R, np.einsum("nij,nj->ni", driven, qdd[part]) + bend)
    return vd, vdd


def motor_torques(constraints: Constraints, v: np.ndarray, load: np.ndarray) -> np.ndarray:
    """(n, coordinates) motor torques that, with the constraint forces, make up the joints' load.

    load = S tau + J^T lambda: the rows of joints without motor give the multipliers lambda (the
    smallest ones where equations are redundant), the others then tau.

    Args:
        constraints: the equations.
        v: (n, moving rows) closed postures.
        load: (n, moving rows) M vdd + h of the open tree, friction included.
    """
    given, others = constraints.given, constraints.others
    tau = np.empty((len(v), len(given)))
    for part in _chunks(len(v)):
        J = sampled(constraints.slope, v[part])
        Q, R = np.linalg.qr(J[:, :, others])
        carried = np.linalg.solve(R.transpose(0, 2, 1), load[part, others][:, :, None])
        multipliers = Q @ carried
        tau[part] = load[part, given] - np.einsum("nij,ni->nj", J[:, :, given], multipliers[..., 0])
    return tau


def distances(constraints: Constraints, v: np.ndarray) -> np.ndarray:
    """(n,) least singular value of J in the joints that follow; 0 in a singular posture.

    Lengths count in sizes of the robot.
    """
    least = np.empty(len(v))
    for part in _chunks(len(v)):
        J = sampled(constraints.slope, v[part]) * constraints.units
        _, R = np.linalg.qr(J[:, :, constraints.others])
        least[part] = np.linalg.svd(R, compute_uv=False)[:, -1]
    return least


def _chunks(count: int) -> Iterator[slice]:
    return (slice(begin, min(begin + _CHUNK, count)) for begin in range(0, count, _CHUNK))


def _least(Q: np.ndarray, R: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(n, columns) least squares solutions of Q R x = right."""
    turned = np.einsum("nij,ni->nj", Q, right)
    return np.linalg.solve(R, turned[:, :, None])[:, :, 0]


def _at_home(robot: Robot, constraints: Constraints) -> np.ndarray:
    names = [joint.name for joint in robot.moving]
    home = _solved(constraints, np.array([robot.home.get(name, 0.0) for name in names]))
    if home is None:
        raise RobotError(
            f"simulation: the loops of {robot.name} do not close at [home]; state values near a "
            "closed posture, and check the lengths"
        )
    J = constraints.slope(home).full()[:, constraints.others]
    _, sizes, turned = np.linalg.svd(J)
    free = turned[np.sum(sizes > _SINGULAR * sizes[0]) :]
    if len(free):
        loose = np.array(names)[constraints.others][np.max(np.abs(free), axis=0) > _SINGULAR]
        raise RobotError(
            f"simulation: joints {', '.join(loose)} of {robot.name} can move at [home] with the "
            "actuated joints locked; actuate one of them, add a loop or a relation, or correct "
            "[home]"
        )
    return home


def _led(
    robot: Robot, constraints: Constraints, v: np.ndarray, q: np.ndarray, where: str
) -> np.ndarray:
    """The closed posture at q, from the closed posture v, straight and in small steps."""
    begin = v[constraints.given]
    steps = max(1, int(np.ceil(np.max(np.abs(q - begin)) / _STRIDE)))
    for share in np.arange(1, steps + 1) / steps:
        start = v.copy()
        start[constraints.given] = begin + share * (q - begin)
        found = _solved(constraints, start)
        if found is None or not _same_mode(constraints, v, found):
            raise _not_closed(robot, start[constraints.given], where)
        v = found
    return v


def _same_mode(constraints: Constraints, before: np.ndarray, after: np.ndarray) -> bool:
    """True if no joint jumped, and no singular posture lies between two near postures.

    Of square Jacobians, the ratio of the determinants is above 0; of redundant equations, that of
    what one Jacobian is in the columns of the other.
    """
    if np.max(np.abs(after - before)) > _JUMP:
        return False
    old, new = (constraints.slope(v).full()[:, constraints.others] for v in (before, after))
    return bool(np.linalg.det(np.linalg.lstsq(old, new, rcond=_RANK)[0]) > 0)


def _between(
    robot: Robot, constraints: Constraints, before: np.ndarray, q: np.ndarray, first: int
) -> np.ndarray:
    """Closed postures at q: some one after the other, those between them all at once."""
    travel = np.cumsum(np.max(np.abs(np.diff(q, axis=0, prepend=q[:1])), axis=1))
    anchors = np.unique([0, *np.flatnonzero(np.diff(travel // _APART)), len(q) - 1])
    found = []
    for k in anchors:
        before = _led(robot, constraints, before, q[k], f"at sample {first + k + 1}")
        found.append(before)
    start = np.column_stack([
        np.interp(np.arange(len(q)), anchors, column) for column in np.array(found).T
    ])  # fmt: skip
    start[:, constraints.given] = q
    v, closed = _polished(constraints, start)
    wrong = ~closed | (np.max(np.abs(v - start), axis=1) > _JUMP)
    if np.any(wrong):
        k = int(np.argmax(wrong))
        raise _not_closed(robot, q[k], f"at sample {first + k + 1}")
    return v


def _polished(constraints: Constraints, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Newton for all samples at once; (n, moving rows), and (n,) True where loops are closed."""
    v = v.copy()
    for _ in range(_ITERATIONS):
        c = sampled(constraints.value, v)[:, :, 0]
        open_ = np.flatnonzero(np.max(np.abs(c), axis=1) >= _CLOSED)
        if not open_.size:
            break
        Q, R = _factors(constraints, v[open_])
        if not np.all(_regular(R)):
            break
        step = _least(Q, R, c[open_])
        longest = np.max(np.abs(step), axis=1, keepdims=True)
        v[open_[:, None], constraints.others] -= step * np.minimum(1.0, _LONGEST / longest)
    return v, np.max(np.abs(sampled(constraints.value, v)[:, :, 0]), axis=1) < _CLOSED


def _factors(constraints: Constraints, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Q and R of the columns of J of the joints that are not given, (n, ...) each."""
    return np.linalg.qr(sampled(constraints.slope, v)[:, :, constraints.others])


def _regular(R: np.ndarray) -> np.ndarray:
    """(n,) True where the joints that are not given are determined."""
    diagonal = np.abs(np.diagonal(R, axis1=1, axis2=2))
    return diagonal.min(axis=1) > _SINGULAR * diagonal.max(axis=1)


def _solved(constraints: Constraints, v: np.ndarray) -> np.ndarray | None:
    """Newton on the rows that are not given, by least squares; None if it does not converge."""
    v = v.copy()
    for _ in range(_ITERATIONS):
        c = constraints.value(v).full().ravel()
        if np.max(np.abs(c)) < _CLOSED:
            return v
        J = constraints.slope(v).full()[:, constraints.others]
        step = np.linalg.lstsq(J, -c, rcond=_RANK)[0]
        v[constraints.others] += step * min(1.0, _LONGEST / np.max(np.abs(step)))
    return None


def _not_closed(robot: Robot, q: np.ndarray, where: str) -> DataError:
    joints = ", ".join(joint.name for joint in robot.coordinates)
    values = ", ".join(f"{x:.4g}" for x in q)
    return DataError(
        f"simulation: the loops of {robot.name} do not close {where}, joints {joints} at "
        f"{values}; shrink [limits] of these joints"
    )
