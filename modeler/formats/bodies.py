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
    PhysicalParameters,
    compute_body_covariance,
    compute_pseudo_inertia,
    define_physical_parameters,
    extract_parameters,
)
from modeler.formats.body_tree import Pose
from modeler.formats.completion import (
    CompletedParameters,
    Prior,
    compute_completion,
    compute_smallest_eigenvalue,
    find_nearest_physical,
    find_violations,
)
from modeler.formats.linkage import compute_capsule_parameters
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import Robot, parse_robot_text

_ROUND = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0])  # the inertia of a ball

HELD = {
    "urdf": ("damping", "friction"),
    "sdf": ("damping", "friction", "stiffness"),
    "mjcf": ("damping", "friction", "armature", "stiffness"),
}
"""What a joint of these formats has."""

_HELD_AS = {
    ("viscous", "Fv"): "damping",
    ("passive_friction", "Fvp"): "damping",
    ("coulomb", "Fs"): "friction",
    ("passive_friction", "Fsp"): "friction",
    ("rotor_inertia", "Ia"): "armature",
    ("spring", "Ks"): "stiffness",
}

Terms = Mapping[str, Mapping[str, float]]
"""quantity -> {standard parameter: coefficient}."""


@dataclass(frozen=True, eq=False)
class ExportParameters:
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
    machine: PhysicalParameters
    completion: CompletedParameters
    stated_links: frozenset[str]
    nominal: Mapping[str, float]
    fit: tuple[np.ndarray, np.ndarray] | None = None
    released_links: frozenset[str] = frozenset()
    notes: tuple[str, ...] = ()

    @cached_property
    def indices(self) -> dict[str, int]:
        """Returns the place of every parameter in chi; a shared one has that of all its names."""
        indices = {name: i for i, name in enumerate(self.machine.names)}
        for shared in self.robot.shared:
            if shared.name in indices:
                indices |= dict.fromkeys(shared.members, indices[shared.name])
        return indices

    def find_link_indices(self, row: str) -> list[int]:
        """Returns places in chi of the ten parameters of the link of a row; [] without a body."""
        if not self.robot.get_inertial_prefixes(row) or not self.robot.get_joint(row).is_moving:
            return []
        indices = [self.indices.get(f"{prefix}{row}") for prefix in PREFIXES]
        return [i for i in indices if i is not None] if None not in indices else []

    def get_link_parameters(self, row: str) -> np.ndarray | None:
        """Returns (10,) standard parameters of the link of a row; None if it has no body."""
        places = self.find_link_indices(row)
        return self.completion.chi[places] if places else None

    def get_nominal_parameters(self, row: str) -> np.ndarray | None:
        """Returns (10,) what the robot file says of them; None unless it says all."""
        values = [self.nominal.get(f"{prefix}{row}") for prefix in PREFIXES]
        return None if None in values else np.array(values, dtype=float)

    def evaluate_sum(self, terms: Mapping[str, float]) -> tuple[float, float]:
        """Returns a sum of parameters, and its standard deviation."""
        at = [self.indices[name] for name in terms]
        c = np.array(list(terms.values()))
        variance = float(c @ self.completion.covariance[np.ix_(at, at)] @ c)
        return float(c @ self.completion.chi[at]), max(variance, 0.0) ** 0.5

    def collect_drive_terms(self, row: str, to: str) -> Terms:
        """Returns what the joint of a row gets in a file of that format, of what has a value."""
        drive_terms: dict[str, Mapping[str, float]] = {}
        joint_terms = {} if row in self.robot.motors else collect_joint_terms(self.robot, row)
        for quantity, terms in joint_terms.items():
            known = {name: c for name, c in terms.items() if name in self.indices}
            if quantity in HELD[to] and known and self.evaluate_sum(known)[0] >= 0.0:
                drive_terms[quantity] = known
        return drive_terms


