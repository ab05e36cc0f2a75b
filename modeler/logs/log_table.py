"""A log as named columns of floats, under our names, or a DataError that says what is wrong."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs.arrays import LEAST_ROWS
from modeler.logs.columns import Column, ColumnRequest, Columns, NotNumericError
from modeler.logs.guess import guess_role
from modeler.logs.mapping import (
    LogMap,
    MappedColumn,
    Unit,
    find_unit,
    resolve_si_unit,
    suggest_name,
)
from modeler.logs.readers import read_columns
from modeler.logs.thresholds import THRESHOLDS

_TINY, _HUGE = 1e-100, 1e100  # in any unit; squares of what is beyond are no numbers any more
_SHOWN = 40  # names of columns that a message lists


def _list_motion_names(joints: Sequence[JointSpec]) -> set[str]:
    """Our names of what is measured of joints."""
    kinds = ("q", "qd", "qdd", "qc", "tau", "current")
    return {f"{kind}{joint.name}" for kind in kinds for joint in joints}


class LogTable:
    """The columns of one log by our names; numbers are converted when they are requested.

    Attributes:
        path: of the file.
        names: our names of mapped columns, and the file's of all others.
        whole: True if these are all rows of the file.
        before: rows of the file that stand before these.
        rated: True if time is counted from the rate, for lack of a column.
        rows: of every column.
        notes: what reading left out, one sentence each.
        reading_notes: how it was read, one sentence each: nothing to warn of.
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
        request = ColumnRequest(mapping.topic, any_topic, mapping.files)
        self.file_columns = part or read_columns(path, request)
        self.rows: int = self.file_columns.rows
        self._joints = joints
        self._columns: dict[str, Column] = dict(self.file_columns.columns)
        self._check()
        self._entries, self._guessed = mapping.expand_entries(joints), bool(mapping.guess_notes)
        if mapping.rate:
            self._entries.pop("time", None)
        self._taken: dict[str, str] = {}  # which an error of the next line reads
        self._taken = self._match_columns()
        timed = "time" in self._taken or "time" in self._columns
        timed = timed or any(guess_role(n) == "time" for n in self._columns)
        self._rate = mapping.rate or (None if timed else self.file_columns.rate)
        self._said = "" if mapping.rate else ", as the file says"
        self.rated = self._rate is not None
        used = set(self._taken.values())
        used |= {"time"} if self._rate else set()
        others = [name for name in self._columns if name not in used and name not in self._taken]
        self.names: tuple[str, ...] = (*self._taken, *(["time"] if self._rate else []), *others)
        self._units = {name: self._find_unit(name) for name in self.names}
        self.notes: tuple[str, ...] = (*self.file_columns.notes, *self._collect_notes())
        notes = (*self.file_columns.reading_notes, *mapping.guess_notes)
        self.reading_notes: tuple[str, ...] = (*notes, *self._describe_stated_units())

    def _check(self) -> None:
        names = [name for name, _ in self.file_columns.columns]
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

    def _match_columns(self) -> dict[str, str]:
        """Our name -> column of the file, of the entries whose column is there.

        Raises:
            DataError: none of the columns that a strict entry names is there.
        """
        matched = {}
        for our_name, entry in self._entries.items():
            there = next((name for name in entry.columns if name in self._columns), None)
            if there is not None:
                matched[our_name] = there
        for our_name, taken in matched.items():
            first = next(o for o, c in matched.items() if c == taken)
            if first != our_name and self._entries[our_name].has_same_scale(self._entries[first]):
                raise DataError(
                    f"{self.path}: column {taken} is taken as {first} and as {our_name}; "
                    "expected a "
                    "column for each; correct [log] or --map"
                )
        for our_name, entry in self._entries.items():
            if entry.strict and our_name not in matched:
                alike = [o for o, e in self._entries.items() if e.where == entry.where]
                if not any(other in matched for other in alike):
                    raise DataError(
                        f"{self.path}: {entry.where}: {self._describe_absent(our_name)}"
                    )
        return matched

    def _find_unit(self, our_name: str) -> Unit | None:
        """What a column is converted from; None if it is in SI units."""
        if our_name == "time" and self._rate:
            return None
        column, entry = self._taken.get(our_name, our_name), self._entries.get(our_name)
        stated = entry.unit if entry is not None and our_name in self._taken else None
        if stated is None and (text := self.file_columns.units.get(column)):
            stated = find_unit(text)
            entry = MappedColumn((), where=f"{self.path}: column {column}")
        where = entry.where if entry is not None else ""
        if stated is None:
            return None
        return resolve_si_unit(our_name, where or our_name, stated, self._joints)

    def _collect_notes(self) -> list[str]:
        """Entries of [log] that found nothing, units that nobody knows."""
        lines = []
        for our_name, entry in self._entries.items():
            if our_name not in self._taken and our_name not in self._columns and our_name != "time":
                lines.append(f"no column {entry.columns[0]} for {our_name}")
        units = self.file_columns.units.items()
        unknown = [n for n, t in units if n in self._columns and not find_unit(t)]
        if unknown:
            texts, listed = self.file_columns.units, unknown[: THRESHOLDS.max_listed_units]
            named = ", ".join(f'{name} "{texts[name]}"' for name in listed)
            lines.append(f"the file states units that are not understood, taken as SI: {named}")
        return lines

    def _describe_stated_units(self) -> list[str]:
        """Units of the file's own, a time without column."""
        stated = [
            f"{our_name} in {unit.text}"
            for our_name, unit in self._units.items()
            if unit is not None and not (our_name in self._taken and self._entries[our_name].unit)
        ]
        lines = [f"by the units that the file states: {', '.join(stated)}"] if stated else []
        if self._rate:
            beside = next((n for n in self._columns if n == "time" or guess_role(n) == "time"), "")
            why = f"column {beside} is not used" if beside else "no time column"
            lines.append(f"{why}: rows counted at {self._rate:g} Hz{self._said}")
        return lines

    def __contains__(self, name: str) -> bool:
        return name in self._units

    def find_file_column(self, name: str) -> str:
        """Returns the file's own name of a column of ours."""
        return self._taken.get(name, name)

    def format_name(self, name: str) -> str:
        """Returns a column as the user knows it.

        `t (time)`, or `time` if that is its name in the file.
        """
        column = self._taken.get(name, name)
        if column == name and name in self._entries and name not in self._columns:
            column = self._entries[name].columns[0]
        return name if column == name else f"{column} ({name})"

    def get_unit(self, name: str) -> str:
        """Returns what a column is known to be converted from; "" if nobody said."""
        unit = self._units[name]
        return "" if unit is None else unit.text

    def convert_to_unit(self, name: str, values: np.ndarray) -> np.ndarray:
        """Returns SI values of a column in the unit that it is known to be in."""
        unit = self._units[name]
        return values if unit is None else values / unit.factor - unit.zero

    def convert_to_logged(self, name: str, values: np.ndarray) -> np.ndarray:
        """Returns SI values as the file has them: with sign, scale, offset and unit."""
        entry, values = self._entries.get(name), self.convert_to_unit(name, values)
        if entry is None or name not in self._taken:
            return values
        return (values - entry.offset) / (entry.sign * entry.scale)

    def describe_source(self, name: str) -> str:
        """Returns the name of a column, ours first: `tau2`, or `tau2 from moment_b`."""
        column = self.find_file_column(name)
        return name if column == name else f"{name} from {column}"

    def is_numeric(self, name: str) -> bool:
        """Returns True if the column holds numbers (or nothing at all)."""
        if name == "time" and self._rate:
            return True
        return self._columns[self._taken.get(name, name)].is_numeric

    def read_numbers(self, name: str) -> np.ndarray:
        """Returns the column as floats in SI units, (rows,).

        Null, NaN and infinite entries are NaN.

        Raises:
            DataError: the column is missing or holds something else than numbers.
        """
        if name not in self:
            raise DataError(f"{self.path}: {self._describe_absent(name)}")
        if name == "time" and self._rate:
            return np.arange(self.before, self.before + self.rows) / self._rate
        column = self._columns[self._taken.get(name, name)]
        if column.is_time and name in _list_motion_names(self._joints):
            raise DataError(
                f"{self.path}: column {self.format_name(name)} holds dates or times of day; "
                "expected "
                f"numbers; say which column it is: --map {name}=COLUMN"
            )
        try:
            values = column.read_numbers()
        except NotNumericError as why:
            raise DataError(f"{self.path}: column {self.format_name(name)}{why}") from None
        values[~np.isfinite(values)] = np.nan
        return self._convert_values(name, values)

    def _convert_values(self, name: str, values: np.ndarray) -> np.ndarray:
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

    def read_measured(self, name: str) -> np.ndarray:
        """Returns a measured column in SI units.

        Specks are 0, values beyond all measure are refused.
        """
        values = self.read_numbers(name)
        values[np.abs(values) < _TINY] = 0.0
        if (beyond := np.abs(values) > _HUGE).any():
            row = int(np.argmax(beyond))
            raise DataError(
                f"{self.path}: column {self.format_name(name)}, row {self.before + row + 1}: got "
                f"{values[row]:.3g}; expected a measurement, below {_HUGE:g} in any unit; repair "
                "it, or leave the entry empty"
            )
        return values

    def _describe_absent(self, name: str) -> str:
        there = [column for column, _ in self.file_columns.columns]
        entry = self._entries.get(name)
        wanted = name if entry is None else entry.columns[-1]
        other = next((name for name, column in self._taken.items() if column == wanted), None)
        hint = f" (it is taken as {other})" if other else suggest_name(wanted, there)
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
