"""Which paper has which method."""

from collections.abc import Callable, Mapping

from modeler.papers.briot import briot_methods
from modeler.papers.guegan import guegan_methods
from modeler.papers.hanssen import hanssen_methods
from modeler.papers.houda import houda_methods
from modeler.papers.methods import MethodTable
from modeler.papers.paper import Paper

Report = Callable[[float], None]
"""Told how much is done, 0 to 1."""

METHODS: Mapping[str, Callable[[Paper, Report], list[MethodTable]]] = {
    "briot-2012": briot_methods,
    "guegan-2003": guegan_methods,
    "hanssen-2000": hanssen_methods,
    "houda": houda_methods,
}


def run_methods(paper: Paper, report: Report) -> list[MethodTable]:
    """The paper's identification, run again in simulation; nothing for a paper without one."""
    method = METHODS.get(paper.name)
    return method(paper, report) if method is not None else []
