"""Do the values of an effect belong to this robot? Drive gains, friction, bodies, springs."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np

from modeler.core.table import format_percent
from modeler.diagnosis.candidates import Candidate, Columns, list_body_parameters, to_dense
from modeler.diagnosis.profile import ProfileProblem, find_effect_columns
from modeler.diagnosis.scoring import PLAIN
from modeler.diagnosis.state import State, build_all_columns, build_columns, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Requirement
from modeler.estimation import define_body, project_parameters

_GRID = tuple(np.geomspace(1e-3, 1e3, 37))
_SCALES = frozenset({"torque"})


def is_gain(candidate: Candidate) -> bool:
    """Returns whether an effect scales the torque of its joint."""
    return candidate.is_local and candidate.form.names == _SCALES


def pair_columns(state: State, candidates: Sequence[Candidate]) -> list[tuple[Candidate, Columns]]:
    """Pairs candidates with their columns; those of a gain about the model with that gain."""
    every = build_all_columns(state.rows, candidates)
    for i, candidate in enumerate(candidates):
        beta = solve_parameters(state, candidate) if is_gain(candidate) else None
        if beta is not None:
            joint_columns: list[np.ndarray | None] = [None] * state.rows.joint_count
            joint_columns[candidate.index] = -(state.rows.W[candidate.index] @ beta)[:, None]
            every[i] = tuple(joint_columns)
    return [*zip(candidates, every, strict=True)]


def _list_gain_joints(picks: Iterable[Candidate]) -> list[int]:
    """Joints whose torque is scaled."""
    return [pick.index for pick in picks if is_gain(pick)]


def solve_parameters(state: State, candidate: Candidate | None = None) -> np.ndarray | None:
    """Solves for the base parameters (c,) about which all gains are linear.

    Gains that the robot has already count among them. None without a gain, or without an answer.
    """
    gains = _list_gain_joints(state.picks if candidate is None else (*state.picks, candidate))
    solution = _solve_best(_build_problem(state, gains)) if gains else None
    return None if solution is None else solution.beta


def select_likeliest(state: State, candidates: Sequence[Candidate]) -> Candidate | None:
    """Selects, of gains of several joints, the likeliest; None where none has a solution.

    Where a wrong gain bends the model, the weights of the state say more of the bend than of the
    joints. None where no gain can be settled.
    """
    gains = [_list_gain_joints((*state.picks, c)) for c in candidates]
    solutions = [_solve_best(_build_problem(state, joints)) for joints in gains]
    scores = [(s.score, k) for k, s in enumerate(solutions) if s is not None]
    return candidates[min(scores)[1]] if scores else None


def _solve_best(problem: "_GainProblem") -> "_GainSolution | None":
    """The likelier of the solutions with the weights given and with none."""
    level = problem.update_weights(problem.torque_squares)  # by torques, which no model bent
    every = [p.solve_reweighted(p.choose_start()) for p in (problem, level)]
    solutions = [f for f in every if f is not None]
    return min(solutions, key=lambda f: f.score) if solutions else None


def compute_gain_deviations(state: State, place: int) -> np.ndarray:
    """Computes the standard deviation (1,) of the eps of one pick.

    From sums over blocks, so that coloured residuals count, and with all that beta may be.
    """
    problem = _build_problem(state, _list_gain_joints(state.picks))
    gain_index = [problem.gains.index(state.picks[place].index)]
    rows, block = _build_weighted_rows(state), state.gram_blocks.block
    return problem.compute_deviations(problem.initial_gains, rows, block)[gain_index]


def compute_gain_visibility(state: State, place: int) -> float:
    """Computes the share of the column of one pick that nothing else hides."""
    problem = _build_problem(state, _list_gain_joints(state.picks))
    return problem.compute_visibility(state.picks[place].index)


@dataclass(frozen=True, eq=False)
class _GainSolution:
    beta: np.ndarray  # (c,)
    g: np.ndarray  # (J,)
    left: np.ndarray  # (J,) squares, in units of sigma
    score: float  # the less, the likelier


@dataclass(frozen=True, eq=False)
class _GainProblem:
    """J joints; z columns: c of the base, then those of all picks that are no gains.

    Attributes:
        rows: (J,) how many.
        grams: (J, z + 1, z + 1) products of the columns, divided by sigma; the last is the torque.
        free: indices of the columns that are fitted.
        fixed: (z,) values of the others.
        gains: joints with a g.
        size: c.
        initial_gains: (J,) g of the robot's own gains and of the last fit.
        robot_gains: base columns that are gains which the robot has, and their joints.
        sigma: (J,) sigma.
    """

    rows: np.ndarray
    grams: np.ndarray
    free: np.ndarray
    fixed: np.ndarray
    gains: list[int]
    size: int
    initial_gains: np.ndarray
    robot_gains: Mapping[int, int]
    sigma: np.ndarray

    @cached_property
    def column_lengths(self) -> np.ndarray:
        """Returns the lengths of the columns, (free,)."""
        square = np.einsum("jkk->k", self.grams)[self.free]
        return np.sqrt(np.where(square > 0.0, square, 1.0))

    def choose_start(self) -> np.ndarray:
        """Chooses the first g, (J,): as given; of a new gain the best of a grid."""
        start = self.initial_gains.copy()
        for j in self.gains:
            if self.initial_gains[j] == 1.0:
                grid = [np.where(np.arange(len(start)) == j, g, start) for g in _GRID]
                left = [self._compute_squares(g, self._solve_values(g)) for g in grid]
                start = grid[int(np.argmin([self._compute_score(x) for x in left]))]
        return start

    def solve(self, g: np.ndarray) -> _GainSolution | None:
        """Solves for all parameters and gains; None without convergence."""
        g, values, step = g.copy(), self._solve_values(g), np.inf
        for _ in range(THRESHOLDS.max_gain_iterations):
            matrix, right = self._build_equations(g, values)
            change = _solve_ridge(matrix, right)
            most = THRESHOLDS.max_gain_step * np.maximum(np.abs(g[self.gains]), 0.1)
            step_g = np.clip(change[len(self.free) :], -most, most)
            g[self.gains] += step_g
            values = self._solve_values(g)
            step = float(np.max(np.abs(step_g) / np.maximum(np.abs(g[self.gains]), 1e-3)))
            if step < THRESHOLDS.gain_tolerance:
                break
        if not step < THRESHOLDS.max_gain_change:
            return None
        beta = values[: self.size].copy()
        for column, j in self.robot_gains.items():
            beta[column] = 1.0 - g[j]
        left = self._compute_squares(g, values)
        least = 1.0 / THRESHOLDS.max_sought_gain
        wrong = np.log(np.maximum(np.abs(g), least))  # of equals, the least wrong gains
        return _GainSolution(beta, g, left, self._compute_score(left) + float(wrong @ wrong))

    def _compute_score(self, left: np.ndarray) -> float:
        """Minus twice the log likelihood of what is left, each joint with its own sigma."""
        is_used = (self.rows > 0) & (self.torque_squares > 0.0)
        floor = THRESHOLDS.min_gain_residual_share**2 * self.torque_squares
        variance = np.where(is_used, np.maximum(left, floor) / np.maximum(self.rows, 1), 1.0)
        return float(np.sum(self.rows * np.log(variance * self.sigma**2)))

    def solve_reweighted(self, g: np.ndarray) -> _GainSolution | None:
        """Solves with the weight of each joint from its residual."""
        problem, solution = self, self.solve(g)
        for _ in range(THRESHOLDS.max_gain_reweightings):
            if solution is None:
                break
            before, problem = problem.sigma, problem.update_weights(solution.left)
            solution = problem.solve(solution.g)
            if np.max(np.abs(problem.sigma / before - 1.0)) < THRESHOLDS.weight_tolerance:
                break
        return solution

    def update_weights(self, left: np.ndarray) -> "_GainProblem":
        """Updates the sigma of each joint to its residual."""
        rows = np.maximum(self.rows, 1)
        least = THRESHOLDS.min_gain_residual_share * np.sqrt(self.torque_squares / rows)
        ratio = np.where(self.torque_squares > 0.0, np.maximum(np.sqrt(left / rows), least), 1.0)
        grams = self.grams / ratio[:, None, None] ** 2
        return replace(self, grams=grams, sigma=self.sigma * ratio)

    def compute_deviations(
        self, g: np.ndarray, weighted: Sequence[np.ndarray], block: Sequence[np.ndarray]
    ) -> np.ndarray:
        """Computes the standard deviations of g, (gains,), from sums over blocks.

        Args:
            g: (J,).
            weighted: (rows_j, z + 1) by joint: what `grams` are the products of.
            block: (rows_j,) by joint.
        """
        values, c = self._solve_values(g), self.size
        matrix, _ = self._build_equations(g, values)
        length = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
        inverse = np.linalg.pinv(matrix / np.outer(length, length), rcond=THRESHOLDS.gain_ridge)
        inverse = (inverse / np.outer(length, length))[len(self.free) :]
        sums = np.zeros((max(int(b.max(initial=0)) for b in block) + 1, len(matrix)))
        for j, joint_rows in enumerate(weighted):
            base, rest = joint_rows[:, :c] @ values[:c], joint_rows[:, c:-1] @ values[c:]
            more = [base if j == k else np.zeros(len(joint_rows)) for k in self.gains]
            instruments = np.column_stack([joint_rows[:, self.free] / self.column_lengths, *more])
            left = joint_rows[:, -1] - g[j] * base - rest
            np.add.at(sums, block[j], instruments * left[:, None])
        return np.asarray(np.sqrt(np.sum((sums @ inverse.T) ** 2, axis=0)))

    def compute_visibility(self, joint: int) -> float:
        """Computes the share of the column of a gain that the others do not hide."""
        values = self._solve_values(self.initial_gains)
        n, i = len(self.free), self.gains.index(joint)
        matrix, _ = self._build_equations(self.initial_gains, values)
        scaled = self._build_multipliers(self.initial_gains)
        whole = np.einsum("jkl,jk,jl->kl", self.grams[:, :-1, :-1], scaled, scaled)
        scale = np.outer(self.column_lengths, self.column_lengths)
        matrix[:n, :n] = whole[np.ix_(self.free, self.free)] / scale
        matrix[:n, n:] = matrix[n:, :n].T
        rest = np.delete(np.arange(len(matrix)), n + i)
        column = matrix[rest, n + i]
        hidden = column @ _solve_ridge(matrix[np.ix_(rest, rest)], column)
        return float(np.sqrt(max(0.0, 1.0 - hidden / max(matrix[n + i, n + i], 1e-300))))

    def _build_multipliers(self, g: np.ndarray) -> np.ndarray:
        """(J, z) what multiplies each column on each joint."""
        scaled = np.ones((len(g), len(self.fixed)))
        scaled[:, : self.size] = g[:, None]
        return scaled

    def _solve_values(self, g: np.ndarray) -> np.ndarray:
        """(z,) of the columns with these gains."""
        P = self.grams
        matrix = np.einsum("jkl,jl->kl", P[:, :-1, :-1], self._build_multipliers(g))
        right = P[:, :-1, -1].sum(axis=0) - matrix @ self.fixed
        values, scale = self.fixed.copy(), self.column_lengths
        scaled = matrix[np.ix_(self.free, self.free)] / np.outer(scale, scale)
        values[self.free] = _solve_ridge(scaled, right[self.free] / scale) / scale
        return values

    def _build_equations(self, g: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of the changes of all values (times their scale) and gains, to first order."""
        P, free, n = self.grams, self.free, len(self.free)
        scaled, lengths = self._build_multipliers(g), self.column_lengths
        matrix, right = np.zeros((n + len(self.gains),) * 2), np.zeros(n + len(self.gains))
        whole = np.einsum("jkl,jl->kl", P[:, :-1, :-1], scaled)
        matrix[:n, :n] = whole[np.ix_(free, free)] / np.outer(lengths, lengths)
        right[:n] = (P[:, :-1, -1].sum(axis=0) - whole @ values)[free] / lengths
        base = np.where(np.arange(len(values)) < self.size, values, 0.0)
        for i, j in enumerate(self.gains, start=n):
            along = P[j, :-1, :-1] @ base
            matrix[:n, i] = along[free] / lengths
            matrix[i, :n] = (along * scaled[j])[free] / lengths
            matrix[i, i] = base @ along
            right[i] = base @ P[j, :-1, -1] - along @ (scaled[j] * values)
        return matrix, right

    def _compute_squares(self, g: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(J,) squares that these leave."""
        along = np.hstack([-self._build_multipliers(g) * values, np.ones((len(g), 1))])
        return np.maximum(np.einsum("jk,jkl,jl->j", along, self.grams, along), 0.0)

    @property
    def torque_squares(self) -> np.ndarray:
        """Returns the squares of the torque, (J,), in units of sigma."""
        return self.grams[:, -1, -1]


def _solve_ridge(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """With a ridge in place of the rank: products of columns of length one."""
    ridge = THRESHOLDS.gain_ridge * np.maximum(np.diag(matrix), 1.0)
    return np.linalg.solve(matrix + np.diag(ridge), right)


def _build_weighted_rows(state: State) -> list[np.ndarray]:
    """(rows_j, z + 1) by joint: base columns, those of picks that are no gains, and torque."""
    rows = state.rows
    extra = [e for e, pick in zip(state.extra, state.picks, strict=True) if not is_gain(pick)]
    return [
        np.hstack([base, *(to_dense(e, j, len(y)) for e in extra), y[:, None]]) / state.sigma[j]
        for j, (base, y) in enumerate(zip(rows.W, rows.y, strict=True))
    ]


@lru_cache(maxsize=1)
def _compute_grams(state: State) -> np.ndarray:
    """(J, z + 1, z + 1) products of the columns of `_build_weighted_rows`."""
    weighted_rows = _build_weighted_rows(state) if state.data.fixed_parameters is not None else []
    if not weighted_rows:  # the same products by few rows
        left_out = [is_gain(pick) for pick in state.picks]
        is_left_out = np.repeat([False, *left_out], [len(state.beta), *map(len, state.values)])
        reduced = zip(state.reduced_rows.W, state.reduced_rows.y, state.sigma, strict=True)
        weighted_rows = [np.column_stack([w[:, ~is_left_out], y]) / s for w, y, s in reduced]
    return np.stack([joint_rows.T @ joint_rows for joint_rows in weighted_rows])


def _build_problem(state: State, gains: Sequence[int]) -> _GainProblem:
    """With these gains, those of the robot, and all picks that are no gains."""
    owner = {p.name: (p.effect, p.joint) for p in state.spec.standard}
    scales = {e.id for e in state.data.stated_effects.catalogue if e.forms[0].names == _SCALES}
    of = [owner[base.column_of] for base in state.spec.base]
    scaled = [(i, joint) for i, (effect, joint) in enumerate(of) if effect in scales]
    robot_gains = {i: state.joint_names.index(joint) for i, joint in scaled}
    grams = _compute_grams(state)
    size, every = len(state.beta), grams.shape[1] - 1
    fixed = np.zeros(every)
    if state.data.fixed_parameters is not None:
        fixed[:size] = state.data.fixed_parameters
        fixed[state.data.free_columns] = 0.0
    fixed[list(robot_gains)] = 0.0
    initial_gains = np.ones(state.rows.joint_count)
    for column, j in robot_gains.items():
        initial_gains[j] -= state.beta[column]
    for pick, values in zip(state.picks, state.values, strict=True):
        if is_gain(pick):
            initial_gains[pick.index] -= values[0]
    free = [*(int(i) for i in state.data.free_columns if i not in robot_gains), *range(size, every)]
    rows, which = np.array([len(y) for y in state.rows.y]), np.array(free, dtype=int)
    gains = sorted({*gains, *robot_gains.values()})
    known = gains, size, initial_gains, robot_gains, state.sigma
    return _GainProblem(rows, grams, which, fixed, *known)


# Friction brakes: does that of a model with an effect, on the motion seen and where it has faded?
#
# The friction of a joint takes energy: its torque times the speed is not negative, at any speed,
# load and temperature of the logs (what turns gradually, as bristles do, gives back a little
# after a reversal and is left out). What reads more than the motion of its joint may be absent:
# friction that grows with the load, or fades as the joint warms up, adds to that of the unloaded
# or warm joint, which brakes too. An effect with values that make friction drive describes
# something else.


DRIVES = "with it the friction of its joint would drive instead of brake"
"""Why such an effect is refused."""

FADES = frozenset({"t", "load", "static"})
"""What may be absent while a joint moves: time since the start, load."""


def is_friction_driving(before: State, after: State, pick: Candidate) -> bool:
    """Returns whether friction would drive with the effect, and does not without it.

    Args:
        before: the state without the effect.
        after: with it, as the last that was put in.
        pick: the effect.
    """
    if pick.effect.family != "friction" or not pick.is_local:
        return False
    j = pick.index
    if not has_friction(after, j):
        return False  # a model without friction says nothing of the whole
    left = float(np.sqrt(np.mean(after.residual[j] ** 2)))
    braking_picks = _list_friction_picks(after, j)
    worst = _compute_driving_torque(after, j, braking_picks)
    if pick.form.names & FADES:
        worst = max(worst, _compute_driving_torque(after, j, braking_picks[:-1]))
    return worst > max(left, _compute_driving_torque(before, j, _list_friction_picks(before, j)))


def has_friction(state: State, j: int) -> bool:
    """Returns whether the model has friction of joint j alone."""
    return bool(_find_friction_columns(state, j))


def _list_friction_picks(state: State, j: int) -> list[int]:
    """Places of the picks that are friction of that joint without memory."""
    local = [k for k, pick in enumerate(state.picks) if pick.is_local and pick.index == j]
    friction = [(k, state.picks[k]) for k in local if state.picks[k].effect.family == "friction"]
    return [k for k, pick in friction if pick.form.internal_state is None]


def compute_largest_friction(state: State, j: int) -> float:
    """Computes the 98 % quantile of the friction torque of joint j, N m or N."""
    torque = np.abs(_compute_friction(state, j, _list_friction_picks(state, j)))
    return float(np.quantile(torque, 0.98)) if torque.size else 0.0


def is_torque_computed(state: State) -> bool:
    """Returns whether torques were computed from the motion: no joint has friction.

    By medians over the joints of Coulomb and viscous friction; those that the model lacks are
    fitted beside it.
    """
    present = {(p.effect, p.joint) for p in state.spec.standard}
    plain = [e for e in state.data.stated_effects.catalogue if e.id in PLAIN]
    moved = [j for j, joint in enumerate(state.spec.joints) if joint.actuated and state.y[j].size]
    pairs = [(j, state.joint_names[j], effect) for j in moved for effect in plain]
    lacking = [(j, name, effect) for j, name, effect in pairs if (effect.id, name) not in present]
    picks = [Candidate(effect, effect.forms[0], name, j) for j, name, effect in lacking]
    shown = [p for p in picks if is_visible(build_columns(state.rows, p))]
    full = build_state(state.data, [*state.picks, *shown], state.beta)
    sizes = []
    for j in moved:
        rubbing = _list_friction_picks(full, j)
        if state.y[j].any() and (has_friction(full, j) or rubbing):
            torques = _compute_friction(full, j, rubbing), state.y[j], full.residual[j]
            sizes.append([np.linalg.norm(torque) for torque in torques])
    if not sizes:  # friction in loops is no column of one joint alone
        return False
    friction, torque, left = np.maximum(np.array(sizes).T, 1e-300)
    low = np.median(friction / torque) < THRESHOLDS.min_friction_share
    return bool(low and np.median(friction / left) < THRESHOLDS.min_friction_residual_ratio)


def _compute_driving_torque(state: State, j: int, picks: Sequence[int]) -> float:
    """Rms of the friction torque of joint j where it drives, N m or N; with some of the picks."""
    direction = np.sign(state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals]))
    driving = np.minimum(0.0, _compute_friction(state, j, picks) * direction)
    return float(np.sqrt(np.mean(driving**2)))


def _find_friction_columns(state: State, j: int) -> list[int]:
    """Base columns of the friction of joint j alone."""
    base = state.spec.base
    return [i for i, b in enumerate(base) if b.kind == "friction" and b.rows == (j,)]


def _compute_friction(state: State, j: int, picks: Sequence[int]) -> np.ndarray:
    """(rows_j,) friction torque of joint j, N m or N: of the model and some of the picks."""
    base_columns = _find_friction_columns(state, j)
    torque = state.rows.W[j][:, base_columns] @ state.beta[base_columns]
    for k in picks:
        columns = state.extra[k][j]
        assert columns is not None, "it acts on its joint"
        torque = torque + columns @ state.values[k]
    return torque


def find_caveat(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """Explains why the values cannot be those of the effect; empty if they can.

    Where no gravity turns a joint, nothing balances it; nor is a lever seen where a straight line
    describes its torque as well.

    Args:
        state: with the effect.
        pick: it.
        parameters: its parameters and shapes by name, SI.
    """
    doubts = (_CHECKS[need](state, pick, parameters) for need in pick.effect.needs)
    return next((doubt for doubt in doubts if doubt), "")


def _check_friction_size(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A part of the friction that is larger than all of it."""
    part = parameters[pick.list_parameter_names()[0]]
    unit = "N m" if _is_revolute(state, pick) else "N"
    whole = compute_largest_friction(state, pick.index)
    if part <= THRESHOLDS.max_friction_part * whole:
        return ""
    return f"all friction of its joint is {whole:.3g} {unit}, and this part of it {part:.3g} {unit}"


def _is_revolute(state: State, pick: Candidate) -> bool:
    return state.spec.joints[pick.index].unit == "rad"


def _check_rest_position(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """Far from its rest a spring is a constant torque, unless the model has one already."""
    having = {(p.effect, p.joint) for p in state.spec.standard}
    scale = state.joint_scales[pick.index]
    near = abs(pick.nonlinear_parameters["q0"] - scale.middle) < 0.5 * scale.range
    if ("offset", pick.joint) in having or near:
        return ""
    return f"its rest lies outside of all that joint {pick.joint} moves over: a constant torque"


def _check_body(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """What a body that can be built explains, over what these parameters do."""
    mass = parameters.get("mass", 0.0)
    if mass < 0.0:
        return f"no body has a mass of {mass:.3g} kg"
    # a root of the information on its parameters, beside all else
    weighted = list(zip(state.rows.W, state.sigma, strict=True))
    columns = build_columns(state.rows, pick)
    stacked = [to_dense(columns, j, len(w)) / s for j, (w, s) in enumerate(weighted)]
    left = np.vstack(stacked)
    others = np.vstack([w[:, state.data.free_columns] / s for w, s in weighted])
    if others.size:
        left = left - others @ np.linalg.lstsq(others, left, rcond=None)[0]
    root = np.asarray(np.linalg.qr(left, mode="r"))
    body_specs = list_body_parameters(pick, state.rows.signals[0])
    values = np.array([parameters[name] for name in list(parameters)[: len(body_specs)]])
    nearest = project_parameters(define_body(body_specs), values, root)
    most = THRESHOLDS.max_body_misfit * float(np.linalg.norm(root @ values))
    if nearest is None or nearest.distance < most:
        return ""
    return "no body has these inertial parameters: its pseudo-inertia would be negative"


def _check_gain(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A torque of the other sign, or off by that much, is no matter of its torque constant."""
    eps = parameters[pick.list_parameter_names()[0]]
    if 1.0 / THRESHOLDS.max_gain_factor < 1.0 - eps < THRESHOLDS.max_gain_factor:
        return ""
    true = f"{1.0 / (1.0 - eps):.2g} times" if eps != 1.0 else "infinitely many times"
    return f"the true gain would be {true} the given one: check sign and unit of that torque"


def _check_tilt(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A base that stands askew turns gravity, and changes it by no more than that."""
    change, (column,) = float(np.linalg.norm(list(parameters.values()))), pick.form.columns
    if change <= column.largest:
        return ""
    size = f"{change:.3g} {column.unit_revolute}"
    return f"gravity would change by {size}, and a tilted base turns it"


EITHER = "describes it as well"
"""Ends the caveat to a filter that these data do not distinguish from a delay."""


def _check_lag(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A torque that is only late, or of which a part alone is filtered.

    1 + lag (1/(tau s + 1) - 1) is a first-order filter for lag = 1, and for lag = 2 the Pade
    approximation of a delay of 2 tau.
    """
    problem = ProfileProblem(state, pick, find_effect_columns(state, state.picks.index(pick)))
    share, tau = parameters[pick.list_parameter_names()[0]], parameters["tau"]

    def minimise_squares(lag: float) -> tuple[float, float]:
        every = share * tau / lag * np.geomspace(0.5, 2.0, 25)
        picks = ((replace(pick, nonlinear_parameters={"tau": float(x)}), x) for x in every)
        gain = np.array([lag])
        return min((problem.compute_squares(lagged, gain), float(x)) for lagged, x in picks)

    (filtered, _), (late, half) = minimise_squares(1.0), minimise_squares(2.0)
    ratio = THRESHOLDS.max_equal_residual_ratio
    if late < ratio * filtered:
        how = EITHER if filtered < ratio * late else "describes it better"
        return f"a pure delay of {2e3 * half:.2g} ms {how}"
    if filtered > ratio * problem.compute_squares(pick, np.array([share])):
        part = format_percent(share)
        return f"a filter that only {part} of the torque passes describes it better"
    return ""


def find_gravity_confounders(start: State, candidates: Sequence[Candidate]) -> list[str]:
    """Finds joints on which gravity of the links imitates what balances it.

    Of most shapes, less than a tenth of the torque is left beside inertias that are free.

    Args:
        start: the model as given.
        candidates: of such an effect.
    """
    joints = []
    for joint in dict.fromkeys(c.joint for c in candidates):
        joint_candidates = [c for c in candidates if c.joint == joint]
        columns = [c for c in build_all_columns(start.rows, joint_candidates) if is_visible(c)]
        if joint is None or not columns or _check_gravity_load(start, joint_candidates[0], {}):
            continue
        shares = start.rank_columns(columns).visible_shares
        if float(np.median(shares)) < THRESHOLDS.min_balance_share:
            joints.append(joint)
    return joints


def _check_gravity_load(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """A lever with a spring is built where gravity turns a joint."""
    weight = np.concatenate([s.static[::20, pick.index] for s in state.rows.signals])
    torque = state.rows.y[pick.index]
    if np.mean(weight**2) > THRESHOLDS.min_gravity_share**2 * np.mean(torque**2):
        return ""
    return f"gravity does not turn joint {pick.joint}, so no spring balances it"


def _check_lever(state: State, pick: Candidate, parameters: Mapping[str, float]) -> str:
    """What the residual covers of its torque beside a straight line over the stroke is not seen.

    With link data that is `GATE` of its variance: no free inertia bends so.
    """
    j = pick.index
    column = build_columns(state.rows, pick)[j]
    assert column is not None, "it acts on its own joint"
    torque = column @ [parameters[name] for name in pick.list_parameter_names()]
    line = np.vander(state.rows.filter_samples(j, [s.q[:, j] for s in state.rows.signals]), 2)
    nonlinear_part = torque - line @ np.linalg.lstsq(line, torque, rcond=None)[0]
    bodies = state.data.prior is not None and state.data.prior.has_bodies
    least = THRESHOLDS.min_variance_reduction if bodies else 1.0
    if np.mean(nonlinear_part**2) > least * np.mean(state.residual[j] ** 2):
        return ""
    return "over this stroke its torque is a straight line in q: another spring gives it too"


_CHECKS: Mapping[Requirement, Callable[[State, Candidate, Mapping[str, float]], str]] = {
    Requirement.GRAVITY: _check_gravity_load,
    Requirement.CURVE: _check_lever,
    Requirement.REST: _check_rest_position,
    Requirement.MASS: _check_body,
    Requirement.GAIN: _check_gain,
    Requirement.LAG: _check_lag,
    Requirement.TILT: _check_tilt,
    Requirement.FRICTION: _check_friction_size,
}
"""A sentence where the robot is not so; empty where it is."""
