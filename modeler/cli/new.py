"""`modeler new ROBOT.toml`, and `modeler convert FILE --out ROBOT.toml`: robot files that begin."""

import argparse
import sys
from pathlib import Path

from modeler.cli.console import Json, print_error, say, say_lines, show_next
from modeler.core.builtin import CONVENTIONS, TEMPLATES
from modeler.core.errors import RobotError
from modeler.robot import Robot, check_new_robot, convert, lock_values, new_robot, template_robot

_FILES = (
    "a URDF, MJCF or SYMORO file needs no new one: every command reads it, or `modeler convert`"
)


def run_new(args: argparse.Namespace) -> Json:
    """Writes a robot file to start from, by questions on a terminal."""
    out = Path(args.file)
    check_new_robot(out, args.force)
    words = ("template", "joints", "convention")
    given = {key: value for key, value in vars(args).items() if key in words and value}
    asked = not given and sys.stdin is not None and sys.stdin.isatty()
    if asked:
        given = _answers()
    robot = new_robot(out, force=args.force, **given)
    loops = ", loops that close" if robot.loops else ""
    say(f"{robot.title}: {len(robot.moving)} joints{loops}, written to {out}; write your lengths")
    show_next([f"modeler derive {out}"])
    if asked:
        print_error(_FILES)
    return _about(robot, out)


def _about(robot: Robot, out: Path) -> Json:
    """What a script is told of a robot file that was written."""
    joints, loops = ([one.name for one in many] for many in (robot.moving, robot.loops))
    return {"robot": robot.name, "out": str(out), "joints": joints, "loops": loops}


def _answers() -> dict[str, str]:
    """What the user says of the robot; Enter takes what stands in brackets."""
    found = {"template": _asked(f"kind: {', '.join(TEMPLATES)}", TEMPLATES[0], "template")}
    if found["template"] == TEMPLATES[0]:
        found["joints"] = _asked("joints from the base, R or P each", "RRRRRR", "joints")
        told = f"whose table have you: {', '.join(CONVENTIONS)}"
        found["convention"] = _asked(told, "khalil", "convention")
    return found


def _asked(question: str, usual: str, key: str) -> str:
    """An answer that a template can be made with; asked again until it is one."""
    while True:
        sys.stderr.write(f"{question} [{usual}]: ")
        sys.stderr.flush()
        answer = sys.stdin.readline().strip() or usual
        try:
            template_robot("arm", **{key: answer})
            return answer
        except RobotError as error:
            print_error(str(error))


def run_convert(args: argparse.Namespace) -> Json:
    """Writes the robot file, when it has been read as one; prints the notes."""
    lock = lock_values(args.lock)
    robot = convert(args.file, args.out, args.base, args.tip, lock, args.exact_decimals, args.force)
    loops = f", {len(robot.loops)} loops" if robot.loops else ""
    say(f"{robot.name}: {len(robot.moving)} joints{loops}, written to {args.out}")
    say_lines(robot.readings, "* ")
    return {
        **_about(robot, Path(args.out)), "file": str(args.file), "notes": list(robot.readings)
    }  # fmt: skip
