"""Symbolic model and base parameters to the files of a C module; touches no disk but templates."""

import dataclasses
import math
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy

from modeler.codegen import functions as layout
from modeler.codegen.a2l import build_a2l_files
from modeler.codegen.block import Block, make_block
from modeler.codegen.closed import (
    LoopSolver,
    build_closed_functions,
    build_closure_tables,
    build_loop_solver,
)
from modeler.codegen.closed_control import format_state_prototypes
from modeler.codegen.control import (
    OBSERVATION,
    UNIT as CONTROL_UNIT,
    Control,
    build_control_functions,
    build_fitted_control_functions,
    select_roles,
)
from modeler.codegen.cuda import build_cuda_files
from modeler.codegen.fitted import (
    UNIT,
    build_fitted_functions,
    check_values,
    find_widths,
    format_fitted_texts,
)
from modeler.codegen.functions import CFunction
from modeler.codegen.fused import (
    UNIT as TILE_UNIT,
    ClosingTile,
    Tile,
    build_closing_tile,
    build_tile,
)
from modeler.codegen.law_tables import build_law_tables
from modeler.codegen.naming import Letters, format_legend
from modeler.codegen.package import C_INTERFACE, LICENSE, build_package_files, make_origin, render
from modeler.codegen.parameter_set import SMOOTH
from modeler.codegen.structured_text import build_structured_text
from modeler.codegen.symbols import build_symbol_lines
from modeler.codegen.targets import OF_PRECISION, TILES, Target
from modeler.codegen.vectors import build_stored_states, format_vectors
from modeler.core import manifest
from modeler.core.errors import EmitError, Precision
from modeler.core.files import locate_resources
from modeler.core.json import select_attributes
from modeler.core.law import Law
from modeler.core.manifest import EmittedModule, FittedSpec, FunctionSpec, ModuleSpec
from modeler.derivation import (
    BaseParameters,
    Label,
    SymbolicModel,
    evaluate_precisely,
    format_coefficient,
)
from modeler.robot import Limits

# The manifest of an emitted module: everything the numeric stages will know of the robot.


def build_module_spec(
    model: SymbolicModel, base: BaseParameters, blocks: Iterable[tuple[CFunction, Block]]
) -> ModuleSpec:
    """The manifest of the module with these functions."""
    robot, closure, closing = model.robot, model.closure, None
    prefix = layout.make_prefix(robot.name)
    if closure is not None:
        closing = manifest.ClosureSpec(
            given=closure.actuated,
            home=closure.home,
            variables=tuple(joint.name for joint in robot.free_joints),
            units=tuple(joint.unit for joint in robot.free_joints),
            platform=closure.platform or (),
            carrier=robot.platform[-1] if robot.platform else "",
        )
    joints = tuple(
        manifest.JointSpec(
            **select_attributes(joint, "name unit effort_unit actuated"),
            kind="revolute" if joint.is_revolute else "prismatic",
            drive_gain=robot.drive_gains.get(joint.name),
            drive=robot.drives.get(joint.name),
        )
        for joint in robot.coordinates
    )
    standard = tuple(
        manifest.ParameterSpec(
            **select_attributes(column, "name unit kind effect nonnegative"),
            joint=robot.joints[column.row].name,
            nominal=robot.parameters.get(column.name),
            deviation=robot.uncertainty.get(column.name),
        )
        for column in model.columns
    )
    measured = [robot.joints[s.row].name if s.row >= 0 else "" for s in model.signals]
    return ModuleSpec(
        robot=robot.name,
        title=robot.title,
        prefix=prefix,
        format=manifest.FORMAT,
        symbols=tuple(manifest.SymbolSpec(*symbol) for symbol in model.geometry.values.items()),
        joints=joints,
        standard=standard,
        base=_build_base_specs(model, base),
        unidentifiable=tuple(base.unidentifiable),
        functions=build_function_specs(prefix, list(blocks)),
        closure=closing,
        signals=tuple(
            manifest.SignalSpec(signal.kind, joint, manifest.SIGNALS[signal.kind], signal.value)
            for signal, joint in zip(model.signals, measured, strict=True)
        ),
        inertial_uncertainty=robot.uncertainty.get("inertial"),
    )


