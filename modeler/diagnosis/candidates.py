"""What could be missing: effects on joints over their grids, and their columns on the rows."""

import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.sparse import csr_array

from modeler.core.json import ShortRepr
from modeler.core.manifest import ModuleSpec, ParameterSpec
from modeler.diagnosis.signals import EVERY, SignalReference, Signals, compute_tilt_columns
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import (
    CATALOGUE,
    NOISE,
    PASSIVE_FRICTION_IS,
    TURN,
    Effect,
    EffectTarget,
    Form,
    NonlinearParameter,
    Requirement,
)
from modeler.estimation import Motion, Windup
from modeler.numerics.filters import SPREAD, restrict_weights
from modeler.regression import FilteredSegment, Observation, compute_signals, rebuild_observation

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


@dataclass(frozen=True)
class StatedEffects(ShortRepr):
    """What a robot file says of effects.

    Attributes:
        catalogue: the effects that may be missing (`Robot.catalogue`).
        coupling: of motors that turn with several joints: name of the joint whose motor it is ->
            {joint: coefficient} (`Robot.coupling`).
    """

    catalogue: Sequence[Effect] = CATALOGUE
    coupling: Mapping[str, Mapping[str, float]] = field(default_factory=dict)


@dataclass(frozen=True)
class JointScale:
    """What is large on a joint over the logs: top speed, range of motion, rms load; SI.

    And `middle`, the middle of its motion.
    """

    speed: float
    range: float
    load: float
    angular: bool
    middle: float = 0.0

    def get_unit(self, shape: NonlinearParameter) -> float:
        """Returns the SI value of 1 in the grid of a nonlinear parameter."""
        travel = 1.0 if self.angular else self.range / 3.0
        turn = 1.0 if self.angular else 2.0 * np.pi / self.range
        units = {"speed": self.speed, "travel": travel, "place": travel, "bend": travel**-2}
        return (units | {"turn": turn, "load": self.load}).get(shape.scale, 1.0)

    def scale_value(self, shape: NonlinearParameter, entry: float) -> float:
        """Converts an entry of a grid or a limit of a nonlinear parameter to SI."""
        start = self.middle if shape.scale == "place" else 0.0
        return start + entry * self.get_unit(shape)


@dataclass(frozen=True, eq=False)
class ElasticFit(ShortRepr):
    """What was fitted of an elastic joint.

    Attributes:
        windup: the robot with it, and with the elastic joints that were put in before.
        others: with these alone; None without any.
        is_plausible: False where the values are none of an elastic joint, or uncertain.
    """

    windup: Windup
    others: Windup | None
    is_plausible: bool

    def compute_torque(self, signals: Signals) -> np.ndarray:
        """Computes the torque (n, J) that the joint adds, at full rate."""
        motion = describe_motion(signals)
        torque = self.windup.compute_torque_change(motion)
        return torque if self.others is None else torque - self.others.compute_torque_change(motion)

    def is_resolved(self, segments: Sequence[Signals]) -> bool:
        """Returns whether the samples of the segments resolve its resonances."""
        motions = [describe_motion(signals) for signals in segments]
        highest = float(self.windup.compute_resonances(motions)[0].max())
        return all(m.step * highest < THRESHOLDS.max_resonance_step for m in motions)


def describe_motion(signals: Signals) -> Motion:
    """Returns the motion of a segment, as a windup reads it."""
    return Motion(signals.q, signals.v, signals.a, signals.step, signals.model_signals)


