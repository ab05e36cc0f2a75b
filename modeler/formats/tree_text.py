"""A tree of bodies as the text of a robot file, with what had to be decided or left out."""

import json
import math
from fractions import Fraction
from pathlib import PurePath

import numpy as np

from modeler.core.errors import RobotError
from modeler.core.toml_cells import join_names
from modeler.formats.body_tree import (
    BodyTree,
    LoopClosure,
    MovingLink,
    Pose,
    collect_moving_links,
    compute_body_poses,
    compute_standard_parameters,
    summarise_names,
)
from modeler.formats.mdh_rows import (
    Loop,
    MdhRow,
    build_mdh_table,
    compute_fixed_row,
    compute_point_row,
    compute_roll_pitch_yaw,
    snap_length,
)
from modeler.formats.par_table import LETTER, Symbols, convert_gravity
from modeler.formats.thresholds import THRESHOLDS
from modeler.robot import (
    ANGLES,
    FRAME_COLUMNS,
    INERTIAL,
    LINKS,
    PARAMETERS,
    ConvertedRobot,
    JointKind,
    TextRow,
    TomlCell,
    choose_robot_name,
    format_columns_and_rows,
    format_effects,
    format_head,
    format_loops,
    format_mdh,
    format_number,
    format_pi_multiple,
    format_section,
    format_symbols,
    join_lines,
    quote_cell,
)

_TIES = {
    "rigid": (0, 1, 2, 3, 4, 5),
    "revolute": (0, 1, 2, 3, 4),
    "prismatic": (0, 1, 3, 4, 5),
    "cylindrical": (0, 1, 3, 4),
    "universal": (0, 1, 2, 6),
    "planar": (2, 3, 4),
}
"""Kind -> which of `_apart` it ties; the others tie the three of the origin."""


def choose_independent_joints(tree: BodyTree) -> set[str]:
    """Chooses as many joints as the loops leave free, the nearest to the base first.

    The rank is taken where no loop is closed: it is that of the mechanism wherever it does not
    depend on special lengths.
    """
    depth = {tree.root: 0}
    for joint in tree.joints:
        depth[joint.child] = depth[joint.parent] + 1
    leading = [j for j in tree.joints if j.kind is not JointKind.FIXED and not j.leader]
    leading.sort(key=lambda joint: depth[joint.child])
    q = np.random.default_rng(0).uniform(-1.0, 1.0, len(leading))
    names = [joint.name for joint in leading]

    def compute_closure_errors(q: np.ndarray) -> np.ndarray:
        poses = compute_body_poses(tree, dict(zip(names, q.tolist(), strict=True)))
        errors = [_compute_closure_error(meeting, poses) for meeting in tree.loop_closures]
        return np.concatenate(errors)

    steps = THRESHOLDS.closure_difference_step * np.eye(len(q))
    errors = [(compute_closure_errors(q + h), compute_closure_errors(q - h)) for h in steps]
    width = 2 * THRESHOLDS.closure_difference_step
    J = np.column_stack([(after - before) / width for after, before in errors])
    rank, dependent = _compute_rank(J), list(range(len(names)))
    for k in range(len(names)):
        others = [i for i in dependent if i != k]
        if len(dependent) > rank and _compute_rank(J[:, others]) == rank:
            dependent = others
    return {name for k, name in enumerate(names) if k not in dependent}


def _compute_closure_error(meeting: LoopClosure, poses: dict[str, Pose]) -> np.ndarray:
    """What the joint that closes a loop holds at 0."""
    one = poses[meeting.body] @ meeting.pose
    relative_pose = one.inverse() @ (poses[meeting.other] @ meeting.other_pose)
    R = relative_pose.rotation
    residuals = np.array([*relative_pose.position, R[0, 2], R[1, 2], R[0, 1], R[2, 2]])
    return residuals[list(_TIES.get(meeting.kind, (0, 1, 2)))]


def _compute_rank(matrix: np.ndarray) -> int:
    values = np.linalg.svd(matrix, compute_uv=False) if matrix.size else np.zeros(1)
    return int(np.sum(values > THRESHOLDS.min_closure_singular_value * max(values[0], 1e-3)))