def _build_base_specs(model: SymbolicModel, base: BaseParameters) -> tuple[manifest.BaseSpec, ...]:
    """The base parameters; entries of the regressor and equal coefficients are looked at once."""
    rows: dict[int, list[int]] = {}
    for joint, place in model.regressor:
        rows.setdefault(place, []).append(joint)
    every = range(len(model.closure.actuated)) if model.closure is not None else None
    graph, values = model.graph, model.geometry.values
    terms: dict[sympy.Expr, tuple[str, float]] = {}
    for coefficient in (term.coefficient for each in base.parameters for term in each.terms):
        if coefficient not in terms:
            number = evaluate_precisely(graph, [model.algebra.static(coefficient)], values)[0]
            terms[coefficient] = (
                format_coefficient(coefficient, model.robot.has_binary_fractions),
                float(number),
            )
    specs = []
    for parameter in base.parameters:
        column = model.columns[parameter.column]
        specs.append(
            manifest.BaseSpec(
                name=parameter.name,
                column_of=column.name,
                **select_attributes(column, "unit kind"),
                # With loops a column can enter the torque of every coordinate.
                rows=tuple(every or sorted(rows.get(parameter.column, ()))),
                terms=tuple(
                    manifest.TermSpec(*terms[t.coefficient], t.parameter) for t in parameter.terms
                ),
            )
        )
    return tuple(specs)


def build_function_specs(
    prefix: str,
    blocks: Sequence[tuple[CFunction, Block]],
    called: Sequence[tuple[CFunction, Block]] = (),
) -> tuple[FunctionSpec, ...]:
    """The public ones; one that closes loops has the operations of all that it calls, once each.

    Args:
        prefix: of the module.
        blocks: the functions.
        called: functions of other units that they may call.
    """
    operations = {
        function.role: (block.additions, block.multiplications)
        for function, block in (*called, *blocks)
    }
    functions = {function.role: function for function, _ in (*called, *blocks)}

    def collect_roles(role: str) -> set[str]:
        """Roles of the straight lines of code that a function consists of."""
        function = functions.get(role)
        made = function and (function.closed or function.composed)
        if not made:
            return {role}
        return set().union(*map(collect_roles, made.calls)) - {role}

    specs = []
    for function in (function for function, _ in blocks if not function.internal):
        parts = [
            operations[role] for role in sorted(collect_roles(function.role)) if role in operations
        ]
        specs.append(
            FunctionSpec(
                name=f"{prefix}_{function.role}",
                **select_attributes(function, "equation inputs"),
                outputs=(function.output,),
                additions=sum(additions for additions, _ in parts),
                multiplications=sum(multiplications for _, multiplications in parts),
                status=function.status,
            )
        )
    return tuple(specs)


_RESTRICT = "MODELER_RESTRICT "


@dataclass(frozen=True, kw_only=True)
class _WrittenFunction(CFunction):
    """One function with its finished strings."""

    name: str
    arguments: list[str]
    declaration: str
    definition: str
    made: str  # prototypes of what is made of a closed posture, and of a state
    at_declaration: str
    at_definition: str
    lines: list[str]
    symbols: frozenset[str]
    additions: int
    multiplications: int
    letters: frozenset[Letters]
    laws: Mapping[str, Law]


