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

from modeler.core.brief import Brief
from modeler.core.manifest import ModuleSpec
from modeler.core.toml_cells import Place
from modeler.diagnosis.candidates import Candidate, JointScale
from modeler.effects import Effect, Shape, read_definition

_SYMBOL = re.compile(r"sign\(\w+\)|[A-Za-z_]\w*|[0-9.]+")  # a direction is one
_SPEEDS = {"v", "a"}  # what equations of robots with loops may read
_MOST_SHAPES = 4
_LARGER = 1.37
_ROUND = 6  # digits of an exponent


@dataclass(frozen=True)
class Part(Brief):
    """A factor with values of its shapes.

    Attributes:
        factor: as an effect would be.
        scale: of the joint that it reads.
        shapes: SI.
    """

    factor: Effect
    scale: JointScale
    shapes: Mapping[str, float]

    @property
    def texts(self) -> list[str]:
        """Its equations: one, or the sine and the cosine of a wave."""
        return [column.equation.text for column in self.factor.columns]

    @property
    def lag(self) -> str:
        """What z follows; empty without a lag."""
        memory = self.factor.forms[0].memory
        return memory.follows.text if memory is not None and memory.follows is not None else ""

    @property
    def remembers(self) -> bool:
        """True if it has the inner state z: an effect has one."""
        return self.factor.forms[0].memory is not None

    def sizes(self) -> list[float]:
        """What is a large change of each of its shapes."""
        return [self._size(shape) for shape in self.factor.forms[0].shapes]

    def _size(self, shape: Shape) -> float:
        if shape.scale == "waves":
            return 1.0 / self.scale.range
        if shape.limits[0] > 0.0:
            return 0.5 * self.shapes[shape.name]
        return self.scale.range * (shape.grid[1] - shape.grid[0])

    def first_values(self, shape: Shape) -> list[float]:
        """The value found between two neighbours, six digits: what a definition tries first."""
        value, size = self.shapes[shape.name], self._size(shape)
        return [float(f"{x:.6g}") for x in (value - size, value, value + size)]

    def within(self, shapes: Mapping[str, float]) -> "Part":
        """The same with other values of its shapes, as far as they make sense."""
        found = dict(shapes)
        for shape in self.factor.forms[0].shapes:
            if shape.scale != "waves":
                low, high = (stated(self.scale, shape, end) for end in shape.limits)
                found[shape.name] = min(max(shapes[shape.name], low), high)
        return replace(self, shapes=found)


Term = tuple[Part, ...]
"""A product: one column, or two with a wave."""


@dataclass(frozen=True)
class Formula(Brief):
    """A sum of at most two terms, each with its own parameter, or two for a wave."""

    terms: tuple[Term, ...]

    @cached_property
    def parts(self) -> list[tuple[Part, dict[str, str]]]:
        """Its parts, and the names of their shapes in it: of two vs the second is vs2."""
        found, taken = [], list[str]()
        for part in itertools.chain(*self.terms):
            taken += part.shapes
            counts = {shape: taken.count(shape) for shape in part.shapes}
            found.append((part, {s: s if n == 1 else f"{s}{n}" for s, n in counts.items()}))
        return found

    @cached_property
    def shapes(self) -> dict[str, float]:
        """Values by their names in it."""
        return {names[key]: value for part, names in self.parts
                for key, value in part.shapes.items()}  # fmt: skip

    @cached_property
    def columns(self) -> list[str]:
        """Its equations."""
        found, every = list[str](), iter(self.parts)
        for term in self.terms:
            named = []
            for part, names in (next(every) for _ in term):
                texts = part.texts
                for key, name in names.items():
                    texts = [re.sub(rf"\b{key}\b", name, text) for text in texts]
                named.append(texts)
            found += ["*".join(texts) for texts in itertools.product(*named)]
        return found

    @property
    def lag(self) -> str:
        """What its inner state follows; empty without a lag."""
        return "".join(part.lag for part, _ in self.parts)

    @property
    def text(self) -> str:
        """Its columns."""
        return " + ".join([*self.columns, *([f"z of {self.lag}"] if self.lag else [])])

    @property
    def title(self) -> str:
        """In plain words."""
        return " and ".join(" times ".join(p.factor.title for p in term) for term in self.terms)

    @property
    def symbols(self) -> int:
        """Names and numbers in it, of what z stands for too, and free numbers: what has a price."""
        told = [*self.columns, *([self.lag] if self.lag else [])]
        told += [key for part, _ in self.parts if part.remembers for key in part.shapes]
        return len(self.shapes) + sum(map(symbols_of, told))

    @property
    def possible(self) -> bool:
        """True if a definition can hold it: one inner state, few shapes."""
        few = len(self.shapes) <= _MOST_SHAPES
        return few and sum(part.remembers for part, _ in self.parts) < 2

    def with_shapes(self, shapes: Mapping[str, float]) -> "Formula":
        """The same at other values of its shapes, by their names in it."""
        every = iter(part.within({key: shapes[name] for key, name in names.items()})
                     for part, names in self.parts)  # fmt: skip
        return Formula(tuple(tuple(next(every) for _ in term) for term in self.terms))

    def definition(self, prefixes: Sequence[str]) -> dict[str, Any]:
        """Its table of `[own_effects]` but for title and units."""
        table: dict[str, Any] = {"columns": dict(zip(prefixes, self.columns, strict=False))}
        if self.lag:
            table["lag"] = self.lag
        if self.shapes:
            table["shapes"] = {
                names[shape.name]: part.first_values(shape)
                for part, names in self.parts for shape in part.factor.forms[0].shapes
            }  # fmt: skip
        return table

    def candidate(self, names: Sequence[str], j: int) -> Candidate:
        """It as an effect of joint j of those with the names; its id is its equation."""
        # whether it is finite everywhere is asked of those that are offered: it takes long
        place = Place("discover", value=self.definition(["Xa", "Xb", "Xc", "Xd"]))
        effect = read_definition(self.text, place, {}, False, names)
        return Candidate(effect, effect.forms[0], names[j], j, dict(self.shapes))

    def shape_units(self, linear: bool) -> dict[str, str]:
        """Units of its shapes, on a prismatic joint or on one that turns."""
        own = dict.fromkeys(("stroke", "stretch"), ("rad", "m")[linear])
        return {
            names[shape.name]: own.get(shape.scale) or shape.unit(linear)
            for part, names in self.parts for shape in part.factor.forms[0].shapes
        }  # fmt: skip