# A tree of bodies as the text of a robot file, with what had to be decided or left out.


_EFFECTS = {
    "rotor_inertia": ("armature", "Ia"),
    "viscous": ("damping", "Fv"),
    "coulomb": ("friction", "Fs"),
    "spring": ("stiffness", "Ks"),
}
"""Effect -> attribute of a joint, and its parameter."""
_SPEED = {JointKind.REVOLUTE: 2.0, JointKind.PRISMATIC: 0.5}
"""rad/s, m/s where a file states none."""
_LIMITS = "[limits]                              # lower, upper, speed, acceleration"


def convert_tree(tree: BodyTree, where: str) -> ConvertedRobot:
    """Returns the robot file that says what the tree says.

    Rows 1, 2, ... are the joints that move, in their order; q_j is the position of the file, frame
    0 that of its root.

    Args:
        tree: of a file.
        where: its name, for messages and the name of a robot that has none.

    Raises:
        RobotError: nothing of it moves.
    """
    if all(joint.kind is JointKind.FIXED for joint in tree.joints):
        expected = "expected at least one that turns or slides"
        raise RobotError(f"{where}: no joint of the robot moves; {expected}")
    writer = _TreeWriter(tree, where)
    parts = [
        *format_section(
            "[symbols]", format_symbols(writer.symbols.values, writer.symbols.comments)
        ),
        *format_mdh(writer.rows),
        *format_section("[relations]", writer.format_relations()),
        *format_loops(writer.loops),
        *format_section("[home]", writer.format_home()),
        *writer.format_frames(),
        *format_section(LINKS, writer.format_massless_links()),
        *format_section("[effects]", writer.format_effects()),
        *writer.format_parameters(),
        *format_section(_LIMITS, writer.format_limits()),
    ]
    name = choose_robot_name(tree.name, PurePath(where).stem)[:40]
    source = f"{tree.format} {PurePath(where).name}"
    notes = writer.symbols.notes
    head = format_head(name, tree.name, source, notes, writer.gravity)
    return ConvertedRobot(join_lines([*head, *parts]), tuple(notes))


