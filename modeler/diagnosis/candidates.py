"""What could be missing: every effect on every joint, over its grid of shapes."""

import dataclasses
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.effects import (
    CATALOGUE,
    PASSIVE_FRICTION_IS,
    Effect,
    EffectTarget,
    Form,
    NonlinearParameter,
    Requirement,
)


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
        """What 1 means in the grid of a shape parameter, SI."""
        travel = 1.0 if self.angular else self.range / 3.0
        units = {
            "speed": self.speed,
            "travel": travel,
            "place": travel,
            "bend": travel**-2,
            "turn": 1.0 if self.angular else 2.0 * np.pi / self.range,
            "load": self.load,
        }
        return units.get(shape.scale, 1.0)

    def scale_value(self, shape: NonlinearParameter, entry: float) -> float:
        """Of a shape parameter from an entry of its grid or limits, SI."""
        start = self.middle if shape.scale == "place" else 0.0
        return start + entry * self.get_unit(shape)


@dataclass(frozen=True)
class Candidate(ShortRepr):
    """One effect on one joint with its shapes.

    Attributes:
        effect: of the catalogue.
        form: which of its forms.
        joint: name; None for an effect of the whole robot.
        index: of the joint among those of the model, or of the row that has no motor; -1 without.
        shapes: values by name, SI.
        turn: of a motor that turns with several joints, {index of a joint: coefficient}.
    """

    effect: Effect
    form: Form
    joint: str | None
    index: int
    nonlinear_parameters: Mapping[str, float] = field(default_factory=dict)
    coupling: Mapping[int, float] = field(default_factory=dict)

    @property
    def key(self) -> tuple[str, str | None]:
        """Effect and joint: what a diagnosis names."""
        return self.effect.id, self.joint

    @property
    def wave_order(self) -> float:
        """Waves per turn, or per 2 pi m; 0 if it has none."""
        waves = [
            self.nonlinear_parameters[shape.name]
            for shape in self.form.nonlinear_parameters
            if shape.scale == "waves"
        ]
        return waves[0] if waves else 0.0

    @property
    def is_local(self) -> bool:
        """True if it enters the torque of its own joint only."""
        return self.effect.acts is EffectTarget.JOINT

    @property
    def is_delay(self) -> bool:
        """True if it shifts all torques in time."""
        return "rate" in self.form.names

    @property
    def scale_index(self) -> int:
        """Index of the joint whose scale its shapes have; 0 for what sits on no joint of q."""
        of_joints = (EffectTarget.JOINT, EffectTarget.MOTOR, EffectTarget.POSITION)
        return max(self.index, 0) if self.effect.acts in of_joints else 0

    def list_parameter_names(self) -> list[str]:
        """Of its columns, as in a robot file."""
        return [f"{column.prefix}{self.joint or ''}" for column in self.form.columns]

    def can_refine(self, shape: NonlinearParameter) -> bool:
        """True if values beside that of the candidate make sense: of waves, if no grid gave it."""
        if shape.scale == "waves":
            return self.nonlinear_parameters[shape.name] not in shape.grid
        return shape.is_continuous

    def replace_nonlinear_parameters(
        self, shapes: Sequence[NonlinearParameter], x: Sequence[float] | np.ndarray
    ) -> "Candidate":
        """The same effect with other coded values of some shapes."""
        values = {
            shape.name: decode_parameter(shape, v) for shape, v in zip(shapes, x, strict=True)
        }
        return dataclasses.replace(
            self, nonlinear_parameters={**self.nonlinear_parameters, **values}
        )

    def list_affected_joints(self, joints: int) -> list[int]:
        """Indices of the joints whose errors it is there to explain."""
        if self.is_local:
            return [self.index]
        if self.effect.acts is EffectTarget.MOTOR:
            return sorted(self.coupling)
        if self.effect.acts is EffectTarget.POSITION:
            return list(range(max(self.index - 1, 0), self.index + 1))
        return list(range(joints))


