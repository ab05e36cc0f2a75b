"""Wrong drive gains: the model about which their columns are linear, and what they are known to.

The torque of a joint is logged g times too large: y_j = g_j W_j beta, g_j = 1 - eps_j. Joints that
share base parameters tell each other's g apart, up to one scale that those without eps have. The
column of eps_j is -W_j beta of the *true* beta; about the beta of a model without eps_j it would
bend eps_j and, where |eps_j| > 1, no repetition would mend that: the parameters that joint j has
alone grow by eps_j every time. So beta and all g are solved for together, by the equations that the
linear fit with these columns satisfies at its own parameters (`instruments`: W_j and W_j beta).
"""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from modeler.diagnosis.candidates import Candidate
from modeler.diagnosis.effect_columns import Columns, expand_columns
from modeler.diagnosis.state import State, build_all_columns
from modeler.diagnosis.thresholds import THRESHOLDS

_GRID = tuple(np.geomspace(1e-3, 1e3, 37))
_SCALES = frozenset({"torque"})


def is_gain(candidate: Candidate) -> bool:
    """True for an effect that scales the torque of its joint."""
    return candidate.is_local and candidate.form.names == _SCALES


def compute_candidate_columns(state: State, candidates: Sequence[Candidate]) -> list[Columns]:
    """The columns of candidates; those of a gain about the model with that gain."""
    every = build_all_columns(state.rows, candidates)
    for i, candidate in enumerate(candidates):
        beta = solve_parameters(state, candidate) if is_gain(candidate) else None
        if beta is not None:
            joint_columns: list[np.ndarray | None] = [None] * state.rows.joint_count
            joint_columns[candidate.index] = -(state.rows.W[candidate.index] @ beta)[:, None]
            every[i] = tuple(joint_columns)
    return every


def _list_gain_joints(picks: Iterable[Candidate]) -> list[int]:
    """Joints whose torque is scaled."""
    return [pick.index for pick in picks if is_gain(pick)]


def solve_parameters(state: State, candidate: Candidate | None = None) -> np.ndarray | None:
    """(c,) base parameters about which the gains among the picks and a candidate are linear.

    Gains that the robot has already count among them. None without a gain, or without an answer.
    """
    gains = _list_gain_joints(state.picks if candidate is None else (*state.picks, candidate))
    solution = _solve_best(_build_problem(state, gains)) if gains else None
    return None if solution is None else solution.beta


def select_likeliest(state: State, candidates: Sequence[Candidate]) -> Candidate | None:
    """Of gains of several joints the one that leaves least; each joint weighs by what it leaves.

    Where a wrong gain bends the model, the weights of the state say more of the bend than of the
    joints. None where no gain can be settled.
    """
    each = (
        (c, _solve_best(_build_problem(state, _list_gain_joints((*state.picks, c)))))
        for c in candidates
    )
    scores = [(candidate, best.score) for candidate, best in each if best is not None]
    return min(scores, key=lambda pair: pair[1])[0] if scores else None


def _solve_best(problem: "_GainProblem") -> "_GainSolution | None":
    """The likelier of the solutions with the weights given and with none."""
    level = problem.update_weights(
        problem.torque_squares
    )  # every joint weighs by its torque: no model bent it
    every = [p.solve_reweighted(p.choose_start()) for p in (problem, level)]
    solutions = [f for f in every if f is not None]
    return min(solutions, key=lambda f: f.score) if solutions else None


def compute_gain_deviations(state: State, place: int) -> np.ndarray:
    """(1,) standard deviation of the eps of one pick, of a state about its own parameters.

    From sums over blocks, so that coloured residuals count, and with all that beta may be.
    """
    problem = _build_problem(state, _list_gain_joints(state.picks))
    gain_index = [problem.gains.index(state.picks[place].index)]
    return problem.compute_deviations(
        problem.initial_gains, _build_weighted_rows(state), state.gram_blocks.block
    )[gain_index]


