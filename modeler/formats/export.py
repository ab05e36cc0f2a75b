"""A robot or a model as a file for another program."""

import dataclasses
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.formats.bodies import (
    Equations,
    ExportParameters,
    Original,
    build_export_parameters,
    build_symmetric_matrix,
    compute_central_parameters,
    find_spring_rest,
    get_robot,
)
from modeler.formats.body_tree import Pose, compute_axis_rotation
from modeler.formats.linkage import (
    BASE,
    Capsule,
    build_capsules,
    close_loops,
    compute_gravity,
    compute_row_pose,
    evaluate_variables,
    get_variable_sign,
)
from modeler.formats.mdh_rows import compute_roll_pitch_yaw
from modeler.formats.original import TENSOR, assign_links, collect_original, read_original
from modeler.formats.result import (
    Exported,
    Torques,
    Value,
    build_body_values,
    build_drive_values,
    compute_sigmas,
    find_lost_effects,
    format_numbers,
    insert_comment,
)
from modeler.formats.rewriting import rewrite_file
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import Joint, JointKind, Robot, extract_linear_form

_TINY = {"mjcf": 1e-13, "urdf": 1e-9, "sdf": 1e-9}
"""Of all mass: a link that has none, which MuJoCo and SDF refuse; ODE divides by it."""

_EFFORT = 1e3  # N m, N: of a file that must state one
_FAR = 1e3  # m, of a prismatic joint without limits, where it must have some


@dataclass(frozen=True, eq=False)
class Part:
    """A row of the table as a link and its joint.

    Attributes:
        row: it.
        link, joint, parent: names in the file.
        pose: in the frame of the parent, at `zero`.
        zero: position of the joint there.
        axis: (3,) in its own frame.
        body: (10,) mass, centre, inertia about it; None without.
        drive: damping, friction, armature, stiffness, rest; those it has.
        leaders: joints that it follows, and how many times; offset: what is added.
    """

    row: Joint
    link: str
    joint: str
    parent: str
    pose: Pose
    zero: float
    axis: np.ndarray
    body: np.ndarray | None
    drive: Mapping[str, float]
    leaders: Mapping[str, float]
    offset: float
    capsules: tuple[Capsule, ...]


@dataclass(frozen=True)
class Names:
    """What rows are called, no name being that of two things: SDF and MuJoCo refuse such.

    Attributes:
        joints: by row: as in the file that the robot came from, where it has them.
        links: by row, and of the base.
        upright: the joint that turns the base.
    """

    joints: dict[str, str]
    links: dict[str, str]
    upright: str

    @classmethod
    def choose_names(cls, robot: Robot) -> "Names":
        """Chooses the names of the links and joints of a robot."""
        taken = {"world", *(frame.joint for frame in robot.frames.values())}

        def make_unique(name: str) -> str:
            while name in taken:
                name += "_"
            taken.add(name)
            return name

        rows = [joint.name for joint in robot.joints]
        file_names = {f.row: f.joint for f in robot.frames.values() if f.joint not in ("", "world")}
        joints = {row: file_names.get(row) or make_unique(f"joint_{row}") for row in rows}
        links = {BASE: make_unique("base")} | {row: make_unique(f"link_{row}") for row in rows}
        return cls(joints, links, make_unique("upright"))


def format_new_file(physics: ExportParameters, to: str, notes: list[str]) -> bytes:
    """Returns the text of the file; notes grow.

    Raises:
        DataError: loops, or couplings of several joints, that the format cannot state.
    """
    robot = physics.robot
    if to != "mjcf" and robot.loops:
        raise DataError(
            f"{robot.name}: {to.upper()} has no loops, and this robot has "
            f"{', '.join(loop.name for loop in robot.loops)}; write MJCF (--to mjcf), or cut the "
            "loops in the robot file"
        )
    at = close_loops(robot) if to == "mjcf" and (robot.loops or robot.relations) else {}
    names = Names.choose_names(robot)
    parts = _build_parts(physics, to, at, names, notes)
    root = {"urdf": _build_urdf, "mjcf": _build_mjcf, "sdf": _build_sdf}[to](physics, parts, names)
    ET.indent(root)
    return b'<?xml version="1.0"?>\n' + ET.tostring(root) + b"\n"


