"""Command lines: numbers, options, places, windows of logs."""

from tests.bad_input.fits import true_values
from tests.bad_input.robot_files import writes
from tests.bad_input.row import Row, row

SIMULATE = "simulate two-link --duration 2 --rate 100 --out s.csv"
FIT = "fit two-link a.csv --out f.json"


def option(base: str, name: str, *values: str) -> list[Row]:
    """A row for every value of an option; the line names the option, or its quantity."""
    quantity = name.strip("-").replace("-", "_")
    word = f"{name}|{quantity}|decimation"
    return [
        row(f"number: {name}={value}", "refused", (*base.split(), f"{name}={value}"), word)
        for value in values
    ]


NUMBERS = [
    *option(SIMULATE, "--duration", "0", "nan", "1e9", "ten", ""),
    *option(SIMULATE, "--rate", "-100", "inf"),
    *option(SIMULATE, "--seed", "-1", "1.5"),
    *option(SIMULATE, "--parameter-seed", "-1"),
    *option(SIMULATE, "--noise", "-0.1", "nan"),
    *option(SIMULATE, "--process-noise", "-1", "inf"),
    *option(SIMULATE, "--encoder-counts", "-5", "nan"),
    *option(FIT, "--cutoff", "-5", "nan", "100", "1e-9", "abc"),
    *option(FIT, "--parallel-cutoff", "-5", "inf", "1e-6"),
    *option(FIT, "--decimate", "0", "1.5", "1000000"),
    *option(FIT, "--low-speed", "nan", "1.5"),
    *option(FIT, "--payload-mass", "-2"),
    row("number: --rate 0.001", "refused", SIMULATE + " --rate 0.001", "duration", "0.001"),
]

WORDS = [
    row("usage: --json without a file", "refused", "derive wrist --json", "--json"),
    row("usage: unknown derivatives", "refused", FIT + " --derivatives speed", "speed", "log"),
    row(
        "usage: effects by semicolon",
        "refused",
        ("derive", "wrist", "--effects", "viscous;coulomb"),
        "--effects",
    ),
    row("usage: an effect with shapes", "refused", "derive wrist --effects stribeck", "stribeck"),
    row("usage: add an unknown effect", "refused", "add m.json ghost a.csv --out n.json", "ghost"),
    row("usage: add without log", "refused", "add m.json offset --out n.json", "LOG"),
    row("usage: without an unknown", "refused", "diagnose m.json b.csv --without ghost", "ghost"),
    row("usage: without at no joint", "refused", "diagnose m.json b.csv --without spring@9", "9"),
    row("usage: paper unknown", "refused", "reproduce ghost-1999", "ghost-1999", "hanssen-2000"),
    row("usage: a dash of Word", "refused", ("derive", "wrist", "—json", "x.json"), "—json"),
    row("usage: no Unicode in a name", "refused", ("derive", "caf\udce9"), "caf"),
]

WINDOWS = [
    row("window: @:", "works", "compare m.json b.csv@:"),
    row("window: @", "refused", "compare m.json b.csv@", "b.csv@"),
    row("window: @nan:", "refused", "compare m.json b.csv@nan:", "nan"),
    row(
        "window: two that share none",
        "works",
        "fit two-link a.csv@0:4 a.csv@4: --out f.json",
        check=true_values,
    ),
    row(
        "window: the log by a link",
        "refused",
        "fit two-link a.csv l.csv --out f.json",
        "again",
        make=lambda w: w.path("l.csv").symlink_to(w.take("a.csv")),
    ),
]


# That no input is written over: tests/cli/test_places.py, of every command and option.
PLACES = [
    row("place: --json a folder", "refused", "derive two-link --json d", "d:", "folder|directory",
        make=lambda w: w.path("d").mkdir()),
    row("place: --json with a slash at its end", "ends", "derive two-link --json new/", "new"),
    row("place: --json a name of 300 letters", "refused", f"derive two-link --json {'j' * 300}",
        "long"),
    row("place: --json in folders that are not there yet", "works",
        "derive two-link --json new/er/d.json"),
    row("place: simulate to Excel", "refused", "simulate two-link --duration 2 --out s.xlsx",
        ".csv"),
    row("place: a refused command leaves the old file", "refused",
        "fit two-link no.csv --out old.json", "no.csv", make=writes("old.json", "{}")),
]  # fmt: skip

ROWS = [*NUMBERS, *WORDS, *WINDOWS, *PLACES]
