"""Closed forms that people read: functions of the configuration, coefficients, CAD values."""

from modeler.formulas.closed_form import closed_form as closed_form
from modeler.formulas.coefficients import coefficient_table as coefficient_table
from modeler.formulas.function_sheet import sheet_lines as sheet_lines
from modeler.formulas.regressor_form import regressor_form as regressor_form
from modeler.formulas.regressor_form import short_form as short_form
