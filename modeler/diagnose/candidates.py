"""What could be missing: every effect on every joint, over its grid of shapes."""

import itertools
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass, field

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.effects import CATALOGUE, RIPPLES, Acts, Effect, Form, Shape


@dataclass(frozen=True)
class JointScale:
    """What is large on a joint over the logs: top speed, range of motion, rms load; SI."""

    speed: float
    range: float
    load: float
    angular: bool

    def unit(self, shape: Shape) -> float:
        """What 1 means in the grid of a shape parameter, SI."""
        travel = 1.0 if self.angular else self.range / 3.0
        units = {"speed": self.speed, "travel": travel, "bend": travel**-2, "load": self.load}
        return units.get(shape.scale, 1.0)


@dataclass(frozen=True)
class Candidate:
    """One effect on one joint with its shapes.

    Attributes:
        effect: of the catalogue.
        form: which of its forms.
        joint: name; None for an effect of the whole robot.
        index: of the joint among those of the model, or of the row that has no motor; -1 without.
        shapes: values by name, SI.
    """

    effect: Effect
    form: Form
    joint: str | None
    index: int
    shapes: Mapping[str, float] = field(default_factory=dict)

    @property
    def key(self) -> tuple[str, str | None]:
        """Effect and joint: what a diagnosis names."""
        return self.effect.id, self.joint

    @property
    def local(self) -> bool:
        """True if it enters the torque of its own joint only."""
        return self.effect.acts is Acts.JOINT

    def parameter_names(self) -> list[str]:
        """Of its columns, as in a robot file."""
        return [f"{column.prefix}{self.joint or ''}" for column in self.form.columns]

    def concerns(self, joints: int) -> list[int]:
        """Indices of the joints whose errors it is there to explain."""
        if self.local:
            return [self.index]
        if self.effect.acts in (Acts.MOTOR, Acts.POSITION):
            return list(range(max(self.index - 1, 0), self.index + 1))
        return list(range(joints))


def shape_values(shape: Shape, scale: JointScale) -> list[float]:
    """The grid of a shape parameter on a joint, SI."""
    return [value * scale.unit(shape) for value in shape.grid]


def candidates(
    spec: ModuleSpec,
    scales: Sequence[JointScale],
    has_temperature: Mapping[str, bool],
    present: Set[tuple[str, str]],
    catalogue: Sequence[Effect] = CATALOGUE,
) -> list[Candidate]:
    """All that can be written as columns from the catalogue alone.

    Loads, contacts and ripples whose order is not known yet come from elsewhere.

    Args:
        spec: the robot.
        scales: of its joints.
        has_temperature: by joint.
        present: effect and joint of what the model has already.
        catalogue: the effects there are.
    """
    found: list[Candidate] = []
    for effect in distinct(catalogue):
        if effect.acts in (Acts.JOINT, Acts.POSITION):
            for j, joint in enumerate(spec.joints):
                if (effect.id, joint.name) not in present and joint.actuated:
                    form = _form(effect, has_temperature.get(joint.name, False))
                    if form is not None:
                        found += _over_grid(effect, form, joint.name, j, scales[j])
        elif effect.acts in (Acts.TORQUE, Acts.GRAVITY):
            found.append(Candidate(effect, effect.forms[0], None, -1))
        elif effect.acts is Acts.MOTOR:
            found += _pairs(spec, effect, present)
        elif effect.acts is Acts.PASSIVE and spec.closure is not None:
            found += _passive(spec, effect, present)
    return found


def distinct(catalogue: Sequence[Effect]) -> list[Effect]:
    """The catalogue, one of every class that no data tell apart."""
    found: list[Effect] = []
    for effect in catalogue:
        if not any(other.id in effect.same_as for other in found) and effect.id not in RIPPLES:
            found.append(effect)
    return found


def _form(effect: Effect, has_temperature: bool) -> Form | None:
    """The first form that needs no temperature, unless one was logged; None if there is none."""
    return next((f for f in effect.forms if has_temperature or "T" not in f.names), None)


def _over_grid(
    effect: Effect, form: Form, joint: str, index: int, scale: JointScale
) -> Iterator[Candidate]:
    grids = [shape_values(shape, scale) for shape in form.shapes]
    for values in itertools.product(*grids):
        names = [shape.name for shape in form.shapes]
        yield Candidate(effect, form, joint, index, dict(zip(names, values, strict=True)))


def _pairs(spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]]) -> Iterator[Candidate]:
    """A motor that turns with a joint and the one before it, as wrists have them."""
    for j in range(1, len(spec.joints)):
        here, before = spec.joints[j], spec.joints[j - 1]
        if here.unit == before.unit and (effect.id, here.name) not in present:
            for ratio in (1.0, -1.0):
                yield Candidate(effect, effect.forms[0], here.name, j, {"c": ratio})


def _passive(
    spec: ModuleSpec, effect: Effect, present: Set[tuple[str, str]]
) -> Iterator[Candidate]:
    assert spec.closure is not None
    rubbing = {joint for of, joint in present if of in ("viscous", "coulomb", effect.id)}
    driven = {*spec.closure.given, *spec.closure.platform}
    for place, name in enumerate(spec.closure.variables):
        if place not in driven and name not in rubbing:
            yield Candidate(effect, effect.forms[0], name, place)


def scales_of(
    spec: ModuleSpec,
    q: Sequence[np.ndarray],
    v: Sequence[np.ndarray],
    load: Sequence[np.ndarray],
) -> list[JointScale]:
    """Of every joint, from samples (n, J) of all stretches."""
    positions, speeds, loads = (np.concatenate(list(x)) for x in (q, v, load))
    return [
        JointScale(
            speed=float(np.quantile(np.abs(speeds[:, j]), 0.98)) or 1.0,
            range=float(np.ptp(positions[:, j])) or 1.0,
            load=float(np.sqrt(np.mean(loads[:, j] ** 2))) or 1.0,
            angular=spec.joints[j].unit == "rad",
        )
        for j in range(positions.shape[1])
    ]
