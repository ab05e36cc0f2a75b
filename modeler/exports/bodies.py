"""Which body and which joint gets which numbers."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation import (
    PREFIXES,
    IdentifiedModel,
    Machine,
    body_covariance,
    machine_of,
    parameters_of,
    pseudo_inertia_of,
)
from modeler.exports.capsules import weights
from modeler.exports.completion import (
    INSIDE,
    Beforehand,
    Completed,
    buildable,
    conditioned,
    impossible,
    least,
)
from modeler.robot import Pose, Robot, robot_from_text

SHARE = 0.3
"""How sure the values of a file are that says nothing of it, over the scale of a body."""

_UNKNOWN = 1.0  # the same of a capsule
_WIDE = 100.0  # how sure a value is of which nothing is known, over what the torques allow
_LOOSE = (1e-2, 0.1, 1.0)  # of what is known beforehand: by how much values of no body may move
_ROUNDING = 1e-15  # of the size of a number
LEAST = 1e-14
"""kg m2: MuJoCo takes no smaller moment of inertia (its mjEPS of full inertias)."""

_NO_BODY = 1e-12  # an eigenvalue of a pseudo-inertia that rounding does not explain
_THIN = 1e-10  # of the inertia of a capsule of its mass: what a rod or a point gets
_ROUND = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0])  # the inertia of a ball
_DENSITIES = (1e-3, 1e3)  # what a fit may say of a capsule's

HELD = {
    "urdf": ("damping", "friction"),
    "sdf": ("damping", "friction", "stiffness"),
    "mjcf": ("damping", "friction", "armature", "stiffness"),
}
"""What a joint of these formats has."""

_HELD_AS = {
    ("viscous", "Fv"): "damping", ("passive_friction", "Fvp"): "damping",
    ("coulomb", "Fs"): "friction", ("passive_friction", "Fsp"): "friction",
    ("rotor_inertia", "Ia"): "armature", ("spring", "Ks"): "stiffness",
}  # fmt: skip

Terms = Mapping[str, Mapping[str, float]]
"""quantity -> {standard parameter: coefficient}."""


@dataclass(frozen=True, eq=False)
class Physics:
    """Standard parameters of a machine that could be built, and where they came from.

    Attributes:
        robot: its table.
        machine: unknowns.
        now: their values.
        stated: links whose values were stated or fitted; the others got those of capsules.
        nominal: what the robot file says, by name.
        fit: beta and its covariance; None of a robot.
        released: links on which what hangs must change too.
        notes: what was decided, a line each.
    """

    robot: Robot
    machine: Machine
    now: Completed
    stated: frozenset[str]
    nominal: Mapping[str, float]
    fit: tuple[np.ndarray, np.ndarray] | None = None
    released: frozenset[str] = frozenset()
    notes: tuple[str, ...] = ()

    @cached_property
    def place(self) -> dict[str, int]:
        """Of every parameter in chi; of those that similar legs share under every name."""
        found = {name: i for i, name in enumerate(self.machine.names)}
        for shared in self.robot.shared:
            if shared.name in found:
                found |= dict.fromkeys(shared.members, found[shared.name])
        return found

    def ten_places(self, row: str) -> list[int]:
        """Places in chi of the ten parameters of the link of a row; none if it has no body."""
        if not self.robot.inertial(row) or not self.robot.joint(row).moves:
            return []
        found = [self.place.get(f"{prefix}{row}") for prefix in PREFIXES]
        return [i for i in found if i is not None] if None not in found else []

    def ten(self, row: str) -> np.ndarray | None:
        """(10,) standard parameters of the link of a row; None if it has no body."""
        places = self.ten_places(row)
        return self.now.chi[places] if places else None

    def stated_before(self, row: str) -> np.ndarray | None:
        """(10,) what the robot file says of them; None unless it says all."""
        found = [self.nominal.get(f"{prefix}{row}") for prefix in PREFIXES]
        return None if None in found else np.array(found, dtype=float)

    def value(self, terms: Mapping[str, float]) -> tuple[float, float]:
        """A sum of parameters, and its standard deviation."""
        at = [self.place[name] for name in terms]
        c = np.array(list(terms.values()))
        variance = float(c @ self.now.covariance[np.ix_(at, at)] @ c)
        return float(c @ self.now.chi[at]), max(variance, 0.0) ** 0.5

    def drive(self, row: str, to: str) -> Terms:
        """What the joint of a row gets in a file of that format, of what has a value."""
        found: dict[str, Mapping[str, float]] = {}
        own = {} if row in self.robot.motors else held_by_joint(self.robot, row)
        for quantity, terms in own.items():
            known = {name: c for name, c in terms.items() if name in self.place}
            if quantity in HELD[to] and known and self.value(known)[0] >= 0.0:
                found[quantity] = known
        return found


def held_by_joint(robot: Robot, row: str) -> dict[str, dict[str, float]]:
    """Damping, friction, armature and stiffness of a joint, as sums of parameters.

    Those of a motor of its own, too, that turns c times as fast: c^2 Fv, |c| Fs, c^2 Ia.
    """
    found: dict[str, dict[str, float]] = {}
    for name, quantity in _held_names(robot, row):
        found.setdefault(quantity, {})[name] = 1.0
    for motor, ratios in robot.motors.items():
        own = robot.relations.get(row)
        if set(ratios) == {row} and own is not None and own.names == {f"q{motor}"}:
            c = ratios[row]
            for name, quantity in _held_names(robot, motor):
                found.setdefault(quantity, {})[name] = abs(c) if quantity == "friction" else c * c
    return found


def _held_names(robot: Robot, row: str) -> Iterator[tuple[str, str]]:
    for effect, form, instance in robot.effects_on(row):
        for column in form.columns:
            quantity = _HELD_AS.get((effect.id, column.prefix))
            if quantity and not (quantity == "stiffness" and instance.shapes.get("h")):
                yield f"{column.prefix}{row}{instance.label}", quantity


def rest_of(robot: Robot, row: str) -> float:
    """Where the spring of a joint is at rest."""
    springs = [i.shapes for effect, _, i in robot.effects_on(row) if effect.id == "spring"]
    return float(springs[0].get("q0", 0.0)) if springs else 0.0


# Ten parameters of a body in other frames, and as files write them.


def carried(ten: np.ndarray, pose: Pose) -> np.ndarray:
    """(10, ...) parameters in a frame a of a body given in b, whose pose in a that is."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = pose.rotation, pose.position
    P = pseudo_inertia_of(ten)
    return np.asarray(parameters_of(np.einsum("ai,ij...,bj->ab...", T, P, T)))


