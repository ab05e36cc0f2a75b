"""Pages: results as one HTML file each, that needs no network and no other file."""

from modeler.pages.additions import write_additions as write_additions
from modeler.pages.comparison import report_html as report_html
from modeler.pages.comparison import write_report as write_report
from modeler.pages.report import write_diagnosis as write_diagnosis