@dataclass(frozen=True)
class Candidate(ShortRepr):
    """One effect on one joint with its shapes.

    Attributes:
        effect: of the catalogue.
        form: which of its forms.
        joint: name; None for an effect of the whole robot.
        index: of the joint among those of the model, or of the row that has no motor; -1 without.
        nonlinear_parameters: values by name, SI.
        coupling: of a motor that turns with several joints, {index of a joint: coefficient}.
        elastic: of an elastic joint whose windup was fitted.
    """

    effect: Effect
    form: Form
    joint: str | None
    index: int
    nonlinear_parameters: Mapping[str, float] = field(default_factory=dict)
    coupling: Mapping[int, float] = field(default_factory=dict)
    elastic: ElasticFit | None = None

    @property
    def key(self) -> tuple[str, str | None]:
        """Returns effect and joint, which a diagnosis names."""
        return self.effect.id, self.joint

    @property
    def wave_order(self) -> float:
        """Returns waves per turn, or per 2 pi m; 0 without any."""
        names = [s.name for s in self.form.nonlinear_parameters if s.scale == "waves"]
        waves = [self.nonlinear_parameters[name] for name in names]
        return waves[0] if waves else 0.0

    @property
    def is_local(self) -> bool:
        """Returns whether it enters the torque of its own joint only."""
        return self.effect.acts is EffectTarget.JOINT

    @property
    def is_delay(self) -> bool:
        """Returns whether it shifts all torques in time."""
        return "rate" in self.form.names

    @property
    def scale_index(self) -> int:
        """Returns the index of the joint that scales its parameters; 0 without one."""
        of_joints = (EffectTarget.JOINT, EffectTarget.MOTOR, EffectTarget.POSITION)
        return max(self.index, 0) if self.effect.acts in of_joints else 0

    def list_parameter_names(self) -> list[str]:
        """Lists the names of its columns, as in a robot file."""
        return [f"{column.prefix}{self.joint or ''}" for column in self.form.columns]

    @property
    def loop(self) -> tuple[float, ...]:
        """Returns the travel and the share of the state of a bristle or cable; else nothing."""
        memory, values = self.form.internal_state, self.nonlinear_parameters
        if memory is None or memory.kind not in ("slip", "bouc_wen"):
            return ()
        return values[memory.parameter], values.get(memory.share, 1.0)

    def can_refine(self, shape: NonlinearParameter) -> bool:
        """Returns whether values off the grid are possible; of waves, if no grid gave the order."""
        if shape.scale == "waves":
            return self.nonlinear_parameters[shape.name] not in shape.grid
        return shape.is_continuous

    def set_parameters(
        self, shapes: Sequence[NonlinearParameter], x: Sequence[float] | np.ndarray
    ) -> "Candidate":
        """Returns the same effect with other encoded values of some parameters."""
        pairs = zip(shapes, x, strict=True)
        values = {s.name: float(np.exp(v) if s.limits[0] > 0.0 else v) for s, v in pairs}
        return replace(self, nonlinear_parameters={**self.nonlinear_parameters, **values})

    def encode_parameters(self, shapes: Sequence[NonlinearParameter]) -> np.ndarray:
        """Encodes the values of some parameters."""
        values = self.nonlinear_parameters
        return np.array([encode_parameter(shape, values[shape.name]) for shape in shapes])

    def list_affected_joints(self, joints: int) -> list[int]:
        """Lists the indices of the joints whose errors it can explain."""
        if self.is_local:
            return [self.index]
        if self.effect.acts is EffectTarget.MOTOR:
            return sorted(self.coupling)
        if self.effect.acts is EffectTarget.POSITION:
            return list(range(max(self.index - 1, 0), self.index + 1))
        return list(range(joints))


