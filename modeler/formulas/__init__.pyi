from . import (
    coefficients as coefficients,
    function_sheet as function_sheet,
    render as render,
    values as values,
)
from .by_link import energy_functions as energy_functions, kane_form as kane_form
from .cad import (
    CadComparison as CadComparison,
    KnownAgainstFit as KnownAgainstFit,
    check_known as check_known,
    compare_cad as compare_cad,
)
from .closed_form import ClosedForm as ClosedForm, closed_form as closed_form
from .coefficients import (
    CoefficientTable as CoefficientTable,
    coefficient_table as coefficient_table,
)
from .function_sheet import SheetWriter as SheetWriter, sheet_lines as sheet_lines
from .leg_blocks import LegBlock as LegBlock, block_form as block_form, leg_blocks as leg_blocks
from .physical_system import PhysicalSystem as PhysicalSystem, physical_system as physical_system
from .print_checks import (
    check_independent as check_independent,
    check_solutions as check_solutions,
    wrong_definitions as wrong_definitions,
    wrong_functions as wrong_functions,
)
from .print_report import check_friction as check_friction, terms_report as terms_report
from .printed import Print as Print
from .regressor_form import (
    Equation as Equation,
    equation_of as equation_of,
    nonzero_base as nonzero_base,
    regressor_form as regressor_form,
    short_form as short_form,
)
from .solve import (
    ClosedSolution as ClosedSolution,
    definition_lines as definition_lines,
    determined as determined,
    missing_lines as missing_lines,
    solution_json as solution_json,
    solution_lines as solution_lines,
    solve as solve,
)
from .sufficient_sets import (
    KnownSets as KnownSets,
    easiest_set as easiest_set,
    known_sets as known_sets,
    smallest_number as smallest_number,
)
from .text import monomial_text as monomial_text
from .values import (
    VERIFIED as VERIFIED,
    DerivedValue as DerivedValue,
    KnownValues as KnownValues,
    Rated as Rated,
    known_from_text as known_from_text,
    rated as rated,
)
