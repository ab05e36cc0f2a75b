"""How results show themselves: summaries, tables, figures; what a notebook displays.

One room for all: a result knows what it found, these files know how to say it. They are loaded
when a result is first shown.
"""

from modeler.core.presented import present_later


def register() -> None:
    """Says who knows how the results of every stage are shown."""
    present_later(("Robot", "Derivation", "Emitted", "CompiledModel", "HomeModes"), _robots)
    present_later(("Look", "Log", "SimulatedLog", "Observation", "DataReport", "Exciting"), _logs)
    present_later(("FitResult", "IdentifiedModel", "Addition", "SideBySide"), _models)
    present_later(("Contest", "Comparison", "Diagnosis"), _judgements)
    present_later(("FreeRun",), _free_runs)
    present_later(("Fleet",), _fleets)


def _robots() -> None:
    from modeler.notebook.robots import present_robots

    present_robots()


def _logs() -> None:
    from modeler.notebook.logs import present_logs

    present_logs()


def _models() -> None:
    from modeler.notebook.models import present_models

    present_models()


def _judgements() -> None:
    from modeler.notebook.judgements import present_judgements

    present_judgements()


def _free_runs() -> None:
    from modeler.notebook.freeruns import present_free_runs

    present_free_runs()


def _fleets() -> None:
    from modeler.notebook.fleets import present_fleets

    present_fleets()
