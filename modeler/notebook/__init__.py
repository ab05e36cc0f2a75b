"""How results show themselves: summaries, tables, figures; what a notebook displays.

One room for all: a result knows what it found, these files know how to say it.
"""

from modeler.notebook.fleets import present_fleets
from modeler.notebook.freeruns import present_free_runs
from modeler.notebook.judgements import present_judgements
from modeler.notebook.logs import present_logs
from modeler.notebook.models import present_models
from modeler.notebook.robots import present_robots


def register() -> None:
    """Says how the results of every stage are shown."""
    present_robots()
    present_logs()
    present_models()
    present_judgements()
    present_free_runs()
    present_fleets()
