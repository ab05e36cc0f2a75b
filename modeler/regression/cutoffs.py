"""The cut-offs of both filters: where the torques answer to the motion, and no further."""

import dataclasses
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from modeler.core.json import ShortRepr, select_attributes
from modeler.numerics.filters import BANDWIDTH, SPREAD
from modeler.numerics.least_squares import solve_scaled_least_squares
from modeler.regression import prepare
from modeler.regression.motion import Processing, Segment, build_segment
from modeler.regression.motion_noise import Bands, ChannelNoise, MotionNoise
from modeler.regression.observation import Observation, assemble_observation
from modeler.regression.report import DataReport
from modeler.regression.segments import (
    clear_resting_speeds,
    compute_speed_floors,
    filter_segment,
    find_shafts,
)
from modeler.regression.thresholds import THRESHOLDS
from modeler.runtime import CompiledModel


def limit_cutoffs(
    model: CompiledModel, prepared: prepare.PreparedLogs, asked: Processing
) -> prepare.PreparedLogs:
    """Returns the logs with both cut-offs where the torques answer to the motion.

    Parallel filter: where the noise of the positions, as torque, meets the noise of the torques.
    With positions of noise density N_i, M the inertia matrix of the fitted model, and the residual
    of joint j of variance s_j^2 behind a filter of cut-off f and noise bandwidth 1.0645 f,

        A_j = (2 pi)^4 sum_i mean(M_ji^2) N_i,  T_j = s_j^2 / 1.0645 f - A_j mean(f^4),
        f' = min_j (max(T_j, T_least) / A_j)^(1/4)

    is tried anew until it stays, from below: from above, inertias bent by noise would hide it.
    Then both are lowered further until the model's torque is `quiet`: noise without a floor.

    Args:
        model: the compiled robot.
        prepared: the logs, with the widest cut-offs.
        asked: the processing that was requested; a cut-off that it gives stays.
    """
    if asked.parallel_cutoff is not None or not prepared.noise.moving:
        return prepared
    is_fixed = asked.position_cutoff is not None
    search = widen_search(CutoffSearch(model, prepared), is_fixed)
    prepared, noise, wide = search.prepared, search.prepared.noise, search.prepared.processing
    position = wide.position_cutoff
    crossover = find_noise_crossover(search, position)
    widest = search.fit(position, wide.parallel_cutoff)
    chatter_free = search.find_chatter_free(crossover.cutoff, is_fixed)
    if chatter_free.position < position:
        crossover = find_noise_crossover(search, chatter_free.position)
    parallel = prepare.round_to_two_digits(min(crossover.cutoff, chatter_free.parallel))
    if not is_fixed:
        lowered = min(noise.cutoff, chatter_free.position)
        position = prepare.round_to_two_digits(max(lowered, 2.0 * parallel))
    prepared = prepared.set_cutoffs(position, parallel)
    said = _describe_choice(prepared, wide.parallel_cutoff, is_fixed, crossover, chatter_free)
    by = crossover.joint if chatter_free.joint is None else chatter_free.joint
    bands = Bands(
        position,
        parallel,
        crossover.attach_torque_noise(noise),
        widest_cutoffs=select_attributes(wide, "position_cutoff parallel_cutoff"),
        reasons=said,
        limiting_joint=None if by is None else noise.joints[by].joint,
        chatter_ratio=chatter_free.chatter_ratio,
        chatter_ratio_filtered=chatter_free.chatter_ratio_filtered,
        widest_values=()
        if widest is None or parallel > THRESHOLDS.cutoff_factor * wide.parallel_cutoff
        else tuple(widest.solution[0].tolist()),
    )
    return dataclasses.replace(prepared, choices=(*prepared.choices, *said), lowered=bands)


def widen_search(search: "CutoffSearch", is_fixed: bool) -> "CutoffSearch":
    """Returns the logs with later floors of the noise, where the torques follow the motion.

    What a controller leaves of a motion may be flat for octaves before it falls, and so may the
    noise of a slow sensor: positions do not distinguish which it is, torques do.

    Args:
        search: at the logs, with the first floors.
        is_fixed: the position cut-off is the user's.
    """
    prepared, later = search.prepared, search.prepared.noise.take_last_floors()
    if later.cutoff <= prepared.noise.cutoff:
        return search
    _, beta = search.narrowest_fit
    position = prepared.processing.position_cutoff if is_fixed else later.cutoff
    slowest = max(piece.step for piece in prepared.pieces)
    position = min(position, THRESHOLDS.max_cutoff_share / slowest)
    parallel = prepared.processing.parallel_cutoff
    fit = search.fit(position, parallel)
    if fit is None or beta is None:
        return search
    if compute_coherence(fit.rows, fit.rows.predict(beta)) < THRESHOLDS.min_coherence:
        return search
    wider = prepared.set_cutoffs(prepare.round_to_two_digits(position), parallel)
    return CutoffSearch(search.model, dataclasses.replace(wider, noise=later))