def emit(
    model: SymbolicModel,
    base: BaseParameters,
    fitted: FittedSpec | None = None,
    precision: Precision = "double",
    cuda: bool = False,
    control: Control | None = None,
) -> EmittedModule:
    """The module of a robot: C source and header, runtime, build files, manifest, tables.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        fitted: their values, of a model; the unit with them is added.
        precision: of the numbers: all `double`, or all `float`.
        cuda: add the kernels of `codegen.cuda`, of a robot without loops.
        control: add the controller's unit, and what else it says.

    Raises:
        EmitError: something has no C99 form, or a value is missing or none, or too large for the
            precision; says what.
    """
    if not base.parameters:
        raise EmitError(f"{model.robot.name} has no base parameters: nothing to emit")
    if fitted is not None:
        check_values(base, fitted)
    with model.restore_labels():
        solving = build_loop_solver(model, base) if model.closure is not None else None
        parts, labels = list[Sequence[CFunction]](), list[dict[int, Label]]()
        for part in _build_parts(model, base, solving, fitted, control):
            parts.append(part)
            labels.append(model.graph.labels.copy())  # without those of the parts to come
        every = [function for part in parts for function in part]
        units, selected = None, frozenset(f.role for f in every)
        if control is not None and control.only:
            if cuda or control.a2l:
                raise EmitError(
                    f"--{'cuda' if cuda else 'a2l'}: not with --only; generate two folders"
                )
            selected = select_roles(every, control.only, model.robot.name)
            units = {f.unit for f in every if f.role in selected} | {UNIT}
            units |= {"_batch"} if OBSERVATION in control.only else set()
        main, twins, more = ([f for f in part if f.role in selected] for part in parts)
        model.graph.labels = labels[0]
        values = _build_module(model, base, precision, solving, main, units)
        spec: ModuleSpec = values["spec"]
        code = _render_code(spec, values)
        kernels = build_cuda_files(values) if cuda else {}
        if fitted is not None:
            model.graph.labels = labels[1]
            spec, unit = _build_fitted_unit(model, fitted, twins, values)
            code |= unit
        if control is not None:
            model.graph.labels = labels[2]
            spec, unit = _build_control_unit(model, spec, more, values)
            code |= unit
        values |= {"spec": spec}
        if control is not None and control.structured_text:
            kernels |= build_structured_text(model, spec, values, twins)
        if control is not None and control.a2l:
            kernels |= build_a2l_files(model, spec, values, [*main, *twins, *more])

    def build_other_files() -> dict[str, str]:
        stored = build_stored_states(model, every, OF_PRECISION[precision], selected)
        more = (
            {"vectors.csv": format_vectors(spec.prefix, model, every, selected)}
            if control and control.vectors
            else {}
        )
        return {
            **build_package_files(
                spec, code, {**values, "vectors": stored, "many_states": bool(more)}
            ),
            **more,
            "base_parameters.md": render("base_parameters.md", **values),
            manifest.MANIFEST: dataclasses.replace(spec, origin=make_origin()).to_json(),
        }

    return EmittedModule(spec, _LazyFiles({**code, **kernels}, build_other_files))


def _build_parts(
    model: SymbolicModel,
    base: BaseParameters,
    solving: LoopSolver | None,
    fitted: FittedSpec | None,
    control: Control | None,
) -> Iterator[Sequence[CFunction]]:
    """The functions of the robot, those with its fitted values, those of the controller's unit."""
    yield (
        layout.build_tree_functions(model, base) if solving is None
        else build_closed_functions(model, base, solving)
    )  # fmt: skip
    yield build_fitted_functions(model, base, fitted) if fitted is not None else ()
    more = build_control_functions(model, base, control) if control is not None else ()
    if control is not None and fitted is not None:
        more = (*more, *build_fitted_control_functions(model, base, fitted, more))
    yield more


class _LazyFiles(Mapping[str, str]):
    """Files of a module: its code, and others that are made when one of them is asked for.

    Who compiles the code in memory does not wait for the numbers of the check.
    """

    def __init__(self, code: Mapping[str, str], others: Callable[[], Mapping[str, str]]) -> None:
        self._code, self._others = code, cache(others)

    def __getitem__(self, name: str) -> str:
        return self._code[name] if name in self._code else self._others()[name]

    def __iter__(self) -> Iterator[str]:
        return iter([*self._code, *self._others()])

    def __len__(self) -> int:
        return len(self._code) + len(self._others())

    def __or__(self, more: Mapping[str, str]) -> dict[str, str]:
        return {**self, **more}

    def __reduce__(self) -> tuple[type, tuple[dict[str, str]]]:
        return dict, (dict(self),)