def collect_joint_terms(robot: Robot, row: str) -> dict[str, dict[str, float]]:
    """Returns damping, friction, armature and stiffness of a joint, as sums of parameters.

    Those of a motor of its own, too, that turns c times as fast: c^2 Fv, |c| Fs, c^2 Ia.
    """
    joint_terms: dict[str, dict[str, float]] = {}
    for name, quantity in _iterate_joint_parameters(robot, row):
        joint_terms.setdefault(quantity, {})[name] = 1.0
    for motor, ratios in robot.motors.items():
        relation = robot.relations.get(row)
        if set(ratios) == {row} and relation is not None and relation.names == {f"q{motor}"}:
            c = ratios[row]
            for name, quantity in _iterate_joint_parameters(robot, motor):
                share = abs(c) if quantity == "friction" else c * c
                joint_terms.setdefault(quantity, {})[name] = share
    return joint_terms


def _iterate_joint_parameters(robot: Robot, row: str) -> Iterator[tuple[str, str]]:
    for effect, form, instance in robot.find_joint_effects(row):
        for column in form.columns:
            quantity = _HELD_AS.get((effect.id, column.prefix))
            is_hard = instance.nonlinear_parameters.get("h")  # no spring, but a stop
            if quantity and not (quantity == "stiffness" and is_hard):
                yield f"{column.prefix}{row}{instance.label}", quantity


def find_spring_rest(robot: Robot, row: str) -> float:
    """Returns where the spring of a joint is at rest."""
    effects = robot.find_joint_effects(row)
    springs = [i.nonlinear_parameters for effect, _, i in effects if effect.id == "spring"]
    return float(springs[0].get("q0", 0.0)) if springs else 0.0


# Ten parameters of a body in other frames, and as files write them.


def express_parameters(ten: np.ndarray, pose: Pose) -> np.ndarray:
    """Returns (10, ...) parameters in a frame a of a body given in b, whose pose in a that is."""
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = pose.rotation, pose.position
    P = compute_pseudo_inertia(ten)
    return np.asarray(extract_parameters(np.einsum("ai,ij...,bj->ab...", T, P, T)))


def compute_central_parameters(ten: np.ndarray, axes: np.ndarray | None = None) -> np.ndarray:
    """Returns (10,) mass, centre, and XX XY XZ YY YZ ZZ about the centre along some axes.

    A body without mass has its centre in the origin.

    Args:
        ten: at the origin of the frame.
        axes: (3, 3) as columns; None: those of the frame.
    """
    mass = ten[9]
    centre = ten[6:9] / mass if mass else 0.0 * ten[6:9]
    spread = centre @ centre * np.eye(3) - np.outer(centre, centre)
    about = build_symmetric_matrix(ten[:6]) - mass * spread
    if axes is not None:
        about = axes.T @ about @ axes
    parameters = np.concatenate([[mass], centre, about[np.triu_indices(3)]])
    nothing = np.abs(parameters) <= THRESHOLDS.max_relative_rounding * compute_magnitudes(
        parameters
    )  # what differences leave of 0
    return parameters - np.where(nothing, parameters.real, 0.0)


def build_symmetric_matrix(six: np.ndarray) -> np.ndarray:
    """Returns (3, 3) of XX XY XZ YY YZ ZZ."""
    return np.asarray(six[[[0, 1, 2], [1, 3, 4], [2, 4, 5]]])


def compute_magnitudes(body: np.ndarray) -> np.ndarray:
    """Returns (10,) how large the numbers of a body are, as `compute_central_parameters`.

    Those of a kind are alike.

    Of the centre its distance and the radius of gyration count, of the inertia that about the
    origin: these are what differences are taken of.
    """
    mass, far, about = abs(body[0]), np.abs(body[1:4]).max(), np.abs(body[4:]).max()
    inertia = about + mass * far**2
    radius = (inertia / mass) ** 0.5 if mass else 0.0
    return np.repeat([mass, radius, inertia], [1, 3, 6])


