"""Symbolic model and base parameters to the files of a C module; touches no disk but templates."""

import dataclasses
import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import cache

import sympy

from modeler.codegen import closed, elimination, functions as layout
from modeler.codegen.advance import build_advance_functions
from modeler.codegen.block import OF_PRECISION, TILES, Target
from modeler.codegen.closed import LoopSolver
from modeler.codegen.context import (
    ModuleContext,
    WrittenFunction,
    build_law_tables,
    build_symbol_lines,
)
from modeler.codegen.control import (
    FITTED_UNIT,
    OBSERVATION,
    SMOOTH,
    UNIT as CONTROL_UNIT,
    Control,
    build_control_functions,
    build_fitted_control_functions,
    build_fitted_functions,
    check_values,
    find_widths,
    format_fitted_texts,
    select_roles,
)
from modeler.codegen.elimination import UNIT as TILE_UNIT, ClosingTile, Tile
from modeler.codegen.functions import CFunction
from modeler.codegen.package import C_INTERFACE, LICENSE, build_package_files, make_origin
from modeler.codegen.printers import build_a2l_files, build_cuda_files, build_structured_text
from modeler.codegen.vectors import build_stored_states, format_vectors
from modeler.core import manifest
from modeler.core.choices import Precision
from modeler.core.errors import EmitError
from modeler.core.files import locate_resources
from modeler.core.json import select_attributes
from modeler.core.manifest import EmittedModule, FittedSpec, FunctionSpec, ModuleSpec
from modeler.derivation import (
    BaseParameters,
    Label,
    Signal,
    SymbolicModel,
    evaluate_precisely,
    format_coefficient,
)

# The manifest of an emitted module: everything the numeric stages will know of the robot.


