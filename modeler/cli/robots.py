"""Reading ROBOT as every command does, and `modeler robots`, `modeler effects`."""

import argparse
from collections.abc import Sequence

from modeler.cli.console import Json, say
from modeler.cli.signature import signature_lines
from modeler.core.errors import RobotError
from modeler.effects import CATALOGUE, Effect, effect_named
from modeler.robot import Robot, builtin_names, read_robot, robot_from_text
from modeler.robot.edit import with_effects
from modeler.robot.place import near


def add_robot(parser: argparse.ArgumentParser) -> None:
    """The ROBOT argument and what changes it."""
    parser.add_argument(
        "robot", metavar="ROBOT", help="a robot file, or the name of a built-in robot"
    )
    parser.add_argument(
        "--effects",
        metavar="LIST",
        help='effects instead of those of the file, for all joints: "viscous,coulomb"; "" for none',
    )


def robot_of(args: argparse.Namespace) -> Robot:
    """The robot that the arguments mean."""
    robot = read_robot(args.robot)
    if args.effects is None:
        return robot
    wanted = [name.strip() for name in args.effects.split(",") if name.strip()]
    names = [effect.id for effect in robot.catalogue]
    unknown = [name for name in wanted if effect_named(name, robot.catalogue) is None]
    if unknown:
        raise RobotError(
            f"--effects: got {unknown[0]}{near(unknown[0], names)}; expected some of "
            f"{', '.join(names)}, with commas between"
        )
    text = with_effects(robot.text, dict.fromkeys(wanted, "all"))
    return robot_from_text(text, f"{args.robot} with --effects")


def add_robots(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler robots`."""
    parser = commands.add_parser(
        "robots",
        help="the built-in robots",
        description="Lists the built-in robots: names to use wherever a command asks for ROBOT.",
        epilog="example: modeler robots --json robots.json",
    )
    parser.add_argument("--show", metavar="NAME", help="print that robot's file, to start your own")
    parser.add_argument("--json", metavar="FILE", help="write the list for machines")
    parser.set_defaults(run=run_robots)


def run_robots(args: argparse.Namespace) -> Json:
    """Prints the table of built-in robots, or one robot's file."""
    if args.show is not None:
        text = read_robot(args.show).text
        say(text.rstrip())
        return {"name": args.show, "text": text}
    robots = [read_robot(name) for name in builtin_names()]
    width = max(len(robot.name) for robot in robots)
    for robot in robots:
        effects = ", ".join(use.effect for use in robot.effects) or "rigid links only"
        count = len(robot.coordinates)
        tree = len(robot.moving)
        joints = f"{count} joints" + (f" of {tree}" if tree > count else "")
        say(f"{robot.name:<{width}}  {joints:<12}  {robot.title} ({effects})")
    return [
        {
            "name": robot.name,
            "title": robot.title,
            "joints": [joint.name for joint in robot.coordinates],
            "effects": [use.effect for use in robot.effects],
        }
        for robot in robots
    ]


def add_effects(commands: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    """`modeler effects`."""
    parser = commands.add_parser(
        "effects",
        help="the catalogue of physical effects",
        description="Lists the physical effects that a robot file may name under [effects].",
        epilog="example: modeler effects coulomb",
    )
    parser.add_argument("effect", metavar="EFFECT", nargs="?", help="one effect, in full")
    parser.add_argument(
        "--robot", metavar="ROBOT", help="with the effects that this robot file defines"
    )
    parser.add_argument("--json", metavar="FILE", help="write the catalogue for machines")
    parser.set_defaults(run=run_effects)


def run_effects(args: argparse.Namespace) -> Json:
    """Prints the catalogue, or one page of it."""
    known = CATALOGUE if args.robot is None else read_robot(args.robot).catalogue
    chosen = known if args.effect is None else (_effect(args.effect, known),)
    facts = [_facts(effect) for effect in chosen]
    for fact in facts:
        say(f"{fact['id']:<22} {fact['equation']}")
        say(f"  {fact['title']}")
        if args.effect is not None:
            for name, value in fact.items():
                if name not in ("id", "equation", "title") and value:
                    say(f"  {name:<12} {', '.join(value) if isinstance(value, list) else value}")
            for line in signature_lines(chosen[0]):
                say(line)
    return facts


def _effect(name: str, known: Sequence[Effect]) -> Effect:
    effect = effect_named(name, known)
    if effect is None:
        names = [each.id for each in known]
        raise RobotError(
            f"effects: got {name}{near(name, names)}; expected one of {', '.join(names)}, or one "
            "that the file of --robot defines"
        )
    return effect


def _facts(effect: Effect) -> dict[str, str | list[str]]:
    return {
        "id": effect.id,
        "aliases": list(effect.aliases),
        "title": effect.title,
        "equation": effect.equation,
        "parameters": [column.prefix for column in effect.columns],
        "unit": [column.unit_revolute for column in effect.columns],
        "shapes": [f"{s.name}: {s.meaning}" for f in effect.forms for s in f.free],
        "same_as": list(effect.same_as),
        "signature": effect.signature,
        "look_alikes": effect.look_alikes,
        "range": effect.range,
        "source": effect.source,
    }
