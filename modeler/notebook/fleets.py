"""Fleets."""

from collections.abc import Callable
from functools import partial

from modeler.core.presented import Figures, Presentation, Tables, present
from modeler.core.table import Cell, Table
from modeler.fleet import Fleet
from modeler.fleet.result import Followed
from modeler.fleet.text import effect_title, fleet_lines
from modeler.notebook.figures import picture_figure
from modeler.pages.fleet import map_pictures, quantity_picture
from modeler.pictures.draw_matplotlib import Drawing


def present_fleets() -> None:
    """Fleet."""
    present(Fleet, Presentation("a fleet", lambda f: "\n".join(fleet_lines(f)), _tables, _figures))


def _tables(found: Fleet) -> Tables:
    return {
        "findings": lambda: _findings(found),
        "values": lambda: _values(found),
        "quantities": lambda: _quantities(found),
    }


def _findings(found: Fleet) -> Table:
    columns = (("machine", ""), ("joint", ""), ("effect", ""), ("shape", ""), ("from", ""),
               ("to", ""), ("before", ""), ("change", ""), ("unit", ""), ("change of it", "%"),
               ("sigmas", ""), ("chance", ""))  # fmt: skip
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (f.machine, f.quantity.joint, f.quantity.effect, f.shape, f.begin, f.end, f.before,
         f.change, f.quantity.unit, f.percent, f.score, f.chance)
        for f in found.findings
    )  # fmt: skip
    return Table(f"{found.robot}: {found.verdict}", columns, rows)


def _values(found: Fleet) -> Table:
    columns = (("machine", ""), ("period", ""), ("at", found.unit), ("parameter", ""),
               ("value", ""), ("sigma", ""), ("unit", ""))  # fmt: skip
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (name, own.periods[k], own.at[k], each.quantity.parameter, own.values[k], own.sigmas[k],
         each.quantity.unit)
        for each in found.followed
        for name, own in each.machines.items()
        for k in range(len(own.periods))
    )  # fmt: skip
    return Table("what was followed, log by log", columns, rows)


def _quantities(found: Fleet) -> Table:
    columns = (("joint", ""), ("effect", ""), ("parameter", ""), ("level", ""), ("unit", ""),
               ("scatter", ""), ("told", ""))  # fmt: skip
    rows: tuple[tuple[Cell, ...], ...] = tuple(
        (each.quantity.joint, effect_title(each.quantity), each.quantity.parameter, each.level,
         each.quantity.unit, each.factor, each.told)
        for each in found.followed
    )  # fmt: skip
    return Table("what may drift", columns, rows)


def _figures(found: Fleet) -> Figures:
    drawn: dict[str, Callable[[], Drawing]] = {
        "changes" if not k else f"changes {k + 1}": partial(picture_figure, picture)
        for k, picture in enumerate(map_pictures(found))
    }
    for k, each in enumerate(found.followed, start=1):
        drawn[f"quantity {k}"] = partial(_drawn, found, each)
    return drawn


def _drawn(found: Fleet, each: Followed) -> Drawing:
    return picture_figure(quantity_picture(found, each))
