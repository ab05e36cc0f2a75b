"""How results show themselves: summaries, tables, figures; what a notebook displays.

One room for all: a result knows what it found, these files know how to say it. They are loaded
when a result is first shown.
"""

from functools import partial
from importlib import import_module

from modeler.core.result import present_later

_SHOWN = {
    "derivation.present_robots": "Robot Derivation Emitted CompiledModel HomeModes",
    "log.present_logs": "Look Log SimulatedLog Observation DataReport Exciting",
    "fit.present_models": "FitResult IdentifiedModel Addition SideBySide",
    "judgements.present_judgements": "Contest Comparison Diagnosis FreeRun",
    "fleet.present_fleets": "Fleet",
}
"""Classes of results, by the file of this package and its function that says how they are shown."""


def register() -> None:
    """Says who knows how the results of every stage are shown."""
    for place, names in _SHOWN.items():
        present_later(names.split(), partial(_load, *place.split(".")))


def _load(module: str, function: str) -> None:
    getattr(import_module(f"modeler.report.{module}"), function)()