def propagate_deviations(
    function: Callable[[np.ndarray], np.ndarray], at: np.ndarray, covariance: np.ndarray
) -> np.ndarray:
    """Returns standard deviations of a function of what has that covariance, to first order.

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

    total_inertia: Mapping[str, np.ndarray] = field(default_factory=dict)
    attached_inertia: Mapping[str, np.ndarray] = field(default_factory=dict)


def get_robot(robot_or_model: Robot | IdentifiedModel) -> Robot:
    """Returns the robot, or that of the model, its elastic joints as they were fitted."""
    if isinstance(robot_or_model, Robot):
        return robot_or_model
    where = f"model of {robot_or_model.spec.robot}, robot_text"
    robot, values = parse_robot_text(robot_or_model.robot_text, where), robot_or_model.fit
    sizes = values.elastic_values
    return robot if sizes is None else robot.set_windups(sizes.tolist())


def build_export_parameters(
    robot_or_model: Robot | IdentifiedModel,
    original: Original,
    equations: Callable[[], Equations] | None = None,
) -> ExportParameters:
    """Returns the numbers of a robot, or of a model.

    Args:
        robot_or_model: it.
        original: a file that is to be written anew.
        equations: of a robot that leaves parameters of bodies open; None: any body is as good.

    Raises:
        DataError: a robot without values; nothing near the values could be built.
    """
    robot = get_robot(robot_or_model)
    if isinstance(robot_or_model, Robot):
        fit = None
        (machine, beta) = _collect_stated_values(robot_or_model, bool(original.total_inertia))
        values = collect_nominal_values(robot)
        tens = [[values.get(machine.names[i]) for i in places] for places in machine.links.values()]
        if equations is not None and not original.total_inertia and not all(map(_is_body, tens)):
            return _complete_with_torques(robot, equations())
        C = np.zeros((len(beta), len(beta)))
    else:
        machine = define_physical_parameters(robot_or_model.spec)
        beta = robot_or_model.fit.beta
        C = robot_or_model.fit.covariance
        fit = beta, C
    before, stated, notes = build_prior(machine, robot, original, beta, C)
    completion = compute_completion(machine.K, before, beta, C)
    released = frozenset[str]()
    values = collect_nominal_values(robot)
    if not isinstance(robot_or_model, Robot):
        if standard := robot_or_model.fit.standard:
            chosen = zip(machine.names, completion.chi, strict=True)
            chi = [standard.get(name, x) for name, x in chosen]
            completion = dataclasses.replace(completion, chi=np.array(chi))
        if aside := [p.name for p in robot_or_model.fit.parameters if p.sigma is None]:
            notes.append(
                f"the fit set {', '.join(aside)} aside, at 0: other motion, or a prior "
                "([parameters.uncertainty]), would show more"
            )
    if fit or not original.total_inertia:  # what a file states stays as it is, whatever it is
        fit_here = beta, C
        completion, released, more = _find_projection(
            robot, machine, before, completion, fit_here, original
        )
        notes += more
    else:
        notes = []
    return ExportParameters(robot, machine, completion, stated, values, fit, released, tuple(notes))


def _iterate_carrying_rows(robot: Robot, row: str) -> Iterator[str]:
    """The rows that carry a row."""
    rows = {joint.name for joint in robot.joints}
    while (row := robot.get_joint(row).antecedent) in rows:
        yield row


def _is_body(ten: list[float | None]) -> bool:
    """Whether all parameters of a body are stated, and it can be built."""
    known = np.array([x for x in ten if x is not None])
    return (
        len(known) == 10
        and compute_smallest_eigenvalue(known, _compute_sphere_scaling(known))
        >= THRESHOLDS.min_body_eigenvalue
    )


def _complete_with_torques(robot: Robot, equations: Equations) -> ExportParameters:
    """Bodies with the torques of the robot's C, in which what is not stated is 0.

    Torques depend on K chi alone: the rest of chi is chosen so that the bodies can be built, stated
    values last of all. Rods and points, which are limits of bodies, stay what they are.
    """
    machine = define_physical_parameters(equations.spec)
    values = collect_nominal_values(robot)
    nothing = Original()
    known = np.array([values.get(name, 0.0) for name in machine.names])
    beta = machine.K @ known
    none = np.zeros((len(beta), len(beta)))
    before, stated, _ = build_prior(machine, robot, nothing, beta, none)
    size = _compute_sizes(machine, before)
    thin, others, moves, notes = list[str](), dict(machine.links), np.zeros(len(known)), list[str]()
    heavy = [link for link, indices in machine.links.items() if known[indices[9]] > 0.0]
    carrying = {row for link in heavy for row in _iterate_carrying_rows(robot, link)}
    for link, indices in machine.links.items():
        if link in carrying and not known[indices].any():
            del others[link]  # without a body, as in the C
            continue
        smallest = -1.0
        if known[indices[9]] > 0.0:
            smallest = compute_smallest_eigenvalue(known[indices], size[link])
        if smallest < -THRESHOLDS.min_rounded_eigenvalue:
            moves[indices] = 1.0
            continue
        del others[link]
        if smallest < THRESHOLDS.min_body_eigenvalue:
            thin.append(link)
            share = THRESHOLDS.added_inertia_share * before.mean[indices[:6]].max()
            known[indices] += max(share, 2.0 * THRESHOLDS.min_moment_of_inertia) * _ROUND
    if thin:
        notes.append(
            f"link {', '.join(thin)}: a rod or a point as it is stated; "
            f"{THRESHOLDS.added_inertia_share:g} of its size was "
            "added to its inertia, for programs refuse bodies without"
        )
    beta = machine.K @ known
    unstated = moves * [name not in values for name in machine.names]
    summary = f"link {', '.join(others)}: what is not stated was chosen; torques are those of the C"
    rest = dataclasses.replace(machine, links=others)
    for freedom, more in ((unstated, ""), (moves, ", and stated values were moved for it")):
        mean, S = np.where(freedom > 0.0, before.mean, known), before.S * np.outer(freedom, freedom)
        completion = compute_completion(machine.K, Prior(mean, S), beta, none)
        whole = find_nearest_physical(rest, completion, beta, none, size, {})
        if whole is not None:
            notes += [summary + more] if others else []
            return ExportParameters(robot, machine, whole, stated, values, notes=tuple(notes))
    plain = build_export_parameters(robot, nothing)
    plain_indices = [plain.indices.get(name) for name in machine.names]
    chi = np.array([0.0 if i is None else plain.completion.chi[i] for i in plain_indices])
    right, other = (np.linalg.norm(equations.torques(b)) for b in (beta, machine.K @ chi - beta))
    note = (
        f"torques differ by {100.0 * other / right:.2g} % at random motion from those of the "
        f"C, where what is not stated is 0, for no such bodies can be built; state all of link "
        f"{', '.join(others)}"
    )
    return dataclasses.replace(plain, notes=(*plain.notes, note))


def _collect_stated_values(
    robot: Robot, with_bodies: bool
) -> tuple[PhysicalParameters, np.ndarray]:
    """The stated values as base parameters, what is not stated beside them.

    Args:
        robot: with values.
        with_bodies: a file states these.
    """
    values = collect_nominal_values(robot)
    links = [joint.name for joint in robot.moving_joints if robot.get_inertial_prefixes(joint.name)]
    rows = [joint.name for joint in robot.moving_joints]
    effects = [(row, e) for row in rows for e in robot.find_joint_effects(row)]
    effect_parameters = [
        f"{column.prefix}{row}{instance.label}"
        for row, (_, form, instance) in effects
        for column in form.columns
    ]
    names = [f"{prefix}{link}" for link in links for prefix in PREFIXES]
    names += [name for name in effect_parameters if name in values]
    has_mass = any(f"M{link}" in values or f"ZZ{link}" in values for link in links)
    if not has_mass and not (with_bodies and any(name in values for name in effect_parameters)):
        raise DataError(
            f"{robot.name}: a robot without values; write [parameters] into its file, or export a "
            "model of `modeler fit`"
        )
    place = {name: i for i, name in enumerate(names)}
    known_names = [name for name in names if name in values]
    K = np.eye(len(names))[[place[name] for name in known_names]]
    tens = {link: np.array([place[f"{p}{link}"] for p in PREFIXES]) for link in links}
    parameters = [p for row in rows for p in _iterate_joint_parameters(robot, row)]
    loss = {name for name, quantity in parameters if quantity != "stiffness"}
    machine = PhysicalParameters(tuple(names), K, tens, {n: place[n] for n in names if n in loss})
    return machine, np.array([values[name] for name in known_names])


def collect_nominal_values(robot: Robot) -> dict[str, float]:
    """Returns nominal values by name, those that legs share under the name of every leg too."""
    values = dict(robot.parameters)
    for shared in robot.shared:
        if shared.name in values:
            values |= dict.fromkeys(shared.members, values[shared.name])
    return values


def build_prior(
    machine: PhysicalParameters, robot: Robot, original: Original, beta: np.ndarray, C: np.ndarray
) -> tuple[Prior, frozenset[str], list[str]]:
    """Returns what is known without torques; links of which something is; what to report."""
    values, count = collect_nominal_values(robot), len(machine.names)
    mean, S = np.zeros(count), np.zeros((count, count))
    share = robot.uncertainty.get("inertial") or THRESHOLDS.stated_body_deviation
    unknown, stated = {}, set()
    capsule_parameters = compute_capsule_parameters(robot, robot.home)
    for link, indices in machine.links.items():
        ten = [values.get(f"{prefix}{link}") for prefix in PREFIXES]
        if None not in ten:
            parameters = np.array(ten, dtype=float)
        else:
            parameters = original.total_inertia.get(link, np.zeros(10))
        why, block = compute_body_covariance(parameters, share)
        if any(x is not None for x in ten):
            stated.add(link)
        if why or not block[0, 0]:
            unknown[link] = indices
        else:
            mean[indices], S[np.ix_(indices, indices)] = parameters, block
            stated.add(link)
    notes = []
    if unknown:
        density, basis = _estimate_density(machine, unknown, capsule_parameters, mean, (beta, C))
        for link, indices in unknown.items():
            mass = values.get(f"M{link}") or density * capsule_parameters[link][9]
            mean[indices] = capsule_parameters[link] * (mass / capsule_parameters[link][9])
            covariance = compute_body_covariance(mean[indices], THRESHOLDS.capsule_deviation)[1]
            S[np.ix_(indices, indices)] = covariance
        notes.append(
            f"link {', '.join(unknown)}: no body is stated in the robot file; what "
            f"{_describe_undetermined(C)} of it is that of a capsule{basis}"
        )
    of_links = {i for indices in machine.links.values() for i in indices}
    most = np.abs(beta) + np.abs(machine.K @ mean) + np.sqrt(np.maximum(np.diag(C), 0.0))
    for i, name in enumerate(machine.names):
        deviation = robot.uncertainty.get(name)
        if i not in of_links and deviation is None:
            active_rows = np.flatnonzero(machine.K[:, i])
            deviation = THRESHOLDS.unknown_value_deviation * float(
                max(most[active_rows] / np.abs(machine.K[active_rows, i]), default=0.0)
            )
        if deviation is not None:
            S[i], S[:, i] = 0.0, 0.0
            S[i, i], mean[i] = deviation**2, values.get(name, 0.0)
    return Prior(mean, S), frozenset(stated), notes


def _estimate_density(
    machine: PhysicalParameters,
    unknown: Mapping[str, np.ndarray],
    capsule_parameters: Mapping[str, np.ndarray],
    mean: np.ndarray,
    fit: tuple[np.ndarray, np.ndarray],
) -> tuple[float, str]:
    """Of capsules, over that of water; what is to be reported about it."""
    known = [link for link in machine.links if link not in unknown]
    if known:
        known_mass = sum(mean[machine.links[link][9]] for link in known)
        known_capsules = sum(capsule_parameters[link][9] for link in known)
        return float(known_mass / known_capsules), ", as dense as the others"
    beta, C = fit
    whole = mean.copy()
    for link, indices in unknown.items():
        whole[indices] = capsule_parameters[link]
    a, size = machine.K @ whole, np.sqrt(np.diag(C))
    weight = np.where(size > 0.0, 1.0 / np.where(size > 0.0, size, 1.0), 0.0)
    weighted_norm = float(np.sum((weight * a) ** 2))
    density = float(np.sum(weight**2 * a * beta) / weighted_norm) if weighted_norm else 0.0
    if THRESHOLDS.density_range[0] < density < THRESHOLDS.density_range[1]:
        return density, ", as dense as the torques allow: a mass they do not determine is arbitrary"
    return 1.0, " as dense as water: its mass is arbitrary"


def _describe_undetermined(C: np.ndarray) -> str:
    """Of a fit, and of a robot, whose values have no covariance."""
    return "the torques do not determine" if C.any() else "is not stated"


def _find_projection(
    robot: Robot,
    machine: PhysicalParameters,
    before: Prior,
    completion: CompletedParameters,
    fit: tuple[np.ndarray, np.ndarray],
    original: Original,
) -> tuple[CompletedParameters, frozenset[str], list[str]]:
    """What can be built; links on which what hangs must change; what is to be reported.

    Raises:
        DataError: nothing near the values can be built.
    """
    beta, C = fit
    size = _compute_sizes(machine, before)
    none = {link: np.zeros(10) for link in machine.links}
    first = find_violations(machine, completion.chi, size, none)
    notes, stated = [], C
    for tolerance in (
        0.0,
        *THRESHOLDS.stated_value_tolerances,
    ):  # values that are stated of no body
        if tolerance:
            C = stated + tolerance**2 * machine.K @ before.S @ machine.K.T
            completion = compute_completion(machine.K, before, beta, C)
        nearest = partial(_find_nearest, machine, before, completion, beta, C, size)
        whole = nearest({})
        if whole is not None:
            break
    if whole is None:
        raise DataError(
            f"{robot.name}: nothing near these values could be built, because of "
            f"{', '.join(first)}; correct [parameters] there"
        )
    if C is not stated:
        what = "stated as no machine could be built; the nearest that could is written"
        notes.append(f"{', '.join(first)}: {what}")
    elif first:
        names, moved = ", ".join(first), whole.shift_in_sigmas
        note = f"what {_describe_undetermined(stated)} was moved so that it could be built"
        if moved > 0.01:
            note = "no body of these base parameters could be built; they moved by "
            note += f"{moved:.2g} sigmas to the nearest that could"
        notes.append(f"{names}: {note}")
    if not original.attached_inertia:
        return whole, frozenset(), notes
    floors = {link: original.attached_inertia.get(link, np.zeros(10)) for link in machine.links}
    tight = find_violations(machine, whole.chi, size, floors)
    projection = nearest(original.attached_inertia)
    if projection is not None and projection.shift_in_sigmas <= whole.shift_in_sigmas + 1.0:
        return projection, frozenset(), notes
    rest = {link: ten for link, ten in original.attached_inertia.items() if link not in tight}
    return nearest(rest) or whole, frozenset(tight), notes


def _find_nearest(
    machine: PhysicalParameters,
    before: Prior,
    completion: CompletedParameters,
    beta: np.ndarray,
    C: np.ndarray,
    size: Mapping[str, np.ndarray],
    attached_inertia: Mapping[str, np.ndarray],
) -> CompletedParameters | None:
    """The nearest that can be built; with base parameters as they are, if it is hardly farther."""
    best = find_nearest_physical(machine, completion, beta, C, size, attached_inertia)
    if best is None or not best.shift_in_sigmas:
        return best
    exact = compute_completion(machine.K, before, beta, 0.0 * C)
    exact = dataclasses.replace(exact, chi=completion.chi)
    other = find_nearest_physical(machine, exact, beta, C, size, attached_inertia)
    if other is None or other.total_shift > best.total_shift + 1.0:
        return best
    return dataclasses.replace(other, root=best.root, shift_in_sigmas=0.0)


def _compute_sizes(machine: PhysicalParameters, prior: Prior) -> dict[str, np.ndarray]:
    """By link, (4, 4) W of the round body of its size."""
    mean = prior.mean
    return {link: _compute_sphere_scaling(mean[places]) for link, places in machine.links.items()}


def _compute_sphere_scaling(ten: np.ndarray) -> np.ndarray:
    """(4, 4) W of the round body of that mass, centre and size, W P W^T = 1."""
    mass, centre = abs(ten[9]) or 1.0, ten[6:9] / (ten[9] or 1.0)
    second = np.trace(compute_pseudo_inertia(ten)[:3, :3]) - mass * centre @ centre
    radius = max(second / (3.0 * mass), 1e-12) ** 0.5
    W = np.diag([1.0 / radius, 1.0 / radius, 1.0 / radius, 1.0])
    W[:3, 3] = -centre / radius
    return np.asarray(W / mass**0.5)
