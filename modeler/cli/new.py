"""`modeler new ROBOT.toml`, and `modeler convert FILE --out ROBOT.toml`: robot files that begin."""

import argparse
import sys
from pathlib import Path

from modeler.cli.console import Json, print_error, print_lines, print_result, show_next
from modeler.core.choices import CONVENTIONS, TEMPLATES
from modeler.core.errors import RobotError
from modeler.robot import (
    Robot,
    check_new_robot,
    convert,
    fill_template,
    new_robot,
    parse_lock_values,
)

_FILES = (
    "a URDF, MJCF or SYMORO file needs no new one: every command reads it, or `modeler convert`"
)


def run_new(args: argparse.Namespace) -> Json:
    """Writes a robot file to start from, by questions on a terminal."""
    out = Path(args.file)
    check_new_robot(out, args.force)
    words = ("template", "joints", "convention")
    answers = {key: value for key, value in vars(args).items() if key in words and value}
    is_interactive = not answers and sys.stdin is not None and sys.stdin.isatty()
    if is_interactive:
        answers = _ask_robot()
    robot = new_robot(out, force=args.force, **answers)
    loops = ", loops that close" if robot.loops else ""
    print_result(
        f"{robot.title}: {len(robot.moving_joints)} joints{loops}, written to {out}; write your "
        "lengths"
    )
    show_next([f"modeler derive {out}"])
    if is_interactive:
        print_error(_FILES)
    return _describe_robot(robot, out)


def _describe_robot(robot: Robot, out: Path) -> Json:
    """What a script is told of a robot file that was written."""
    joints, loops = ([one.name for one in many] for many in (robot.moving_joints, robot.loops))
    return {"robot": robot.name, "out": str(out), "joints": joints, "loops": loops}


def _ask_robot() -> dict[str, str]:
    """What the user says of the robot; Enter takes what stands in brackets."""
    answers = {"template": _ask_question(f"kind: {', '.join(TEMPLATES)}", TEMPLATES[0], "template")}
    if answers["template"] == TEMPLATES[0]:
        answers["joints"] = _ask_question("joints from the base, R or P each", "RRRRRR", "joints")
        question = f"whose table have you: {', '.join(CONVENTIONS)}"
        answers["convention"] = _ask_question(question, "khalil", "convention")
    return answers


def _ask_question(question: str, default: str, key: str) -> str:
    """An answer that a template can be made with; asked again until it is one."""
    while True:
        sys.stderr.write(f"{question} [{default}]: ")
        sys.stderr.flush()
        answer = sys.stdin.readline().strip() or default
        try:
            fill_template("arm", **{key: answer})
            return answer
        except RobotError as error:
            print_error(str(error))


def run_convert(args: argparse.Namespace) -> Json:
    """Writes the robot file, when it has been read as one; prints the notes."""
    lock = parse_lock_values(args.lock)
    robot = convert(args.file, args.out, args.base, args.tip, lock, args.exact_decimals, args.force)
    loops = f", {len(robot.loops)} loops" if robot.loops else ""
    print_result(f"{robot.name}: {len(robot.moving_joints)} joints{loops}, written to {args.out}")
    print_lines(robot.readings, "* ")
    return {
        **_describe_robot(robot, Path(args.out)),
        "file": str(args.file),
        "notes": list(robot.readings),
    }
