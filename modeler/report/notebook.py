"""How results show themselves: summaries, tables, figures; what a notebook displays.

One room for all: a result knows what it found, these files know how to say it. They are loaded
when a result is first shown.
"""

from modeler.core.result import present_later


def register() -> None:
    """Says who knows how the results of every stage are shown."""
    present_later(("Robot", "Derivation", "Emitted", "CompiledModel", "HomeModes"), _robots)
    present_later(("Look", "Log", "SimulatedLog", "Observation", "DataReport", "Exciting"), _logs)
    present_later(("FitResult", "IdentifiedModel", "Addition", "SideBySide"), _models)
    present_later(("Contest", "Comparison", "Diagnosis"), _judgements)
    present_later(("FreeRun",), _free_runs)
    present_later(("Fleet",), _fleets)


def _robots() -> None:
    from modeler.report.derivation import present_robots

    present_robots()


def _logs() -> None:
    from modeler.report.log import present_logs

    present_logs()


def _models() -> None:
    from modeler.report.fit import present_models

    present_models()


def _judgements() -> None:
    from modeler.report.judgements import present_judgements

    present_judgements()


def _free_runs() -> None:
    from modeler.report.free_run import present_free_runs

    present_free_runs()


def _fleets() -> None:
    from modeler.report.fleet import present_fleets

    present_fleets()