def build_module_spec(model: SymbolicModel, base: BaseParameters) -> ModuleSpec:
    """Returns the manifest of a module without its functions."""
    robot, closure, closing = model.robot, model.closure, None
    prefix = layout.make_prefix(robot.name)
    if closure is not None:
        closing = manifest.ClosureSpec(
            actuated=closure.actuated,
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

    def format_unit(signal: Signal) -> str:
        return manifest.SIGNALS[signal.kind].format(angle=robot.joints[signal.row].unit)

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
        functions=(),
        closure=closing,
        signals=tuple(
            manifest.SignalSpec(signal.kind, joint, format_unit(signal), signal.value, signal.share)
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
            text = format_coefficient(coefficient, model.robot.has_binary_fractions)
            terms[coefficient] = (text, float(number))
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
    prefix: str, functions: Sequence[WrittenFunction], called: Sequence[WrittenFunction] = ()
) -> tuple[FunctionSpec, ...]:
    """Returns the public functions; one that closes loops has the operations of all it calls.

    Args:
        prefix: of the module.
        functions: of a unit.
        called: functions of other units that they may call.
    """
    by_role = {function.role: function for function in (*called, *functions)}

    def collect_roles(role: str) -> set[str]:
        """Collects the roles of the straight lines of code that a function consists of."""
        function = by_role.get(role)
        made = function and (function.closed or function.composed)
        if not made:
            return {role}
        return set().union(*map(collect_roles, made.calls)) - {role}

    specs = []
    for function in (function for function in functions if not function.internal):
        parts = [by_role[role].block for role in collect_roles(function.role) if role in by_role]
        specs.append(
            FunctionSpec(
                name=f"{prefix}_{function.role}",
                equation=function.equation,
                inputs=function.inputs,
                outputs=(function.output,),
                additions=sum(part.additions for part in parts),
                multiplications=sum(part.multiplications for part in parts),
                status=function.status,
            )
        )
    return tuple(specs)


_RESTRICT = "MODELER_RESTRICT "


def emit(
    model: SymbolicModel,
    base: BaseParameters,
    fitted: FittedSpec | None = None,
    precision: Precision = "double",
    cuda: bool = False,
    control: Control | None = None,
) -> EmittedModule:
    """Returns the module of a robot: C source and header, runtime, build files, manifest, tables.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        fitted: their values, of a model; the unit with them is added.
        precision: of the numbers: all `double`, or all `float`.
        cuda: add the kernels of `codegen.printers`, of a robot without loops.
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
        solving = closed.build_loop_solver(model, base) if model.closure is not None else None
        parts, labels = list[Sequence[CFunction]](), list[dict[int, Label]]()
        for part in _build_parts(model, base, solving, fitted, control):
            parts.append(part)
            labels.append(model.graph.labels.copy())  # without those of the parts to come
    every = [function for part in parts for function in part]
    units, selected = None, frozenset(f.role for f in every)
    if control is not None and control.only:
        if cuda or control.a2l:
            raise EmitError(f"--{'cuda' if cuda else 'a2l'}: not with --only; generate two folders")
        selected = select_roles(every, control.only, model.robot.name)
        units = {f.unit for f in every if f.role in selected} | {FITTED_UNIT}
        units |= {"_batch"} if OBSERVATION in control.only else set()
    main, twins, more = ([f for f in part if f.role in selected] for part in parts)
    module = _build_module(model, base, OF_PRECISION[precision], solving, main, units, labels[0])
    code = _render_code(module)
    files = build_cuda_files(module, labels[0]) if cuda else {}
    if fitted is not None:
        code |= _build_fitted_unit(module, fitted, twins, labels[1])
    if control is not None:
        code |= _build_control_unit(module, more, labels[2])
        if control.structured_text:
            files |= build_structured_text(module, twins, labels[2])
        files |= build_a2l_files(module, [*main, *twins, *more]) if control.a2l else {}

    def remaining() -> dict[str, str]:
        spec, vectors = module.spec, dict[str, str]()
        if control and control.vectors:
            vectors["vectors.csv"] = format_vectors(spec.prefix, model, every, selected)
        stored = build_stored_states(model, every, module.target, selected)
        values = {**module.values, "vectors": stored, "many_states": bool(vectors), "spec": spec}
        return {
            **build_package_files(spec, code, values),
            **vectors,
            "base_parameters.md": module.render("base_parameters.md"),
            manifest.MANIFEST: dataclasses.replace(spec, origin=make_origin()).format_file(),
        }

    return EmittedModule(module.spec, _LazyFiles({**code, **files}, remaining))


def _build_parts(
    model: SymbolicModel,
    base: BaseParameters,
    solving: LoopSolver | None,
    fitted: FittedSpec | None,
    control: Control | None,
) -> Iterator[Sequence[CFunction]]:
    """The functions of the robot, those with its fitted values, those of the controller's unit."""
    if solving is None:
        beta = layout.make_beta_symbols(model, base)
        advance = build_advance_functions(model, base, beta)
        yield (*layout.build_tree_functions(model, base), *advance)
    else:
        yield closed.build_closed_functions(model, base, solving)
    yield build_fitted_functions(model, base, fitted) if fitted is not None else ()
    more = build_control_functions(model, base, control) if control is not None else ()
    if control is not None and fitted is not None:
        more = (*more, *build_fitted_control_functions(model, base, fitted, more))
    yield more


class _LazyFiles(Mapping[str, str]):
    """Files of a module: its code, and others that are made when one of them is requested.

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
    target: Target,
    solving: LoopSolver | None,
    functions: Sequence[CFunction],
    units: Collection[str] | None,
    labels: Mapping[int, Label],
) -> ModuleContext:
    """Returns what the units of the module share, its main functions written."""
    prefix = layout.make_prefix(model.robot.name)
    parameters = [f"beta[{i}]" for i in range(base.rank)]
    parameters += [f"chi[{k}]" for k in range(len(model.columns))]
    parameters += solving.symbols if solving is not None else []
    parameters += ["dt[0]", *(f"s[{k}]" for k in range(len(model.signals)))]
    parameters += [f"elastic[{k}]" for k in range(2 * len(model.windups))]
    names = layout.name_constants(prefix, model.geometry.values)
    spec = dataclasses.replace(
        build_module_spec(model, base),
        precision=target.precision,
        units=None if units is None else tuple(sorted(units)),
        laws=len({table.partition("_")[0] for table in model.graph.tables}),
    )
    module = ModuleContext(
        model,
        base,
        target,
        spec,
        layout.map_graph_symbols(model.geometry.coordinate_count, names, parameters),
        names,
        build_symbol_lines(model, base, layout.name_macros(prefix, model.robot.symbols), target),
    )
    written = [module.write(function, labels) for function in functions]
    spec = dataclasses.replace(spec, functions=build_function_specs(prefix, written))
    there = {f.role for f in functions}
    shown = spec.nonzeros if spec.has_unit("_batch") or "base_regressor_nonzeros" in there else ()
    loops = closed.build_closure_tables(model, base, solving, target) if solving else None
    if loops is not None:
        loops["sets"] = [each for each in loops["sets"] if f"tree_{each['head']}factor" in there]
        loops["rowed"] = "tree_rows" in there
    relations = [layout.format_grouping_relation(parameter) for parameter in base.parameters]
    chi, beta = layout.format_parameter_lines(spec, relations)
    states = [f"const {target.number} *{name}" for name in ("q", "qd", "qdd")]
    states += [f"const {target.number} *s"] if spec.signals else []
    status = ["int *status"] if spec.closure is not None else []
    module.values = {
        **target.template_words,
        "prefix": prefix,
        "macro": prefix.upper(),
        "interface": C_INTERFACE,
        "license": LICENSE,
        "title": layout.format_comment(spec.title or spec.robot),
        "symbols": module.symbols,
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
        "windup": [
            layout.format_prototype(
                f"{prefix}_windup",
                [
                    "size_t samples",
                    *states[:3],
                    f"{target.number} step",
                    *(f"const {target.number} *{name}" for name in ("beta", "elastic")),
                    f"{target.number} *{restrict}s",
                ],
            )
            for restrict in ("", _RESTRICT)
        ],
        "windup_places": ", ".join(map(str, spec.windups)),
        "counts": (len(spec.joints), len(spec.standard), len(spec.base), len(spec.nonzeros)),
        "nonzero_rows": layout.wrap_names([row for row, _ in shown]),
        "nonzero_columns": layout.wrap_names([column for _, column in shown]),
        "loops": loops,
        "elastic": len(spec.windups),
        "travels": any(s.kind in ("slip", "bouc_wen", "direction") for s in spec.signals),
        "plain": not layout.needs_more_than_speed(model) and not spec.windups,
        "signature": "",
        "tile": _build_tile(spec, functions, module.places, labels),
    }
    module.spec = spec
    module.spec = dataclasses.replace(spec, code=manifest.digest_code(_render_code(module)))
    module.values["signature"] = module.spec.compute_signature()
    return module


def _build_tile(
    spec: ModuleSpec,
    functions: Sequence[CFunction],
    places: Mapping[str, str],
    labels: Mapping[int, Label],
) -> Tile | ClosingTile | None:
    target = TILES[spec.precision]
    if not spec.tile_sources:
        return None
    if spec.closure is not None:
        return elimination.build_closing_tile(functions, places, len(spec.base), target, labels)
    return elimination.build_tile(functions, places, spec.nonzeros, target, labels)


def _build_fitted_unit(
    module: ModuleContext,
    fitted: FittedSpec,
    functions: Sequence[CFunction],
    labels: Mapping[int, Label],
) -> dict[str, str]:
    """Returns the C of the functions that have the fitted values; these go into the manifest."""
    prefix, called = module.spec.prefix, [*module.written]
    widths = find_widths(prefix, module.model, functions)
    turning = {speed: width.constant for speed, width in widths.items()}
    every = tuple(dict.fromkeys(widths.values()))
    written = [module.write(function, labels, turning) for function in functions]
    fitted = dataclasses.replace(
        fitted,
        widths=tuple(width.macro for width in every),
        functions=build_function_specs(prefix, written, called),
        code="",
        signature="",
    )
    values = format_fitted_texts(module.spec, fitted, every) | module.unit(
        written, module.symbols.texts
    )
    values |= {"inner": [f for f in written if f.internal], "geometry": [*module.symbols.macros]}
    loops = module.spec.closure is not None
    values |= {"outer": [f for f in written if not (f.internal and loops)]}

    def files(fitted: FittedSpec) -> dict[str, str]:
        names = {f"{prefix}{FITTED_UNIT}.{kind}": f"fitted.{kind}" for kind in ("h", "c")}
        return {name: module.render(path, **values, fitted=fitted) for name, path in names.items()}

    # The signature stands in the unit, so it comes last: it covers all the rest.
    fitted = dataclasses.replace(fitted, code=manifest.digest_code(files(fitted)))
    module.spec = dataclasses.replace(module.spec, fitted=fitted)
    fitted = dataclasses.replace(fitted, signature=manifest.digest_text(module.spec.to_json()))
    texts = files(fitted)
    module.spec = dataclasses.replace(module.spec, fitted=fitted)
    return texts


def _build_control_unit(
    module: ModuleContext, functions: Sequence[CFunction], labels: Mapping[int, Label]
) -> dict[str, str]:
    """Returns the C of the controller's unit; its functions go into the manifest."""
    spec, model, called = module.spec, module.model, [*module.written]
    prefix, literal = spec.prefix, module.target.format_literal
    fitted = [f for f in functions if f.role.startswith("fitted_")]
    widths = find_widths(prefix, model, fitted)
    smooth = find_widths(prefix, model, [f for f in functions if f.role.startswith(SMOOTH)])
    smooth_widths = list(dict.fromkeys(smooth.values()))
    written = []
    for f in functions:
        turning = {speed: width.constant for speed, width in widths.items()} if f in fitted else {}
        if f.role.startswith(SMOOTH):
            turning = {speed: f"widths[{smooth_widths.index(w)}]" for speed, w in smooth.items()}
        written.append(module.write(f, labels, turning))
    limits = [
        [math.nan if each is None else getattr(each, side) for side in _SIDES]
        for each in (model.robot.limits.get(joint.name) for joint in spec.joints)
    ]
    symbols = module.symbols
    values = {
        **module.unit(written, symbols.texts if fitted else symbols.initial),
        "fitted": spec.fitted,
        "geometry": list(symbols.macros) if fitted else [],
        "widths": tuple(dict.fromkeys(widths.values())),
        "smooth": smooth_widths,
        "limits": [[literal(x) if math.isfinite(x) else "NAN" for x in row] for row in limits],
    }
    files = {
        f"{prefix}_{unit}.{kind}": module.render(f"{unit}.{kind}", **values)
        for unit in ("control", "joints")
        if unit == "joints" or spec.units is None or CONTROL_UNIT in spec.units
        for kind in "hc"
    }
    files |= {name: _read_runtime(name, spec.precision) for name in manifest.CONTROL_RUNTIME}
    specs = build_function_specs(prefix, written, called)
    control = manifest.ControlSpec(specs, manifest.digest_code(files))
    module.spec = dataclasses.replace(spec, control=control)
    return files


_SIDES = ("lower", "upper", "speed", "acceleration")


def _render_code(module: ModuleContext) -> dict[str, str]:
    """Returns the files that the library is compiled from."""
    spec, initial, tile = module.spec, module.symbols.initial, module.values["tile"]
    prefix, functions = spec.prefix, module.values["functions"]
    files = {f"{prefix}.h": module.render("module.h")}
    for unit in ("", "_regressor", "_base_regressor"):
        if not unit or spec.has_unit(unit):
            texts = module.unit([f for f in functions if f.unit == unit], initial)
            files[f"{prefix}{unit}.c"] = module.render("module.c", **texts, main=not unit)
    for kind in "hc" if spec.has_unit("_batch") else "":
        files[f"{prefix}_batch.{kind}"] = module.render(f"batch.{kind}")
    runtime: tuple[str, ...] = (*manifest.RUNTIME, *manifest.BATCH_RUNTIME)
    runtime += manifest.LAW_RUNTIME if spec.laws else ()
    runtime += manifest.CONTROL_RUNTIME if spec.windups else ()
    if spec.closure is not None:  # the opened tree's functions, and what closes the loops
        inner = [f for f in functions if f.internal]
        outer = [f for f in functions if f.unit == "_loops"]
        files[f"{prefix}_tree.h"] = module.render("tree.h", functions=inner)
        files[f"{prefix}_loops.c"] = module.render("loops.c", functions=outer)
        runtime += manifest.CLOSURE_RUNTIME
    if spec.tile_sources:
        texts = {"constants": module.constants([tile], initial)}
        laws = build_law_tables([tile], module.target)
        for kind in ("h", "c"):
            name = "closing_tile.c" if spec.closure is not None and kind == "c" else f"tile.{kind}"
            files[f"{prefix}{TILE_UNIT}.{kind}"] = module.render(name, **texts, laws=laws)
        runtime += spec.tile_runtime
    return files | {name: _read_runtime(name, spec.precision) for name in runtime}


def _read_runtime(name: str, precision: Precision) -> str:
    """A hand-written file: its own in that precision, where it has one."""
    folder = locate_resources("csrc")
    source = folder / precision / name
    if not source.is_file():
        source = (folder / "include" if name.endswith(".h") else folder) / name
    return source.read_text("utf-8")
