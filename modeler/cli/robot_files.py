"""Commands about robot files: `new`, `convert`, `show`, `home`, `export`."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, cast

import numpy as np

from modeler.cli.console import (
    print_error,
    print_lines,
    print_note,
    print_result,
    show_activity,
    show_next,
)
from modeler.cli.documents import (
    AssemblyModes,
    ConvertedRobot,
    ExportReport,
    ShownRobot,
    WrittenRobot,
)
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.places import Output, check_places
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.choices import CONVENTIONS, TEMPLATES
from modeler.core.errors import DataError, RobotError
from modeler.core.files import write_atomically
from modeler.formats import convert, parse_lock_values
from modeler.robot import (
    Robot,
    check_new_robot,
    fill_template,
    format_home_lines,
    new_robot,
    replace_home,
)
from modeler.views import (
    PICTURE_KINDS,
    Posture,
    build_skeleton,
    describe_posture,
    estimate_robot_size,
    render_modes_page,
    serialise_posture,
    show,
)

if TYPE_CHECKING:
    from modeler.derivation import HomeModes, Linkage

_FILES = (
    "a URDF, MJCF or SYMORO file needs no new one: every command reads it, or `modeler convert`"
)


def run_new(args: argparse.Namespace) -> WrittenRobot:
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


def _describe_robot(robot: Robot, out: Path) -> WrittenRobot:
    """What a script learns of a robot file that was written."""
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


def run_convert(args: argparse.Namespace) -> ConvertedRobot:
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


def run_show(args: argparse.Namespace) -> ShownRobot:
    """Writes the page and the picture; prints the frames at home and whether the loops close."""
    robot = read_robot_with_notes(args.robot)
    if args.out is None and (args.picture is None or args.open):
        args.out = Output(f"{robot.name}.html")
        check_places(args)
    with show_activity(f"drawing {robot.name}"):
        drawing = show(robot, args.out, args.picture)
    print_lines(describe_posture(drawing.skeleton, drawing.posture))
    places = {"page": args.out, "picture": args.picture}
    written = {what: str(place) for what, place in places.items() if place is not None}
    print_lines(f"{what}: {place}" for what, place in written.items())
    shown = serialise_posture(drawing.skeleton, drawing.posture)
    return cast(ShownRobot, shown | written)


MODE_PICTURES = (*PICTURE_KINDS, ".html")


def run_home(args: argparse.Namespace) -> AssemblyModes:
    """Prints the assembly modes, draws them, writes one into the robot file."""
    from modeler.api import postures  # symbols take long to load
    from modeler.derivation import express_as_home

    kind = "" if args.picture is None else Path(args.picture).suffix.lower()
    if args.picture is not None and kind not in MODE_PICTURES:
        raise DataError(
            f"--picture {args.picture}: got {kind or 'no ending'}; expected a name that ends in "
            f"{', '.join(MODE_PICTURES)}"
        )
    if args.write:
        postures.check_own_file(args.robot, "posture")
    robot = read_robot_with_notes(args.robot)
    with show_activity(f"closing the loops of {robot.name}"):
        modes = postures.home(robot, args.near, args.anew)
    chosen = postures.select_mode(modes, args.mode, args.near is not None)
    print_lines(_format_table(modes))
    for place, ending in ((args.picture, kind), (args.report, ".html")):
        if place is not None:
            with show_activity("drawing"):
                write_atomically(Path(place), _draw_modes(modes, ending))
            print_result(f"written: {place}")
    home = express_as_home(modes.linkage, modes.modes[chosen].posture)
    if args.write:
        path, text = Path(args.robot), replace_home(robot.text, robot.home, home)
        if b"\r\n" in path.read_bytes():  # its line ends stay as they were
            text = text.replace("\n", "\r\n")
        write_atomically(path, text)
        print_result(f"mode {modes.modes[chosen].letter} written into {args.robot} as [home]")
    else:
        print_result(
            f"[home] of mode {modes.modes[chosen].letter} (--write puts it into the file):"
        )
        print_lines(format_home_lines(home), "  ")
    return {
        "robot": robot.name,
        "chosen_mode": modes.modes[chosen].letter,
        "as_given": None if modes.stated_index is None else modes.modes[modes.stated_index].letter,
        "modes": [
            {
                "letter": mode.letter,
                "home": express_as_home(modes.linkage, mode.posture),
                "singular_value": mode.singularity_distance,
                "is_within_limits": mode.is_within_limits,
                "copy_count": mode.copy_count,
                "distance": mode.distance_from_stated,
            }
            for mode in modes.modes
        ],
    }


def _draw_modes(modes: "HomeModes", kind: str) -> bytes:
    """A small picture of every assembly mode, beside each other: a file that needs no other."""
    from modeler.views import render_modes

    robot = modes.linkage.robot
    skeleton = build_skeleton(robot)
    size = estimate_robot_size(skeleton, modes.modes[0].posture)
    postures = [
        Posture(mode.posture, size, is_closed=True, is_as_stated=True) for mode in modes.modes
    ]
    titles = [
        mode.letter + (" (as in the file)" if k == modes.stated_index else "")
        for k, mode in enumerate(modes.modes)
    ]
    picture = render_modes(skeleton, postures, titles, ".svg" if kind == ".html" else kind)
    if kind != ".html":
        return picture
    return render_modes_page(robot.name, robot.title, len(modes.modes), picture.decode()).encode()


def _format_table(assembly: "HomeModes") -> list[str]:
    linkage, modes = assembly.linkage, assembly.modes
    actuated_joints = list(linkage.loops.actuated)
    count = f"{len(modes)} assembly mode{'s' if len(modes) > 1 else ''}"
    lines = [
        f"{linkage.robot.name}: {count} with "
        f"{_format_values(linkage, modes[0].posture, actuated_joints)}",
        "",
    ]
    # The joints by which people distinguish modes: the platform's, else the first that follow.
    names = [joint.name for joint in linkage.free]
    shown_places = [names.index(name) for name in linkage.robot.platform if name in names]
    shown_places = shown_places or list(linkage.loops.solved)[: THRESHOLDS.listed_joints]
    for k, mode in enumerate(modes):
        facts = [f"singular value {mode.singularity_distance:.2g}"]
        if linkage.robot.limits:
            facts.append("within [limits]" if mode.is_within_limits else "outside [limits]")
        if mode.copy_count > 1:
            facts.append(f"{mode.copy_count} symmetric copies")
        if k == assembly.stated_index:
            facts.append("as [home] of the file" if linkage.robot.home else "as without [home]")
        lines.append(f"{mode.letter:<3} {_format_values(linkage, mode.posture, shown_places)}")
        lines.append(f"    {', '.join(facts)}")
    return [*lines, ""]


def _format_values(linkage: "Linkage", u: np.ndarray, places: list[int]) -> str:
    """`q1 = 1.571 rad (90.00 deg), q3 = 0.33 m`."""
    texts = []
    for k in places:
        value = float(f"{u[k]:.4g}") if abs(u[k]) > 1e-9 else 0.0
        degrees = f" ({np.degrees(value):.1f} deg)" if linkage.free[k].is_revolute else ""
        texts.append(f"q{linkage.free[k].name} = {value:g} {linkage.free[k].unit}{degrees}")
    return ", ".join(texts)


def run_export(args: argparse.Namespace) -> ExportReport:
    """Writes the file; prints its numbers and what it cannot hold."""
    from modeler.api.exporting import export  # equations and models take long to load
    from modeler.api.model import open_model

    model = open_model(args.source) if Path(args.source).suffix.lower() == ".json" else None
    thing = read_robot_with_notes(args.source) if model is None else model
    for line in () if model is None else model.warning:
        print_note(line)
    with show_activity(f"exporting {args.source}"):
        exported = export(thing, args.out, args.to, args.like, args.force)
    first, *lines = exported.summary().splitlines()
    print_result(f"{first}, written to {args.out}")
    changed = exported.table("changed")
    if exported.template and len(changed):
        same = len(exported.values) - len(changed)
        print_lines(
            [
                "",
                *changed.to_text().splitlines()[1:],
                f"{same} others are as they were, in these digits",
                "",
            ]
        )
    print_lines(lines, "* ")
    return ExportReport(exported, str(args.out))