def list_links(spec: ModuleSpec) -> list[str]:
    """Lists the names of the links that have inertial parameters."""
    return list(dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"))


def find_passive_joints(spec: ModuleSpec) -> dict[str, int]:
    """Finds joints without motor: names, and places among the variables of the loops.

    In a robot without loops, their places among the joints.
    """
    if spec.closure is None:
        return {joint.name: j for j, joint in enumerate(spec.joints) if not joint.actuated}
    driven = {*spec.closure.actuated, *spec.closure.platform}
    return {name: i for i, name in enumerate(spec.closure.variables) if i not in driven}


def encode_parameter(shape: NonlinearParameter, value: float) -> float:
    """Encodes a positive parameter by its logarithm."""
    return float(np.log(value)) if shape.limits[0] > 0.0 else value


def list_candidates(
    spec: ModuleSpec,
    scales: Sequence[JointScale],
    has_temperature: Mapping[str, bool],
    present: Set[tuple[str, str]],
    known: StatedEffects,
    allowed: Callable[[str, str | None], bool] = lambda effect, joint: True,
) -> list[Candidate]:
    """Lists all candidates that the catalogue alone determines.

    Loads, contacts and ripples whose order is not known yet come from elsewhere.

    Args:
        spec: the robot.
        scales: of its joints.
        has_temperature: by joint.
        present: effect and joint of what the model has already.
        known: the effects there are, and how motors are coupled.
        allowed: False for an id and a joint that the user rules out.
    """
    results: list[Candidate] = []
    for effect in known.catalogue:
        if effect.is_repeatable:
            continue
        if effect.acts in (EffectTarget.JOINT, EffectTarget.POSITION):
            for j, joint in enumerate(spec.joints):
                missing = joint.actuated and (effect.id, joint.name) not in present
                turning = joint.unit == "rad" or not effect.is_rotary_only
                if missing and turning and _is_representative(effect, joint.name, known, allowed):
                    warm = has_temperature.get(joint.name, False)
                    form = next((f for f in effect.forms if warm or "T" not in f.names), None)
                    others = {other.name for other in spec.joints} - {joint.name}  # in the logs
                    if form and {name[1:] for name in form.other_joint_names} <= others:
                        results += expand_grid(effect, form, joint.name, j, scales[j])
            if Requirement.LAG in effect.needs and len(spec.joints) > 1:
                whole = replace(effect, acts=EffectTarget.TORQUE)
                results += expand_grid(whole, whole.forms[0], None, -1, scales[0])
        elif effect.acts in (EffectTarget.TORQUE, EffectTarget.GRAVITY):
            results.append(Candidate(effect, effect.forms[0], None, -1))
        elif effect.acts is EffectTarget.MOTOR:
            results += _generate_motor_candidates(spec, effect, present, known)
        elif effect.acts is EffectTarget.PASSIVE and spec.closure is not None:
            rubbing = {joint for of, joint in present if of in (*PASSIVE_FRICTION_IS, effect.id)}
            places = find_passive_joints(spec).items()
            free = [(name, place) for name, place in places if name not in rubbing]
            results += [Candidate(effect, effect.forms[0], name, place) for name, place in free]
    return [candidate for candidate in results if allowed(*candidate.key)]


def _is_representative(
    effect: Effect, joint: str, known: StatedEffects, allowed: Callable[[str, str | None], bool]
) -> bool:
    """True if it stands for those that no data separate from it: the first not ruled out."""
    for other in known.catalogue:
        if other is effect:
            return True
        if other.id in effect.equivalent_effects and allowed(other.id, joint):
            return False
    return False


def expand_grid(
    effect: Effect, form: Form, joint: str | None, index: int, scale: JointScale
) -> Iterator[Candidate]:
    """Expands an effect on a joint over the grids of its parameters."""
    shapes = form.nonlinear_parameters
    grids = [[(s.name, scale.scale_value(s, entry)) for entry in s.grid] for s in shapes]
    for values in itertools.product(*grids):
        yield Candidate(effect, form, joint, index, dict(values))


def _generate_motor_candidates(
    spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]], known: StatedEffects
) -> Iterator[Candidate]:
    """Motors that turn with several joints: those declared, else pairs, as wrists have them."""
    place = {joint.name: j for j, joint in enumerate(spec.joints)}
    for j, here in enumerate(spec.joints):
        if (effect.id, here.name) in present or not here.actuated:
            continue
        form = effect.forms[0]
        if here.name in known.coupling:
            pairs = known.coupling[here.name].items()
            coefficients = {place[name]: factor for name, factor in pairs}
            yield Candidate(effect, form, here.name, j, {}, coefficients)
        elif j > 0 and here.unit == spec.joints[j - 1].unit:
            for ratio in (1.0, -1.0):
                yield Candidate(effect, form, here.name, j, {"c": ratio}, {j - 1: ratio, j: 1.0})


def compute_scales(
    spec: ModuleSpec, q: Sequence[np.ndarray], v: Sequence[np.ndarray], load: Sequence[np.ndarray]
) -> list[JointScale]:
    """Computes the scale of every joint from samples (n, J) of all segments."""
    positions, speeds, loads = (np.concatenate(list(x)) for x in (q, v, load))
    scales = []
    for joint, x, speed, torque in zip(spec.joints, positions.T, speeds.T, loads.T, strict=True):
        top, rms = float(np.quantile(np.abs(speed), 0.98)), float(np.sqrt(np.mean(torque**2)))
        size, middle = float(np.ptp(x)) or 1.0, float(0.5 * (x.min() + x.max()))
        scales.append(JointScale(top or 1.0, size, rms or 1.0, joint.unit == "rad", middle))
    return scales