def _build_parts(
    physics: ExportParameters, to: str, at: Mapping[str, float], names: Names, notes: list[str]
) -> list[Part]:
    robot, massless_links = physics.robot, list[str]()
    values = evaluate_variables(robot, at) | {f"q{row}": q for row, q in at.items()}
    if not at:
        values |= {joint.variable: 0.0 for joint in robot.moving_joints}
    symbols, capsules_by_row = robot.evaluate_symbols(), build_capsules(robot, at)
    bodies = [physics.get_link_parameters(joint.name) for joint in robot.moving_joints]
    total_mass = sum(float(ten[9]) for ten in bodies if ten is not None)
    parts, moment, tiny = [], THRESHOLDS.min_moment_of_inertia, _TINY[to]
    for row in robot.joints:
        if row.name in robot.motors:
            continue
        ten = physics.get_link_parameters(row.name)
        body = None if ten is None or not ten[9] else compute_central_parameters(ten)
        if body is None and row.is_moving:
            massless_links.append(names.links[row.name])
            moment = total_mass * capsules_by_row[row.name][0].radius ** 2
            least = THRESHOLDS.min_moment_of_inertia
            moment = float(np.clip(2.0 * least, tiny * moment, 1e3 * tiny * moment))
            body = np.array([tiny * total_mass, 0, 0, 0, moment, 0, 0, moment, 0, moment])
        relation = robot.relations.get(row.name)
        form = None if relation is None else extract_linear_form(relation, symbols)
        leaders = {} if form is None else dict(form.coefficients)
        if any(name[1:] in robot.motors for name in leaders):
            leaders = {}
        if len(leaders) > 1 and to != "mjcf":
            raise DataError(
                f"{robot.name}: joint {row.name} follows {', '.join(leaders)}, and {to.upper()} "
                "lets a joint follow one; write MJCF (--to mjcf)"
            )
        terms = physics.collect_drive_terms(row.name, to)
        drive = {quantity: physics.evaluate_sum(sum_)[0] for quantity, sum_ in terms.items()}
        if "stiffness" in drive:
            drive["rest"] = find_spring_rest(robot, row.name)
        parts.append(
            Part(
                row,
                names.links[row.name],
                names.joints[row.name],
                names.links[row.antecedent],
                compute_row_pose(row, values),
                values[row.variable] if row.is_moving else 0.0,
                np.array([0.0, 0.0, get_variable_sign(row, symbols) if row.is_moving else 1.0]),
                body,
                drive,
                {names.joints[name[1:]]: c for name, c in leaders.items()},
                form.constant if form else 0.0,
                capsules_by_row[row.name],
            )
        )
    if massless_links:
        is_small = moment < THRESHOLDS.min_moment_of_inertia
        refusing_programs = "SDF refuses" if is_small else "MuJoCo and SDF refuse"
        size_note = "; it is too small for MuJoCo" if is_small else ""
        notes.append(
            f"{', '.join(massless_links)}: no body, and {tiny:g} of the mass of all is written, "
            f"for {refusing_programs} a moving link without mass{size_note}"
        )
    return parts


Number = float | np.ndarray


def _build_node(
    tag: str, *children: ET.Element | str | Number, **attributes: str | Number
) -> ET.Element:
    """An element; of numbers and texts among the children its text."""
    node = ET.Element(tag, {key: _format_value(value) for key, value in attributes.items()})
    for child in children:
        if isinstance(child, ET.Element):
            node.append(child)
        else:
            node.text = _format_value(child)
    return node


def _format_value(value: str | Number) -> str:
    return value if isinstance(value, str) else format_numbers(np.ravel(value))