def _build_module(
    model: SymbolicModel,
    base: BaseParameters,
    precision: Precision,
    solving: LoopSolver | None,
    functions: Sequence[CFunction],
    units: Collection[str] | None,
) -> dict[str, Any]:
    """What the templates read; the functions' bodies and the places of symbols with it."""
    prefix, target = layout.make_prefix(model.robot.name), OF_PRECISION[precision]
    macros = layout.name_macros(prefix, model.robot.symbols)
    parameters = [f"beta[{i}]" for i in range(base.rank)]
    parameters += [f"chi[{k}]" for k in range(len(model.columns))]
    parameters += solving.symbols if solving is not None else []
    parameters += ["dt[0]", *(f"s[{k}]" for k in range(len(model.signals)))]
    constants = layout.name_constants(prefix, model.geometry.values)
    places = layout.map_graph_symbols(model.geometry.coordinate_count, constants, parameters)
    blocks = [(f, _make_block(f, places, target)) for f in functions]
    spec = dataclasses.replace(
        build_module_spec(model, base, blocks),
        precision=precision,
        units=None if units is None else tuple(sorted(units)),
        laws=len({name for table in model.graph.tables for name in [table.partition("_")[0]]}),
    )
    there = {f.role for f in functions}
    shown = spec.has_unit("_batch") or "base_regressor_nonzeros" in there
    loops = build_closure_tables(model, base, solving, target) if solving else None
    if loops is not None:
        loops["sets"] = [each for each in loops["sets"] if f"tree_{each['head']}factor" in there]
        loops["rowed"] = "tree_rows" in there
    symbols = build_symbol_lines(model, base, macros, target)
    written = [_write_function(prefix, f, block, target) for f, block in blocks]
    relations = [layout.format_grouping_relation(parameter) for parameter in base.parameters]
    chi, beta = layout.format_parameter_lines(spec, relations)
    states = [f"const {target.number} *{name}" for name in ("q", "qd", "qdd")]
    states += [f"const {target.number} *s"] if spec.signals else []
    status = ["int *status"] if spec.closure is not None else []
    values = {
        **target.template_words,
        "spec": spec,
        "prefix": prefix,
        "macro": prefix.upper(),
        "interface": C_INTERFACE,
        "license": LICENSE,
        "title": layout.format_comment(spec.title or spec.robot),
        "symbols": symbols,
        "standard": chi,
        "base": beta,
        "enums": [
            layout.wrap_names(
                layout.name_enumerators(prefix, kind, [each.name for each in parameters])
            )
            for kind, parameters in (("chi", spec.standard), ("beta", spec.base))
        ],
        "joints": ", ".join(joint.name for joint in spec.joints),
        "relations": relations,
        "functions": written,
        "signals": layout.format_signal_lines(spec),
        "observation": [
            layout.format_prototype(
                f"{prefix}_observation",
                ["size_t samples", *states, f"{target.number} *{restrict}W", *status],
            )
            for restrict in ("", _RESTRICT)
        ],
        "counts": (len(spec.joints), len(spec.standard), len(spec.base), len(spec.nonzeros)),
        "nonzero_rows": layout.wrap_names([row for row, _ in spec.nonzeros] if shown else []),
        "nonzero_columns": layout.wrap_names(
            [column for _, column in spec.nonzeros] if shown else []
        ),
        "loops": loops,
        "names": constants,
        "plain": not layout.needs_more_than_speed(model),
        "signature": "",
        "blocks": blocks,
        "places": places,
        "tile": _build_tile(spec, functions, places),
    }
    spec = dataclasses.replace(spec, code=manifest.digest_code(_render_code(spec, values)))
    values |= {"spec": spec, "signature": spec.compute_signature()}
    return values


def _build_tile(
    spec: ModuleSpec, functions: Sequence[CFunction], places: dict[str, str]
) -> Tile | ClosingTile | None:
    if not spec.tile_sources:
        return None
    if spec.closure is not None:
        return build_closing_tile(functions, places, len(spec.base), TILES[spec.precision])
    return build_tile(functions, places, spec.nonzeros, TILES[spec.precision])