# The columns of a candidate over the samples of a segment: the catalogue's equations in numpy.


FUNCTIONS: dict[str, np.ufunc] = {
    name: getattr(np, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh", "abs")
}


def evaluate_equations(
    candidates: Sequence[Candidate], signals: Signals, window: slice = EVERY
) -> np.ndarray:
    """Evaluates the equations of candidates of one form on one joint, (n, k), side by side.

    Over a window of the samples, which are the last axis until all is evaluated.
    """
    first = candidates[0]
    j, names, memory = first.index, first.form.names, first.form.internal_state
    values, shape = _spread_parameters(candidates)
    span = window if memory is None else EVERY  # what has memory reads the segment from its start
    read = names & {"q", "v", "a", "load", "static", "torque", "rate"}
    values |= {name: np.ascontiguousarray(getattr(signals, name)[span, j]) for name in read}
    values |= {name: signals.select_other(name)[span] for name in first.form.other_joint_names}
    if "t" in names:
        values["t"] = signals.time[span]
    if "since" in names:
        backs = [candidate.nonlinear_parameters.get(TURN, NOISE) for candidate in candidates]
        times = [signals.compute_reversal_time(j, back)[span] for back in backs]
        values["since"] = np.reshape(times, (*shape, -1))
    if "T" in names and (warmth := signals.compute_temperature(first.joint or "")) is not None:
        values["T"] = warmth[span]
    with np.errstate(all="ignore"):  # columns that are not finite are not looked at
        if memory is not None:
            x = np.zeros(1)
            if memory.lagged_input is not None:
                x = memory.lagged_input.fold(values, FUNCTIONS, np.pi, float)
            followed = np.broadcast_to(x, (*shape, len(signals.q))).reshape(len(candidates), -1)
            states = [
                signals.compute_memory_state(memory, j, candidate.nonlinear_parameters, signal)
                for candidate, signal in zip(candidates, followed, strict=True)
            ]
            values["z"] = np.reshape(states, (*shape, -1))
        count = len(signals.q[span])
        columns = np.empty((count, len(candidates), len(first.form.columns)))
        for k, column in enumerate(first.form.columns):
            every = column.equation.fold(values, FUNCTIONS, np.pi, float)
            columns[:, :, k] = np.broadcast_to(every, (*shape, count)).reshape(-1, count).T
    columns = columns if memory is None else columns[window]
    return columns.reshape(len(columns), -1)


def _spread_parameters(
    candidates: Sequence[Candidate],
) -> tuple[dict[str, object], tuple[int, ...]]:
    """Parameters of candidates before an axis of samples, and the shape of all the others.

    Of a whole grid each has an axis of its own: a function of one of them is evaluated once for all
    values of the others.
    """
    names = list(candidates[0].nonlinear_parameters)
    listed = [np.array([c.nonlinear_parameters[name] for c in candidates]) for name in names]
    axes = [np.array(list(dict.fromkeys(values.tolist()))) for values in listed]
    grid = np.meshgrid(*axes, indexing="ij") if axes else [np.zeros(len(candidates))]
    if grid[0].size != len(candidates) or not all(map(np.array_equal, map(np.ravel, grid), listed)):
        return {n: x[:, None] for n, x in zip(names, listed, strict=True)}, (len(candidates),)
    shape, count = grid[0].shape, len(names)
    spread = [x.reshape(-1, *[1] * (count - i)) for i, x in enumerate(axes)]
    return dict(zip(names, spread, strict=True)), shape


def evaluate_columns(candidate: Candidate, signals: Signals, window: slice = EVERY) -> np.ndarray:
    """Evaluates the torques of its columns on every joint, (n, J, k), over a window."""
    acts = candidate.effect.acts
    if candidate.elastic is not None:
        return candidate.elastic.compute_torque(signals)[window, :, None]
    if candidate.is_delay:
        return signals.rate[window, :, None]
    if acts is EffectTarget.GRAVITY:
        return compute_tilt_columns(signals, window)
    if acts is EffectTarget.LINK:
        places = [i for i, _ in _find_inertial_parameters(candidate, signals)]
        return signals.compute_regressor(window)[:, :, places]
    if acts is EffectTarget.MOTOR:
        turn = np.zeros(signals.q.shape[1])
        turn[list(candidate.coupling)] = list(candidate.coupling.values())
        columns = _evaluate_shaft(candidate, signals.v[window] @ turn, signals.a[window] @ turn)
        return columns[:, None, :] * turn[None, :, None]
    if acts is EffectTarget.PASSIVE:
        row = signals.coupling[window, candidate.index]
        speed = np.einsum("nj,nj->n", row, signals.v[window])
        columns = _evaluate_shaft(candidate, speed, np.zeros_like(speed))
        return columns[:, None, :] * row[:, :, None]
    if acts is EffectTarget.POSITION:
        dq = evaluate_equations([candidate], signals)
        whole = candidate.effect.acts_on_whole_axis
        return signals.compute_displacement_torque(candidate.index, dq, whole, window)
    columns = evaluate_equations([candidate], signals, window)
    result = np.zeros((len(columns), signals.q.shape[1], columns.shape[1]))
    result[:, candidate.index] = columns
    return result


def _evaluate_shaft(
    candidate: Candidate, speed: np.ndarray, acceleration: np.ndarray
) -> np.ndarray:
    """(n, k) equations of a shaft that is no joint of the model."""
    values = {"v": speed, "a": acceleration}
    equations = (column.equation for column in candidate.form.columns)
    return np.column_stack([e.fold(values, FUNCTIONS, np.pi, float) for e in equations])


def list_body_parameters(candidate: Candidate, signals: Signals) -> list[ParameterSpec]:
    """Lists the standard parameters of the columns of a body on a link."""
    return [parameter for _, parameter in _find_inertial_parameters(candidate, signals)]


def _find_inertial_parameters(
    candidate: Candidate, signals: Signals
) -> list[tuple[int, ParameterSpec]]:
    """Inertial parameters of the loaded link that act on any joint; their places."""
    spec = signals.reference.compiled.spec
    link_key = "rigid_body", list_links(spec)[candidate.index]
    every = [(i, p) for i, p in enumerate(spec.standard) if (p.effect, p.joint) == link_key]
    least = THRESHOLDS.min_parameter_column
    return [(i, p) for i, p in every if signals.column_maxima[i] > least]


Columns = tuple[np.ndarray | None, ...]
"""Columns of one candidate by joint, (rows_j, k) each; None where they are zero throughout."""


Evaluate = Callable[[int, slice], np.ndarray]
"""Values over a window of the samples of a segment, by its number."""


@dataclass(frozen=True, eq=False)
class RowBlock(ShortRepr):
    """Rows that lie beside each other, and the samples that they reach.

    Attributes:
        window: samples.
        filters: (rows_j, samples of the window) by joint.
    """

    window: slice
    filters: tuple[csr_array, ...]


@dataclass(frozen=True, eq=False)
class Rows(ShortRepr):
    """The used rows of every joint; J joints, c base columns.

    Attributes:
        y: (rows_j,) by joint, measured torque, N m or N.
        W: (rows_j, c) by joint, base columns.
        time: (rows_j,) by joint, s.
        run: (rows_j,) by joint, index of the log.
        segment: (rows_j,) by joint.
        blocks: filters (rows_j, samples) in pieces, by segment.
        signals: by segment.
        reference_cache: what was made of them for this reference, by name.
        cache: columns that do not depend on the model, shared by all references.
    """

    y: tuple[np.ndarray, ...]
    W: tuple[np.ndarray, ...]
    time: tuple[np.ndarray, ...]
    run: tuple[np.ndarray, ...]
    segment: tuple[np.ndarray, ...]
    blocks: tuple[tuple[RowBlock, ...], ...]
    signals: tuple[Signals, ...]
    reference_cache: dict[Any, Any] = field(default_factory=dict)
    cache: dict[Any, Any] = field(default_factory=dict)

    @property
    def joint_count(self) -> int:
        """Returns the number of joints, J."""
        return len(self.y)

    def replace_reference(self, reference: SignalReference) -> "Rows":
        """Returns the same rows with effects linearised about another reference."""
        signals = tuple(replace(s, reference=reference) for s in self.signals)
        return replace(self, signals=signals, reference_cache={})

    def filter_samples(self, j: int, values: Sequence[np.ndarray]) -> np.ndarray:
        """Filters values (samples, ...) by segment to the rows of joint j, (rows_j, ...)."""
        blocks = self._numbered_blocks
        return np.concatenate([b.filters[j] @ values[i][b.window] for i, b in blocks])

    def build_columns(self, candidate: Candidate) -> Columns:
        """Builds the columns of a candidate on these rows."""
        if candidate.elastic is not None:
            torques = [candidate.elastic.compute_torque(s)[:, :, None] for s in self.signals]
            return self.filter_joints(lambda i, w: torques[i][w])
        if candidate.is_local or candidate.effect.acts is EffectTarget.POSITION:
            return self._build_stacked([candidate])
        if candidate.effect.acts is EffectTarget.TORQUE and not candidate.is_delay:  # on all alike
            alone = [replace(candidate, index=j) for j in range(self.joint_count)]
            each = ([evaluate_equations([c], s) for c in alone] for s in self.signals)
            values = [np.stack(columns, axis=1) for columns in each]
            return self.filter_joints(lambda i, w: values[i][w])
        return self.filter_joints(lambda i, w: evaluate_columns(candidate, self.signals[i], w))

    def build_batch(self, candidates: Sequence[Candidate]) -> list[Columns]:
        """Builds the columns of several candidates of one effect on one joint."""
        first = candidates[0]
        local = first.is_local or first.effect.acts is EffectTarget.POSITION
        if not local or first.elastic is not None:
            return [self.build_columns(candidate) for candidate in candidates]
        whole = self._build_stacked(candidates)
        columns = [None if c is None else np.ascontiguousarray(c.T) for c in whole]
        size = len(first.form.columns)
        # a candidate may leave joints alone that its neighbours move
        starts = range(0, size * len(candidates), size)
        parts = ([None if c is None else c[k : k + size].T for c in columns] for k in starts)
        return [tuple(c if c is not None and c.any() else None for c in part) for part in parts]

    def _build_stacked(self, candidates: Sequence[Candidate]) -> Columns:
        """Columns of candidates of one effect on its joint, beside each other."""
        first, signals = candidates[0], self.signals
        j, whole = first.index, first.effect.acts_on_whole_axis
        if first.is_local and first.form.internal_state is None:
            return self._filter_joint(j, lambda i, w: evaluate_equations(candidates, signals[i], w))
        values = [evaluate_equations(candidates, s) for s in signals]
        if first.is_local:
            return self._filter_joint(j, lambda i, w: values[i][w])
        pairs = zip(signals, values, strict=True)
        every = [partial(s.compute_displacement_torque, j, x, whole) for s, x in pairs]
        return self.filter_joints(lambda i, w: every[i](w))

    def _filter_joint(self, j: int, evaluate: Evaluate) -> Columns:
        """Columns of one joint from its values (samples, k)."""
        columns: list[np.ndarray | None] = [None] * self.joint_count
        blocks = self._numbered_blocks
        parts = [(b.filters[j] @ evaluate(i, b.window)).T for i, b in blocks]
        columns[j] = np.concatenate(parts, axis=1).T  # column after column, as batches read them
        return tuple(columns)

    def filter_joints(self, evaluate: Evaluate) -> Columns:
        """Filters values (samples, J, k) to columns; None on joints where they are zero."""
        parts: list[list[np.ndarray]] = [[] for _ in range(self.joint_count)]
        shown = np.zeros(self.joint_count, dtype=bool)
        for i, block in self._numbered_blocks:
            values = evaluate(i, block.window)
            for j, weights in enumerate(block.filters):
                parts[j].append((weights @ values[:, j]).T)
                shown[j] |= parts[j][-1].any()
        pairs = zip(parts, shown, strict=True)
        return tuple(np.concatenate(part, axis=1).T if there else None for part, there in pairs)

    @property
    def _numbered_blocks(self) -> list[tuple[int, RowBlock]]:
        """Segment by segment."""
        return [(i, block) for i, blocks in enumerate(self.blocks) for block in blocks]


def count_columns(columns: Columns) -> int:
    """Returns k of columns that are not zero on all joints."""
    return next(c.shape[1] for c in columns if c is not None)


def to_dense(columns: Columns, j: int, rows: int) -> np.ndarray:
    """Returns the columns on joint j, (rows, k); zeros where there are none."""
    here = columns[j]
    return np.zeros((rows, count_columns(columns))) if here is None else here


def build_rows(observation: Observation, reference: SignalReference) -> Rows:
    """Builds the rows of an observation.

    Args:
        observation: of the analysis.
        reference: where effects are linearised.
    """
    signals, blocks = list[Signals](), []
    for part in thin_samples(observation, reference.compiled).stretches:
        s = part.segment
        signals.append(Signals(s, part.usable, s.q, s.qd, s.qdd, reference))
        pairs = zip(part.used.T, part.usable.T, strict=True)
        filters = (restrict_weights(part.rows.weights, usable)[used] for used, usable in pairs)
        blocks.append(_split_blocks([_normalise_rows(weights) for weights in filters], s.samples))
    counted, made = list(observation.used.T), build_base_columns(blocks, signals)
    y = tuple(observation.torque[rows, j] for j, rows in enumerate(counted))
    every = observation.time, observation.run, observation.segment
    time, run, segment = (tuple(of[rows] for rows in counted) for of in every)
    return Rows(y, made, time, run, segment, tuple(blocks), tuple(signals))


def thin_samples(observation: Observation, compiled: "CompiledModel") -> Observation:
    """Thins the samples of rows: columns are smooth beside the filter of the rows.

    Its Gaussian needs one sample per width.
    """
    cutoff = observation.report.processing.parallel_cutoff
    parts = list[FilteredSegment]()
    for part in observation.stretches:
        every = max(1, int(SPREAD / (cutoff * part.segment.step))) if cutoff > 0.0 else 1
        read = compute_signals(compiled, part.segment)
        parts.append(part.thin_samples(every, read) if every > 1 else part)
    return rebuild_observation(compiled, replace(observation, stretches=tuple(parts)))


def build_base_columns(
    blocks: Sequence[Sequence[RowBlock]], signals: Sequence[Signals]
) -> tuple[np.ndarray, ...]:
    """Builds the base columns of the motion of some signals, (rows_j, c) by joint."""
    parts: list[list[np.ndarray]] = [[] for _ in blocks[0][0].filters]
    for group, s in zip(blocks, signals, strict=True):
        for block in group:
            values = s.compute_base_regressor(block.window)
            for j, weights in enumerate(block.filters):
                parts[j].append(weights @ values[:, j])
    return tuple(np.concatenate(group) for group in parts)


def _split_blocks(filters: Sequence[csr_array], samples: int) -> tuple[RowBlock, ...]:
    """Of one segment: the rows whose first sample lies in one window, for one after the other."""
    starts = np.arange(0, samples, THRESHOLDS.sample_window)
    edges = []
    for weights in filters:
        first = weights.indices[weights.indptr[:-1]]
        edges.append([*np.searchsorted(first, starts).tolist(), len(first)])
    row_blocks = []
    for start, *ends in zip(starts.tolist(), *(pairwise(bounds) for bounds in edges), strict=True):
        parts = [weights[slice(*bounds)] for weights, bounds in zip(filters, ends, strict=True)]
        stop = max(int(part.indices.max(initial=start)) for part in parts) + 1
        ends = [(p.data, *map(np.int32, (p.indices - start, p.indptr))) for p in parts]
        made = [csr_array(x, shape=(len(x[2]) - 1, stop - start)) for x in ends]
        row_blocks.append(RowBlock(slice(start, stop), tuple(made)))
    return tuple(row_blocks)


def _normalise_rows(weights: csr_array) -> csr_array:
    """Each row divided by its sum."""
    total = weights @ np.ones(weights.shape[1])
    share = np.repeat(1.0 / np.where(total > 0.0, total, 1.0), np.diff(weights.indptr))
    return csr_array((weights.data * share, weights.indices, weights.indptr), shape=weights.shape)
