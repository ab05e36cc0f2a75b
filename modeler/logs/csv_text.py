"""What a CSV file says before it is parsed: mistakes that the parser would name wrongly."""

import re
from pathlib import Path

from modeler.core.errors import DataError

_MARKS = {";": "semicolons", "\t": "tabs", "|": "bars"}
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d")
_LINE = 2**24  # bytes of the longest line that is looked at
_BOM = "\ufeff"


def check_csv(path: Path) -> None:
    """Refuse what is not comma-separated UTF-8 with decimal points and its header in row 1.

    Raises:
        DataError: the header is in another encoding, a comment, or separated by something else;
            or the first row has more entries than there are columns.
        OSError: the file cannot be read.
    """
    with path.open("rb") as file:
        lines = iter(lambda: file.readline(_LINE), b"")
        written = (line for line in lines if line.strip())  # the parser skips blank lines too
        header = _header(path, next(written, b""))
        if len(header) >= _LINE:
            raise DataError(
                f"{path}: the first line does not end within {_LINE >> 20} MiB; expected the names "
                "of the columns; write the file again"
            )
        # Text columns are left out, so what they hold need not be readable.
        first = next(written, b"").decode("utf-8", errors="replace")
    if header.lstrip().startswith("#"):
        raise DataError(
            f'{path}: starts with a comment, "{header[:40]}"; expected the names of the columns; '
            'delete the lines before them, and a "#" in front of them'
        )
    if header.count('"') % 2:
        raise DataError(
            f'{path}: the first line has a quote (") that is not closed; expected the names of the '
            "columns; close it, or delete it"
        )
    if "," not in header:
        for mark, name in _MARKS.items():
            if mark in header:
                raise DataError(_separated_by(path, mark, name, first))
    columns, entries = header.count(",") + 1, first.count(",") + 1
    if entries > columns and '"' not in header + first:
        raise DataError(
            f"{path}: row 1: got {entries} entries for {columns} columns; expected one each; "
            "write decimal points where numbers have decimal commas"
        )


def _separated_by(path: Path, mark: str, name: str, first: str) -> str:
    also = ""
    if any(_DECIMAL_COMMA.match(entry) for entry in first.split(mark)):
        also = ", and decimal points for the decimal commas"
    return (
        f"{path}: columns separated by {name}; expected columns separated by commas; write the "
        f"file again with commas{also}"
    )


def _header(path: Path, line: bytes) -> str:
    try:
        return line.decode("utf-8").removeprefix(_BOM).rstrip("\r\n")
    except UnicodeDecodeError as error:
        before = line[: error.start].decode("utf-8")[-40:]
        raise DataError(
            f'{path}: the header is not UTF-8: byte 0x{line[error.start]:02x} after "{before}"; '
            "save the file as UTF-8"
        ) from None