def _compute_upright_axes(gravity: np.ndarray) -> np.ndarray:
    """(3, 3) axes of frame 0 in a world whose gravity points along -z."""
    size = float(np.linalg.norm(gravity))
    down = gravity / size if size else np.array([0.0, 0.0, -1.0])
    axis = np.cross(down, [0.0, 0.0, -1.0])
    sine = float(np.linalg.norm(axis))
    if sine < 1e-12:
        half_turn = compute_axis_rotation(np.array([1.0, 0.0, 0.0]), np.pi)
        return np.eye(3) if down[2] < 0.0 else half_turn
    return compute_axis_rotation(axis / sine, float(np.arctan2(sine, -down[2])))


def _collect_limits(physics: ExportParameters, row: Joint) -> dict[str, float]:
    limits = physics.robot.limits.get(row.name)
    if limits is None:
        far = {"lower": -_FAR, "upper": _FAR, "velocity": _FAR}
        return far if row.kind is JointKind.PRISMATIC else {}
    return {"lower": limits.lower, "upper": limits.upper, "velocity": limits.speed}


def _compute_capsule_pose(capsule: Capsule) -> Pose:
    """The middle of a capsule, z along it."""
    middle = 0.5 * (capsule.start + capsule.end)
    turn = _compute_upright_axes(-capsule.axis_vector).T if capsule.length else np.eye(3)
    return Pose(middle, turn)


# URDF.


def _build_urdf(physics: ExportParameters, parts: list[Part], names: Names) -> ET.Element:
    root = _build_node("robot", name=physics.robot.name)
    lift = _compute_upright_axes(compute_gravity(physics.robot))
    if not np.allclose(lift, np.eye(3), atol=1e-12):
        ends = _build_node("parent", link="world"), _build_node("child", link=names.links[BASE])
        upright = _build_origin(Pose(np.zeros(3), lift)), *ends
        root.append(_build_node("link", name="world"))
        root.append(_build_node("joint", *upright, name=names.upright, type="fixed"))
    root.append(_build_node("link", name=names.links[BASE]))
    for part in parts:
        moves, link = part.row.is_moving, _build_node("link", name=part.link)
        if part.body is not None:
            tensor = _build_node("inertia", **dict(zip(TENSOR, part.body[4:], strict=True)))
            mass = _build_node("mass", value=part.body[0])
            link.append(_build_node("inertial", _build_origin(Pose(part.body[1:4])), mass, tensor))
        shapes = (shape for capsule in part.capsules for shape in _build_visuals(capsule))
        link.extend(shapes if moves else ())
        limits = _collect_limits(physics, part.row) if moves else {}
        kind = part.row.kind.name.lower() if limits or not moves else "continuous"
        ends = _build_node("parent", link=part.parent), _build_node("child", link=part.link)
        joint = _build_node("joint", _build_origin(part.pose), *ends, name=part.joint, type=kind)
        if moves:
            joint.append(_build_node("axis", xyz=part.axis))
        if limits:
            joint.append(_build_node("limit", **limits, effort=_EFFORT))
        if part.drive:
            joint.append(_build_node("dynamics", **part.drive))
        for leader, ratio in part.leaders.items():
            joint.append(_build_node("mimic", joint=leader, multiplier=ratio, offset=part.offset))
        root.extend([link, joint])
    return root


def _build_origin(pose: Pose) -> ET.Element:
    angles = np.array(compute_roll_pitch_yaw(pose.rotation))
    return _build_node("origin", xyz=pose.position, rpy=angles)


def _build_visuals(capsule: Capsule) -> Iterator[ET.Element]:
    def build_visual(pose: Pose, tag: str, **sizes: float) -> ET.Element:
        geometry = _build_node("geometry", _build_node(tag, **sizes))
        return _build_node("visual", _build_origin(pose), geometry)

    yield build_visual(Pose(capsule.start), "sphere", radius=capsule.radius)
    if capsule.length:
        yield build_visual(Pose(capsule.end), "sphere", radius=capsule.radius)
        sizes = {"radius": capsule.radius, "length": capsule.length}
        yield build_visual(_compute_capsule_pose(capsule), "cylinder", **sizes)


