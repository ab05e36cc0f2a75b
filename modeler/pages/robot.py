"""The pages of a robot: moved by sliders, and its assembly modes beside each other."""

from modeler.pages.render import render, script_json
from modeler.show.closing import Posture
from modeler.show.content import page_content
from modeler.show.skeleton import Skeleton
from modeler.show.table import gravity_text, relations_text, table_head, table_rows


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
