"""How results show themselves: summaries, tables, figures; what a notebook displays.

One package for all: a result knows what it found, these files know how to say it. They are loaded
when a result is first shown.
"""

from functools import partial
from importlib import import_module

from modeler.core.result import register_lazily, register_presentations

_SHOWN = {
    "derivation": "Robot Derivation EmittedModule CompiledModel HomeModes",
    "log": "LogInspection Log SimulatedLog Observation DataReport ExcitingMotion",
    "fit": "FitResult IdentifiedModel Addition MethodComparison",
    "comparison": "ModelComparison Comparison FreeRun",
    "diagnosis": "Diagnosis",
    "fleet": "Fleet",
}
"""Classes of results, by the file of this package whose `PRESENTATIONS` say how they are shown."""


def register_report_modules() -> None:
    """Says who knows how the results of every stage are shown."""
    for module, names in _SHOWN.items():
        register_lazily(names.split(), partial(_load_presentations, module))


def _load_presentations(module: str) -> None:
    register_presentations(import_module(f"modeler.views.{module}").PRESENTATIONS)