# MJCF.


def _build_mjcf(physics: ExportParameters, parts: list[Part], names: Names) -> ET.Element:
    robot, base = physics.robot, _build_node("body", name=names.links[BASE])
    bodies, zero = {names.links[BASE]: base}, {part.joint: part.zero for part in parts}
    equality, tendons, motors = (ET.Element(x) for x in ("equality", "tendon", "actuator"))
    for part in parts:
        angles = np.array(compute_roll_pitch_yaw(part.pose.rotation))
        place = {"pos": part.pose.position, "euler": angles}
        bodies[part.link] = body = _build_node("body", name=part.link, **place)
        bodies[part.parent].append(body)
        if not part.row.is_moving:
            continue
        assert part.body is not None
        full = part.body[[4, 7, 9, 5, 6, 8]]
        numbers = {"pos": part.body[1:4], "mass": part.body[0], "fullinertia": full}
        body.append(_build_node("inertial", **numbers))
        keys = {"friction": "frictionloss", "rest": "springref"}
        more: dict[str, Number] = {keys.get(q, q): x for q, x in part.drive.items()}
        if limits := robot.limits.get(part.row.name):
            more["range"] = np.array([limits.lower, limits.upper])
        more |= {"ref": part.zero} if part.zero else {}
        kind = "slide" if part.row.kind is JointKind.PRISMATIC else "hinge"
        body.append(_build_node("joint", name=part.joint, type=kind, axis=part.axis, **more))
        if windup := robot.find_windup(part.row.name):  # less the windup: the link behind the motor
            K, D = windup
            about: dict[str, Number] = {"axis": part.axis, "stiffness": K, "damping": D}
            name = f"{part.joint}_windup"
            body.append(_build_node("joint", name=name, type=kind, **about))
        for capsule in part.capsules:
            shape: dict[str, str | Number] = {"type": "sphere", "size": capsule.radius}
            if capsule.start.any():
                shape["pos"] = capsule.start
            if capsule.length:
                end_points = np.concatenate([capsule.start, capsule.end])
                shape = {"type": "capsule", "size": capsule.radius, "fromto": end_points}
            body.append(_build_node("geom", **shape, mass=0.0, contype="0", conaffinity="0"))
        if part.leaders:
            _add_follower(part, zero, equality, tendons)
        elif part.row.actuated or part.row.name in robot.relations:
            motors.append(_build_node("motor", name=part.joint, joint=part.joint))
    for loop in robot.loops:
        ends = {"body1": names.links[loop.frame], "body2": names.links[loop.meets]}
        if loop.kind == "rigid":
            equality.append(_build_node("weld", **ends))
            continue
        size = parts[0].capsules[0].radius  # a second point of the axis
        for z in (0.0, size) if loop.kind == "revolute" else (0.0,):
            equality.append(_build_node("connect", anchor=np.array([0.0, 0.0, z]), **ends))
    further = [element for element in (tendons, equality, motors) if len(element)]
    option = _build_node("option", gravity=compute_gravity(physics.robot))
    compiler = _build_node("compiler", angle="radian", eulerseq="XYZ")
    head = compiler, option, _build_node("worldbody", base)
    return _build_node("mujoco", *head, *further, model=robot.name)


def _add_follower(
    part: Part, zero: Mapping[str, float], equality: ET.Element, tendons: ET.Element
) -> None:
    """q = offset + sum ratio q_leader; MuJoCo counts from the positions of `ref`."""
    if len(part.leaders) == 1:
        ((leader, ratio),) = part.leaders.items()
        line = np.array([part.offset + ratio * zero[leader] - part.zero, ratio, 0, 0, 0])
        equality.append(_build_node("joint", joint1=part.joint, joint2=leader, polycoef=line))
        return
    name, shares = f"{part.joint}_follows", {part.joint: -1.0, **part.leaders}
    joints = [_build_node("joint", joint=joint, coef=ratio) for joint, ratio in shares.items()]
    tendons.append(_build_node("fixed", *joints, name=name))
    equality.append(_build_node("tendon", tendon1=name, polycoef="0 1 0 0 0"))