def compute_gain_visibility(state: State, place: int) -> float:
    """Share of the column of one pick that all else does not hide, of a state about itself."""
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
        given: (J,) g of the robot's own gains and of the last fit.
        had: base columns that are gains which the robot has, and their joints.
        spread: (J,) sigma.
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
        """(free,) lengths of the columns."""
        square = np.einsum("jkk->k", self.grams)[self.free]
        return np.sqrt(np.where(square > 0.0, square, 1.0))

    def choose_start(self) -> np.ndarray:
        """(J,) of g: as given; of a new one the best of a grid."""
        start = self.initial_gains.copy()
        for j in self.gains:
            if self.initial_gains[j] == 1.0:
                grid = [np.where(np.arange(len(start)) == j, g, start) for g in _GRID]
                start = min(
                    grid,
                    key=lambda g: self._compute_score(
                        self._compute_squares(g, self._solve_values(g))
                    ),
                )
        return start

    def solve(self, g: np.ndarray) -> _GainSolution | None:
        """All parameters and gains; None where they do not come to rest."""
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
        wrong = np.log(
            np.maximum(np.abs(g), 1.0 / THRESHOLDS.max_sought_gain)
        )  # of equals, those that are least so
        return _GainSolution(beta, g, left, self._compute_score(left) + float(wrong @ wrong))

    def _compute_score(self, left: np.ndarray) -> float:
        """Minus twice the log likelihood of what is left, each joint with its own sigma."""
        is_used = (self.rows > 0) & (self.torque_squares > 0.0)
        floor = THRESHOLDS.min_gain_residual_share**2 * self.torque_squares
        variance = np.where(is_used, np.maximum(left, floor) / np.maximum(self.rows, 1), 1.0)
        return float(np.sum(self.rows * np.log(variance * self.sigma**2)))

    def solve_reweighted(self, g: np.ndarray) -> _GainSolution | None:
        """The same with the weight of each joint from what it leaves."""
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
        """With sigma of each joint so that it leaves one for each row."""
        rows = np.maximum(self.rows, 1)
        least = THRESHOLDS.min_gain_residual_share * np.sqrt(self.torque_squares / rows)
        ratio = np.where(self.torque_squares > 0.0, np.maximum(np.sqrt(left / rows), least), 1.0)
        grams = self.grams / ratio[:, None, None] ** 2
        return dataclasses.replace(self, grams=grams, sigma=self.sigma * ratio)

    def compute_deviations(
        self, g: np.ndarray, weighted: Sequence[np.ndarray], block: Sequence[np.ndarray]
    ) -> np.ndarray:
        """(gains,) standard deviations of g, from sums over blocks.

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
        sums = np.zeros(
            (max(int(joint_rows.max(initial=0)) for joint_rows in block) + 1, len(matrix))
        )
        for j, joint_rows in enumerate(weighted):
            base, rest = joint_rows[:, :c] @ values[:c], joint_rows[:, c:-1] @ values[c:]
            more = [base if j == k else np.zeros(len(joint_rows)) for k in self.gains]
            instruments = np.column_stack([joint_rows[:, self.free] / self.column_lengths, *more])
            np.add.at(
                sums, block[j], instruments * (joint_rows[:, -1] - g[j] * base - rest)[:, None]
            )
        return np.asarray(np.sqrt(np.sum((sums @ inverse.T) ** 2, axis=0)))

    def compute_visibility(self, joint: int) -> float:
        """Share of the column of a gain that the others do not hide."""
        values, n, i = (
            self._solve_values(self.initial_gains),
            len(self.free),
            self.gains.index(joint),
        )
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
        free_block = np.ix_(self.free, self.free)
        scale = self.column_lengths
        scaled_values = _solve_ridge(
            matrix[free_block] / np.outer(scale, scale), right[self.free] / scale
        )
        values = self.fixed.copy()
        values[self.free] = scaled_values / scale
        return values

    def _build_equations(self, g: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Of the changes of all values (times their scale) and gains, to first order."""
        P, free, n = self.grams, self.free, len(self.free)
        scaled = self._build_multipliers(g)
        matrix, right = np.zeros((n + len(self.gains),) * 2), np.zeros(n + len(self.gains))
        whole = np.einsum("jkl,jl->kl", P[:, :-1, :-1], scaled)
        matrix[:n, :n] = whole[np.ix_(free, free)] / np.outer(
            self.column_lengths, self.column_lengths
        )
        right[:n] = (P[:, :-1, -1].sum(axis=0) - whole @ values)[free] / self.column_lengths
        base = np.where(np.arange(len(values)) < self.size, values, 0.0)
        for i, j in enumerate(self.gains, start=n):
            along = P[j, :-1, :-1] @ base
            matrix[:n, i] = along[free] / self.column_lengths
            matrix[i, :n] = (along * scaled[j])[free] / self.column_lengths
            matrix[i, i] = base @ along
            right[i] = base @ P[j, :-1, -1] - along @ (scaled[j] * values)
        return matrix, right

    def _compute_squares(self, g: np.ndarray, values: np.ndarray) -> np.ndarray:
        """(J,) squares that these leave."""
        along = np.hstack([-self._build_multipliers(g) * values, np.ones((len(g), 1))])
        return np.maximum(np.einsum("jk,jkl,jl->j", along, self.grams, along), 0.0)

    @property
    def torque_squares(self) -> np.ndarray:
        """(J,) squares of the torque, in units of sigma."""
        return self.grams[:, -1, -1]


def _solve_ridge(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """With a ridge in place of the rank: products of columns of length one."""
    ridge = THRESHOLDS.gain_ridge * np.maximum(np.diag(matrix), 1.0)
    return np.linalg.solve(matrix + np.diag(ridge), right)


def _build_weighted_rows(state: State) -> list[np.ndarray]:
    """(rows_j, z + 1) by joint: base columns, those of picks that are no gains, and torque."""
    rows = state.rows
    extra = [e for e, pick in zip(state.extra, state.picks, strict=True) if not is_gain(pick)]
    weighted_rows = []
    for j, (base, y) in enumerate(zip(rows.W, rows.y, strict=True)):
        parts = [expand_columns(e, j, len(y)) for e in extra]
        weighted_rows.append(np.hstack([base, *parts, y[:, None]]) / state.sigma[j])
    return weighted_rows


@lru_cache(maxsize=1)
def _compute_grams(state: State) -> np.ndarray:
    """(J, z + 1, z + 1) products of the columns of `_build_weighted_rows`."""
    return np.stack([joint_rows.T @ joint_rows for joint_rows in _build_weighted_rows(state)])


def _build_problem(state: State, gains: Sequence[int]) -> _GainProblem:
    """With these gains, those of the robot, and all picks that are no gains."""
    owner = {p.name: (p.effect, p.joint) for p in state.spec.standard}
    scales = {e.id for e in state.data.stated_effects.catalogue if e.forms[0].names == _SCALES}
    of = [owner[base.column_of] for base in state.spec.base]
    robot_gains = {
        i: state.joint_names.index(j) for i, (effect, j) in enumerate(of) if effect in scales
    }
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
    return _GainProblem(
        rows=np.array([len(torque) for torque in state.rows.y]),
        grams=grams,
        free=np.array(free, dtype=int),
        fixed=fixed,
        gains=sorted({*gains, *robot_gains.values()}),
        size=size,
        initial_gains=initial_gains,
        robot_gains=robot_gains,
        sigma=state.sigma,
    )
