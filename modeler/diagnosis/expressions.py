"""Small expressions that `[own_effects]` can hold: factors, products of them, sums of products."""

import itertools
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from modeler.core.brief import Brief
from modeler.core.toml_cells import Place
from modeler.diagnosis.candidates import Candidate, JointScale
from modeler.effects import VARIABLES, read_definition

Unit = Mapping[str, float]
"""Exponents by unit: {"rad": 1, "s": -1}."""

_SPEEDS = {"v", "a"}
_SYMBOL = re.compile(r"[A-Za-z_]\w*|[0-9.]+")
_SHAPE = re.compile(r"\{(\w+)\}")
_MOST_SHAPES = 6
_MOST = 100  # combinations of first values that a definition may have


@dataclass(frozen=True)
class Factor(Brief):
    """A part of a product.

    Attributes:
        text: its equation, shapes in braces: `exp(-abs(v)/{vs})`.
        unit: of its value.
        words: plain language.
        grid: values of its shapes that are tried first, SI.
        lag: what a first-order lag makes z of, in `text`; empty without.
        wave: True if it stands for a wave of any phase: its sine and its cosine, two columns.
    """

    text: str
    unit: Unit
    words: str
    grid: Mapping[str, Sequence[float]] = field(default_factory=dict)
    lag: str = ""
    wave: bool = False

    def over_grid(self) -> Iterator[dict[str, float]]:
        """All combinations of the first values of its shapes."""
        for values in itertools.product(*self.grid.values()):
            yield dict(zip(self.grid, values, strict=True))

    def within(self, shape: str, value: float) -> float:
        """A value no further beyond the first ones than a step, or than twice and half of them."""
        first = self.grid[shape]
        if self.wave:
            return value
        low, high = min(first), max(first)
        wide = (0.5 * low, 2.0 * high) if low > 0.0 else (low, high)
        return min(max(value, wide[0]), wide[1])

    @property
    def remembers(self) -> bool:
        """True if it has the inner state z: an effect has one."""
        return bool(re.search(r"\bz\b", self.text))


@dataclass(frozen=True)
class Part(Brief):
    """A factor with values of its shapes."""

    factor: Factor
    shapes: Mapping[str, float] = field(default_factory=dict)

    @property
    def key(self) -> tuple[object, ...]:
        """What tells it from others."""
        return self.factor.text, self.factor.lag, *self.shapes.items()


Term = tuple[Part, ...]
"""A product: one column, or two with a wave."""