def symbols_of(text: str) -> int:
    """Names, directions and numbers in a column, and its parameter."""
    return 1 + len(_SYMBOL.findall(text))


def stated(scale: JointScale, shape: Shape, entry: float) -> float:
    """Of a shape from an entry of its grid or limits, SI, also in parts of a stroke."""
    if shape.scale in ("stroke", "stretch"):
        return (shape.scale == "stroke") * scale.middle + scale.range * entry
    return scale.value(shape, entry)


# The factors that a column of a joint may have.


def parts(
    spec: ModuleSpec, scales: Sequence[JointScale], j: int, warm: bool, waves: Sequence[float]
) -> Iterator[list[Part]]:
    """The parts that every factor gives on joint j at the first values of its shapes.

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
            own = _of_joint(table, joints[k]) if others else table
            factor = read_definition(
                name, Place(file.name, name, own), {}, False, [*joints.values()]
            )
            (form, *_), scale = factor.forms, scales[k]
            read = form.names
            loops = spec.closure is not None and (not read <= _SPEEDS or form.memory is not None)
            if loops or (factor.turns and not scale.angular) or ("T" in read and not warm):
                continue
            grids = [
                [stated(scale, shape, x) for x in shape.grid] or waves for shape in form.shapes
            ]
            values = itertools.product(*grids)
            yield [Part(factor, scale, dict(zip((s.name for s in form.shapes), own, strict=True)))
                   for own in values]  # fmt: skip


def _of_joint(table: Mapping[str, Any], name: str) -> dict[str, Any]:
    """A factor that reads another joint."""
    columns = {key: text.replace("_", name) for key, text in table["columns"].items()}
    return {**table, "title": table["title"].replace("_", name), "columns": columns}


# Units.

_UNITS = ("N", "m", "s", "rad", "K")


def parameter_unit(
    spec: ModuleSpec, j: int, candidate: Candidate, column: int, shapes: Mapping[str, str]
) -> str:
    """The unit of the parameter of a column, torque over column: "N*m*s/rad".

    Args:
        spec: the robot.
        j: index of the joint.
        candidate: the effect.
        column: which.
        shapes: units of the shapes.
    """
    linear = spec.joints[j].unit == "m"
    effort, place = ("N", "m") if linear else ("N*m", "rad")
    equation, memory = candidate.form.columns[column].equation, candidate.form.memory
    units = {"q": place, "v": f"{place}/s", "a": f"{place}/s^2", "load": effort, "static": effort,
             "t": "s", "since": "s", "T": "K", **shapes}  # fmt: skip
    for joint in spec.joints:
        own = "m" if joint.unit == "m" else "rad"
        units |= {f"q{joint.name}": own, f"v{joint.name}": f"{own}/s"}
    values = {name: 0.7 + 0.01 * i for i, name in enumerate([*units, "z"])} | dict(candidate.shapes)
    found = powers(effort)
    for unit in _UNITS:
        sizes = []
        for scale in (1.0, _LARGER):
            now = {name: value * scale ** _power_of(units.get(name, "1"), unit, equation.text)
                   for name, value in values.items()}  # fmt: skip
            if memory is not None and memory.follows is not None:
                now["z"] = memory.follows.number(now)
            sizes.append(equation.number(now))
        found[unit] = found.get(unit, 0.0) - math.log(sizes[1] / sizes[0]) / math.log(_LARGER)
    every = {unit: round(power, _ROUND) for unit, power in found.items()}
    above = [_raised(unit, power) for unit, power in every.items() if power > 0.0]
    below = [_raised(unit, -power) for unit, power in every.items() if power < 0.0]
    return "/".join(["*".join(above) or "1", *below])


def powers(unit: str) -> dict[str, float]:
    """Exponents of "N*m/s^2"."""
    found, sign = dict[str, float](), 1.0
    for mark, name, power in re.findall(r"([*/]?)([A-Za-z]+)\^?([0-9.]*)", unit.replace(" ", "*")):
        sign = -1.0 if mark == "/" else 1.0
        found[name] = found.get(name, 0.0) + sign * float(power or 1.0)
    return found


def _power_of(own: str, unit: str, equation: str) -> float:
    """How a quantity grows with a unit; an angle within a sine is a number."""
    if unit == "rad" and own == "rad" and re.search(r"\b(sin|cos)\b", equation):
        return 0.0
    return powers(own).get(unit, 0.0)


def _raised(unit: str, power: float) -> str:
    return unit if power == 1.0 else f"{unit}^{power:.3g}"
