"""A tree of bodies as the text of a robot file, with what had to be decided or left out."""

import json
import math
from fractions import Fraction
from pathlib import PurePath

import numpy as np

import modeler.robot.robot_text as toml
from modeler.core.errors import RobotError
from modeler.core.toml_cells import listed
from modeler.robot.angles import pi_multiple
from modeler.robot.body_tree import (
    BodyTree,
    Meeting,
    MovingLink,
    Pose,
    about_origin,
    moving_links,
    several,
)
from modeler.robot.cells import robot_name
from modeler.robot.conventions import ANGLES
from modeler.robot.loop_joints import independent_joints
from modeler.robot.mdh_rows import (
    Loop,
    MdhRow,
    exact_length,
    fixed_row,
    mdh_table,
    roll_pitch_yaw,
    towards,
)
from modeler.robot.par_table import LETTER, Symbols, gravity
from modeler.robot.robot import INERTIAL, JointKind, Place
from modeler.robot.robot_text import Converted, TextRow
from modeler.robot.sections import FRAME_COLUMNS

UNCERTAINTY = 0.3
"""How sure masses, centres and inertias of another program's file are, over their scale."""
_EFFECTS = {
    "rotor_inertia": ("armature", "Ia"),
    "viscous": ("damping", "Fv"),
    "coulomb": ("friction", "Fs"),
    "spring": ("stiffness", "Ks"),
}
"""Effect -> attribute of a joint, and its parameter."""
_SMALLEST = 1e-3
"""m; where masses are nearer to an origin, digits below the rounding of that distance are none."""
_SPEED = {JointKind.REVOLUTE: 2.0, JointKind.PRISMATIC: 0.5}
"""rad/s, m/s where a file states none."""
_ACCELERATION = 4.0
"""Over the speed, 1/s, where a file states none."""
_LIMITS = "[limits]                              # lower, upper, speed, acceleration"


def tree_to_toml(tree: BodyTree, where: str) -> Converted:
    """The robot file that says what the tree says.

    Rows 1, 2, ... are the joints that move, in their order; q_j is the position of the file, frame
    0 that of its root.

    Args:
        tree: of a file.
        where: its name, for messages and the name of a robot that has none.

    Raises:
        RobotError: nothing of it moves.
    """
    if all(joint.kind is JointKind.FIXED for joint in tree.joints):
        raise RobotError(
            f"{where}: no joint of the robot moves; expected at least one that turns or slides"
        )
    made = _Writing(tree, where)
    parts = [
        *toml.section("[symbols]", toml.symbol_lines(made.symbols.values, made.symbols.comments)),
        *toml.mdh_lines(made.rows),
        *toml.section("[relations]", made.relations()),
        *toml.loop_lines(made.loops),
        *toml.section("[home]", made.home()),
        *made.frames(),
        *toml.section(toml.LINKS, made.without_mass()),
        *toml.section("[effects]", made.effects()),
        *made.parameters(),
        *toml.section(_LIMITS, made.limits()),
    ]
    name = robot_name(tree.name, PurePath(where).stem)[:40]
    source = f"{tree.format} {PurePath(where).name}"
    notes = made.symbols.notes
    head = toml.head_lines(name, tree.name, source, notes, made.gravity)
    return Converted(toml.joined([*head, *parts]), tuple(notes))


