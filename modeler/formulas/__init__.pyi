from . import coefficients as coefficients, function_sheet as function_sheet
from .closed_form import ClosedForm as ClosedForm, derive_closed_form as derive_closed_form
from .coefficients import (
    CoefficientTable as CoefficientTable,
    build_coefficient_table as build_coefficient_table,
)
from .function_sheet import SheetWriter as SheetWriter, format_sheet as format_sheet
from .known_values import (
    CadComparison as CadComparison,
    CadRow as CadRow,
    Explanation as Explanation,
    KnownAgainstFit as KnownAgainstFit,
    KnownValues as KnownValues,
    check_known as check_known,
    compare_cad as compare_cad,
    parse_known_values as parse_known_values,
    read_cad_example as read_cad_example,
    read_cad_file as read_cad_file,
    verify_solution as verify_solution,
)
from .paper_forms import (
    LegBlock as LegBlock,
    derive_block_form as derive_block_form,
    derive_leg_blocks as derive_leg_blocks,
    energy_functions as energy_functions,
    kane_form as kane_form,
)
from .physical import PrintedTerms as PrintedTerms
from .physical_system import (
    PhysicalSystem as PhysicalSystem,
    build_physical_system as build_physical_system,
)
from .print_checks import (
    check_friction as check_friction,
    check_independent as check_independent,
    check_solutions as check_solutions,
    find_wrong_definitions as find_wrong_definitions,
    find_wrong_functions as find_wrong_functions,
    write_terms_report as write_terms_report,
)
from .regressor_form import (
    Equation as Equation,
    derive_equation as derive_equation,
    derive_regressor_form as derive_regressor_form,
    derive_short_form as derive_short_form,
    drop_zero_parameters as drop_zero_parameters,
)
from .ring import format_monomial as format_monomial
from .solve import (
    ClosedSolution as ClosedSolution,
    DerivedValue as DerivedValue,
    derive_values as derive_values,
    find_determined as find_determined,
    find_impossible as find_impossible,
    format_definition_lines as format_definition_lines,
    format_missing_lines as format_missing_lines,
    format_solution_lines as format_solution_lines,
    serialise_solution as serialise_solution,
    solve as solve,
)
from .sufficient_sets import (
    KnownSets as KnownSets,
    RatedSet as RatedSet,
    count_smallest_set as count_smallest_set,
    find_easiest_set as find_easiest_set,
    find_known_sets as find_known_sets,
    rate_sets as rate_sets,
)
from .thresholds import THRESHOLDS as THRESHOLDS
