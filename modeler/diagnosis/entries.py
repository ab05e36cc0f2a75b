"""What `modeler.diagnosis` offers; loaded when the first of these is asked for."""

from modeler.diagnosis.add import add_effect as add_effect
from modeler.diagnosis.add import add_findings as add_findings
from modeler.diagnosis.add import undone as undone
from modeler.diagnosis.added_model import Logs as Logs
from modeler.diagnosis.added_model import added as added
from modeler.diagnosis.added_model import notes as notes
from modeler.diagnosis.candidates import Known as Known
from modeler.diagnosis.diagnosis import diagnose as diagnose
from modeler.diagnosis.result import Diagnosis as Diagnosis
from modeler.diagnosis.result import Finding as Finding