# SDF.


def _build_sdf(physics: ExportParameters, parts: list[Part], names: Names) -> ET.Element:
    lift = Pose(np.zeros(3), _compute_upright_axes(compute_gravity(physics.robot)))
    base, keys = names.links[BASE], {"stiffness": "spring_stiffness", "rest": "spring_reference"}
    ends = _build_node("parent", "world"), _build_node("child", base)
    first = _build_node("link", _build_pose_node(lift), name=base)
    upright = _build_node("joint", *ends, name=names.upright, type="fixed")
    model = _build_node("model", first, upright, name=physics.robot.name)
    for part in parts:
        if part.body is None or not part.row.is_moving:
            frame_attributes = {"name": part.link, "attached_to": part.parent}
            model.append(_build_node("frame", _build_pose_node(part.pose), **frame_attributes))
            continue
        entries = (_build_node(k, x) for k, x in zip(TENSOR, part.body[4:], strict=True))
        mass, tensor = _build_node("mass", part.body[0]), _build_node("inertia", *entries)
        pose = _build_pose_node(part.pose, relative_to=part.parent)
        link = _build_node("link", pose, name=part.link)
        link.append(_build_node("inertial", _build_pose_node(Pose(part.body[1:4])), mass, tensor))
        for k, capsule in enumerate(part.capsules):
            kind, sizes = "sphere", {"radius": capsule.radius}
            if capsule.length:
                kind, sizes["length"] = "capsule", capsule.length
            geometry = _build_node("geometry", _build_node(kind, *_build_text_nodes(sizes)))
            visual = _build_pose_node(_compute_capsule_pose(capsule)), geometry
            link.append(_build_node("visual", *visual, name=f"capsule{k}"))
        axis = _build_node("axis", _build_node("xyz", part.axis))
        if limits := _collect_limits(physics, part.row):
            axis.append(_build_node("limit", *_build_text_nodes(limits)))
        if part.drive:
            drive = {keys.get(quantity, quantity): x for quantity, x in part.drive.items()}
            axis.append(_build_node("dynamics", *_build_text_nodes(drive)))
        for leader, ratio in part.leaders.items():
            law = {"multiplier": ratio, "offset": part.offset, "reference": 0.0}
            axis.append(_build_node("mimic", *_build_text_nodes(law), joint=leader))
        kind = part.row.kind.name.lower()
        ends = _build_node("parent", part.parent), _build_node("child", part.link)
        model.extend([link, _build_node("joint", *ends, axis, name=part.joint, type=kind)])
    return _build_node("sdf", model, version="1.9")


def _build_text_nodes(values: Mapping[str, float]) -> list[ET.Element]:
    return [_build_node(key, value) for key, value in values.items()]


def _build_pose_node(pose: Pose, **attributes: str) -> ET.Element:
    place = np.array([*pose.position, *compute_roll_pitch_yaw(pose.rotation)])
    return _build_node("pose", place, **attributes)


# A robot or a model as a file for another program.


ENDINGS = {
    ".urdf": "urdf",
    ".xml": "mjcf",
    ".mjcf": "mjcf",
    ".sdf": "sdf",
    ".casadi": "casadi",
    ".fmu": "fmu",
}
"""Formats by the ending of a file."""

FORMATS = ("urdf", "mjcf", "sdf", "casadi", "fmu", "simulink", "ros2")
"""All that --to may name."""


