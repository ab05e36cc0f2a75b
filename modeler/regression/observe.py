"""From logs to rows, with the cut-offs below which the torques answer to the measured motion.

Two things are asked of a band: that the noise of the motion, as torque, is less than that of the
drives, and that the torque of the model does not tremble more than the measured one.
"""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.json import select_attributes
from modeler.numerics.filters import BANDWIDTH, SPREAD
from modeler.numerics.least_squares import solve_scaled_least_squares
from modeler.regression.log import Log
from modeler.regression.low_speed import clear_resting_speeds, compute_speed_floors, find_shafts
from modeler.regression.motion import HIGHEST, Segment, build_segment
from modeler.regression.motion_noise import ChannelNoise, MotionNoise
from modeler.regression.observation import Observation, assemble_observation, build_observation
from modeler.regression.prepare import (
    PreparedLogs,
    close_segment,
    prepare_logs,
    round_to_two_digits,
)
from modeler.regression.repairs import choose_repairs
from modeler.regression.report import Bands, DataReport
from modeler.regression.settings import Processing
from modeler.regression.stretch import filter_segment
from modeler.runtime import CompiledModel

LEAST_BANDS = 2.0
"""Bands of the motion that a parallel filter leaves at least, and ..."""

LEAST_CUTOFF = 0.5
"""... Hz."""

TREMBLES = 4.0
"""Times as much as the measured torque a model's may tremble: beyond, its motion is noise."""

ANSWERED = 0.5
"""Share of the trembling of a model's torque that the measured one has, if it is a motion."""

LOWER = 0.7
"""Factor by which a cut-off is lowered."""

APART = 2.5
"""Times the parallel cut-off, down to which that of the positions is lowered by itself."""

ROWS_EACH = 10
"""Rows for every parameter, at least: a fit of fewer leaves less than their noise."""

ROUNDS = 4
"""Fits by which the parallel cut-off is found."""

SAMPLES = 2**15
"""Of the logs, evenly spread over them, that the cut-offs are chosen by."""


def observe(
    model: CompiledModel, logs: Sequence[Log], processing: Processing | None = None
) -> Observation:
    """The observation of logs: W, y, and which row is which.

    One parallel filter and decimation for the torque and every column (Guegan, Khalil and Lemoine
    2003, section 5.2). Samples below the speed floor, saturated or missing ones have no weight.

    Args:
        model: the compiled robot.
        logs: read with the same manifest.
        processing: None: automatic. For held-out logs `report.processing` of the fit.

    Raises:
        DataError: no logs, of another robot, or no usable row.
        LoopError: hardly a sample closes the loops.
    """
    asked = choose_repairs(model, logs, processing or Processing())
    prepared = prepare_logs(model.spec, logs, asked)
    return build_observation(model, logs, limit_cutoffs(model, prepared, asked))


def limit_cutoffs(model: CompiledModel, prepared: PreparedLogs, asked: Processing) -> PreparedLogs:
    """The logs with both cut-offs where the torques answer to the motion.

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
        asked: the processing that was asked for; a cut-off that it gives stays.
    """
    if asked.parallel_cutoff is not None or not prepared.noise.moving:
        return prepared
    is_position_given = asked.position_cutoff is not None
    search = widen_search(CutoffSearch(model, prepared), is_position_given)
    prepared, noise, wide = search.prepared, search.prepared.noise, search.prepared.processing
    position = wide.position_cutoff
    crossover = find_noise_crossover(search, position)
    widest = search.fit(position, wide.parallel_cutoff)
    chatter_free = search.find_chatter_free(crossover.cutoff, is_position_given)
    if chatter_free.position < position:
        crossover = find_noise_crossover(search, chatter_free.position)
    parallel = round_to_two_digits(min(crossover.cutoff, chatter_free.parallel))
    if not is_position_given:
        position = round_to_two_digits(
            max(min(noise.cutoff, chatter_free.position), 2.0 * parallel)
        )
    prepared = prepared.set_cutoffs(position, parallel)
    said = _describe_choice(
        prepared, wide.parallel_cutoff, is_position_given, crossover, chatter_free
    )
    by = crossover.joint if chatter_free.joint is None else chatter_free.joint
    bands = Bands(
        position,
        parallel,
        crossover.attach_torque_noise(noise),
        widest=select_attributes(wide, "position_cutoff parallel_cutoff"),
        chosen_by=said,
        limited_by=None if by is None else noise.joints[by].joint,
        trembling=chatter_free.chatter_ratio,
        trembling_left=chatter_free.chatter_ratio_filtered,
        widest_values=()
        if widest is None or parallel > LOWER * wide.parallel_cutoff
        else tuple(widest.solution[0].tolist()),
    )
    return dataclasses.replace(prepared, choices=(*prepared.choices, *said), lowered=bands)


