"""Robots with loops drawn from a seed: any lengths, angles and offsets, closed by construction.

A tree is drawn with its posture; the row where a loop closes is then placed, in that posture, on
the frame that it meets, moved as far as the joint between them allows.
"""

import numpy as np

from modeler.robot.read import parse_robot_text
from tests.oracles.closed_ways import regularity
from tests.oracles.complex_step import Oracle, rotation

ATTEMPTS = 200
REGULAR = 0.1  # smallest singular value of the solved columns at home

_COLUMNS = ("gamma", "b", "alpha", "d", "theta", "r")


class _Drawing:
    """A robot file in the making."""

    def __init__(self, seed: list[int]) -> None:
        self.rng = np.random.default_rng(seed)
        self.symbols: dict[str, float] = {}
        self.rows: list[str] = []
        self.loops: list[str] = []
        self.home: dict[str, float] = {}
        self.gravity = np.round(self.rng.normal(size=3) * 5, 2)

    def symbol(self, low: float, high: float) -> str:
        """A new symbol with a value between the bounds."""
        return self.worth(float(self.rng.uniform(low, high)))

    def worth(self, value: float) -> str:
        """A new symbol of that value; right angles are exact."""
        quarters = round(value / (np.pi / 2))
        if abs(value - quarters * np.pi / 2) < 1e-9:
            return f"{quarters}*pi/2"
        name = f"s{len(self.symbols) + 1}"
        self.symbols[name] = round(value, 4)
        return name

    def length(self) -> str:
        """A new length of order 1."""
        return self.symbol(0.3, 0.9)

    def angle(self) -> str:
        """A new angle, far from right ones."""
        return self.symbol(0.4, 1.1)

    def row(self, name: str, on: str, kind: str, actuated: bool = False, **cells: str) -> None:
        """A row that turns ("R"), slides ("P") or is fixed ("F"), with a drawn home."""
        sigma = "RPF".index(kind)
        if kind != "F":
            cells["theta" if kind == "R" else "r"] = f"q{name}"
            low, high = (-1.2, 1.2) if kind == "R" else (0.3, 0.8)
            self.home[f"q{name}"] = round(float(self.rng.uniform(low, high)), 3)
        written = ", ".join(f'"{cells.get(column, 0)}"' for column in _COLUMNS)
        self.rows.append(f'["{name}", "{on}", {int(actuated)}, {sigma}, {written}],')

    def planar(self, name: str, on: str, kind: str = "R", actuated: bool = False) -> None:
        """A row in the plane, at a drawn distance and height."""
        cells = {"d": self.length(), "b": self.symbol(-0.2, 0.2)}
        self.row(name, on, kind, actuated, **cells)

    def spatial(self, name: str, on: str, kind: str = "R", actuated: bool = False) -> None:
        """A row about or along a skew axis."""
        cells = {"d": self.length(), "alpha": self.angle()}
        if kind != "P":
            cells["r"] = self.length()
        self.row(name, on, kind, actuated, **cells)

    def ball(self, names: str, on: str) -> None:
        """Rows about crossing axes: two a universal joint, three a spherical one."""
        for k, name in enumerate(names):
            if k == 0:
                self.spatial(name, on)
            else:
                self.row(name, names[k - 1], "R", alpha="pi/2" if k % 2 else "-pi/2")

    def close(self, name: str, on: str, frame: str, kind: str) -> None:
        """The fixed row `name` where `frame` is, in the drawn posture, and the loop there."""
        tree = Oracle(parse_robot_text(self.text(), "drawn"))
        frames = tree.frames(np.array([self.home[row.variable] for row in tree.robot.free_joints]))
        (R, p), (S, o) = ((x[0][0], x[1][0]) for x in (frames[frame], frames[on]))
        R, p = self._freed(R, p, kind)
        cells = placed(S.T @ R, S.T @ (p - o))
        self.row(name, on, "F", **{k: self.worth(x) for k, x in cells.items() if abs(x) > 1e-9})
        self.loops.append(f'["{len(self.loops) + 1}", "{frame}", "{name}", "{kind}"],')

    def _freed(self, R: np.ndarray, p: np.ndarray, kind: str) -> tuple[np.ndarray, np.ndarray]:
        """The frame moved by what the joint lets free."""
        angle, x, y = self.rng.uniform(0.2, 0.6, 3)
        if kind in ("cylindrical", "prismatic"):
            p = p + x * R[:, 2]
        if kind == "planar":
            p = p + x * R[:, 0] + y * R[:, 1]
        if kind in ("cylindrical", "planar"):
            R = R @ rotation(2, angle)
        if kind in ("spherical", "position"):
            R = R @ rotation(2, angle) @ rotation(0, x) @ rotation(2, y)
        if kind == "universal":
            R = R @ rotation(2, angle) @ rotation(0, np.pi / 2) @ rotation(2, x)
        return R, p

    def text(self) -> str:
        """The robot file."""
        lines = ['name = "drawn"', f"gravity = {self.gravity.tolist()}", "[symbols]"]
        lines += [f"{name} = {value}" for name, value in self.symbols.items()]
        lines += ["[mdh]", f"columns = {['j', 'a', 'mu', 'sigma', *_COLUMNS]}", "rows = ["]
        lines += [*self.rows, "]"]
        if self.loops:
            lines += ["[loops]", 'columns = ["loop", "frame", "meets", "joint"]', "rows = ["]
            lines += [*self.loops, "]", "[home]"]
            lines += [f"{name} = {value}" for name, value in self.home.items()]
        return "\n".join(lines) + "\n"


