"""What `modeler.papers` offers; loaded when the first of these is asked for."""

from modeler.core.builtin import paper_names as paper_names
from modeler.papers.check import Line as Line
from modeler.papers.check import LineVerdict as LineVerdict
from modeler.papers.check import check_line as check_line
from modeler.papers.check import check_paper as check_paper
from modeler.papers.check import written_out as written_out
from modeler.papers.paper import DerivedPaper as DerivedPaper
from modeler.papers.paper import Paper as Paper
from modeler.papers.paper import PrintedLine as PrintedLine
from modeler.papers.paper import derived_robot as derived_robot
from modeler.papers.paper import read_paper as read_paper
from modeler.papers.wrist import coefficient_quotations as coefficient_quotations