@dataclass(frozen=True)
class Formula(Brief):
    """A sum of terms, each with its own parameter, or two for a wave.

    Attributes:
        terms: at most two.
        effort: unit of the torque of its joint.
    """

    terms: tuple[Term, ...]
    effort: Unit

    @cached_property
    def parts(self) -> list[tuple[Part, dict[str, str]]]:
        """Its parts, and the names of their shapes in it: of two vs the second is vs2."""
        found, taken = [], list[str]()
        for part in itertools.chain(*self.terms):
            names = {}
            for shape in part.shapes:
                taken.append(shape)
                count = taken.count(shape)
                names[shape] = shape if count == 1 else f"{shape}{count}"
            found.append((part, names))
        return found

    @cached_property
    def shapes(self) -> dict[str, float]:
        """Values by their names in it."""
        return {names[key]: value for part, names in self.parts
                for key, value in part.shapes.items()}  # fmt: skip

    @cached_property
    def columns(self) -> list[tuple[str, str]]:
        """Equation and unit of the parameter of each column."""
        found, every = [], iter(self.parts)
        for term in self.terms:
            own = [next(every) for _ in term]
            texts = [_SHAPE.sub(lambda m, names=names: names[m[1]], part.factor.text)
                     for part, names in own]  # fmt: skip
            unit = unit_text(self.effort, [part.factor.unit for part in term])
            wave = any(part.factor.wave for part in term)
            for function in ("sin", "cos") if wave else ("",):
                found.append(("*".join(t.replace("wave(", f"{function}(") for t in texts), unit))
        return found

    @property
    def text(self) -> str:
        """Its columns."""
        lags = (part.factor.lag for part, _ in self.parts if part.factor.lag)
        return " + ".join([*(text for text, _ in self.columns), *lags])

    @property
    def symbols(self) -> int:
        """Names and numbers in it, of what z stands for too, and free numbers: what has a price."""
        told = [text for text, _ in self.columns]
        for part, _ in self.parts:
            told += [part.factor.lag, *part.shapes] if part.factor.remembers else []
        free = len(self.columns) + len(self.shapes)
        return free + sum(len(_SYMBOL.findall(text)) for text in told)

    @property
    def title(self) -> str:
        """In plain words."""
        return " and ".join(" times ".join(p.factor.words for p in term) for term in self.terms)

    @property
    def possible(self) -> bool:
        """True if a definition can hold it: one inner state, few shapes."""
        few = len(self.shapes) <= _MOST_SHAPES
        return few and sum(part.factor.remembers for part, _ in self.parts) < 2

    def with_shapes(self, shapes: Mapping[str, float]) -> "Formula":
        """The same at other values of its shapes, by their names in it."""
        every = iter(self.parts)
        terms = tuple(
            tuple(replace(part, shapes={k: part.factor.within(k, shapes[names[k]])
                                        for k in part.shapes})
                  for part, names in (next(every) for _ in term))
            for term in self.terms
        )  # fmt: skip
        return Formula(terms, self.effort)

    def definition(self, prefixes: Sequence[str]) -> dict[str, object]:
        """Its table of `[own_effects]`; the shapes found stand between their neighbours."""
        columns = dict(zip(prefixes, self.columns, strict=False))
        units = {prefix: unit for prefix, (_, unit) in columns.items()}
        table: dict[str, object] = {"columns": {p: text for p, (text, _) in columns.items()}}
        if self.shapes:
            few = 3 ** len(self.shapes) <= _MOST
            table["shapes"] = {
                names[key]: _beside(part.shapes[key], _step(part, key), few)
                for part, names in self.parts for key in part.shapes
            }  # fmt: skip
        lags = [part.factor.lag for part, _ in self.parts if part.factor.lag]
        table |= {"lag": lags[0]} if lags else {}
        one = set(units.values())
        table["unit"] = one.pop() if len(one) == 1 else units
        return table

    def candidate(self, names: Sequence[str], j: int) -> Candidate:
        """It as an effect of joint j of those with the names; its id is its equation."""
        table = self.definition([f"X{letter}" for letter in "abcd"])
        # whether it is finite everywhere is asked of those that are offered: it takes long
        effect = read_definition(self.text, Place("discover", value=table), {}, False, names)
        return Candidate(effect, effect.forms[0], names[j], j, dict(self.shapes))


def _step(part: Part, key: str) -> float:
    """Of a place or an order, how far its neighbours are; 0 of what is positive: factors."""
    grid = part.factor.grid[key]
    if min(grid) > 0.0 and not part.factor.wave:
        return 0.0
    return float(min(b - a for a, b in itertools.pairwise(grid))) if len(grid) > 1 else 0.02


def _beside(value: float, step: float, both: bool) -> list[float]:
    """First values of a shape about the one that was found, six digits."""
    ends = (value - step, value + step) if step else (value / 1.5, value * 1.5)
    return [float(f"{x:.6g}") for x in (ends[0], value, ends[1])][: 3 if both else 2]


def unit_text(effort: Unit, units: Sequence[Unit]) -> str:
    """The unit of the parameter before a product: N*m*s/rad."""
    total = dict(effort)
    for unit in units:
        for name, power in unit.items():
            total[name] = total.get(name, 0.0) - power
    above = [_power(name, p) for name, p in total.items() if p > 1e-9]
    below = [_power(name, -p) for name, p in total.items() if p < -1e-9]
    return "/".join(["*".join(above) or "1", *below])


def _power(name: str, power: float) -> str:
    return name if abs(power - 1.0) < 1e-9 else f"{name}^{power:.3g}"


# The factors that a column of a joint may have.


