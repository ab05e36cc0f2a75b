"""What could be missing: every effect on every joint, over its grid of shapes."""

import dataclasses
import itertools
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field

import numpy as np

from modeler.core.brief import Brief
from modeler.core.manifest import ModuleSpec
from modeler.effects import CATALOGUE, PASSIVE_FRICTION_IS, Acts, Effect, Form, Needs, Shape


@dataclass(frozen=True)
class StatedEffects(Brief):
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

    def unit(self, shape: Shape) -> float:
        """What 1 means in the grid of a shape parameter, SI."""
        travel = 1.0 if self.angular else self.range / 3.0
        units = {
            "speed": self.speed, "travel": travel, "place": travel, "bend": travel**-2,
            "turn": 1.0 if self.angular else 2.0 * np.pi / self.range,
            "load": self.load,
        }  # fmt: skip
        return units.get(shape.scale, 1.0)

    def value(self, shape: Shape, entry: float) -> float:
        """Of a shape parameter from an entry of its grid or limits, SI."""
        start = self.middle if shape.scale == "place" else 0.0
        return start + entry * self.unit(shape)


@dataclass(frozen=True)
class Candidate(Brief):
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
    shapes: Mapping[str, float] = field(default_factory=dict)
    turn: Mapping[int, float] = field(default_factory=dict)

    @property
    def key(self) -> tuple[str, str | None]:
        """Effect and joint: what a diagnosis names."""
        return self.effect.id, self.joint

    @property
    def order(self) -> float:
        """Waves per turn, or per 2 pi m; 0 if it has none."""
        waves = [self.shapes[shape.name] for shape in self.form.shapes if shape.scale == "waves"]
        return waves[0] if waves else 0.0

    @property
    def local(self) -> bool:
        """True if it enters the torque of its own joint only."""
        return self.effect.acts is Acts.JOINT

    @property
    def delays(self) -> bool:
        """True if it shifts all torques in time."""
        return "rate" in self.form.names

    @property
    def scaled(self) -> int:
        """Index of the joint whose scale its shapes have; 0 for what sits on no joint of q."""
        of_joints = (Acts.JOINT, Acts.MOTOR, Acts.POSITION)
        return max(self.index, 0) if self.effect.acts in of_joints else 0

    def parameter_names(self) -> list[str]:
        """Of its columns, as in a robot file."""
        return [f"{column.prefix}{self.joint or ''}" for column in self.form.columns]

    def refinable(self, shape: Shape) -> bool:
        """True if values beside that of the candidate make sense: of waves, if no grid gave it."""
        if shape.scale == "waves":
            return self.shapes[shape.name] not in shape.grid
        return shape.smooth

    def moved(self, shapes: Sequence[Shape], x: Sequence[float] | np.ndarray) -> "Candidate":
        """The same effect with other coded values of some shapes."""
        values = {shape.name: decoded(shape, v) for shape, v in zip(shapes, x, strict=True)}
        return dataclasses.replace(self, shapes={**self.shapes, **values})

    def concerns(self, joints: int) -> list[int]:
        """Indices of the joints whose errors it is there to explain."""
        if self.local:
            return [self.index]
        if self.effect.acts is Acts.MOTOR:
            return sorted(self.turn)
        if self.effect.acts is Acts.POSITION:
            return list(range(max(self.index - 1, 0), self.index + 1))
        return list(range(joints))


def links_of(spec: ModuleSpec) -> list[str]:
    """Names of the links that have inertial parameters."""
    return list(dict.fromkeys(p.joint for p in spec.standard if p.effect == "rigid_body"))


def passive_joints(spec: ModuleSpec) -> dict[str, int]:
    """Joints without motor by name, and their places among the variables of the loops.

    In a robot without loops, their places among the joints.
    """
    if spec.closure is None:
        return {joint.name: j for j, joint in enumerate(spec.joints) if not joint.actuated}
    driven = {*spec.closure.given, *spec.closure.platform}
    return {name: i for i, name in enumerate(spec.closure.variables) if i not in driven}


