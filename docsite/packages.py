"""Draws the architecture from the code: packages as boxes, what they import as lines."""

import ast
from pathlib import Path

WIDTH, HEIGHT, BOX, ROW = 1080, 70, 150, 44
NORTH = ("effects", "robot", "derivation", "formulas", "codegen")
AROUND = ("core", "simulation", "papers", "views", "api", "cli")
FILL = {"derives": "#fde8c8", "numbers": "#d3e6f8", "around": "#e6e6e6"}


def package_imports(package: Path) -> dict[str, set[str]]:
    """{package: the packages that it imports}, but for the way round of an added effect."""
    table: dict[str, set[str]] = {path.parent.name: set() for path in package.glob("*/__init__.py")}
    for room, others in table.items():
        for path in (package / room).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("modeler."):
                    others.add(str(node.module).split(".")[1])
    back = {"robot", "codegen"}  # diagnosis writes the effect into the robot file: the round
    return {
        room: (others & table.keys()) - {room} - (back if room == "diagnosis" else set())
        for room, others in table.items()
    }


def package_levels(imports: dict[str, set[str]]) -> dict[str, int]:
    """{package: length of the longest way down to the core}."""
    levels: dict[str, int] = {}

    def level(room: str) -> int:
        if room not in levels:
            levels[room] = 1 + max((level(other) for other in imports[room]), default=-1)
        return levels[room]

    for room in imports:
        level(room)
    return levels


def package_edges(imports: dict[str, set[str]]) -> list[tuple[str, str]]:
    """Imports that no way through other packages implies."""

    def below(room: str) -> set[str]:
        return imports[room].union(*(below(other) for other in imports[room]))

    return sorted(
        (room, other)
        for room, others in imports.items()
        for other in others
        if not any(other in below(between) for between in others - {other})
    )


def _side(room: str) -> tuple[int, str]:
    """What derives stands left, what only uses numbers right."""
    return (0 if room in NORTH else 1 if room in AROUND else 2, room)


def draw_packages(package: Path) -> str:
    """The picture: the core at the foot, the command line on top.

    Args:
        package: folder of the package.
    """
    imports = package_imports(package)
    levels = package_levels(imports)
    rows = [
        sorted((r for r in levels if levels[r] == k), key=_side)
        for k in range(max(levels.values()) + 1)
    ]
    place = {
        room: (WIDTH * (i + 1) / (len(row) + 1), 30 + HEIGHT * (len(rows) - 1 - k))
        for k, row in enumerate(rows)
        for i, room in enumerate(row)
    }
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT * len(rows) + 20}" '
        'font-family="sans-serif" font-size="15" text-anchor="middle">'
    ]
    for room, other in package_edges(imports):
        (x, y), (u, v) = place[room], place[other]
        parts.append(
            f'<line x1="{x:.0f}" y1="{y + ROW / 2:.0f}" x2="{u:.0f}" y2="{v - ROW / 2:.0f}" '
            'stroke="#999"/>'
        )
    for room, (x, y) in sorted(place.items()):
        half = "derives" if room in NORTH else "around" if room in AROUND else "numbers"
        files = len(list((package / room).rglob("*.py")))
        parts.append(
            f'<rect x="{x - BOX / 2:.0f}" y="{y - ROW / 2:.0f}" width="{BOX}" height="{ROW}" '
            f'rx="6" fill="{FILL[half]}" stroke="#666"/>'
            f'<text x="{x:.0f}" y="{y:.0f}">{room}</text>'
            f'<text x="{x:.0f}" y="{y + 15:.0f}" font-size="11">{files} files</text>'
        )
    return "\n".join([*parts, "</svg>", ""])