class _TreeWriter:
    """The parts of a robot file; symbols and notes grow with them."""

    def __init__(self, tree: BodyTree, where: str) -> None:
        self.tree, self.links = tree, collect_moving_links(tree)
        loops = [self._locate_loop(meeting) for meeting in tree.loop_closures]
        self.table = build_mdh_table(self.links, loops)
        self.symbols = Symbols(notes=list(tree.notes))
        self._equal: dict[float, str] = {}
        moving_joints = [link.joint for link in self.links if link.joint is not None]
        self.joints = {f"{k}": joint for k, joint in enumerate(moving_joints, start=1)}
        self.row_of = {joint.name: name for name, joint in self.joints.items()}
        free = [name for name, joint in self.joints.items() if not joint.leader]
        self.driven = [name for name in free if self.joints[name].actuated]
        if not self.driven:
            chosen = choose_independent_joints(tree) if tree.loop_closures else set(self.row_of)
            self.driven = [name for name in free if self.joints[name].name in chosen]
            note = "the file states no motor: all joints are taken as actuated"
            if tree.loop_closures and not chosen:
                raise RobotError(f"{where}: its loops leave no joint free to move; correct them")
            which = summarise_names(joint.name for joint in moving_joints if joint.name in chosen)
            note = note.replace("all joints", which) if tree.loop_closures else note
            self.symbols.notes.append(note)
        self.free = self.driven if tree.loop_closures else free
        self.rows = [self._format_row(row) for row in self.table.rows]
        self.loops = self._add_loop_rows()
        entries = tuple(repr(snap_length(float(entry))) for entry in tree.gravity)
        self.gravity = convert_gravity(entries, self.symbols, TomlCell(where))

    def _format_row(self, row: MdhRow) -> TextRow:
        cells = {c: self._format_cell(c, value, row.name) for c, value in row.cells.items()}
        if row.name.endswith("s"):
            comment = f"joints of a loop stand on it, {row.name[:-1]} the first"
            return TextRow(row.name, row.antecedent, 0, int(row.kind), cells, comment)
        if row.joint is None:
            tilted = row.name.removesuffix("f")
            self.symbols.notes.append(
                f"the axis of joint {tilted} is parallel to that before but for a little: the "
                f"fixed row {row.name} stands between them, and no frame is far away"
            )
            return TextRow(row.name, row.antecedent, 0, int(row.kind), cells)
        home = "theta" if row.kind is JointKind.REVOLUTE else "r"
        cells[home] = _format_sum(f"q{row.name}", cells.get(home, "0"))
        mu = int(row.name in self.driven)
        return TextRow(row.name, row.antecedent, mu, int(row.kind), cells, row.joint.name)

    def _format_cell(self, column: str, value: float, row: str) -> str:
        """A constant: a multiple of pi, or a symbol with its value, and its sign in the cell."""
        angle = column in ANGLES
        text = _format_angle(value) if angle else "0" if value == 0.0 else ""
        if text:
            return text
        size, shared = abs(value), None
        if self.tree.loop_closures and not angle:
            shared = next((n for x, n in self._equal.items() if abs(x - size) < 1e-13), None)
        preferred, unit = f"{LETTER[column]}{row}", "rad" if angle else "m"
        name = shared or self.symbols.add_symbol(preferred, size, unit)
        self._equal[size] = name
        return f"-{name}" if value < 0.0 else name

    def _locate_loop(self, meeting: LoopClosure) -> Loop:
        """The two links that meet, and where in the frame of each."""
        places = {body: k for k, link in enumerate(self.links) for body in link.bodies}

        def locate_end(body: str, pose: Pose) -> tuple[int, Pose]:
            return places[body], self.links[places[body]].bodies[body] @ pose

        return locate_end(meeting.body, meeting.pose), locate_end(meeting.other, meeting.other_pose)

    def _add_loop_rows(self) -> list[tuple[str, str, str, str]]:
        """Where frames meet; the rows that carry them are added."""
        loops = []
        meetings = zip(self.tree.loop_closures, self.table.ends, strict=True)
        for i, (meeting, ends) in enumerate(meetings, start=1):
            for side, (before, pose) in zip("ab", ends, strict=True):
                if meeting.kind == "spherical":
                    at = compute_point_row(pose.position)
                else:
                    at = compute_fixed_row(pose, meeting.kind not in ("rigid", "prismatic"))
                cells = {c: self._format_cell(c, value, f"P{i}{side}") for c, value in at.items()}
                row = TextRow(f"P{i}{side}", before, 0, JointKind.FIXED, cells, meeting.name)
                self.rows.append(row)
            loops.append((f"P{i}", f"P{i}a", f"P{i}b", meeting.kind))
        return loops

    def format_home(self) -> list[str]:
        """Returns the posture of the file, near which its loops are closed."""
        if not self.loops:
            return []
        places = {joint.name: joint.zero for joint in self.joints.values()} | dict(self.tree.home)
        return [f"q{name} = {format_number(places[j.name])}" for name, j in self.joints.items()]

    def format_relations(self) -> list[str]:
        """Returns joints that follow others."""
        lines = []
        for name, joint in self.joints.items():
            if joint.leader:
                factor = {1.0: "", -1.0: "-"}.get(joint.ratio, f"{joint.ratio!r}*")
                angle = joint.kind is JointKind.REVOLUTE and _format_angle(joint.offset)
                offset = angle or ("0" if joint.offset == 0.0 else repr(joint.offset))
                leader = f"{factor}q{self.row_of[joint.leader]}"
                lines.append(f'q{name} = "{_format_sum(leader, offset)}"')
        return lines

    def format_frames(self) -> list[str]:
        """Returns `[frames]`: every body of the file on its row."""
        cells = []
        for k, link in enumerate(self.links):
            moved_body = link.joint.child if link.joint else ""
            for body, pose in link.bodies.items():
                place = self.table.places[k] @ pose
                joint = link.joint.name if link.joint and body == moved_body else ""
                numbers = [_format_number(snap_length(float(x))) for x in place.position]
                turns = compute_roll_pitch_yaw(place.rotation)
                angles = [quote_cell(_format_angle(angle) or repr(angle)) for angle in turns]
                names = [json.dumps(text, ensure_ascii=False) for text in (body, f"{k}", joint)]
                cells.append([*names, *numbers, *angles])
        head = "[frames]                              # links of the file on their rows: m, rad"
        return [head, *format_columns_and_rows(FRAME_COLUMNS, cells)]

    def format_massless_links(self) -> list[str]:
        """Returns links between the joints of one body: they are nothing."""
        return [f"{k} = []" for k, link in enumerate(self.links) if self._is_hidden(link)]

    def _is_hidden(self, link: MovingLink) -> bool:
        return link.bodies.keys() <= self.tree.auxiliary_bodies

    def _select_rows(self, key: str) -> list[str]:
        """Rows of the joints that have what an attribute says: friction and rotors all of them."""
        if key == "stiffness" and self.loops:  # the C of a robot with loops has no springs
            return []
        default_rows = {"armature": self.driven, "stiffness": []}.get(key, self.free)
        return [n for n, joint in self.joints.items() if getattr(joint, key) or n in default_rows]

    def format_effects(self) -> list[str]:
        """Returns friction, rotors and offset of every joint, and springs that the file states."""
        rows_by_effect = {effect: self._select_rows(key) for effect, (key, _) in _EFFECTS.items()}
        rows_by_effect["offset"] = self.driven
        if self.loops and any(joint.stiffness for joint in self.joints.values()):
            self.symbols.notes.append("springs are left out: robots with loops have none here")
        springs = [
            f'{{joint = "{name}", q0 = {format_number(self.joints[name].rest)}, h = 0}}'
            for name in rows_by_effect.pop("spring")
        ]
        is_stated = {
            effect: any(getattr(joint, key) for joint in self.joints.values())
            for effect, (key, _) in _EFFECTS.items()
        }
        unstated_effects = [effect for effect in rows_by_effect if not is_stated.get(effect)]
        if unstated_effects:
            joints = "actuated joints" if self.loops else "joints"
            self.symbols.notes.append(
                f"added to the {joints}: {join_names(unstated_effects)}, of which the file says "
                "nothing; a fit without would be wrong"
            )
        lines = format_effects({k: v for k, v in rows_by_effect.items() if v}, self.driven)
        return lines + ([f"spring = [{', '.join(springs)}]"] if springs else [])

    def format_parameters(self) -> list[str]:
        """Returns nominal values, and the uncertainty of those of the links."""
        lines, unreliable_bodies, notes = list[str](), list[str](), self.symbols.notes
        notes += self._describe_unreliable_bodies()
        for k, link in enumerate(self.links):
            whole = link.inertial
            if k == 0 or whole is None or not (whole.mass or whole.inertia.any()):
                continue
            if self._is_measured(link):
                ten = compute_standard_parameters(whole.express_in(self.table.places[k]))
                least = abs(whole.mass) * THRESHOLDS.min_mass_distance**2
                inertia = max(*np.abs(ten[:6]).tolist(), least)
                scales = [inertia] * 6 + [math.sqrt(abs(whole.mass) * inertia)] * 3 + [0.0]
                numbers = zip(INERTIAL, ten.tolist(), scales, strict=True)
                lines += [
                    f"{prefix}{k} = {format_number(x, scale)}" for prefix, x, scale in numbers
                ]
            else:
                unreliable_bodies.extend(link.bodies)
        prior = [f"inertial = {THRESHOLDS.read_body_deviation}"] if lines else []
        lines += self._format_joint_parameters()
        if unreliable_bodies:
            names = summarise_names(unreliable_bodies)
            notes.append(f"no values of {names}, which move as one with such a body")
        if prior:
            notes.append(
                f"masses, centres and inertias are a prior, with standard deviations of "
                f"{THRESHOLDS.read_body_deviation:.0%} of their "
                "scale; all other values are nominal only"
            )
        return [
            *format_section(PARAMETERS, lines),
            *format_section(
                "[parameters.uncertainty]              # over the scale of a body", prior
            ),
        ]

    def _describe_unreliable_bodies(self) -> list[str]:
        """What to show of bodies that move and that nobody has weighed.

        A frame without mass on a body that has one says nothing.
        """
        named: dict[str, list[str]] = {}
        for link in self.links[1:]:
            is_massless = link.inertial is None or link.inertial.mass == 0.0
            for name in (body for body in link.bodies if body not in self.tree.auxiliary_bodies):
                why = self.tree.unreliable_bodies.get(name)
                if why and (is_massless or why != "mass 0"):
                    named.setdefault(f"{why}: {{}}", []).append(name)
                elif self.tree.bodies[name] is None and is_massless:
                    sentence = "no inertia is stated of {}; they weigh nothing"
                    named.setdefault(sentence, []).append(name)
        return [sentence.format(summarise_names(names)) for sentence, names in named.items()]

    def _is_measured(self, link: MovingLink) -> bool:
        """False where a placeholder is among bodies that were weighed: a prior would believe it."""
        names = [name for name in link.bodies if name in self.tree.unreliable_bodies]
        unreliable_bodies = [body for name in names if (body := self.tree.bodies[name])]
        placeholders = [
            body
            for body in unreliable_bodies
            if body.mass < 0.0 or np.array_equal(body.inertia, np.eye(3))
        ]
        return not placeholders or len(link.bodies) == 1

    def _format_joint_parameters(self) -> list[str]:
        """What the file states of friction, rotors and springs."""
        return [
            f"{prefix}{name} = {format_number(value)}"
            for key, prefix in _EFFECTS.values()
            for name in self._select_rows(key)
            if (value := getattr(self.joints[name], key)) is not None
        ]

    def format_limits(self) -> list[str]:
        """Writes the ranges of motion of joints that have some; notes say what is assumed."""
        lines, assumed = list[str](), dict[str, list[str]]()
        for name in self.free:
            joint = self.joints[name]
            lower, upper, speed = joint.lower, joint.upper, joint.speed
            unit = "rad" if joint.kind is JointKind.REVOLUTE else "m"
            assumptions = []
            if lower is None or upper is None:
                if unit == "m" or speed is None:
                    continue
                lower, upper = -math.pi, math.pi
                assumptions.append("range -pi to pi")
            if lower >= upper:
                continue
            if speed is None:
                speed = _SPEED[joint.kind]
                assumptions.append(f"speed {speed:g} {unit}/s")
            acceleration = joint.acceleration
            if acceleration is None:
                acceleration = THRESHOLDS.default_acceleration_ratio * speed
                ratio = THRESHOLDS.default_acceleration_ratio
                assumptions.append(f"acceleration {ratio:g}/s times the speed")
            for what in assumptions:
                assumed.setdefault(what, []).append(joint.name)
            cells = ", ".join(format_number(x) for x in (lower, upper, speed, acceleration))
            assumed_names = ", ".join(what.split()[0] for what in assumptions)
            lines.append(
                f"{name} = [{cells}]" + f"  # assumed: {assumed_names}" * bool(assumptions)
            )
        parts = [f"{what} of {summarise_names(names)}" for what, names in assumed.items()]
        if parts:
            note = "not stated by the file, and assumed in [limits]"
            self.symbols.notes.append(f"{note}: {'; '.join(parts)}")
        return lines


def _format_sum(head: str, constant: str) -> str:
    """`q1 + pi/2`, `q1 - D1`, `q1`."""
    if constant == "0":
        return head
    return f"{head} - {constant[1:]}" if constant.startswith("-") else f"{head} + {constant}"


def _format_angle(angle: float) -> str:
    """`pi/2`; nothing for an angle that is no multiple of pi/12."""
    twelfths = round(angle / (math.pi / 12))
    return format_pi_multiple(Fraction(twelfths, 12)) if angle == twelfths * (math.pi / 12) else ""


def _format_number(value: float) -> str:
    return "0" if value == 0.0 else repr(value)