def _describe_choice(
    prepared: prepare.PreparedLogs,
    widest: float,
    is_fixed: bool,
    crossover: "NoiseCrossover",
    chatter_free: "ChatterFreeCutoffs",
) -> tuple[str, ...]:
    """Returns what was chosen, and why."""
    noise, chosen, said = prepared.noise, prepared.processing, []
    position, parallel = chosen.position_cutoff, chosen.parallel_cutoff
    if not is_fixed:
        why = noise.explain_cutoff(position)
        if chatter_free.chatter_ratio and position < noise.cutoff:
            why = f"lowered with the parallel filter; by the noise alone {noise.cutoff:.2g} Hz"
        said.append(f"position filter {position:g} Hz: {why}")
    if chatter_free.joint is None:
        return *said, f"parallel filter {parallel:g} Hz: {crossover.explain_cutoff(noise)}"
    return (
        *said,
        f"parallel filter {parallel:g} Hz: above, the predicted torque has high-frequency content "
        "that the measured one lacks",
        f"the torques do not show the motion between {parallel:g} and {widest:g} Hz: up to there "
        f"the predicted torque of joint {noise.joints[chatter_free.joint].joint} has "
        f"{chatter_free.chatter_ratio:.2g} times the high-frequency content of the measured one",
    )


# Some of the samples, as rows of any cut-offs.