def coded(shape: Shape, value: float) -> float:
    """Positive shapes by their logarithm."""
    return float(np.log(value)) if shape.limits[0] > 0.0 else value


def decoded(shape: Shape, x: float) -> float:
    """The value of a coded shape."""
    return float(np.exp(x)) if shape.limits[0] > 0.0 else float(x)


def candidates(
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
    found: list[Candidate] = []
    for effect in known.catalogue:
        if effect.several:
            continue
        if effect.acts in (Acts.JOINT, Acts.POSITION):
            for j, joint in enumerate(spec.joints):
                missing = joint.actuated and (effect.id, joint.name) not in present
                turning = joint.unit == "rad" or not effect.turns
                if missing and turning and _named_first(effect, joint.name, known, allowed):
                    warm = has_temperature.get(joint.name, False)
                    form = next((f for f in effect.forms if warm or "T" not in f.names), None)
                    if form is not None and _others_known(form, joint.name, spec):
                        found += over_grid(effect, form, joint.name, j, scales[j])
            if Needs.LAG in effect.needs and len(spec.joints) > 1:
                whole = dataclasses.replace(effect, acts=Acts.TORQUE)
                found += over_grid(whole, whole.forms[0], None, -1, scales[0])
        elif effect.acts in (Acts.TORQUE, Acts.GRAVITY):
            found.append(Candidate(effect, effect.forms[0], None, -1))
        elif effect.acts is Acts.MOTOR:
            found += _motors(spec, effect, present, known)
        elif effect.acts is Acts.PASSIVE and spec.closure is not None:
            found += _passive(spec, effect, present)
    return [candidate for candidate in found if allowed(*candidate.key)]


def _others_known(form: Form, joint: str, spec: ModuleSpec) -> bool:
    """True if the other joints that it reads are in the logs, and are others."""
    logged = {own.name for own in spec.joints} - {joint}
    return all(name[1:] in logged for name in form.others)


def _named_first(
    effect: Effect, joint: str, known: StatedEffects,
    allowed: Callable[[str, str | None], bool],
) -> bool:  # fmt: skip
    """True if it stands for those that no data tell from it: the first that is not ruled out."""
    for other in known.catalogue:
        if other is effect:
            return True
        if other.id in effect.same_as and allowed(other.id, joint):
            return False
    return False


def over_grid(
    effect: Effect, form: Form, joint: str | None, index: int, scale: JointScale
) -> Iterator[Candidate]:
    """An effect on a joint with all combinations of its shapes."""
    names = [shape.name for shape in form.shapes]
    grids = [[scale.value(shape, entry) for entry in shape.grid] for shape in form.shapes]
    for values in itertools.product(*grids):
        yield Candidate(effect, form, joint, index, dict(zip(names, values, strict=True)))


def _motors(
    spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]], known: StatedEffects
) -> Iterator[Candidate]:
    """Motors that turn with several joints: those declared, else pairs, as wrists have them."""
    place = {joint.name: j for j, joint in enumerate(spec.joints)}
    for j, here in enumerate(spec.joints):
        if (effect.id, here.name) in present or not here.actuated:
            continue
        form = effect.forms[0]
        if here.name in known.coupling:
            turn = {place[name]: factor for name, factor in known.coupling[here.name].items()}
            yield Candidate(effect, form, here.name, j, {}, turn)
        elif j > 0 and here.unit == spec.joints[j - 1].unit:
            for ratio in (1.0, -1.0):
                yield Candidate(effect, form, here.name, j, {"c": ratio}, {j - 1: ratio, j: 1.0})


def _passive(
    spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]]
) -> Iterator[Candidate]:
    rubbing = {joint for of, joint in present if of in (*PASSIVE_FRICTION_IS, effect.id)}
    for name, place in passive_joints(spec).items():
        if name not in rubbing:
            yield Candidate(effect, effect.forms[0], name, place)


def scales_of(
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
