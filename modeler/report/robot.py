"""The pages of a robot: moved by sliders, and its assembly modes beside each other."""

from modeler.report.page import render, script_json
from modeler.report.robot_closing import Posture
from modeler.report.robot_page import (
    gravity_text,
    page_content,
    relations_text,
    table_head,
    table_rows,
)
from modeler.report.robot_skeleton import Skeleton


def robot_html(skeleton: Skeleton, posture: Posture) -> str:
    """The page as text; its security policy forbids any network access."""
    robot = skeleton.robot
    return render(
        "robot",
        title=f"{robot.name}: skeleton",
        about={"command": "show", "title": f"{robot.name}: skeleton", "verdict": robot.title},
        robot=robot,
        notes=" ".join(robot.notes.split()),
        posture=posture.note,
        gravity=gravity_text(skeleton),
        head=table_head(robot),
        rows=table_rows(robot),
        relations=relations_text(robot),
        content=script_json(page_content(skeleton, posture)),
    )


def modes_html(name: str, title: str, count: int, svg: str) -> str:
    """The page of a robot's assembly modes.

    Args:
        name: of the robot.
        title: of the robot.
        count: of modes.
        svg: the picture of them all, as our own drawer makes it.
    """
    drawn = svg[svg.index("<svg") :]
    return render("modes", title=f"{name}: assembly modes", robot=title, count=count, svg=drawn)
