"""Effects into a model: robot file, C, fit, and the error before and after."""

from modeler.improve.add import add_effect as add_effect
from modeler.improve.add import add_findings as add_findings
from modeler.improve.add import undone as undone
from modeler.improve.notes import added as added
from modeler.improve.notes import notes as notes
from modeler.improve.rows import Logs as Logs
