"""A log as named columns of floats, under our names, or a DataError that says what is wrong."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs.arrays import LEAST_ROWS
from modeler.logs.columns import Column, Columns, NotNumbers, Wanted
from modeler.logs.guess import role_of
from modeler.logs.mapping import LogMap, MappedColumn, Unit, find_unit, near, si_unit
from modeler.logs.readers import read_columns

_TINY, _HUGE = 1e-100, 1e100  # in any unit; squares of what is beyond are no numbers any more
_SHOWN = 40  # names of columns that a message lists
_FEW = 6


def _motion_of(joints: Sequence[JointSpec]) -> set[str]:
    """Our names of what is measured of joints."""
    return {f"{kind}{joint.name}" for kind in ("q", "qd", "qdd", "qc", "tau", "current")
            for joint in joints}  # fmt: skip


class LogTable:
    """The columns of one log by our names; numbers are converted when they are asked for.

    Attributes:
        path: of the file.
        names: our names of mapped columns, and the file's of all others.
        whole: True if these are all rows of the file.
        before: rows of the file that stand before these.
        rated: True if time is counted from the rate, for want of a column.
        rows: of every column.
        notes: what reading left out, one sentence each.
        told: how it was read, one sentence each: nothing to doubt.
    """

    def __init__(
        self,
        path: Path,
        mapping: LogMap | None = None,
        joints: Sequence[JointSpec] = (),
        any_topic: bool = False,
        part: Columns | None = None,
        before: int = 0,
        whole: bool = False,
    ) -> None:
        """Reads a file, or takes rows of it: a part, how many stand before it, if it is whole."""
        self.path = path
        mapping = mapping or LogMap()
        self.whole, self.before = whole or part is None, before
        self.found = part or read_columns(path, Wanted(mapping.topic, any_topic, mapping.files))
        self.rows: int = self.found.rows
        self._joints = joints
        self._columns: dict[str, Column] = dict(self.found.columns)
        self._check()
        self._entries, self._guessed = mapping.entries(joints), bool(mapping.told)
        if mapping.rate:
            self._entries.pop("time", None)
        self._taken: dict[str, str] = {}  # which an error of the next line reads
        self._taken = self._matched()
        timed = "time" in self._taken or "time" in self._columns
        timed = timed or any(role_of(n) == "time" for n in self._columns)
        self._rate = mapping.rate or (None if timed else self.found.rate)
        self._said = "" if mapping.rate else ", as the file says"
        self.rated = self._rate is not None
        used = set(self._taken.values())
        used |= {"time"} if self._rate else set()
        others = [name for name in self._columns if name not in used and name not in self._taken]
        self.names: tuple[str, ...] = (*self._taken, *(["time"] if self._rate else []), *others)
        self._units = {name: self._unit(name) for name in self.names}
        self.notes: tuple[str, ...] = (*self.found.notes, *self._notes())
        self.told: tuple[str, ...] = (*self.found.told, *mapping.told, *self._taken_as_stated())

    def _check(self) -> None:
        names = [name for name, _ in self.found.columns]
        if len(self._columns) < len(names):
            twice = sorted(name for name in self._columns if names.count(name) > 1)
            places = [f"{k}" for k, name in enumerate(names, start=1) if name == twice[0]]
            raise DataError(
                f"{self.path}: column {twice[0]} appears {len(places)} times (as columns "
                f"{', '.join(places)}); expected each name once; delete or rename the others"
            )
        if self.rows < LEAST_ROWS and self.whole:
            raise DataError(
                f"{self.path}: {self.rows} rows; expected at least {LEAST_ROWS}; record a "
                "longer motion"
            )

    def _matched(self) -> dict[str, str]:
        """Our name -> column of the file, of the entries whose column is there.

        Raises:
            DataError: none of the columns that a strict entry names is there.
        """
        found = {}
        for own, entry in self._entries.items():
            there = next((name for name in entry.columns if name in self._columns), None)
            if there is not None:
                found[own] = there
        for own, taken in found.items():
            first = next(o for o, c in found.items() if c == taken)
            if first != own and self._entries[own].like(self._entries[first]):
                raise DataError(
                    f"{self.path}: column {taken} is taken as {first} and as {own}; expected a "
                    "column for each; correct [log] or --map"
                )
        for own, entry in self._entries.items():
            if entry.strict and own not in found:
                alike = [o for o, e in self._entries.items() if e.where == entry.where]
                if not any(other in found for other in alike):
                    raise DataError(f"{self.path}: {entry.where}: {self._absent(own)}")
        return found

    def _unit(self, own: str) -> Unit | None:
        """What a column is converted from; None if it is in SI units."""
        if own == "time" and self._rate:
            return None
        column, entry = self._taken.get(own, own), self._entries.get(own)
        stated = entry.unit if entry is not None and own in self._taken else None
        if stated is None and (text := self.found.units.get(column)):
            stated = find_unit(text)
            entry = MappedColumn((), where=f"{self.path}: column {column}")
        where = entry.where if entry is not None else ""
        return None if stated is None else si_unit(own, where or own, stated, self._joints)

    def _notes(self) -> list[str]:
        """Entries of [log] that found nothing, units that nobody knows."""
        lines = []
        for own, entry in self._entries.items():
            if own not in self._taken and own not in self._columns and own != "time":
                lines.append(f"no column {entry.columns[0]} for {own}")
        unknown = [
            n for n, t in self.found.units.items() if n in self._columns and not find_unit(t)
        ]
        if unknown:
            named = ", ".join(f'{name} "{self.found.units[name]}"' for name in unknown[:_FEW])
            lines.append(f"the file states units that are not understood, taken as SI: {named}")
        return lines

    def _taken_as_stated(self) -> list[str]:
        """Units of the file's own, a time without column."""
        stated = [
            f"{own} in {unit.text}"
            for own, unit in self._units.items()
            if unit is not None and not (own in self._taken and self._entries[own].unit)
        ]
        lines = [f"by the units that the file states: {', '.join(stated)}"] if stated else []
        if self._rate:
            beside = next((n for n in self._columns if n == "time" or role_of(n) == "time"), "")
            why = f"column {beside} is not used" if beside else "no time column"
            lines.append(f"{why}: rows counted at {self._rate:g} Hz{self._said}")
        return lines

    def __contains__(self, name: str) -> bool:
        return name in self._units

    def column(self, name: str) -> str:
        """The file's own name of a column of ours."""
        return self._taken.get(name, name)

    def called(self, name: str) -> str:
        """A column as the user knows it: `t (time)`, or `time` if that is its name in the file."""
        column = self._taken.get(name, name)
        if column == name and name in self._entries and name not in self._columns:
            column = self._entries[name].columns[0]
        return name if column == name else f"{column} ({name})"

    def unit(self, name: str) -> str:
        """What a column is known to be converted from; "" if nobody said."""
        unit = self._units[name]
        return "" if unit is None else unit.text

    def in_unit(self, name: str, values: np.ndarray) -> np.ndarray:
        """SI values of a column in the unit that it is known to be in."""
        unit = self._units[name]
        return values if unit is None else values / unit.factor - unit.zero

    def as_logged(self, name: str, values: np.ndarray) -> np.ndarray:
        """The same as the file has it: with its sign, scale and offset too."""
        entry, values = self._entries.get(name), self.in_unit(name, values)
        if entry is None or name not in self._taken:
            return values
        return (values - entry.offset) / (entry.sign * entry.scale)

    def source(self, name: str) -> str:
        """The same, ours first: `tau2`, or `tau2 from moment_b`."""
        column = self.column(name)
        return name if column == name else f"{name} from {column}"

    def is_numeric(self, name: str) -> bool:
        """True if the column holds numbers (or nothing at all)."""
        if name == "time" and self._rate:
            return True
        return self._columns[self._taken.get(name, name)].numeric

    def numbers(self, name: str) -> np.ndarray:
        """The column as floats in SI units, (rows,); null, NaN and infinite entries are NaN.

        Raises:
            DataError: the column is missing or holds something else than numbers.
        """
        if name not in self:
            raise DataError(f"{self.path}: {self._absent(name)}")
        if name == "time" and self._rate:
            return np.arange(self.before, self.before + self.rows) / self._rate
        column = self._columns[self._taken.get(name, name)]
        if getattr(column, "is_time", False) and name in _motion_of(self._joints):
            raise DataError(
                f"{self.path}: column {self.called(name)} holds dates or times of day; expected "
                f"numbers; say which column it is: --map {name}=COLUMN"
            )
        try:
            values = column.numbers()
        except NotNumbers as why:
            raise DataError(f"{self.path}: column {self.called(name)}{why}") from None
        values[~np.isfinite(values)] = np.nan
        return self._converted(name, values)

    def _converted(self, name: str, values: np.ndarray) -> np.ndarray:
        entry, unit = self._entries.get(name), self._units[name]
        if entry is not None and name in self._taken:
            if entry.sign * entry.scale != 1.0:
                values *= entry.sign * entry.scale
            if entry.offset:
                values += entry.offset
        if unit is not None and unit.zero:
            values += unit.zero
        if unit is not None and unit.factor != 1.0:
            with np.errstate(over="ignore"):
                values *= unit.factor
        return values

    def measured(self, name: str) -> np.ndarray:
        """The same of something that was measured: specks are 0, what is beyond all measure NaN."""
        values = self.numbers(name)
        values[np.abs(values) < _TINY] = 0.0
        if (beyond := np.abs(values) > _HUGE).any():
            row = int(np.argmax(beyond))
            raise DataError(
                f"{self.path}: column {self.called(name)}, row {self.before + row + 1}: got "
                f"{values[row]:.3g}; expected a measurement, below {_HUGE:g} in any unit; repair "
                "it, or leave the entry empty"
            )
        return values

    def _absent(self, name: str) -> str:
        there = [column for column, _ in self.found.columns]
        entry = self._entries.get(name)
        wanted = name if entry is None else entry.columns[-1]
        other = next((own for own, column in self._taken.items() if column == wanted), None)
        hint = f" (it is taken as {other})" if other else near(wanted, there)
        head, colon, unit = wanted.rpartition(":")
        if colon and head in there:
            hint = f' (if column {head} is meant, "{unit}" is no unit that is known)'
        guess = "or let it be guessed, --map auto, "
        guess = "" if self._guessed else guess
        guess += "or of even rows their rate, --map rate=HZ, " * (name == "time")
        return (
            f"no column {name if wanted == name else f'{wanted} ({name})'}{hint}; the columns are "
            f"{', '.join(there[:_SHOWN])}; say which it is, --map {name}=COLUMN, "
            f"{guess}or add it"
        )
