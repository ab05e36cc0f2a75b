"""Pages that show what a diagnosis found and what an added effect gained."""

from modeler.pages.additions import write_additions as write_additions
from modeler.pages.report import write_diagnosis as write_diagnosis
