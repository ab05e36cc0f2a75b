"""Small expressions that `[own_effects]` can hold: factors, products of them, sums of products.

The factors stand in `factors.toml`, in the form of the catalogue of effects. Units follow from what
is read: with all quantities of one unit larger by l, a column is larger by l**p.
"""

import itertools
import math
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from modeler.core.json import ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.core.toml_cells import TomlCell
from modeler.diagnosis.candidates import Candidate, JointScale
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, NonlinearParameter, read_definition

_SYMBOL = re.compile(r"sign\(\w+\)|[A-Za-z_]\w*|[0-9.]+")  # a direction is one
_SPEEDS = {"v", "a"}  # what equations of robots with loops may read


@dataclass(frozen=True)
class Factor(ShortRepr):
    """A factor of a term, with values of its shapes.

    Attributes:
        effect: as an effect would be.
        scale: of the joint that it reads.
        nonlinear_parameters: SI.
    """

    effect: Effect
    scale: JointScale
    nonlinear_parameters: Mapping[str, float]

    @property
    def equations(self) -> list[str]:
        """Returns the equations of the factor: one, or the sine and the cosine of a wave."""
        return [column.equation.text for column in self.effect.columns]

    @property
    def lag_text(self) -> str:
        """Returns what z follows; empty without a lag."""
        memory = self.effect.forms[0].internal_state
        source = None if memory is None else memory.lagged_input
        return "" if source is None else source.text

    @property
    def has_memory(self) -> bool:
        """Returns whether it has the inner state z; an effect has one at most."""
        return self.effect.forms[0].internal_state is not None

    def compute_step_sizes(self) -> list[float]:
        """Computes a large change of each of its parameters."""
        return list(map(self._compute_step_size, self.effect.forms[0].nonlinear_parameters))

    def _compute_step_size(self, shape: NonlinearParameter) -> float:
        if shape.scale == "waves":
            return 1.0 / self.scale.range
        if shape.limits[0] > 0.0:
            return 0.5 * self.nonlinear_parameters[shape.name]
        return self.scale.range * (shape.grid[1] - shape.grid[0])

    def list_first_values(self, shape: NonlinearParameter) -> list[float]:
        """Lists the value and its two neighbours, six digits, as a definition tries them."""
        value, size = self.nonlinear_parameters[shape.name], self._compute_step_size(shape)
        return [float(f"{x:.6g}") for x in (value - size, value, value + size)]

    def clip_parameters(self, shapes: Mapping[str, float]) -> "Factor":
        """Returns the factor with other values of its parameters, within their limits."""
        clipped_values = dict(shapes)
        for shape in self.effect.forms[0].nonlinear_parameters:
            if shape.scale != "waves":
                low, high = (scale_entry(self.scale, shape, end) for end in shape.limits)
                clipped_values[shape.name] = min(max(shapes[shape.name], low), high)
        return replace(self, nonlinear_parameters=clipped_values)


Term = tuple[Factor, ...]
"""A product: one column, or two with a wave."""