def factors(
    scales: Sequence[JointScale], names: Sequence[str], j: int, effort: Unit, warm: bool,
    loops: bool,
) -> list[Factor]:  # fmt: skip
    """All factors for a joint, waves of orders that are not known yet left out.

    Args:
        scales: of all joints.
        names: of the joints.
        j: index of the joint.
        effort: unit of its torque.
        warm: True if its temperature is logged.
        loops: True of a robot with loops, where equations read speeds and accelerations only.
    """
    scale = scales[j]
    place: Unit = {"rad": 1.0} if scale.angular else {"m": 1.0}
    speed: Unit = {**place, "s": -1.0}
    one: Unit = {}
    fast = [scale.speed * x for x in (0.02, 0.05, 0.12, 0.3, 0.7)]
    dips = [scale.speed * x for x in (0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8)]
    taus = (0.05, 0.15, 0.4, 1.0, 3.0)
    found = [
        Factor("sign(v)", one, "the direction of motion"),
        Factor("v", speed, "the speed"),
        Factor("abs(v)", speed, "the size of the speed"),
        Factor("v*abs(v)", squared(speed), "the square of the speed, with its direction"),
        Factor("v**2", squared(speed), "the square of the speed"),
        Factor("a", {**place, "s": -2.0}, "the acceleration"),
        Factor("load", effort, "the load"),
        Factor("abs(load)", effort, "the size of the load"),
        Factor("static", effort, "the load of gravity"),
        Factor("abs(static)", effort, "the size of the load of gravity"),
        Factor("t", {"s": 1.0}, "the time"),
        Factor("exp(-t/{th})", one, "a decay in time", {"th": (10.0, 30.0, 100.0)}),
        Factor("exp(-(abs(v)/{vs})**{p})", one, "a fall with the speed",
               {"vs": fast, "p": (0.5, 1.0, 2.0)}),
        Factor("exp(-((abs(v) - {v0})/{w})**2)", one, "a dip at a speed",
               {"v0": dips, "w": [scale.speed * x for x in (0.05, 0.1, 0.2)]}),
        Factor("tanh(v/{vt})", one, "the direction of motion, turning with the speed",
               {"vt": fast}),
        Factor("1/(1 + abs(v)/{vr})", one, "a slow fall with the speed", {"vr": fast}),
        Factor("z", one, "the direction of motion, turning over a travel", {
            "d": [x * (1.0 if scale.angular else scale.range / 3.0)
                  for x in (0.001, 0.005, 0.02, 0.08, 0.3)]}),
        *_placed("q", scale, place, "the position"),
    ]  # fmt: skip
    for name in ("load", "static"):
        unit = {key: 0.5 * power for key, power in effort.items()}
        found.append(Factor(f"sqrt(abs({name}))", unit, "the root of the load"))
        unit = {key: 1.5 * power for key, power in effort.items()}
        found.append(Factor(f"abs({name})**1.5", unit, "the load to the power 1.5"))
    if warm:
        found.append(Factor("T", {"K": 1.0}, "the temperature"))
    if "since" in VARIABLES:
        found.append(Factor("exp(-since/{ts})", one, "a decay after each reversal", {"ts": taus}))
    lagged = {"v": speed, "abs(v)": speed, "v**2": squared(speed), "load": effort,
              "abs(load)": effort}  # fmt: skip
    if False:
        found += [Factor("z", unit, f"{x} that lags behind", {"tau": taus[1:]}, x)
                  for x, unit in lagged.items()]  # fmt: skip
    for k, name in enumerate(names):
        if k != j and not loops:
            other: Unit = {"rad": 1.0} if scales[k].angular else {"m": 1.0}
            rate: Unit = {**other, "s": -1.0}
            found += _placed(f"q{name}", scales[k], other, f"the position of joint {name}", name)
            found += [
                Factor(f"v{name}", rate, f"the speed of joint {name}"),
                Factor(f"abs(v{name})", rate, f"the size of the speed of joint {name}"),
                Factor(f"sign(v{name})", one, f"the direction of joint {name}"),
            ]
    return [f for f in found if not loops or _SPEEDS.issuperset(_names(f))]


def _names(factor: Factor) -> set[str]:
    """Variables that it reads."""
    return set(_SYMBOL.findall(_SHAPE.sub("", factor.text))) & VARIABLES.keys()


def squared(unit: Unit) -> Unit:
    """The square of a unit."""
    return {name: 2.0 * power for name, power in unit.items()}


def _placed(q: str, scale: JointScale, unit: Unit, words: str, tail: str = "") -> Iterator[Factor]:
    """Factors that read a position."""
    yield Factor(q, unit, words)
    yield Factor(f"{q}**2", squared(unit), f"the square of {words}")
    if scale.angular:
        yield Factor(f"sin({q})", {}, f"the sine of {words}")
        yield Factor(f"cos({q})", {}, f"the cosine of {words}")
    ends = [
        scale.middle + scale.range * x for x in (-0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4)
    ]
    widths = [scale.range * x for x in (0.06, 0.14, 0.3)]
    bump = f"exp(-(({q} - {{c}})/{{b}})**2)"
    yield Factor(bump, {}, f"a bump over {words}", {"c": ends, "b": widths})


def wave(q: str, order: float, scale: JointScale, words: str) -> Factor:
    """Waves over a position, of any phase; those of order 1 are once a turn."""
    if order == 1.0 and scale.angular:
        return Factor(f"wave({q})", {}, f"a wave over {words}", wave=True)
    step = 1.0 / scale.range
    return Factor(f"wave({{n}}*{q})", {}, f"waves over {words}",
                  {"n": (order, order + step)}, wave=True)  # fmt: skip