class _Writing:
    """The parts of a robot file; symbols and notes grow with them."""

    def __init__(self, tree: BodyTree, where: str) -> None:
        self.tree, self.links = tree, moving_links(tree)
        self.table = mdh_table(self.links, [self._loop(meeting) for meeting in tree.meetings])
        self.symbols = Symbols(notes=list(tree.notes))
        self._equal: dict[float, str] = {}
        moved = [link.joint for link in self.links if link.joint is not None]
        self.joints = {f"{k}": joint for k, joint in enumerate(moved, start=1)}
        self.row_of = {joint.name: name for name, joint in self.joints.items()}
        free = [name for name, joint in self.joints.items() if not joint.leader]
        self.driven = [name for name in free if self.joints[name].actuated]
        if not self.driven:
            chosen = independent_joints(tree) if tree.meetings else set(self.row_of)
            self.driven = [name for name in free if self.joints[name].name in chosen]
            told = "the file states no motor: all joints are taken as actuated"
            if tree.meetings and not chosen:
                raise RobotError(f"{where}: its loops leave no joint free to move; correct them")
            which = several(joint.name for joint in moved if joint.name in chosen)
            self.symbols.notes.append(told.replace("all joints", which) if tree.meetings else told)
        self.free = self.driven if tree.meetings else free
        self.rows = [self._row(row) for row in self.table.rows]
        self.loops = self._loops()
        entries = tuple(repr(exact_length(float(entry))) for entry in tree.gravity)
        self.gravity = gravity(entries, self.symbols, Place(where))

    def _row(self, row: MdhRow) -> TextRow:
        cells = {c: self._cell(c, worth, row.name) for c, worth in row.cells.items()}
        if row.name.endswith("s"):
            told = f"joints of a loop stand on it, {row.name[:-1]} the first"
            return TextRow(row.name, row.antecedent, 0, int(row.kind), cells, told)
        if row.joint is None:
            tilted = row.name.removesuffix("f")
            self.symbols.notes.append(
                f"the axis of joint {tilted} is parallel to that before but for a little: the "
                f"fixed row {row.name} stands between them, and no frame is far away"
            )
            return TextRow(row.name, row.antecedent, 0, int(row.kind), cells)
        home = "theta" if row.kind is JointKind.REVOLUTE else "r"
        cells[home] = _sum(f"q{row.name}", cells.get(home, "0"))
        mu = int(row.name in self.driven)
        return TextRow(row.name, row.antecedent, mu, int(row.kind), cells, row.joint.name)

    def _cell(self, column: str, worth: float, row: str) -> str:
        """A constant: a multiple of pi, or a symbol with its value, and its sign in the cell."""
        angle = column in ANGLES
        text = _angle(worth) if angle else "0" if worth == 0.0 else ""
        if text:
            return text
        size, shared = abs(worth), None
        if self.tree.meetings and not angle:
            shared = next((n for x, n in self._equal.items() if abs(x - size) < 1e-13), None)
        name = shared or self.symbols.add(f"{LETTER[column]}{row}", size, "rad" if angle else "m")
        self._equal[size] = name
        return f"-{name}" if worth < 0.0 else name

    def _loop(self, meeting: Meeting) -> Loop:
        """The two links that meet, and where in the frame of each."""
        places = {body: k for k, link in enumerate(self.links) for body in link.bodies}

        def end(body: str, pose: Pose) -> tuple[int, Pose]:
            return places[body], self.links[places[body]].bodies[body] @ pose

        return end(meeting.body, meeting.pose), end(meeting.other, meeting.other_pose)

    def _loops(self) -> list[tuple[str, str, str, str]]:
        """Where frames meet; the rows that carry them are added."""
        found = []
        meetings = zip(self.tree.meetings, self.table.ends, strict=True)
        for i, (meeting, ends) in enumerate(meetings, start=1):
            for side, (before, pose) in zip("ab", ends, strict=True):
                if meeting.kind == "spherical":
                    at = towards(pose.position)
                else:
                    at = fixed_row(pose, meeting.kind not in ("rigid", "prismatic"))
                cells = {c: self._cell(c, worth, f"P{i}{side}") for c, worth in at.items()}
                row = TextRow(f"P{i}{side}", before, 0, JointKind.FIXED, cells, meeting.name)
                self.rows.append(row)
            found.append((f"P{i}", f"P{i}a", f"P{i}b", meeting.kind))
        return found

    def home(self) -> list[str]:
        """The posture of the file, near which its loops are closed."""
        if not self.loops:
            return []
        places = {joint.name: joint.zero for joint in self.joints.values()} | dict(self.tree.home)
        return [f"q{name} = {toml.number(places[j.name])}" for name, j in self.joints.items()]

    def relations(self) -> list[str]:
        """Joints that follow others."""
        lines = []
        for name, joint in self.joints.items():
            if joint.leader:
                factor = {1.0: "", -1.0: "-"}.get(joint.ratio, f"{joint.ratio!r}*")
                angle = joint.kind is JointKind.REVOLUTE and _angle(joint.offset)
                offset = angle or ("0" if joint.offset == 0.0 else repr(joint.offset))
                lines.append(f'q{name} = "{_sum(f"{factor}q{self.row_of[joint.leader]}", offset)}"')
        return lines

    def frames(self) -> list[str]:
        """`[frames]`: every body of the file on its row."""
        cells = []
        for k, link in enumerate(self.links):
            moved = link.joint.child if link.joint else ""
            for body, pose in link.bodies.items():
                place = self.table.places[k] @ pose
                joint = link.joint.name if link.joint and body == moved else ""
                numbers = [_number(exact_length(float(x))) for x in place.position]
                angles = [toml.quoted(_angle(a) or repr(a)) for a in roll_pitch_yaw(place.rotation)]
                names = [json.dumps(text, ensure_ascii=False) for text in (body, f"{k}", joint)]
                cells.append([*names, *numbers, *angles])
        head = "[frames]                              # links of the file on their rows: m, rad"
        return [head, *toml.columns_and_rows(FRAME_COLUMNS, cells)]

    def without_mass(self) -> list[str]:
        """Links between the joints of one body: they are nothing."""
        return [f"{k} = []" for k, link in enumerate(self.links) if self._is_hidden(link)]

    def _is_hidden(self, link: MovingLink) -> bool:
        return link.bodies.keys() <= self.tree.hidden

    def _having(self, key: str) -> list[str]:
        """Rows of the joints that have what an attribute says: friction and rotors all of them."""
        if key == "stiffness" and self.loops:  # the C of a robot with loops has no springs
            return []
        every = {"armature": self.driven, "stiffness": []}.get(key, self.free)
        return [n for n, joint in self.joints.items() if getattr(joint, key) or n in every]

    def effects(self) -> list[str]:
        """Friction, rotors and offset of every joint, and springs that the file states."""
        having = {effect: self._having(key) for effect, (key, _) in _EFFECTS.items()}
        having["offset"] = self.driven
        if self.loops and any(joint.stiffness for joint in self.joints.values()):
            self.symbols.notes.append("springs are left out: robots with loops have none here")
        springs = [
            f'{{joint = "{name}", q0 = {toml.number(self.joints[name].rest)}, h = 0}}'
            for name in having.pop("spring")
        ]
        silent = [
            effect
            for effect in having
            if effect == "offset"
            or not any(getattr(joint, _EFFECTS[effect][0]) for joint in self.joints.values())
        ]
        if silent:
            joints = "actuated joints" if self.loops else "joints"
            self.symbols.notes.append(
                f"added to the {joints}: {listed(silent)}, of which the file says nothing; a fit "
                "without would be wrong"
            )
        lines = toml.effect_lines({k: v for k, v in having.items() if v}, self.driven)
        return lines + ([f"spring = [{', '.join(springs)}]"] if springs else [])

    def parameters(self) -> list[str]:
        """Nominal values, and how sure those of the links are."""
        lines, doubted, notes = list[str](), list[str](), self.symbols.notes
        notes += self._unweighed()
        for k, link in enumerate(self.links):
            whole = link.inertial
            if k == 0 or whole is None or not (whole.mass or whole.inertia.any()):
                continue
            if self._is_measured(link):
                ten = about_origin(whole.seen_from(self.table.places[k]))
                inertia = max(*np.abs(ten[:6]).tolist(), abs(whole.mass) * _SMALLEST**2)
                scales = [inertia] * 6 + [math.sqrt(abs(whole.mass) * inertia)] * 3 + [0.0]
                lines += [
                    f"{prefix}{k} = {toml.number(*worth)}"
                    for prefix, *worth in zip(INERTIAL, ten.tolist(), scales, strict=True)
                ]
            else:
                doubted.extend(link.bodies)
        prior = [f"inertial = {UNCERTAINTY}"] if lines else []
        lines += self._of_joints()
        if doubted:
            notes.append(f"no values of {several(doubted)}, which move as one with such a body")
        if prior:
            notes.append(
                f"masses, centres and inertias are a prior, sure to {UNCERTAINTY:.0%} of their "
                "scale; all other values are nominal only"
            )
        return [
            *toml.section(toml.PARAMETERS, lines),
            *toml.section(
                "[parameters.uncertainty]              # over the scale of a body", prior
            ),
        ]

    def _unweighed(self) -> list[str]:
        """What to tell of bodies that move and that nobody has weighed.

        A frame without mass on a body that has one says nothing.
        """
        named: dict[str, list[str]] = {}
        for link in self.links[1:]:
            light = link.inertial is None or link.inertial.mass == 0.0
            for name in (body for body in link.bodies if body not in self.tree.hidden):
                if (why := self.tree.doubted.get(name)) and (light or why != "mass 0"):
                    named.setdefault(f"{why}: {{}}", []).append(name)
                elif self.tree.bodies[name] is None and light:
                    told = "no inertia is stated of {}; they weigh nothing"
                    named.setdefault(told, []).append(name)
        return [told.format(several(names)) for told, names in named.items()]

    def _is_measured(self, link: MovingLink) -> bool:
        """False where a placeholder is among bodies that were weighed: a prior would believe it."""
        odd = [self.tree.bodies[name] for name in link.bodies if name in self.tree.doubted]
        fake = [b for b in odd if b and (b.mass < 0.0 or np.array_equal(b.inertia, np.eye(3)))]
        return not fake or len(link.bodies) == 1

    def _of_joints(self) -> list[str]:
        """What the file states of friction, rotors and springs."""
        return [
            f"{prefix}{name} = {toml.number(worth)}"
            for key, prefix in _EFFECTS.values()
            for name in self._having(key)
            if (worth := getattr(self.joints[name], key)) is not None
        ]

    def limits(self) -> list[str]:
        """Ranges of motion of the joints for which the file states some; tells what is assumed."""
        lines, assumed = list[str](), dict[str, list[str]]()
        for name in self.free:
            joint = self.joints[name]
            lower, upper, speed = joint.lower, joint.upper, joint.speed
            unit = "rad" if joint.kind is JointKind.REVOLUTE else "m"
            own = []
            if lower is None or upper is None:
                if unit == "m" or speed is None:
                    continue
                lower, upper = -math.pi, math.pi
                own.append("range -pi to pi")
            if lower >= upper:
                continue
            if speed is None:
                speed = _SPEED[joint.kind]
                own.append(f"speed {speed:g} {unit}/s")
            acceleration = joint.acceleration
            if acceleration is None:
                acceleration = _ACCELERATION * speed
                own.append(f"acceleration {_ACCELERATION:g}/s times the speed")
            for what in own:
                assumed.setdefault(what, []).append(joint.name)
            cells = ", ".join(toml.number(x) for x in (lower, upper, speed, acceleration))
            told = ", ".join(what.split()[0] for what in own)
            lines.append(f"{name} = [{cells}]" + f"  # assumed: {told}" * bool(own))
        parts = [f"{what} of {several(names)}" for what, names in assumed.items()]
        if parts:
            self.symbols.notes.append(
                f"not stated by the file, and assumed in [limits]: {'; '.join(parts)}"
            )
        return lines


def _sum(head: str, constant: str) -> str:
    """`q1 + pi/2`, `q1 - D1`, `q1`."""
    if constant == "0":
        return head
    return f"{head} - {constant[1:]}" if constant.startswith("-") else f"{head} + {constant}"


def _angle(worth: float) -> str:
    """`pi/2`; nothing for an angle that is no multiple of pi/12."""
    twelfths = round(worth / (math.pi / 12))
    return pi_multiple(Fraction(twelfths, 12)) if worth == twelfths * (math.pi / 12) else ""


def _number(worth: float) -> str:
    return "0" if worth == 0.0 else repr(worth)