@dataclass(frozen=True)
class Formula(ShortRepr):
    """A sum of at most two terms, each with its own parameter, or two for a wave."""

    terms: tuple[Term, ...]

    @cached_property
    def named_factors(self) -> list[tuple[Factor, dict[str, str]]]:
        """Returns the factors with the names of their parameters: of two vs the second is vs2."""
        entries, taken = [], list[str]()
        for part in itertools.chain(*self.terms):
            taken += part.nonlinear_parameters
            counts = {shape: taken.count(shape) for shape in part.nonlinear_parameters}
            entries.append((part, {s: s if n == 1 else f"{s}{n}" for s, n in counts.items()}))
        return entries

    @property
    def named_shapes(self) -> list[tuple[str, Factor, NonlinearParameter]]:
        """Returns the names of its parameters, each with its factor and what it is there."""
        every = [(f, n, f.effect.forms[0].nonlinear_parameters) for f, n in self.named_factors]
        return [(names[s.name], part, s) for part, names, shapes in every for s in shapes]

    @cached_property
    def nonlinear_parameters(self) -> dict[str, float]:
        """Returns values by their names in it."""
        pairs = ((names, part.nonlinear_parameters) for part, names in self.named_factors)
        return {names[key]: value for names, values in pairs for key, value in values.items()}

    @cached_property
    def equations(self) -> list[str]:
        """Returns the equations of the columns of the formula."""
        equations, every = list[str](), iter(self.named_factors)
        for term in self.terms:
            named = []
            for part, names in (next(every) for _ in term):
                texts = part.equations
                for key, name in names.items():
                    texts = [re.sub(rf"\b{key}\b", name, text) for text in texts]
                named.append(texts)
            equations += ["*".join(texts) for texts in itertools.product(*named)]
        return equations

    @property
    def lag_text(self) -> str:
        """Returns what its inner state follows; empty without a lag."""
        return "".join(part.lag_text for part, _ in self.named_factors)

    @property
    def text(self) -> str:
        """Returns the columns of the formula as text."""
        return " + ".join([*self.equations, *([f"z of {self.lag_text}"] if self.lag_text else [])])

    @property
    def title(self) -> str:
        """Returns the title of the formula in words."""
        return " and ".join(" times ".join(p.effect.title for p in term) for term in self.terms)

    @property
    def symbol_count(self) -> int:
        """Counts names, numbers and free numbers, which have a price."""
        texts = [*self.equations, *([self.lag_text] if self.lag_text else [])]
        for part, _ in self.named_factors:
            texts += part.nonlinear_parameters if part.has_memory else ()
        return len(self.nonlinear_parameters) + sum(map(count_symbols, texts))

    @property
    def is_definable(self) -> bool:
        """Returns whether a definition can hold it: one inner state, few parameters."""
        few = len(self.nonlinear_parameters) <= THRESHOLDS.max_formula_parameters
        return few and sum(part.has_memory for part, _ in self.named_factors) < 2

    def set_parameters(self, shapes: Mapping[str, float]) -> "Formula":
        """Returns the formula with other values of its parameters."""
        every = iter(
            part.clip_parameters({key: shapes[name] for key, name in names.items()})
            for part, names in self.named_factors
        )
        return Formula(tuple(tuple(next(every) for _ in term) for term in self.terms))

    def build_definition(self, prefixes: Sequence[str]) -> dict[str, Any]:
        """Builds the formula's table of `[own_effects]` but for title and units."""
        table: dict[str, Any] = {"columns": dict(zip(prefixes, self.equations, strict=False))}
        if self.lag_text:
            table["lag"] = self.lag_text
        if self.nonlinear_parameters:
            every = self.named_shapes
            table["shapes"] = {name: part.list_first_values(shape) for name, part, shape in every}
        return table

    def build_candidate(self, names: Sequence[str], j: int) -> Candidate:
        """Builds the effect of joint j; its id is its equation."""
        # whether it is finite everywhere is asked of those that are offered: it takes long
        place = TomlCell("discover", value=self.build_definition(["Xa", "Xb", "Xc", "Xd"]))
        effect = read_definition(self.text, place, {}, False, names)
        return Candidate(effect, effect.forms[0], names[j], j, dict(self.nonlinear_parameters))

    def find_nonlinear_units(self, linear: bool) -> dict[str, str]:
        """Finds the units of its parameters on a prismatic or revolute joint."""
        stroke_units = dict.fromkeys(("stroke", "stretch"), ("rad", "m")[linear])
        every = self.named_shapes
        return {n: stroke_units.get(s.scale) or s.get_unit(linear) for n, _, s in every}


def count_symbols(text: str) -> int:
    """Counts names, directions and numbers in a column, and its parameter."""
    return 1 + len(_SYMBOL.findall(text))


def scale_entry(scale: JointScale, shape: NonlinearParameter, entry: float) -> float:
    """Converts an entry of a grid or a limit to SI, also one in parts of a stroke."""
    if shape.scale in ("stroke", "stretch"):
        return (shape.scale == "stroke") * scale.middle + scale.range * entry
    return scale.scale_value(shape, entry)


# The factors that a column of a joint may have.