def list_links(spec: ModuleSpec) -> list[str]:
    """Names of the links that have inertial parameters."""
    return list(dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"))


def find_passive_joints(spec: ModuleSpec) -> dict[str, int]:
    """Joints without motor by name, and their places among the variables of the loops.

    In a robot without loops, their places among the joints.
    """
    if spec.closure is None:
        return {joint.name: j for j, joint in enumerate(spec.joints) if not joint.actuated}
    driven = {*spec.closure.given, *spec.closure.platform}
    return {name: i for i, name in enumerate(spec.closure.variables) if i not in driven}


def encode_parameter(shape: NonlinearParameter, value: float) -> float:
    """Positive shapes by their logarithm."""
    return float(np.log(value)) if shape.limits[0] > 0.0 else value


def decode_parameter(shape: NonlinearParameter, x: float) -> float:
    """The value of a coded shape."""
    return float(np.exp(x)) if shape.limits[0] > 0.0 else float(x)


def list_candidates(
    spec: ModuleSpec,
    scales: Sequence[JointScale],
    has_temperature: Mapping[str, bool],
    present: Set[tuple[str, str]],
    known: StatedEffects,
    allowed: Callable[[str, str | None], bool] = lambda effect, joint: True,
) -> list[Candidate]:
    """All that can be written as columns from the catalogue alone.

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
        if effect.several:
            continue
        if effect.acts in (EffectTarget.JOINT, EffectTarget.POSITION):
            for j, joint in enumerate(spec.joints):
                missing = joint.actuated and (effect.id, joint.name) not in present
                turning = joint.unit == "rad" or not effect.turns
                if missing and turning and _is_representative(effect, joint.name, known, allowed):
                    warm = has_temperature.get(joint.name, False)
                    form = next((f for f in effect.forms if warm or "T" not in f.names), None)
                    if form is not None and _has_logged_others(form, joint.name, spec):
                        results += expand_grid(effect, form, joint.name, j, scales[j])
            if Requirement.LAG in effect.needs and len(spec.joints) > 1:
                whole = dataclasses.replace(effect, acts=EffectTarget.TORQUE)
                results += expand_grid(whole, whole.forms[0], None, -1, scales[0])
        elif effect.acts in (EffectTarget.TORQUE, EffectTarget.GRAVITY):
            results.append(Candidate(effect, effect.forms[0], None, -1))
        elif effect.acts is EffectTarget.MOTOR:
            results += _generate_motor_candidates(spec, effect, present, known)
        elif effect.acts is EffectTarget.PASSIVE and spec.closure is not None:
            results += _generate_passive_candidates(spec, effect, present)
    return [candidate for candidate in results if allowed(*candidate.key)]


def _has_logged_others(form: Form, joint: str, spec: ModuleSpec) -> bool:
    """True if the other joints that it reads are in the logs, and are others."""
    logged = {joint_spec.name for joint_spec in spec.joints} - {joint}
    return all(name[1:] in logged for name in form.other_joint_names)


def _is_representative(
    effect: Effect, joint: str, known: StatedEffects, allowed: Callable[[str, str | None], bool]
) -> bool:
    """True if it stands for those that no data tell from it: the first that is not ruled out."""
    for other in known.catalogue:
        if other is effect:
            return True
        if other.id in effect.same_as and allowed(other.id, joint):
            return False
    return False


def expand_grid(
    effect: Effect, form: Form, joint: str | None, index: int, scale: JointScale
) -> Iterator[Candidate]:
    """An effect on a joint with all combinations of its shapes."""
    names = [shape.name for shape in form.nonlinear_parameters]
    grids = [
        [scale.scale_value(shape, entry) for entry in shape.grid]
        for shape in form.nonlinear_parameters
    ]
    for values in itertools.product(*grids):
        yield Candidate(effect, form, joint, index, dict(zip(names, values, strict=True)))


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
            coefficients = {
                place[name]: factor for name, factor in known.coupling[here.name].items()
            }
            yield Candidate(effect, form, here.name, j, {}, coefficients)
        elif j > 0 and here.unit == spec.joints[j - 1].unit:
            for ratio in (1.0, -1.0):
                yield Candidate(effect, form, here.name, j, {"c": ratio}, {j - 1: ratio, j: 1.0})


def _generate_passive_candidates(
    spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]]
) -> Iterator[Candidate]:
    rubbing = {joint for of, joint in present if of in (*PASSIVE_FRICTION_IS, effect.id)}
    for name, place in find_passive_joints(spec).items():
        if name not in rubbing:
            yield Candidate(effect, effect.forms[0], name, place)


def compute_scales(
    spec: ModuleSpec, q: Sequence[np.ndarray], v: Sequence[np.ndarray], load: Sequence[np.ndarray]
) -> list[JointScale]:
    """Of every joint, from samples (n, J) of all stretches."""
    positions, speeds, loads = (np.concatenate(list(x)) for x in (q, v, load))
    return [
        JointScale(
            speed=float(np.quantile(np.abs(speeds[:, j]), 0.98)) or 1.0,
            range=float(np.ptp(positions[:, j])) or 1.0,
            load=float(np.sqrt(np.mean(loads[:, j] ** 2))) or 1.0,
            angular=spec.joints[j].unit == "rad",
            middle=float(0.5 * (positions[:, j].min() + positions[:, j].max())),
        )
        for j in range(positions.shape[1])
    ]