def _build_fitted_unit(
    model: SymbolicModel, fitted: FittedSpec, functions: Sequence[CFunction], values: dict[str, Any]
) -> tuple[ModuleSpec, dict[str, str]]:
    """The manifest with the values, and the C of the functions that have them."""
    spec: ModuleSpec = values["spec"]
    prefix, target = spec.prefix, OF_PRECISION[spec.precision]
    widths = find_widths(prefix, model, functions)
    turning = {speed: width.constant for speed, width in widths.items()}
    every = tuple(dict.fromkeys(widths.values()))
    blocks = [(f, _make_block(f, values["places"], target, turning)) for f in functions]
    values["fitted_blocks"] = blocks
    written = [_write_function(prefix, f, block, target) for f, block in blocks]
    fitted = dataclasses.replace(
        fitted,
        widths=tuple(width.macro for width in every),
        functions=build_function_specs(prefix, blocks, values["blocks"]),
        code="",
        signature="",
    )
    values = values | format_fitted_texts(spec, fitted, every)
    values |= {
        "functions": written,
        "inner": [f for f in written if f.internal],
        "outer": [f for f in written if not f.internal],
        "constants": _select_constants(written, values, values["symbols"].texts),
        "laws": build_law_tables(written, target),
        "geometry": list(values["symbols"].macros),
        "letters": _format_letters(written),
    }
    # The signature stands in the unit, so it comes last: it covers all the rest.
    fitted = dataclasses.replace(
        fitted, code=manifest.digest_code(_render_fitted_files(prefix, values, fitted))
    )
    spec = dataclasses.replace(spec, fitted=fitted)
    fitted = dataclasses.replace(fitted, signature=manifest.digest_text(spec.to_json()))
    return dataclasses.replace(spec, fitted=fitted), _render_fitted_files(prefix, values, fitted)


_SIDES = ("lower", "upper", "speed", "acceleration")


def _format_limit(limits: Limits | None, side: str, literal: Callable[[float], str]) -> str:
    """A number of C; NAN where the robot file states none."""
    value = math.nan if limits is None else getattr(limits, side)
    return literal(value) if math.isfinite(value) else "NAN"


def _build_control_unit(
    model: SymbolicModel, spec: ModuleSpec, functions: Sequence[CFunction], values: dict[str, Any]
) -> tuple[ModuleSpec, dict[str, str]]:
    """The manifest with the controller's unit, and its C."""
    prefix, target = spec.prefix, OF_PRECISION[spec.precision]
    fitted = [f for f in functions if f.role.startswith("fitted_")]
    widths = find_widths(prefix, model, fitted)
    smooth = find_widths(prefix, model, [f for f in functions if f.role.startswith(SMOOTH)])
    smooth_widths = list(dict.fromkeys(smooth.values()))
    blocks = []
    for f in functions:
        turning = {speed: width.constant for speed, width in widths.items()} if f in fitted else {}
        if f.role.startswith(SMOOTH):
            turning = {speed: f"widths[{smooth_widths.index(w)}]" for speed, w in smooth.items()}
        blocks.append((f, _make_block(f, values["places"], target, turning)))
    written = [_write_function(prefix, f, block, target) for f, block in blocks]
    texts = values["symbols"].texts if fitted else values["symbols"].initial
    values = values | {
        "spec": spec,
        "fitted": spec.fitted,
        "functions": written,
        "constants": _select_constants(written, values, texts),
        "laws": build_law_tables(written, target),
        "geometry": list(values["symbols"].macros) if fitted else [],
        "widths": tuple(dict.fromkeys(widths.values())),
        "smooth": smooth_widths,
        "letters": _format_letters(written),
        "limits": [
            [
                _format_limit(model.robot.limits.get(joint.name), side, values["literal"])
                for side in _SIDES
            ]
            for joint in spec.joints
        ],
    }
    files = {
        f"{prefix}_{unit}.{kind}": render(f"{unit}.{kind}", **values)
        for unit in ("control", "joints")
        if unit == "joints" or spec.units is None or CONTROL_UNIT in spec.units
        for kind in "hc"
    }
    files |= {name: _read_runtime(name, spec.precision) for name in manifest.CONTROL_RUNTIME}
    known = [*values["blocks"], *values.get("fitted_blocks", ())]
    specs = build_function_specs(prefix, blocks, known)
    control = manifest.ControlSpec(specs, manifest.digest_code(files))
    return dataclasses.replace(spec, control=control), files


def _render_fitted_files(prefix: str, values: dict[str, Any], fitted: FittedSpec) -> dict[str, str]:
    return {
        f"{prefix}{UNIT}.{kind}": render(f"fitted.{kind}", **{**values, "fitted": fitted})
        for kind in ("h", "c")
    }