def placed(R: np.ndarray, p: np.ndarray) -> dict[str, float]:
    """Cells of the fixed row with that pose in its antecedent."""
    if R[2, 2] > 1.0 - 1e-9:  # parallel axes
        gamma, turn = float(np.arctan2(p[1], p[0])), float(np.arctan2(R[1, 0], R[0, 0]))
        return dict(gamma=gamma, b=float(p[2]), d=float(np.hypot(*p[:2])), theta=turn - gamma)
    gamma, theta = np.arctan2(R[0, 2], -R[1, 2]), np.arctan2(R[2, 0], R[2, 1])
    across = np.array([[0, np.cos(gamma), R[0, 2]], [0, np.sin(gamma), R[1, 2]], [1, 0, R[2, 2]]])
    b, d, r = np.linalg.solve(across, p)
    cells = (gamma, b, np.arccos(R[2, 2]), d, theta, r)
    return {k: float(x) for k, x in zip(_COLUMNS, cells, strict=True)}


def four_bar(draw: _Drawing) -> None:
    """Crank, coupler with an offset, rocker."""
    draw.planar("1", "0", actuated=True)
    draw.planar("2", "1")
    draw.planar("3", "0")
    draw.planar("E", "2", "F")
    draw.close("F", "3", "E", "revolute")


def slider_crank(draw: _Drawing) -> None:
    """Crank, rod, and a slider that the loop guides on a line with an offset."""
    draw.planar("1", "0", actuated=True)
    draw.planar("2", "1")
    draw.planar("3", "2")
    draw.row("E", "3", "F", gamma=draw.angle(), d=draw.length(), alpha="pi/2")
    draw.close("F", "0", "E", "prismatic")


def stephenson(draw: _Drawing) -> None:
    """A four-bar whose coupler drives a pair of bars to the base."""
    four_bar(draw)
    draw.planar("4", "2")
    draw.planar("5", "0")
    draw.planar("G", "4", "F")
    draw.close("H", "5", "G", "revolute")


def rssr_universal(draw: _Drawing) -> None:
    """Crank, spherical joint, coupler, universal joint that closes the loop, rocker."""
    draw.spatial("1", "0", actuated=True)
    draw.ball("234", "1")
    draw.spatial("5", "0")
    draw.spatial("E", "4", "F")
    draw.close("F", "5", "E", "universal")


def rscr(draw: _Drawing) -> None:
    """Crank, spherical joint that closes the loop, coupler, cylindrical joint, rocker."""
    draw.spatial("1", "0", actuated=True)
    draw.spatial("2", "0")
    draw.spatial("3", "2")
    draw.row("4", "3", "P")
    draw.spatial("E", "4", "F")
    draw.close("F", "1", "E", "spherical")


def rccc(draw: _Drawing) -> None:
    """Crank and three cylindrical joints, the last of which closes the loop."""
    draw.spatial("1", "0", actuated=True)
    draw.spatial("2", "1")
    draw.row("3", "2", "P")
    draw.spatial("4", "3")
    draw.row("5", "4", "P")
    draw.spatial("E", "5", "F")
    draw.close("F", "0", "E", "cylindrical")


def on_a_plane(draw: _Drawing) -> None:
    """Four skew revolute joints, and a plane on which the last body stays."""
    draw.spatial("1", "0", actuated=True)
    for k in range(2, 5):
        draw.spatial(str(k), str(k - 1))
    draw.spatial("E", "4", "F")
    draw.close("F", "0", "E", "planar")


DRAWN = {
    f.__name__: f
    for f in (four_bar, slider_crank, stephenson, rssr_universal, rscr, rccc, on_a_plane)
}


def drawn(kind: str, seed: int) -> str:
    """The robot file of that kind and seed, with a home that is far from singularities."""
    for attempt in range(ATTEMPTS):
        draw = _Drawing([seed, attempt])
        DRAWN[kind](draw)
        oracle = Oracle(parse_robot_text(draw.text(), "drawn"))
        home = np.array([draw.home[joint.variable] for joint in oracle.robot.free_joints])
        if regularity(oracle, home) > REGULAR:
            return draw.text()
    raise AssertionError(f"no {kind} with a regular home among {ATTEMPTS}")