def widen_search(search: "CutoffSearch", is_position_given: bool) -> "CutoffSearch":
    """The logs with later floors of the noise, where the torques answer to what lies before them.

    What a controller leaves of a motion may be flat for octaves before it falls, and so may the
    noise of a slow sensor: positions do not tell which it is, torques do.

    Args:
        search: at the logs, with the first floors.
        is_position_given: the position cut-off is the user's.
    """
    prepared, later = search.prepared, search.prepared.noise.take_last_floors()
    if later.cutoff <= prepared.noise.cutoff:
        return search
    _, beta = search.narrowest_fit
    position = prepared.processing.position_cutoff if is_position_given else later.cutoff
    position = min(position, HIGHEST / max(piece.step for piece in prepared.pieces))
    parallel = prepared.processing.parallel_cutoff
    fit = search.fit(position, parallel)
    if (
        fit is None
        or beta is None
        or compute_coherence(fit.rows, fit.rows.predict(beta)) < ANSWERED
    ):
        return search
    wider = prepared.set_cutoffs(round_to_two_digits(position), parallel)
    return CutoffSearch(search.model, dataclasses.replace(wider, noise=later))


def _describe_choice(
    prepared: PreparedLogs,
    widest: float,
    is_position_given: bool,
    crossover: "NoiseCrossover",
    chatter_free: "ChatterFreeCutoffs",
) -> tuple[str, ...]:
    """What was chosen, and why."""
    noise, chosen, said = prepared.noise, prepared.processing, []
    position, parallel = chosen.position_cutoff, chosen.parallel_cutoff
    if not is_position_given:
        why = noise.explain_cutoff(position)
        if chatter_free.chatter_ratio and position < noise.cutoff:
            why = (
                f"lowered with the parallel filter; the noise alone asks for {noise.cutoff:.2g} Hz"
            )
        said.append(f"position filter {position:g} Hz: {why}")
    if chatter_free.joint is None:
        return *said, f"parallel filter {parallel:g} Hz: {crossover.explain_cutoff(noise)}"
    return (
        *said,
        f"parallel filter {parallel:g} Hz: with more, the model's torque trembles and the measured "
        "one does not",
        f"motion between {parallel:g} and {widest:g} Hz is not what the torques answer to: up to "
        f"there the model's torque of joint {noise.joints[chatter_free.joint].joint} trembles "
        f"{chatter_free.chatter_ratio:.2g} times as much as the measured one",
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
    prepared: PreparedLogs

    @cached_property
    def narrowest_fit(self) -> tuple[float, np.ndarray | None]:
        """The lowest parallel cut-off that leaves rows enough, Hz, and beta (c,) of its fit."""
        noise, widest = self.prepared.noise, self.prepared.processing
        highest, position = widest.parallel_cutoff, min(noise.cutoff, widest.position_cutoff)
        least = min(max(LEAST_BANDS * noise.band, LEAST_CUTOFF), highest)
        while True:
            fit = self.fit(max(position, 2.0 * least), least)
            if least >= highest or (fit is not None and fit.is_determined):
                return least, None if fit is None else fit.solution[0]
            least = min(least / LOWER, highest)

    @cached_property
    def _segments_by_cutoff(self) -> dict[float, tuple[Segment, ...]]:
        return {}

    def filter_segments(self, position: float) -> tuple[Segment, ...]:
        """Parts of the pieces behind a position filter, Hz, that are not all edge."""
        if position not in self._segments_by_cutoff:
            pieces, chosen = self.prepared.pieces, self.prepared.processing
            chosen = dataclasses.replace(chosen, position_cutoff=position)
            every = [build_segment(piece, chosen) for piece in pieces]
            share = SAMPLES / sum(len(piece.time) for piece in pieces)
            parts = [
                close_segment(self.model, _cut_segment(segment, place))[0]
                for segment in every if segment is not None
                for place in _spread_windows(segment.samples, share)
            ]  # fmt: skip
            self._segments_by_cutoff[position] = tuple(part for part in parts if part.whole.any())
        return self._segments_by_cutoff[position]

    @cached_property
    def _fits_by_cutoffs(self) -> "dict[tuple[float, float], WeightedFit | None]":
        return {}

    def fit(self, position: float, parallel: float) -> "WeightedFit | None":
        """The weighted fit of the rows behind filters of these cut-offs, Hz; None without rows."""
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
        some = tuple(
            filter_segment(s, parts, chosen) for s in clear_resting_speeds(segments, parts, still)
        )
        report = DataReport(chosen, (), (), ())
        return WeightedFit(self.model, assemble_observation(self.model, (), some, report))

    def find_worst_chatter(self, position: float, parallel: float) -> tuple[float, int | None]:
        """How much more than the measured torque that of `narrowest_fit` trembles.

        Joint where " "most.
        """
        fit, (_, beta) = self.fit(position, parallel), self.narrowest_fit
        if fit is None or beta is None:
            return 0.0, None
        ratios = compute_chatter_ratios(fit.rows, fit.rows.predict(beta))
        return max(((most, j) for j, most in ratios.items()), default=(0.0, None))

    def find_chatter_free(self, floor: float, is_position_given: bool) -> "ChatterFreeCutoffs":
        """Cut-offs lowered while the model's torque trembles `TREMBLES` times as much as measured.

        The model is that of `narrowest_fit`. First the parallel filter, then that of the
        positions, then both.

        Args:
            floor: Hz to which the parallel filter is lowered before that of the positions is.
            is_position_given: the position filter is the user's, and stays.
        """
        widest, (least, _) = self.prepared.processing, self.narrowest_fit
        position, parallel = widest.position_cutoff, widest.parallel_cutoff
        most, joint = 0.0, None
        while True:
            left, worst = self.find_worst_chatter(position, parallel)
            if left <= TREMBLES or parallel <= least:
                return ChatterFreeCutoffs(position, parallel, left, most, joint)
            if left > most:
                most, joint = left, worst
            if parallel > floor:
                parallel = max(floor, LOWER * parallel)
                continue
            if is_position_given or position <= APART * parallel:
                parallel = max(least, LOWER * parallel)
            if not is_position_given:
                position *= LOWER


@dataclass(frozen=True)
class ChatterFreeCutoffs(ShortRepr):
    """Cut-offs behind which a model's torque does not tremble.

    Attributes:
        position, parallel: Hz.
        left: how many times as much as the measured torque that of the model trembles there.
        most: the same behind the first filters of which it is too much; 0 if behind none.
        joint: of that; None without.
    """

    position: float
    parallel: float
    chatter_ratio_filtered: float
    chatter_ratio: float
    joint: int | None


def _cut_segment(segment: Segment, place: slice) -> Segment:
    """The samples of a segment in some place of it."""
    arrays: dict[str, Any] = {
        member.name: x[place]
        for member in dataclasses.fields(segment)
        if isinstance(x := getattr(segment, member.name), np.ndarray)
    }
    extra = {name: x[place] for name, x in segment.extra.items()}
    return dataclasses.replace(segment, **arrays, extra=extra)


def _spread_windows(samples: int, share: float) -> list[slice]:
    """Eight evenly spread windows that hold a share of the samples, or all of them."""
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
        """beta (c,), and the rms residual of each joint that is driven."""
        rows = self.rows
        W = {j: rows.columns[rows.used[:, j], j] for j in rows.driven}
        y = {j: rows.torque[rows.used[:, j], j] for j in rows.driven}
        sigma = {j: float(np.sqrt(np.mean(y[j] ** 2))) for j in rows.driven}
        least, beta = {j: _EXACT * sigma[j] for j in sigma}, np.zeros(len(rows.names))
        for _ in range(_WEIGHTINGS if W else 0):
            beta = solve_scaled_least_squares(
                np.concatenate([W[j] / sigma[j] for j in W]),
                np.concatenate([y[j] / sigma[j] for j in W]),
                _SEEN,
            )
            free = 1.0 - min(0.9, len(beta) / sum(map(len, y.values())))
            sigma = {
                j: max(float(np.sqrt(np.mean((y[j] - W[j] @ beta) ** 2) / free)), least[j])
                for j in W
            }
        return beta, sigma

    @property
    def is_determined(self) -> bool:
        """True if there are rows enough for the residual to be one."""
        count = self.rows.used[:, self.rows.driven].sum()
        return bool(count >= ROWS_EACH * len(self.rows.names))

    @cached_property
    def _inertias(self) -> tuple[np.ndarray, np.ndarray]:
        """(k, n, n) matrices at some of the rows, and (k, n) accelerations there."""
        beta, _ = self.solution
        q = np.concatenate([part.segment.q[part.rows.centres] for part in self.rows.stretches])
        every = max(1, len(q) // _POSTURES)
        return self.model.inertia_matrix(q[::every], beta), self.rows.qdd[::every]

    def propagate_noise(self, noise: MotionNoise) -> dict[int, float]:
        """Torque of the noise of the motion at 1 Hz, as density, (N m)^2/Hz, by driven joint."""
        densities = [joint.compute_acceleration_density(1.0) for joint in noise.joints]
        squares = np.mean(self._inertias[0] ** 2, axis=0) @ densities
        return {j: float(squares[j]) for j in self.rows.driven}

    def compute_inertial_power(self) -> dict[int, float]:
        """Mean square of the torque of inertia, (N m)^2, by driven joint."""
        torque = np.einsum("kij,kj->ki", *self._inertias)
        return {j: float(np.mean(torque[:, j] ** 2)) for j in self.rows.driven}


# How a model's torque trembles, and how much of that the measured one does.


def compute_chatter_ratios(rows: Observation, model: np.ndarray) -> dict[int, float]:
    """How much more a model's torque (s, n) trembles than the measured one, by driven joint.

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
    """The share of the trembling of a model's torque (s, n) that the measured one has.

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
    """Second differences (2, k) from row to row, and sizes (2,), of the torques of driven joints.

    Args:
        rows: with the measured torque, which comes first.
        model: (s, n) the model's torque.
    """
    near = np.diff(rows.segment) == 0
    near = near[1:] & near[:-1]
    for j in rows.driven:
        used = rows.whole[:, j]
        used_rows = near & used[2:] & used[1:-1] & used[:-2]
        if used_rows.sum() >= _FEW:
            both = np.stack([rows.torque[:, j], model[:, j]])
            yield j, np.diff(both, 2)[:, used_rows], np.sqrt(np.mean(both[:, used] ** 2, axis=1))


_EXACT = 1e-6  # of a torque's rms: a residual that is less is none
_WEIGHTINGS = 4
_SEEN = 1e-8  # of the largest singular value, columns scaled
_POSTURES = 50
_FEW = 10  # rows


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
        """Why it is there."""
        if self.joint is None:
            why = (
                "the widest that the motion asks for; the noise of the torques is larger up to "
                "there"
            )
        elif self.is_drive_limited:
            why = (
                "above, a drive that answers the noise of its encoder could bend the inertias, "
                f"most by joint {noise.joints[self.joint].joint}"
            )
        else:
            why = (
                f"there the noise of the {noise.quantity} makes as much torque on joint "
                f"{noise.joints[self.joint].joint} as is left of it"
            )
        return f"{why}; it would be lower, but for the motion band" if self.is_bounded else why

    def attach_torque_noise(self, noise: MotionNoise) -> tuple[ChannelNoise, ...]:
        """The channels of the motion, with the noise of the torques of their joints."""
        channels = list(noise.joints)
        for j, (A, T) in self.torques.items():
            channels[j] = dataclasses.replace(channels[j], torque_of_noise=A, torque_noise=T)
        return tuple(channels)


def find_noise_crossover(search: CutoffSearch, position: float) -> NoiseCrossover:
    """Where the noise of the motion, as torque, meets that of the drives.

    And no more than where a drive that answers the same noise could bend the inertias by one
    standard deviation: there the share P_n / P_s of it in the torque of inertia is 1 / n, n rows.
    (Of noise in W of power P_n, and noise of variance V in y that is wholly correlated with it, the
    relative bias is sqrt(P_n V) / P_s, and the relative standard deviation sqrt(V / n P_s).) Of
    logged accelerations this alone: as torque their noise is as flat as that of the drives.

    Args:
        search: at the logs.
        position: highest cut-off of the position filter, Hz.
    """
    noise, highest, (least, _) = (
        search.prepared.noise,
        search.prepared.processing.parallel_cutoff,
        search.narrowest_fit,
    )
    power = 2 * noise.order
    at, value = least, min(noise.cutoff, position)
    torques = dict[int, tuple[float, float]]()
    for _ in range(ROUNDS):
        fit = search.fit(max(value, 2.0 * at), at)
        if fit is None:
            return NoiseCrossover(highest)
        _, sigma = fit.solution
        spread = at / (2.0 * np.pi * SPREAD)
        # mean of f^power over the squared gain exp(-f^2 / spread^2) of the filter
        inside = spread**power * (1.0, 0.5, 0.75)[noise.order]
        for j, density in fit.propagate_noise(noise).items():
            T = sigma[j] ** 2 / (BANDWIDTH * at)
            torques[j] = density, max(T - density * inside, _LEAST_SHARE * T)
        meets = torques.items() if power else ()
        crossovers = [((T / max(A, 1e-300)) ** (1.0 / power), j) for j, (A, T) in meets]
        shares = {j: A * inside * BANDWIDTH * at / sigma[j] ** 2 for j, (A, _) in torques.items()}
        inertial = sum(value / sigma[j] ** 2 for j, value in fit.compute_inertial_power().items())
        rows = len(fit.rows.time) * sum(shares.values())
        answered = at * (inertial / max(rows, 1e-300)) ** (1.0 / (power + 2))
        crossovers.append((answered, max(shares, key=lambda j: shares[j], default=0)))
        new = float(np.clip(min(crossovers)[0], least, highest))
        if abs(new - at) < _SAME * at:
            break
        at = new
    limit, by = min(crossovers)
    joint = None if at >= highest else by
    return NoiseCrossover(at, joint, torques, limit == answered, at <= least > limit)


_LEAST_SHARE = 0.1  # of the residual's variance that is taken for the torque's own noise
_SAME = 0.03
