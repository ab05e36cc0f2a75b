"""Effects of robot files that go from one robot to the next: each in a file, read by the folder."""

import tomllib
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

from modeler.core.brief import ShortRepr
from modeler.core.errors import RobotError
from modeler.core.toml_cells import TomlCell, join_names, suggest_name
from modeler.effects import EXAMPLE, Effect, NonlinearParameter, find_effect
from modeler.robot.edit import insert_own_effect
from modeler.robot.effects import read_own_effects
from modeler.robot.read import parse_toml_document, read_file_text
from modeler.robot.robot import Robot


def export_effect(robot: Robot, name: str) -> str:
    """A file that defines an effect of the robot, and nothing else.

    Its shapes are first tried at the values that they have in the robot, and beside these.

    Args:
        robot: it; `[effects]` says where it has the effect.
        name: id of the effect.

    Raises:
        RobotError: the robot defines no such effect.
    """
    names = [effect.id for effect in robot.own_effects]
    if name not in names:
        known = find_effect(name)
        why = "every robot may have it" if known else f"no such effect{suggest_name(name, names)}"
        raise RobotError(
            f"{name}: {why}; expected one that {robot.name} defines: {join_names(names)}"
        )
    definition = tomllib.loads(robot.text)["own_effects"][name]
    used_values = [
        at.nonlinear_parameters
        for use in robot.effects
        if use.effect == name
        for at in use.instances
    ]
    shapes = robot.own_effects[names.index(name)].forms[0].nonlinear_parameters
    about = {s.name: _build_grid(s, [at[s.name] for at in used_values]) for s in shapes}
    try:
        text = insert_own_effect("", name, definition | ({"shapes": about} if about else {}))
        read_own_effects(tomllib.loads(text)["own_effects"], TomlCell("file"))
    except RobotError:  # too many values, or one at which an equation has none
        text = insert_own_effect("", name, definition)
    return text.lstrip()


def _build_grid(shape: NonlinearParameter, used_values: Sequence[float]) -> list[float]:
    """First values of a shape about those that were found, four digits; one value stays fixed."""
    if not used_values or not shape.is_continuous:
        return list(shape.grid)
    low, high = min(used_values), max(used_values)
    step = min(b - a for a, b in pairwise(shape.grid))
    ends = (low / 2.0, high * 2.0) if shape.grid[0] > 0.0 else (low - step, high + step)
    return sorted({float(f"{x:.4g}") for x in (*ends, *used_values)})


@dataclass(frozen=True)
class SharedEffects(ShortRepr):
    """Effects of a folder that a robot may have too.

    Attributes:
        effects: those that it does not define itself.
        definitions: of each, its table of `[own_effects]` by id.
        left_out: id of an effect that it cannot have -> in which file it is, and why.
    """

    effects: tuple[Effect, ...] = ()
    definitions: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    left_out: Mapping[str, str] = field(default_factory=dict)

    def insert_definitions(self, text: str, names: Collection[str]) -> str:
        """A robot file with the definitions of those among the names."""
        for name in [effect_id for effect_id in self.definitions if effect_id in names]:
            text = insert_own_effect(text, name, self.definitions[name])
        return text


def collect_shared_effects(robot: Robot, folder: str | Path) -> SharedEffects:
    """The own effects of every *.toml file of a folder, as far as the robot has what they read.

    What the robot, or a file before, defines alike counts once.

    Args:
        robot: that may have them.
        folder: of files as `export_effect` gives them, or of robot files.

    Raises:
        RobotError: a file that cannot be read, a mistake in it, a name or a parameter that another
            effect has; or the folder has no effect.
    """
    known = {effect.id: (effect, f"the file of {robot.name}") for effect in robot.own_effects}
    joints = [joint.name for joint in robot.moving_joints]
    definitions, left_out, some = dict[str, Mapping[str, Any]](), dict[str, str](), False
    for path in sorted(Path(folder).glob("*.toml")):
        place = TomlCell(str(path))
        table = parse_toml_document(read_file_text(path), place).get("own_effects", {})
        for name, cell in place.enter("[own_effects]", table).read_table(EXAMPLE).items():
            some, others = True, [effect for effect, _ in known.values() if effect.id != name]
            (effect,) = read_own_effects({name: cell}, place, before=others)
            before, owner = known.get(name, (effect, ""))
            if _build_law_key(before) != _build_law_key(effect):
                raise place.enter(f"[own_effects.{name}]").make_error(
                    f"defined otherwise in {owner}; rename one of the two"
                )
            if lacks := [
                n for n in sorted(effect.forms[0].other_joint_names) if n[1:] not in joints
            ]:
                left_out[name] = f"{path}: it reads {join_names(lacks)}, no joint of {robot.name}"
            elif name not in known:
                read_own_effects({name: cell}, place, joints, others)
                known[name], definitions[name] = (effect, str(path)), cell
    if not some:
        raise RobotError(
            f"{folder}: no effects there; expected a folder with files that `modeler effects "
            "--export` wrote, or with robot files that have [own_effects]"
        )
    return SharedEffects(tuple(known[name][0] for name in definitions), definitions, left_out)


def _build_law_key(effect: Effect) -> tuple[object, ...]:
    """All that a joint could tell; where its shapes are tried first is no part of it."""
    form = effect.forms[0]
    return (
        effect.acts,
        form.columns,
        form.internal_state,
        {shape.name for shape in form.nonlinear_parameters},
    )
