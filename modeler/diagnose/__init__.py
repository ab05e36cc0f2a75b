"""Which physical effect a model lacks, and what it would gain."""

from modeler.diagnose.diagnosis import diagnose as diagnose
from modeler.diagnose.result import Diagnosis as Diagnosis
from modeler.diagnose.result import Finding as Finding
from modeler.hypotheses.candidates import Known as Known