def choose_format(to: str | None, like: str, out: str) -> str:
    """Returns the format that is meant; "" where the original says it.

    Raises:
        DataError: nothing says it.
    """
    ending = Path(out).suffix.lower()
    if to is not None or like:  # .xml may be both
        return to or ("" if ending == ".xml" else ENDINGS.get(ending, ""))
    if ending not in ENDINGS:
        raise DataError(
            f"export: {out or 'nothing'} does not say the format; give --to {', '.join(FORMATS)}, "
            f"or an ending {', '.join(ENDINGS)}"
        )
    return ENDINGS[ending]


def export_robot(
    robot_or_model: Robot | IdentifiedModel,
    to: str = "",
    like: Path | None = None,
    torques: Torques | None = None,
    equations: Callable[[], Equations] | None = None,
) -> Exported:
    """Returns the file, and what it holds.

    Args:
        robot_or_model: a robot with values, or a model.
        to: "urdf", "mjcf", "sdf"; "" for that of the original.
        like: the original whose numbers are replaced; None for a file of its own.
        torques: of the logs of the fit, see `held`.
        equations: of a robot, which are requested where parameters of bodies are open.

    Raises:
        DataError: no values, another robot, or what the format cannot state.
        RobotError: a mistake in the original.
    """
    robot = get_robot(robot_or_model)
    if like is None:
        physics, notes = build_export_parameters(robot_or_model, Original(), equations), list[str]()
        data, values = format_new_file(physics, to, notes), list(_build_values(physics, to))
    else:
        source = read_original(like)
        if to and to != source.format:
            raise DataError(
                f"--like {like}: is {source.format.upper()}, and --to or the ending of --out says "
                f"{to}; leave out --like for a file of another format"
            )
        to, placement = source.format, assign_links(source, robot)
        physics = build_export_parameters(robot_or_model, collect_original(placement.links))
        notes = list(placement.notes)
        data, values = rewrite_file(physics, source, placement, notes)
    notes = [*physics.notes, *notes, *_find_too_small(values, to)]
    lost = find_lost_effects(physics, to, torques, has_elastic=to == "mjcf" and like is None)
    name = "" if like is None else like.name
    moved = physics.completion.shift_in_sigmas
    exported = Exported(robot.name, to, name, data, tuple(values), lost, moved, tuple(notes))
    if like is not None and data == source.data:
        return exported
    return dataclasses.replace(exported, data=insert_comment(data, exported))


def _build_values(physics: ExportParameters, to: str) -> Iterator[Value]:
    """The numbers of a file of its own, and what the robot file says of them."""
    names = Names.choose_names(physics.robot)
    for joint in physics.robot.moving_joints:
        ten = physics.get_link_parameters(joint.name)
        if ten is not None and ten[9]:
            nominal = physics.get_nominal_parameters(joint.name)
            was = None if nominal is None else compute_central_parameters(nominal)
            now, sigma = compute_central_parameters(ten), compute_sigmas(physics, joint.name)
            yield from build_body_values(names.links[joint.name], was, now, sigma)
        stated = {
            quantity: sum(c * physics.nominal[name] for name, c in terms.items())
            for quantity, terms in physics.collect_drive_terms(joint.name, to).items()
            if terms.keys() <= physics.nominal.keys()
        }
        yield from build_drive_values(physics, joint, names.joints[joint.name], to, stated)


def _find_too_small(values: Iterable[Value], to: str) -> Iterator[str]:
    """Reports bodies that MuJoCo refuses."""
    bodies: dict[str, list[float]] = {}
    for value in values:
        if value.quantity in TENSOR:
            bodies.setdefault(value.part, []).append(value.after)
    tensors = {name: build_symmetric_matrix(np.array(six)) for name, six in bodies.items()}
    moments = {name: np.linalg.eigvalsh(tensor)[0] for name, tensor in tensors.items()}
    small = [name for name, x in moments.items() if 0.0 < x < THRESHOLDS.min_moment_of_inertia]
    if small and to != "sdf":
        yield (
            f"{', '.join(small)}: too small for MuJoCo, which takes no moment of inertia below "
            f"{THRESHOLDS.min_moment_of_inertia:g} kg m2"
        )
