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
from .closed_form import ClosedForm as ClosedForm, derive_closed_form as derive_closed_form
from .coefficients import (
    CoefficientTable as CoefficientTable,
    build_coefficient_table as build_coefficient_table,
)
from .function_sheet import SheetWriter as SheetWriter, format_sheet_lines as format_sheet_lines
from .leg_blocks import (
    LegBlock as LegBlock,
    derive_block_form as derive_block_form,
    derive_leg_blocks as derive_leg_blocks,
)
from .physical_system import (
    PhysicalSystem as PhysicalSystem,
    build_physical_system as build_physical_system,
)
from .print_checks import (
    check_independent as check_independent,
    check_solutions as check_solutions,
    find_wrong_definitions as find_wrong_definitions,
    find_wrong_functions as find_wrong_functions,
)
from .print_report import check_friction as check_friction, write_terms_report as write_terms_report
from .printed import PrintedTerms as PrintedTerms
from .regressor_form import (
    Equation as Equation,
    derive_equation as derive_equation,
    derive_regressor_form as derive_regressor_form,
    derive_short_form as derive_short_form,
    drop_zero_parameters as drop_zero_parameters,
)
from .solve import (
    ClosedSolution as ClosedSolution,
    find_determined as find_determined,
    format_definition_lines as format_definition_lines,
    format_missing_lines as format_missing_lines,
    format_solution_lines as format_solution_lines,
    serialise_solution as serialise_solution,
    solve as solve,
)
from .sufficient_sets import (
    KnownSets as KnownSets,
    count_smallest_set as count_smallest_set,
    find_easiest_set as find_easiest_set,
    find_known_sets as find_known_sets,
)
from .text import format_monomial as format_monomial
from .thresholds import THRESHOLDS as THRESHOLDS
from .values import (
    DerivedValue as DerivedValue,
    KnownValues as KnownValues,
    RatedSet as RatedSet,
    parse_known_values as parse_known_values,
    rate_sets as rate_sets,
)
