"""Forward dynamics of a fitted robot: M(q) qdd = tau - h(q, qd) - C(q)^T (a sign(C qd)).

All from the compiled C: M is its inertia matrix; h + C^T a sign is its inverse dynamics less M qdd.
What leaps where a shaft changes its direction is dry friction: C holds the shafts, a their torques,
found by evaluating the C at both sides of standstill. They are apart because at standstill dry
friction is no function of the speed: it takes any value between its bounds that holds the shaft.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError
from modeler.core.table import format_percent
from modeler.estimation import scale_inertia
from modeler.regression import find_shafts
from modeler.runtime import CompiledModel

_CREEP = 1e-9  # rad/s or m/s, to both sides of standstill
_STILL = 1e-12  # below, a shaft stands
_FLOOR = 1e-6  # least eigenvalue of M with unit diagonal, below which it is no inertia matrix


@dataclass(frozen=True, eq=False)
class Forces:
    """What acts in states, b of them side by side, n joints, k shafts.

    Attributes:
        M: (b, n, n) inertia matrix.
        smooth: (b, n) h, N m or N: all but inertia and dry friction.
        C: (b, k, n) speeds of the shafts are C qd.
        dry: (b, k) a, bounds of dry friction on the shafts.
    """

    M: np.ndarray
    smooth: np.ndarray
    C: np.ndarray
    dry: np.ndarray


class FittedPlant:
    """The robot of a model with its values.

    Args:
        model: its C.
        beta: (c,) base parameters, SI units.

    Attributes:
        joints: n.
        shafts: k.
    """

    def __init__(self, model: CompiledModel, beta: np.ndarray) -> None:
        self.model, self.beta = model, np.asarray(beta, dtype=float)
        self.joints = len(model.spec.joints)
        closure = model.spec.closure
        rubbing = {p.joint for p in model.spec.standard if p.kind == "friction"}
        if closure is None:
            self._rows = np.array([part.coefficients for part in find_shafts(model)])
            self._rows = self._rows.reshape(-1, self.joints)
            self._places: list[int] = []
            self.shafts = len(self._rows)
        else:
            self._places = [i for i, name in enumerate(closure.variables) if name in rubbing]
            self.shafts = len(self._places)
        self.inner = [i for i, signal in enumerate(model.spec.signals) if signal.is_internal_state]
        """Places in s of what is part of the state."""

    def can_close(self, q: np.ndarray) -> np.ndarray:
        """(b,) True where the loops close; everywhere without loops."""
        if self.model.spec.closure is None:
            return np.ones(len(q), dtype=bool)
        return np.asarray(self.model.closing_status(q) == 0)

    def check_inertia(self, q: np.ndarray) -> None:
        """Refuses values with which some posture among q (b, n) has no inertia.

        Raises:
            DataError: says how often, and which joint is lightest.
        """
        _, least, light = scale_inertia(self.model.inertia_matrix(q, self.beta))
        if (bad := least < _FLOOR).any():
            raise DataError(
                f"{self.model.spec.robot}: with the fitted values the inertia matrix is not "
                f"positive definite in {format_percent(float(np.mean(bad)))} of the postures, most "
                "at "
                f"joint {self.model.spec.joints[light].name}, so no motion follows from a torque; "
                "expected the inertia of a body; fit with `--method consistent`, or record more "
                "motion of that joint"
            )

    def compute_forces(
        self,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        s: np.ndarray | None,
        dry: np.ndarray | None = None,
    ) -> Forces:
        """What acts in states.

        Args:
            q: (b, n) positions.
            qd: (b, n) speeds.
            qdd: about what the acceleration is: it enters friction that depends on the load.
            s: (b, m) signals.
            dry: (b, k) bounds of dry friction where they are known from a state nearby.
        """
        M = self.model.inertia_matrix(q, self.beta)
        C = self.compute_shaft_directions(q)
        if not self.shafts:
            return Forces(M, self._compute_smooth_part(M, q, qd, qdd, s), C, np.zeros((len(q), 0)))
        away = _add_creep(C, qd)
        if dry is None:
            dry = self._estimate_dry_bounds(M, C, q, away, qdd, s)
        dry_friction = np.einsum("bkn,bk->bn", C, dry * np.sign(_compute_shaft_speeds(C, away)))
        return Forces(M, self._compute_smooth_part(M, q, away, qdd, s) - dry_friction, C, dry)

    def compute_smooth_forces(
        self, forces: Forces, q: np.ndarray, qd: np.ndarray, s: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """M (b, n, n) and h (b, n) beside a state whose forces are known: its dry friction holds.

        For difference quotients: steps that are small beside the state, or cross standstill.
        """
        M = self.model.inertia_matrix(q, self.beta)
        rest = self._compute_smooth_part(M, q, qd, np.zeros_like(q), s)
        C = forces.C if self.model.spec.closure is None else self.compute_shaft_directions(q)
        dry_friction = np.einsum(
            "bkn,bk->bn", C, forces.dry * np.sign(_compute_shaft_speeds(C, qd))
        )
        return M, rest - dry_friction

    def compute_shaft_directions(self, q: np.ndarray) -> np.ndarray:
        """(b, k, n) rows of C."""
        if self.model.spec.closure is None:
            return np.broadcast_to(self._rows, (len(q), *self._rows.shape))
        return self.model.coupling(q)[:, self._places]

    def advance_signals(
        self, s: np.ndarray, step: np.ndarray, dt: float, motion: Sequence[np.ndarray]
    ) -> np.ndarray:
        """(b, m) signals dt s later: joints have moved by `step`, q, qd, qdd are now `motion`."""
        return self.model.advance(step, dt, s, *motion) if self.inner else s

    def _compute_smooth_part(
        self, M: np.ndarray, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, s: np.ndarray | None
    ) -> np.ndarray:
        tau = self.model.inverse_dynamics(q, qd, qdd, self.beta, s)
        return np.asarray(tau - np.einsum("bij,bj->bi", M, qdd))

    def _estimate_dry_bounds(
        self,
        M: np.ndarray,
        C: np.ndarray,
        q: np.ndarray,
        qd: np.ndarray,
        qdd: np.ndarray,
        s: np.ndarray | None,
    ) -> np.ndarray:
        """(b, k) half the leap of the torque where one shaft after the other turns."""
        b, k, n = C.shape
        way = np.linalg.solve(M, C.transpose(0, 2, 1))  # (b, n, k)
        shaft_compliance = np.einsum("bkn,bnk->bk", C, way)
        way = way / np.where(shaft_compliance > 0.0, shaft_compliance, 1.0)[:, None, :]
        still = qd[:, None, :] - (way * _compute_shaft_speeds(C, qd)[:, None, :]).transpose(0, 2, 1)
        apart = _CREEP * way.transpose(0, 2, 1)
        states = np.stack([still + apart, still - apart]).reshape(-1, n)  # (2 b k, n)

        def repeat_for_shafts(values: np.ndarray) -> np.ndarray:
            return np.tile(np.repeat(values, k, axis=0), (2, 1))

        tau = self.model.inverse_dynamics(
            repeat_for_shafts(q),
            states,
            repeat_for_shafts(qdd),
            self.beta,
            None if s is None else repeat_for_shafts(s),
        )
        leap = tau.reshape(2, b, k, n)
        half = 0.5 * (leap[0] - leap[1])
        squared = np.einsum("bkn,bkn->bk", C, C)
        along = np.einsum("bkn,bkn->bk", C, half) / np.where(squared > 0.0, squared, 1.0)
        return np.maximum(along, 0.0)  # below 0: no friction, but a fault of the fit; it stays in h


def _compute_shaft_speeds(C: np.ndarray, qd: np.ndarray) -> np.ndarray:
    return np.asarray(np.einsum("bkn,bn->bk", C, qd))


def _add_creep(C: np.ndarray, qd: np.ndarray) -> np.ndarray:
    """qd with shafts that stand made to creep, so that the C and we see the same sign."""
    speeds = _compute_shaft_speeds(C, qd)
    standing = np.abs(speeds) < _STILL
    if not standing.any():
        return qd
    there = standing.any(axis=1)
    pushed = np.where(standing[there], _CREEP, 0.0)
    moved = qd.copy()
    moved[there] += np.einsum("bnk,bk->bn", np.linalg.pinv(C[there]), pushed)
    return moved