def _render_code(spec: ModuleSpec, values: dict[str, Any]) -> dict[str, str]:
    """The files that the library is compiled from."""
    prefix, functions, initial = spec.prefix, values["functions"], values["symbols"].initial
    target = OF_PRECISION[spec.precision]
    files = {f"{prefix}.h": render("module.h", **values)}
    for unit in ("", "_regressor", "_base_regressor"):
        unit_functions = [f for f in functions if f.unit == unit]
        if unit and not spec.has_unit(unit):
            continue
        more = {
            "functions": unit_functions,
            "constants": _select_constants(unit_functions, values, initial),
            "main": not unit,
        }
        more |= {
            "letters": _format_letters(unit_functions),
            "laws": build_law_tables(unit_functions, target),
        }
        files[f"{prefix}{unit}.c"] = render("module.c", **{**values, **more})
    for kind in "hc" if spec.has_unit("_batch") else "":
        files[f"{prefix}_batch.{kind}"] = render(f"batch.{kind}", **values)
    runtime: tuple[str, ...] = (*manifest.RUNTIME, *manifest.BATCH_RUNTIME)
    runtime += manifest.LAW_RUNTIME if spec.laws else ()
    if spec.closure is not None:  # the opened tree's functions, and what closes the loops
        inner = [f for f in functions if f.internal]
        outer = [f for f in functions if f.unit == "_loops"]
        files[f"{prefix}_tree.h"] = render("tree.h", **{**values, "functions": inner})
        files[f"{prefix}_loops.c"] = render("loops.c", **{**values, "functions": outer})
        runtime += manifest.CLOSURE_RUNTIME
    if spec.tile_sources:
        tile_values = {**values, "constants": _select_constants([values["tile"]], values, initial)}
        tile_values["laws"] = build_law_tables([values["tile"]], target)
        for kind in ("h", "c"):
            name = "closing_tile.c" if spec.closure is not None and kind == "c" else f"tile.{kind}"
            files[f"{prefix}{TILE_UNIT}.{kind}"] = render(name, **tile_values)
        runtime += spec.tile_runtime
    return files | {name: _read_runtime(name, spec.precision) for name in runtime}


def _read_runtime(name: str, precision: Precision) -> str:
    """A hand-written file: its own in that precision, where it has one."""
    folder = locate_resources("csrc")
    source = folder / precision / name
    if not source.is_file():
        source = (folder / "include" if name.endswith(".h") else folder) / name
    return source.read_text("utf-8")


def _make_block(
    function: CFunction,
    places: dict[str, str],
    target: Target,
    turning: Mapping[int, str] | None = None,
) -> Block:
    outputs = [(f"{function.output.name}[{index}]", value) for index, value in function.entries]
    return make_block(outputs, places, turning, target)


def _write_function(
    prefix: str, function: CFunction, block: Block, target: Target
) -> _WrittenFunction:
    name, number = f"{prefix}_{function.role}", target.number
    returns = "int" if function.status else "void"
    if function.internal and function.unit in (UNIT, CONTROL_UNIT):
        returns = "static void"
    made, declared, defined = format_state_prototypes(prefix, function, number)
    return _WrittenFunction(
        **vars(function),
        name=name,
        arguments=layout.format_argument_lines(function),
        declaration=layout.format_prototype(
            name, layout.format_arguments(function, number, prefix), returns
        ),
        definition=layout.format_prototype(
            name, layout.format_arguments(function, number, prefix, defined=True), returns
        ),
        made=made,
        at_declaration=declared,
        at_definition=defined,
        lines=[] if function.status else layout.format_body(function, block, target),
        **select_attributes(block, "symbols additions multiplications letters laws"),
    )


def _format_letters(functions: Sequence[_WrittenFunction]) -> list[str]:
    """What the names of the temporaries of these functions are made of."""
    return format_legend(letter for function in functions for letter in function.letters)


def _select_constants(
    functions: Sequence[_WrittenFunction | Tile | ClosingTile],
    values: dict[str, Any],
    initial: Mapping[str, str],
) -> list[tuple[str, str]]:
    """(name, what it is initialised with) of the geometric constants that the functions read."""
    read = frozenset[str]().union(*(function.symbols for function in functions))
    return [(values["names"][symbol], text) for symbol, text in initial.items() if symbol in read]
