"""SYMORO files written from tables of ours, in that program's format."""

from collections.abc import Mapping

from modeler.robot.robot import Robot
from tests.texts import read_pairs, read_rows

INERTIA = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
# A boom on the base, moved by a cylinder: base eye at a, boom eye at c. Links 1 boom, 2 cylinder,
# 3 rod; cut joint 4 at the boom eye, its second frame 5 on the boom.
BOOM = read_pairs("""
    Ant 0,0,2,3,1 Sigma 0,0,1,0,2 B 0,0,0,0,0 d 0,a,0,0,c R 0,0,r3,0,0 Alpha Pi/2,Pi/2,-Pi/2,Pi/2,0
    gamma 0,0,0,0,gam5 Theta t1,t2,0,t4,0 Mu 0,0,1,0,0
""")
_HEAD = """\
(*****************************)
(*   Parameters of a robot   *)
(*****************************)

(* General parameters *)
"""


def par_text(lists: Mapping[str, str], name: str = "arm", links: int = 0, joints: int = 0) -> str:
    """A file of these lists (without braces); those of the geometry that are left out are 0."""
    frames = lists["Ant"].count(",") + 1
    links, joints = links or frames, joints or frames
    zeros = ",".join("0" * frames)
    geometry = dict.fromkeys(("Ant", "Sigma", "B", "d", "R", "gamma", "Alpha", "Mu"), zeros)
    geometry |= {"Mu": ",".join("1" * frames), "Theta": zeros, "G": "0,0,-9.81"}
    kind = 2 if joints > links else 0
    lists = {key: f"{{\n        {cells}}}" for key, cells in (geometry | dict(lists)).items()}
    lines = [f"(* Robotname = '{name}' *)", f"NF = {frames}", f"NL = {links}", f"NJ = {joints}"]
    lines += [f"Type = {kind} (* a comment *)", "", *(f"{key}  = {x}" for key, x in lists.items())]
    lines += ["", "(* End of definition *)"]
    return _HEAD + "\n".join(lines) + "\n"


def par_of(robot: Robot, letters: bool) -> str:
    """The file of a robot whose rows are 1, 2, ... and whose loops are rigid, last rows first.

    Args:
        robot: without relations, platform and effects.
        letters: lengths as symbols without values; otherwise all as rounded numbers.
    """
    links = len(robot.joints) - 2 * len(robot.loops)
    joints = len(robot.joints) - len(robot.loops)
    values = {name: value.evaluate() for name, value in robot.symbols.items() if not value.names}

    def cell(expression, variable: str | None, ours: str) -> str:
        if variable in expression.names:
            return expression.text.replace(variable, ours)
        if letters or expression.is_zero:
            return expression.text.replace("pi", "Pi")
        return f"{expression.evaluate(values):.5g}"

    columns: dict[str, list[str]] = {}
    for row in robot.joints:
        number = row.name
        for key, column in read_rows("B b; d d; R r; gamma gamma; Alpha alpha; Theta theta"):
            text = cell(getattr(row, column), row.variable if row.is_moving else None, f"t{number}")
            columns.setdefault(key, []).append(text)
        columns.setdefault("Ant", []).append(row.antecedent)
        columns.setdefault("Sigma", []).append(str(int(row.kind)))
        columns.setdefault("Mu", []).append(str(int(row.actuated)))
    gravity = [e.text if letters else f"{e.evaluate(values):.5g}" for e in robot.gravity]
    lists = {key: ",".join(cells) for key, cells in columns.items()} | {"G": ",".join(gravity)}
    return par_text(lists, robot.name, links, joints)
