"""Closed forms that people read: functions of the configuration, and their coefficients."""

from modeler.terms.closed_form import ClosedForm as ClosedForm
from modeler.terms.closed_form import Function as Function
from modeler.terms.closed_form import closed_form as closed_form
from modeler.terms.coefficients import Coefficient as Coefficient
from modeler.terms.coefficients import CoefficientTable as CoefficientTable
from modeler.terms.coefficients import coefficient_table as coefficient_table
from modeler.terms.evaluation import Evaluation as Evaluation
from modeler.terms.evaluation import evaluate as evaluate
from modeler.terms.identifiability import Identifiability as Identifiability
from modeler.terms.map_render import backward_lines as backward_lines
from modeler.terms.map_render import determinant_text as determinant_text
from modeler.terms.map_render import forward_lines as forward_lines
from modeler.terms.relations import BaseMap as BaseMap
from modeler.terms.relations import Relations as Relations
from modeler.terms.render import closed_form_json as closed_form_json
from modeler.terms.render import closed_form_latex as closed_form_latex
from modeler.terms.render import closed_form_markdown as closed_form_markdown
from modeler.terms.render import closed_form_text as closed_form_text
from modeler.terms.report import terms_report as terms_report
from modeler.terms.table_render import coefficients_json as coefficients_json
from modeler.terms.table_render import coefficients_latex as coefficients_latex
from modeler.terms.table_render import coefficients_markdown as coefficients_markdown
from modeler.terms.table_render import coefficients_text as coefficients_text