@dataclass(frozen=True, eq=False)
class CutoffSearch(ShortRepr):
    """Pieces of the logs, of which `SAMPLES` samples at most are evaluated.

    Attributes:
        model: the compiled robot.
        prepared: the logs; its parallel cut-off is the widest.
    """

    model: CompiledModel
    prepared: prepare.PreparedLogs

    @cached_property
    def narrowest_fit(self) -> tuple[float, np.ndarray | None]:
        """Returns the lowest parallel cut-off, Hz, with rows enough, and beta (c,) of its fit."""
        noise, widest = self.prepared.noise, self.prepared.processing
        highest, position = widest.parallel_cutoff, min(noise.cutoff, widest.position_cutoff)
        least = max(THRESHOLDS.min_parallel_bands * noise.band, THRESHOLDS.min_parallel_cutoff)
        least = min(least, highest)
        while True:
            fit = self.fit(max(position, 2.0 * least), least)
            if least >= highest or (fit is not None and fit.is_determined):
                return least, None if fit is None else fit.solution[0]
            least = min(least / THRESHOLDS.cutoff_factor, highest)

    @cached_property
    def _segments_by_cutoff(self) -> dict[float, tuple[Segment, ...]]:
        return {}

    def filter_segments(self, position: float) -> tuple[Segment, ...]:
        """Returns parts of the pieces behind a position filter, Hz, that are not all edge."""
        if position not in self._segments_by_cutoff:
            pieces, chosen = self.prepared.pieces, self.prepared.processing
            chosen = dataclasses.replace(chosen, position_cutoff=position)
            every = [build_segment(piece, chosen) for piece in pieces]
            share = THRESHOLDS.search_samples / sum(len(piece.time) for piece in pieces)
            parts = [
                prepare.close_segment(self.model, _cut_segment(segment, place))[0]
                for segment in every
                if segment is not None
                for place in _spread_windows(segment.samples, share)
            ]
            self._segments_by_cutoff[position] = tuple(part for part in parts if part.whole.any())
        return self._segments_by_cutoff[position]

    @cached_property
    def _fits_by_cutoffs(self) -> "dict[tuple[float, float], WeightedFit | None]":
        return {}

    def fit(self, position: float, parallel: float) -> "WeightedFit | None":
        """Returns the weighted fit behind filters of these cut-offs, Hz; None without rows."""
        if (position, parallel) not in self._fits_by_cutoffs:
            self._fits_by_cutoffs[position, parallel] = self._fit_rows(position, parallel)
        return self._fits_by_cutoffs[position, parallel]

    def _fit_rows(self, position: float, parallel: float) -> "WeightedFit | None":
        segments, parts = self.filter_segments(position), find_shafts(self.model)
        if not segments:
            return None
        chosen = self.prepared.set_cutoffs(position, parallel).processing
        floors = compute_speed_floors(chosen, parts, segments, self.prepared.noise)
        chosen = dataclasses.replace(chosen, speed_floors=floors)
        still = [name for name, floor in floors.items() if floor == float("inf")]
        segments = clear_resting_speeds(segments, parts, still)
        some = tuple(filter_segment(segment, parts, chosen) for segment in segments)
        report = DataReport(chosen, (), (), ())
        return WeightedFit(self.model, assemble_observation(self.model, (), some, report))

    def find_worst_chatter(self, position: float, parallel: float) -> tuple[float, int | None]:
        """Returns the largest chatter ratio of the torque of `narrowest_fit`, and its joint."""
        fit, (_, beta) = self.fit(position, parallel), self.narrowest_fit
        if fit is None or beta is None:
            return 0.0, None
        ratios = compute_chatter_ratios(fit.rows, fit.rows.predict(beta))
        return max(((most, j) for j, most in ratios.items()), default=(0.0, None))

    def find_chatter_free(self, floor: float, is_fixed: bool) -> "ChatterFreeCutoffs":
        """Returns cut-offs lowered until the predicted torque has no excess high-frequency content.

        The model is that of `narrowest_fit`. First the parallel filter, then that of the
        positions, then both.

        Args:
            floor: Hz to which the parallel filter is lowered before that of the positions is.
            is_fixed: the position filter is the user's, and stays.
        """
        widest, (least, _) = self.prepared.processing, self.narrowest_fit
        position, parallel = widest.position_cutoff, widest.parallel_cutoff
        most, joint = 0.0, None
        while True:
            left, worst = self.find_worst_chatter(position, parallel)
            if left <= THRESHOLDS.max_chatter_ratio or parallel <= least:
                return ChatterFreeCutoffs(position, parallel, left, most, joint)
            if left > most:
                most, joint = left, worst
            if parallel > floor:
                parallel = max(floor, THRESHOLDS.cutoff_factor * parallel)
                continue
            if is_fixed or position <= THRESHOLDS.position_cutoff_ratio * parallel:
                parallel = max(least, THRESHOLDS.cutoff_factor * parallel)
            if not is_fixed:
                position *= THRESHOLDS.cutoff_factor


@dataclass(frozen=True)
class ChatterFreeCutoffs(ShortRepr):
    """Cut-offs behind which a model's torque has no excess high-frequency content.

    Attributes:
        position, parallel: Hz.
        left: how many times as much as the measured torque the model's torque varies from row to
            row there.
        most: the same behind the first filters of which it is too much; 0 if behind none.
        joint: of that; None without.
    """

    position: float
    parallel: float
    chatter_ratio_filtered: float
    chatter_ratio: float
    joint: int | None


def _cut_segment(segment: Segment, place: slice) -> Segment:
    """Returns the samples of a segment in some place of it."""
    arrays: dict[str, Any] = {
        member.name: x[place]
        for member in dataclasses.fields(segment)
        if isinstance(x := getattr(segment, member.name), np.ndarray)
    }
    extra = {name: x[place] for name, x in segment.extra.items()}
    return dataclasses.replace(segment, **arrays, extra=extra)


def _spread_windows(samples: int, share: float) -> list[slice]:
    """Returns eight evenly spread windows that hold a share of the samples, or all of them."""
    if share >= 1.0:
        return [slice(0, samples)]
    size = max(1, round(samples * share / 8.0))
    starts = np.linspace(0, samples - size, 8).astype(int)
    return [slice(int(start), int(start) + size) for start in starts]