def written(ten: np.ndarray, axes: np.ndarray | None = None) -> np.ndarray:
    """(10,) mass, centre, and XX XY XZ YY YZ ZZ about the centre along some axes.

    A body without mass has its centre in the origin.

    Args:
        ten: at the origin of the frame.
        axes: (3, 3) as columns; None: those of the frame.
    """
    mass = ten[9]
    centre = ten[6:9] / mass if mass else 0.0 * ten[6:9]
    about = symmetric(ten[:6]) - mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    if axes is not None:
        about = axes.T @ about @ axes
    found = np.concatenate([[mass], centre, about[np.triu_indices(3)]])
    nothing = np.abs(found) <= _ROUNDING * sizes(found)  # what differences leave of 0
    return found - np.where(nothing, found.real, 0.0)


def symmetric(six: np.ndarray) -> np.ndarray:
    """(3, 3) of XX XY XZ YY YZ ZZ."""
    return np.asarray(six[[[0, 1, 2], [1, 3, 4], [2, 4, 5]]])


def sizes(body: np.ndarray) -> np.ndarray:
    """(10,) how large the numbers of a body are, as `written`: those of a kind are alike.

    Of the centre its distance and the radius of gyration count, of the inertia that about the
    origin: these are what differences are taken of.
    """
    mass, far, about = abs(body[0]), np.abs(body[1:4]).max(), np.abs(body[4:]).max()
    inertia = about + mass * far**2
    radius = (inertia / mass) ** 0.5 if mass else 0.0
    return np.repeat([mass, radius, inertia], [1, 3, 6])