def list_factors(
    spec: ModuleSpec, scales: Sequence[JointScale], j: int, warm: bool, waves: Sequence[float]
) -> Iterator[list[Factor]]:
    """Lists the factors on joint j at the first values of their parameters.

    Args:
        spec: the robot.
        scales: of its joints.
        j: index of the joint.
        warm: True if its temperature is logged.
        waves: orders of waves over its position.
    """
    file = Path(__file__).with_name("factors.toml")
    joints = {k: joint.name for k, joint in enumerate(spec.joints)}
    for name, table in tomllib.loads(file.read_text(encoding="utf-8")).items():
        others = name.startswith("other_")
        for k in [k for k in joints if k != j] if others else [j]:
            title, texts = table["title"], table["columns"]
            if others:  # it reads another joint
                title = title.replace("_", joints[k])
                texts = {key: text.replace("_", joints[k]) for key, text in texts.items()}
            cell = TomlCell(file.name, name, {**table, "title": title, "columns": texts})
            factor = read_definition(name, cell, {}, False, [*joints.values()])
            (form, *_), scale = factor.forms, scales[k]
            read = form.names
            more = not read <= _SPEEDS or form.internal_state is not None
            loops = spec.closure is not None and more
            if loops or (factor.is_rotary_only and not scale.angular) or ("T" in read and not warm):
                continue
            shapes = form.nonlinear_parameters
            grids = [[scale_entry(scale, s, x) for x in s.grid] or waves for s in shapes]
            values = itertools.product(*grids)
            names = [shape.name for shape in shapes]
            named = (dict(zip(names, value, strict=True)) for value in values)
            yield [Factor(factor, scale, value) for value in named]


# Units.

_UNITS = ("N", "m", "s", "rad", "K")


def derive_parameter_unit(
    spec: ModuleSpec, j: int, candidate: Candidate, column: int, shapes: Mapping[str, str]
) -> str:
    """Derives the unit of the parameter of a column, torque over column: "N*m*s/rad".

    Args:
        spec: the robot.
        j: index of the joint.
        candidate: the effect.
        column: which.
        shapes: units of the shapes.
    """
    linear = spec.joints[j].unit == "m"
    effort, place = ("N", "m") if linear else ("N*m", "rad")
    equation, memory = candidate.form.columns[column].equation, candidate.form.internal_state
    units = {"q": place, "v": f"{place}/s", "a": f"{place}/s^2", "load": effort, "static": effort}
    units |= {"t": "s", "since": "s", "T": "K", **shapes}
    for joint in spec.joints:
        joint_unit = "m" if joint.unit == "m" else "rad"
        units |= {f"q{joint.name}": joint_unit, f"v{joint.name}": f"{joint_unit}/s"}
    values = {name: 0.7 + 0.01 * i for i, name in enumerate([*units, "z"])}
    values |= candidate.nonlinear_parameters
    exponents = parse_unit(effort)
    for unit in _UNITS:
        sizes = []
        for scale in (1.0, THRESHOLDS.unit_scale):
            now = {}
            for name, value in values.items():
                exponent = _find_exponent(units.get(name, "1"), unit, equation.text)
                now[name] = value * scale**exponent
            if memory is not None and memory.lagged_input is not None:
                now["z"] = memory.lagged_input.evaluate(now)
            sizes.append(equation.evaluate(now))
        exponent = math.log(sizes[1] / sizes[0]) / math.log(THRESHOLDS.unit_scale)
        exponents[unit] = exponents.get(unit, 0.0) - exponent
    every = {unit: round(power, THRESHOLDS.exponent_digits) for unit, power in exponents.items()}
    above = [_format_power(unit, power) for unit, power in every.items() if power > 0.0]
    below = [_format_power(unit, -power) for unit, power in every.items() if power < 0.0]
    return "/".join(["*".join(above) or "1", *below])


def parse_unit(unit: str) -> dict[str, float]:
    """Parses the exponents of "N*m/s^2"."""
    exponents = dict[str, float]()
    for mark, name, power in re.findall(r"([*/]?)([A-Za-z]+)\^?([0-9.]*)", unit.replace(" ", "*")):
        sign = -1.0 if mark == "/" else 1.0
        exponents[name] = exponents.get(name, 0.0) + sign * float(power or 1.0)
    return exponents


def _find_exponent(quantity_unit: str, unit: str, equation: str) -> float:
    """How a quantity grows with a unit; an angle within a sine is a number."""
    if unit == "rad" and quantity_unit == "rad" and re.search(r"\b(sin|cos)\b", equation):
        return 0.0
    return parse_unit(quantity_unit).get(unit, 0.0)


def _format_power(unit: str, power: float) -> str:
    return unit if power == 1.0 else f"{unit}^{power:.3g}"