@dataclass(frozen=True, eq=False)
class WeightedFit(ShortRepr):
    """Weighted least squares of some rows; n joints.

    Attributes:
        model: the compiled robot.
        rows: y = W beta.
    """

    model: CompiledModel
    rows: Observation

    @cached_property
    def solution(self) -> tuple[np.ndarray, dict[int, float]]:
        """Returns beta (c,), and the rms residual of each joint that is driven."""
        rows = self.rows
        W = {j: rows.columns[rows.used[:, j], j] for j in rows.driven}
        y = {j: rows.torque[rows.used[:, j], j] for j in rows.driven}
        sigma = {j: float(np.sqrt(np.mean(y[j] ** 2))) for j in rows.driven}
        least = {j: THRESHOLDS.min_residual_share * sigma[j] for j in sigma}
        beta = np.zeros(len(rows.names))
        for _ in range(THRESHOLDS.weight_iterations if W else 0):
            matrix, right = (np.concatenate([x[j] / sigma[j] for j in W]) for x in (W, y))
            beta = solve_scaled_least_squares(matrix, right, THRESHOLDS.min_singular_share)
            free = 1.0 - min(0.9, len(beta) / sum(map(len, y.values())))
            squares = {j: np.mean((y[j] - W[j] @ beta) ** 2) / free for j in W}
            sigma = {j: max(float(np.sqrt(squares[j])), least[j]) for j in W}
        return beta, sigma

    @property
    def is_determined(self) -> bool:
        """Returns True if there are rows enough for the residual to mean something."""
        count = self.rows.used[:, self.rows.driven].sum()
        return bool(count >= THRESHOLDS.min_rows_per_parameter * len(self.rows.names))

    @cached_property
    def _inertias(self) -> tuple[np.ndarray, np.ndarray]:
        """(k, n, n) matrices at some of the rows, and (k, n) accelerations there."""
        beta, _ = self.solution
        q = np.concatenate([part.segment.q[part.rows.centres] for part in self.rows.stretches])
        every = max(1, len(q) // THRESHOLDS.inertia_postures)
        return self.model.inertia_matrix(q[::every], beta), self.rows.qdd[::every]

    def propagate_noise(self, noise: MotionNoise) -> dict[int, float]:
        """Returns the torque of the motion's noise at 1 Hz, as density, (N m)^2/Hz, by joint."""
        densities = [joint.compute_acceleration_density(1.0) for joint in noise.joints]
        squares = np.mean(self._inertias[0] ** 2, axis=0) @ densities
        return {j: float(squares[j]) for j in self.rows.driven}

    def compute_inertial_power(self) -> dict[int, float]:
        """Returns mean square of the torque of inertia, (N m)^2, by driven joint."""
        torque = np.einsum("kij,kj->ki", *self._inertias)
        return {j: float(np.mean(torque[:, j] ** 2)) for j in self.rows.driven}


# How much high-frequency content a model's torque has, and how much of that the measured one does.


def compute_chatter_ratios(rows: Observation, model: np.ndarray) -> dict[int, float]:
    """Returns the high-frequency content of a model's torque over the measured one, by joint.

    Root mean square of the second differences from row to row, over that of the torque itself, of
    the model's over that of the measured: a gain of the channel leaves it as it is.
    """
    ratios = {}
    for j, bent, sizes in compute_curvatures(rows, model):
        if bent[0].any() and sizes.all():
            measured, modelled = np.linalg.norm(bent, axis=1) / sizes
            ratios[j] = float(modelled / measured)
    return ratios


def compute_coherence(rows: Observation, model: np.ndarray) -> float:
    """Returns the share of a model's high-frequency torque (s, n) that the measured one has.

    sum of b m over the sum of m^2, b and m second differences of the measured and of the model's
    torque, each joint in units of its torque: 1 of a motion, 0 of noise of its sensor.
    """
    product = square = 0.0
    for _, (measured, modelled), sizes in compute_curvatures(rows, model):
        unit = max(float(sizes[0]), 1e-300) ** 2
        product += float(measured @ modelled) / unit
        square += float(modelled @ modelled) / unit
    return product / square if square > 0.0 else 0.0


def compute_curvatures(
    rows: Observation, model: np.ndarray
) -> Iterator[tuple[int, np.ndarray, np.ndarray]]:
    """Yields second differences (2, k) from row to row, and sizes (2,), of torques by joint.

    Args:
        rows: with the measured torque, which comes first.
        model: (s, n) the model's torque.
    """
    near = np.diff(rows.segment) == 0
    near = near[1:] & near[:-1]
    for j in rows.driven:
        used = rows.whole[:, j]
        used_rows = near & used[2:] & used[1:-1] & used[:-2]
        if used_rows.sum() >= THRESHOLDS.min_curvature_rows:
            both = np.stack([rows.torque[:, j], model[:, j]])
            yield j, np.diff(both, 2)[:, used_rows], np.sqrt(np.mean(both[:, used] ** 2, axis=1))


@dataclass(frozen=True)
class NoiseCrossover(ShortRepr):
    """Where the noise of the motion, as torque, meets that of the drives.

    Attributes:
        cutoff: Hz.
        joint: it does so on; None at the highest cut-off, where it has not yet.
        torques: by driven joint, torque of the noise of the motion at 1 Hz and noise of the torque
            itself, (N m)^2/Hz.
        answered: True where it is lower, for drives that may answer the noise.
        bounded: True where it would be lower, but may not.
    """

    cutoff: float
    joint: int | None = None
    torques: Mapping[int, tuple[float, float]] = field(default_factory=dict)
    is_drive_limited: bool = False
    is_bounded: bool = False

    def explain_cutoff(self, noise: MotionNoise) -> str:
        """Returns why the cut-off is where it is, in words."""
        if self.joint is None:
            why = "the widest that the motion needs; up to there the torque noise is larger"
        elif self.is_drive_limited:
            why = (
                "above, encoder noise that the controller feeds back could bias the inertias, most "
                f"by joint {noise.joints[self.joint].joint}"
            )
        else:
            why = (
                f"there the torque of joint {noise.joints[self.joint].joint} by the noise of the "
                f"{noise.quantity} is as large as its residual"
            )
        return f"{why}; it would be lower, but for the motion band" if self.is_bounded else why

    def attach_torque_noise(self, noise: MotionNoise) -> tuple[ChannelNoise, ...]:
        """Returns the channels of the motion, with the noise of the torques of their joints."""
        channels = list(noise.joints)
        for j, (A, T) in self.torques.items():
            channels[j] = dataclasses.replace(channels[j], noise_torque=A, torque_noise=T)
        return tuple(channels)


def find_noise_crossover(search: CutoffSearch, position: float) -> NoiseCrossover:
    """Returns where the noise of the motion, as torque, meets that of the drives.

    And no more than where a drive that answers the same noise could bend the inertias by one
    standard deviation: there the share P_n / P_s of it in the torque of inertia is 1 / n, n rows.
    (Of noise in W of power P_n, and noise of variance V in y that is wholly correlated with it, the
    relative bias is sqrt(P_n V) / P_s, and the relative standard deviation sqrt(V / n P_s).) Of
    logged accelerations this alone: as torque their noise is as flat as that of the drives.

    Args:
        search: at the logs.
        position: highest cut-off of the position filter, Hz.
    """
    noise, highest = search.prepared.noise, search.prepared.processing.parallel_cutoff
    least, _ = search.narrowest_fit
    power = 2 * noise.order
    at, value = least, min(noise.cutoff, position)
    torques = dict[int, tuple[float, float]]()
    for _ in range(THRESHOLDS.crossover_fits):
        fit = search.fit(max(value, 2.0 * at), at)
        if fit is None:
            return NoiseCrossover(highest)
        _, sigma = fit.solution
        spread = at / (2.0 * np.pi * SPREAD)
        # mean of f^power over the squared gain exp(-f^2 / spread^2) of the filter
        inside = spread**power * (1.0, 0.5, 0.75)[noise.order]
        for j, density in fit.propagate_noise(noise).items():
            T = sigma[j] ** 2 / (BANDWIDTH * at)
            torques[j] = density, max(T - density * inside, THRESHOLDS.min_torque_noise_share * T)
        meets = torques.items() if power else ()
        crossovers = [((T / max(A, 1e-300)) ** (1.0 / power), j) for j, (A, T) in meets]
        shares = {j: A * inside * BANDWIDTH * at / sigma[j] ** 2 for j, (A, _) in torques.items()}
        inertial = sum(value / sigma[j] ** 2 for j, value in fit.compute_inertial_power().items())
        rows = len(fit.rows.time) * sum(shares.values())
        answered = at * (inertial / max(rows, 1e-300)) ** (1.0 / (power + 2))
        crossovers.append((answered, max(shares, key=lambda j: shares[j], default=0)))
        new = float(np.clip(min(crossovers)[0], least, highest))
        if abs(new - at) < THRESHOLDS.cutoff_tolerance * at:
            break
        at = new
    limit, by = min(crossovers)
    joint = None if at >= highest else by
    return NoiseCrossover(at, joint, torques, limit == answered, at <= least > limit)