def deviations(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, covariance: np.ndarray
) -> np.ndarray:
    """Standard deviations of a function of what has that covariance, to first order.

    The slopes are exact: Im f(x + i h) / h with a tiny h (Squire and Trapp 1998).
    """
    step = 1e-30
    slopes = [function(at + 1j * step * e).imag / step for e in np.eye(len(at))]
    J = np.column_stack(slopes)
    return np.asarray(np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", J, covariance, J), 0.0)))


# From a robot or a model to its physics.


@dataclass(frozen=True)
class Equations:
    """What a robot's C computes.

    Attributes:
        spec: its parameters.
        torques: of base parameters, at random motion.
    """

    spec: ModuleSpec
    torques: Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class Original:
    """What a file that is to be written anew says of the links.

    Attributes:
        whole: by row, (10,) of all its bodies together, in the frame of the row.
        hung: by row, (10,) of those that keep their numbers.
    """

    whole: Mapping[str, np.ndarray] = field(default_factory=dict)
    hung: Mapping[str, np.ndarray] = field(default_factory=dict)


def robot_of(thing: Robot | IdentifiedModel) -> Robot:
    """The robot, or that of the model."""
    if isinstance(thing, Robot):
        return thing
    return robot_from_text(thing.robot_text, f"model of {thing.spec.robot}, robot_text")


def physics_of(
    thing: Robot | IdentifiedModel,
    original: Original,
    equations: Callable[[], Equations] | None = None,
) -> Physics:
    """The numbers of a robot, or of a model.

    Args:
        thing: it.
        original: a file that is to be written anew.
        equations: of a robot that leaves parameters of bodies open; None: any body is as good.

    Raises:
        DataError: a robot without values; nothing near the values could be built.
    """
    robot = robot_of(thing)
    if isinstance(thing, Robot):
        fit, (machine, beta) = None, _of_values(thing, bool(original.whole))
        given = values_of(robot)
        tens = [[given.get(machine.names[i]) for i in own] for own in machine.links.values()]
        if equations is not None and not original.whole and not all(map(_is_body, tens)):
            return _with_its_torques(robot, equations())
        C = np.zeros((len(beta), len(beta)))
    else:
        machine, beta, C = machine_of(thing.spec), thing.fit.beta, thing.fit.covariance
        fit = beta, C
    before, stated, notes = beforehand(machine, robot, original, beta, C)
    found, released, values = (
        conditioned(machine.K, before, beta, C),
        frozenset[str](),
        values_of(robot),
    )
    if not isinstance(thing, Robot):
        if standard := thing.fit.standard:
            chi = [standard.get(name, x) for name, x in zip(machine.names, found.chi, strict=True)]
            found = dataclasses.replace(found, chi=np.array(chi))
        if aside := [p.name for p in thing.fit.parameters if p.sigma is None]:
            notes.append(
                f"the fit set {', '.join(aside)} aside, at 0: other motion, or a prior "
                "([parameters.uncertainty]), would tell more"
            )
    if fit or not original.whole:  # what a file states stays as it is, whatever it is
        found, released, more = _settled(robot, machine, before, found, (beta, C), original)
        notes += more
    else:
        notes = []
    return Physics(robot, machine, found, stated, values, fit, released, tuple(notes))


def _rows_below(robot: Robot, row: str) -> Iterator[str]:
    """The rows that carry a row."""
    rows = {joint.name for joint in robot.joints}
    while (row := robot.joint(row).antecedent) in rows:
        yield row


def _is_body(ten: list[float | None]) -> bool:
    """Whether all parameters of a body are stated, and it can be built."""
    known = np.array([x for x in ten if x is not None])
    return len(known) == 10 and least(known, _round(known)) >= INSIDE


def _with_its_torques(robot: Robot, equations: Equations) -> Physics:
    """Bodies with the torques of the robot's C, in which what is not stated is 0.

    Torques depend on K chi alone: the rest of chi is chosen so that the bodies can be built, stated
    values last of all. Rods and points, which are limits of bodies, stay what they are.
    """
    machine, values, nothing = machine_of(equations.spec), values_of(robot), Original()
    known = np.array([values.get(name, 0.0) for name in machine.names])
    beta = machine.K @ known
    none = np.zeros((len(beta), len(beta)))
    before, stated, _ = beforehand(machine, robot, nothing, beta, none)
    size = {link: _round(before.mean[own]) for link, own in machine.links.items()}
    thin, others, moves, notes = list[str](), dict(machine.links), np.zeros(len(known)), list[str]()
    carrying = {row for link, own in machine.links.items() if known[own[9]] > 0.0
                for row in _rows_below(robot, link)}  # fmt: skip
    for link, own in machine.links.items():
        if link in carrying and not known[own].any():
            del others[link]  # without a body, as in the C
            continue
        smallest = least(known[own], size[link]) if known[own[9]] > 0.0 else -1.0
        if smallest < -_NO_BODY:
            moves[own] = 1.0
            continue
        del others[link]
        if smallest < INSIDE:
            thin.append(link)
            known[own] += max(_THIN * before.mean[own[:6]].max(), 2.0 * LEAST) * _ROUND
    if thin:
        notes.append(
            f"link {', '.join(thin)}: a rod or a point as it is stated; {_THIN:g} of its size was "
            "added to its inertia, for programs refuse bodies without"
        )
    beta = machine.K @ known
    unstated = moves * [name not in values for name in machine.names]
    told = f"link {', '.join(others)}: what is not stated was chosen; torques are those of the C"
    rest = dataclasses.replace(machine, links=others)
    for loose, more in ((unstated, ""), (moves, ", and stated values were moved for it")):
        mean, S = np.where(loose > 0.0, before.mean, known), before.S * np.outer(loose, loose)
        found = conditioned(machine.K, Beforehand(mean, S), beta, none)
        whole = buildable(rest, found, beta, none, size, {})
        if whole is not None:
            notes += [told + more] if others else []
            return Physics(robot, machine, whole, stated, values, notes=tuple(notes))
    plain = physics_of(robot, nothing)
    there = [plain.place.get(name) for name in machine.names]
    chi = np.array([0.0 if i is None else plain.now.chi[i] for i in there])
    right, other = (np.linalg.norm(equations.torques(b)) for b in (beta, machine.K @ chi - beta))
    note = (
        f"torques differ by {100.0 * other / right:.2g} % at random motion from those of the "
        f"C, where what is not stated is 0, for no such bodies can be built; state all of link "
        f"{', '.join(others)}"
    )
    return dataclasses.replace(plain, notes=(*plain.notes, note))


def _of_values(robot: Robot, with_bodies: bool) -> tuple[Machine, np.ndarray]:
    """The stated values as base parameters, what is not stated beside them.

    Args:
        robot: with values.
        with_bodies: a file states these.
    """
    values = values_of(robot)
    links = [joint.name for joint in robot.moving if robot.inertial(joint.name)]
    effects = [(row.name, e) for row in robot.moving for e in robot.effects_on(row.name)]
    own = [f"{column.prefix}{row}{instance.label}"
           for row, (_, form, instance) in effects for column in form.columns]  # fmt: skip
    names = [f"{prefix}{link}" for link in links for prefix in PREFIXES]
    names += [name for name in own if name in values]
    heavy = any(f"M{link}" in values or f"ZZ{link}" in values for link in links)
    if not heavy and not (with_bodies and any(name in values for name in own)):
        raise DataError(
            f"{robot.name}: a robot without values; write [parameters] into its file, or export a "
            "model of `modeler fit`"
        )
    place = {name: i for i, name in enumerate(names)}
    given = [name for name in names if name in values]
    K = np.eye(len(names))[[place[name] for name in given]]
    tens = {link: np.array([place[f"{p}{link}"] for p in PREFIXES]) for link in links}
    loss = {n for row in robot.moving for n, q in _held_names(robot, row.name) if q != "stiffness"}
    machine = Machine(tuple(names), K, tens, {n: place[n] for n in names if n in loss})
    return machine, np.array([values[name] for name in given])


def values_of(robot: Robot) -> dict[str, float]:
    """Nominal values by name, those that legs share under the name of every leg too."""
    found = dict(robot.parameters)
    for shared in robot.shared:
        if shared.name in found:
            found |= dict.fromkeys(shared.members, found[shared.name])
    return found


def beforehand(
    machine: Machine, robot: Robot, original: Original, beta: np.ndarray, C: np.ndarray
) -> tuple[Beforehand, frozenset[str], list[str]]:
    """What is known without torques; links of which something is; what is to be told."""
    values, count = values_of(robot), len(machine.names)
    mean, S = np.zeros(count), np.zeros((count, count))
    share = robot.uncertainty.get("inertial") or SHARE
    unknown, stated = {}, set()
    drawn = weights(robot, robot.home)
    for link, own in machine.links.items():
        ten = [values.get(f"{prefix}{link}") for prefix in PREFIXES]
        if None not in ten:
            given = np.array(ten, dtype=float)
        else:
            given = original.whole.get(link, np.zeros(10))
        why, block = body_covariance(given, share)
        if any(x is not None for x in ten):
            stated.add(link)
        if why or not block[0, 0]:
            unknown[link] = own
        else:
            mean[own], S[np.ix_(own, own)] = given, block
            stated.add(link)
    notes = []
    if unknown:
        density, told = _density(machine, unknown, drawn, mean, (beta, C))
        for link, own in unknown.items():
            mass = values.get(f"M{link}") or density * drawn[link][9]
            mean[own] = drawn[link] * (mass / drawn[link][9])
            S[np.ix_(own, own)] = body_covariance(mean[own], _UNKNOWN)[1]
        notes.append(
            f"link {', '.join(unknown)}: no body is stated in the robot file; what {_open(C)} of "
            f"it is that of a capsule{told}"
        )
    of_links = {i for own in machine.links.values() for i in own}
    most = np.abs(beta) + np.abs(machine.K @ mean) + np.sqrt(np.maximum(np.diag(C), 0.0))
    for i, name in enumerate(machine.names):
        deviation = robot.uncertainty.get(name)
        if i not in of_links and deviation is None:
            felt = np.flatnonzero(machine.K[:, i])
            deviation = _WIDE * float(max(most[felt] / np.abs(machine.K[felt, i]), default=0.0))
        if deviation is not None:
            S[i], S[:, i] = 0.0, 0.0
            S[i, i], mean[i] = deviation**2, values.get(name, 0.0)
    return Beforehand(mean, S), frozenset(stated), notes


def _density(
    machine: Machine,
    unknown: Mapping[str, np.ndarray],
    drawn: Mapping[str, np.ndarray],
    mean: np.ndarray,
    fit: tuple[np.ndarray, np.ndarray],
) -> tuple[float, str]:
    """Of capsules, over that of water; what is to be told of it."""
    known = [link for link in machine.links if link not in unknown]
    if known:
        heavy = sum(mean[machine.links[link][9]] for link in known)
        return float(heavy / sum(drawn[link][9] for link in known)), ", as dense as the others"
    beta, C = fit
    whole = mean.copy()
    for link, own in unknown.items():
        whole[own] = drawn[link]
    a, size = machine.K @ whole, np.sqrt(np.diag(C))
    weight = np.where(size > 0.0, 1.0 / np.where(size > 0.0, size, 1.0), 0.0)
    felt = float(np.sum((weight * a) ** 2))
    density = float(np.sum(weight**2 * a * beta) / felt) if felt else 0.0
    if _DENSITIES[0] < density < _DENSITIES[1]:
        return density, ", as dense as the torques allow: a mass they do not determine is arbitrary"
    return 1.0, " as dense as water: its mass is arbitrary"


def _open(C: np.ndarray) -> str:
    """Of a fit, and of a robot, whose values have no covariance."""
    return "the torques do not determine" if C.any() else "is not stated"


def _settled(
    robot: Robot,
    machine: Machine,
    before: Beforehand,
    found: Completed,
    fit: tuple[np.ndarray, np.ndarray],
    original: Original,
) -> tuple[Completed, frozenset[str], list[str]]:
    """What can be built; links on which what hangs must change; what is to be told.

    Raises:
        DataError: nothing near the values can be built.
    """
    beta, C = fit
    size = {link: _round(before.mean[own]) for link, own in machine.links.items()}
    first = impossible(machine, found.chi, size, {link: np.zeros(10) for link in machine.links})
    notes, stated = [], C
    for loose in (0.0, *_LOOSE):  # values that are stated of no body
        if loose:
            C = stated + loose**2 * machine.K @ before.S @ machine.K.T
            found = conditioned(machine.K, before, beta, C)
        nearest = partial(_nearest, machine, before, found, beta, C, size)
        whole = nearest({})
        if whole is not None:
            break
    if whole is None:
        raise DataError(
            f"{robot.name}: nothing near these values could be built, because of "
            f"{', '.join(first)}; correct [parameters] there"
        )
    if C is not stated:
        notes.append(
            f"{', '.join(first)}: stated as no machine could be built; the nearest that could "
            "is written"
        )
    elif first:
        notes.append(
            f"{', '.join(first)}: no body of these base parameters could be built; they moved by "
            f"{whole.moved:.2g} sigmas to the nearest that could"
            if whole.moved > 0.01 else
            f"{', '.join(first)}: what {_open(stated)} was moved so that it could be built"
        )  # fmt: skip
    if not original.hung:
        return whole, frozenset(), notes
    floors = {link: original.hung.get(link, np.zeros(10)) for link in machine.links}
    tight = impossible(machine, whole.chi, size, floors)
    own = nearest(original.hung)
    if own is not None and own.moved <= whole.moved + 1.0:
        return own, frozenset(), notes
    rest = {link: ten for link, ten in original.hung.items() if link not in tight}
    return nearest(rest) or whole, frozenset(tight), notes


def _nearest(
    machine: Machine,
    before: Beforehand,
    found: Completed,
    beta: np.ndarray,
    C: np.ndarray,
    size: Mapping[str, np.ndarray],
    hung: Mapping[str, np.ndarray],
) -> Completed | None:
    """The nearest that can be built; with base parameters as they are, if it is hardly farther."""
    best = buildable(machine, found, beta, C, size, hung)
    if best is None or not best.moved:
        return best
    exact = conditioned(machine.K, before, beta, 0.0 * C)
    exact = dataclasses.replace(exact, chi=found.chi)
    other = buildable(machine, exact, beta, C, size, hung)
    if other is None or other.far > best.far + 1.0:
        return best
    return dataclasses.replace(other, root=best.root, moved=0.0)


def _round(ten: np.ndarray) -> np.ndarray:
    """(4, 4) W of the round body of that mass, centre and size, W P W^T = 1."""
    mass, centre = abs(ten[9]) or 1.0, ten[6:9] / (ten[9] or 1.0)
    second = np.trace(pseudo_inertia_of(ten)[:3, :3]) - mass * centre @ centre
    radius = max(second / (3.0 * mass), 1e-12) ** 0.5
    W = np.diag([1.0 / radius, 1.0 / radius, 1.0 / radius, 1.0])
    W[:3, 3] = -centre / radius
    return np.asarray(W / mass**0.5)
