"""Command lines: numbers, options, places, windows of logs."""

from tests.bad_input.fits import true_values
from tests.bad_input.robot_files import writes
from tests.bad_input.row import Outcome, Row, row

SIMULATE = "simulate two-link --duration 2 --rate 100 --out s.csv"
FIT = "fit two-link a.csv --out f.json"


def option(
    theme: str, base: str, name: str, *values: str, outcome: Outcome = "refused"
) -> list[Row]:
    """A row for every value of an option; the line names the option, or its quantity."""
    quantity = name.strip("-").replace("-", "_")
    word = f"{name}|{quantity}|decimation" if name == "--decimate" else f"{name}|{quantity}"
    return [
        row(f"{theme}: {name} {value[:20]!r}", outcome, (*base.split(), name, value), word)
       
        if not value.startswith("-")
        else row(
            f"{theme}: {name}={value}", outcome, (*base.split(), f"{name}={value}"), word)
        for value in values
    ]  # fmt: skip


NUMBERS = [
    *option("number", SIMULATE, "--duration", "0", "-1", "nan", "inf", "1e9", "ten", "", "2,5"),
    *option("number", SIMULATE, "--rate", "0", "-100", "nan", "inf", "1e12"),
    *option("number", SIMULATE, "--seed", "-1", "1.5", "one", "nan"),
    *option("number", SIMULATE, "--parameter-seed", "-1", "x"),
    *option("number", SIMULATE, "--noise", "-0.1", "nan", "inf"),
    *option("number", SIMULATE, "--process-noise", "-1", "nan", "inf"),
    *option("number", SIMULATE, "--encoder-counts", "-5", "nan", "1.5"),
    *option("number", FIT, "--cutoff", "-5", "nan", "inf", "100", "1e9", "abc"),
    *option("number", FIT, "--parallel-cutoff", "-5", "nan", "inf"),
    *option("number", FIT, "--decimate", "0", "-3", "1.5", "nan"),
    *option("number", FIT, "--low-speed", "-1", "nan", "inf", "1.5"),
    *option("number", FIT, "--payload-mass", "-2", "nan", "inf", "0"),
    *option("number", FIT, "--payload-link", "7"),
    row("number: --cutoff 1e-9", "refused", FIT + " --cutoff 1e-9", "filter|cutoff|samples|rows"),
    row("number: --parallel-cutoff 1e-6", "refused", FIT + " --parallel-cutoff 1e-6",
        "parallel|filter|samples|rows"),
    row("number: --decimate 1000000", "refused", FIT + " --decimate 1000000", "decimat|rows"),
    row("number: --rate 0.001", "refused", SIMULATE + " --rate 0.001", "duration", "0.001"),
    row("number: --seed of 40 digits", "ends", SIMULATE + f" --seed {'9' * 40}", "seed|samples"),
]  # fmt: skip

WORDS = [
    row("usage: command in capitals", "refused", "DERIVE wrist", "DERIVE"),
    row("usage: unknown format", "refused", "derive wrist --format pdf", "pdf", "latex"),
    row("usage: --json without a file", "refused", "derive wrist --json", "--json"),
    row("usage: unknown derivatives", "refused", FIT + " --derivatives speed", "speed", "log"),
    row("usage: unknown motion", "refused", SIMULATE + " --motion wild", "wild", "exciting"),
    row("usage: effects with a space", "ends", ("derive", "wrist", "--effects", "viscous, coulomb"),
        "effects|wrist"),
    row("usage: effects by semicolon", "refused", ("derive", "wrist", "--effects",
        "viscous;coulomb"),
        "--effects"),
    row("usage: an effect with shapes", "refused", "derive wrist --effects stribeck", "stribeck"),
    row("usage: no effects", "works", ("derive", "two-link", "--effects", ""), "base parameters"),
    row("usage: hidden unknown", "refused", SIMULATE + " --hide ghost", "ghost"),
    row("usage: hidden with unknown value", "refused", SIMULATE + " --hide spring@1:x=3", "x"),
    row("usage: hidden with nan", "refused", SIMULATE + " --hide spring@1:k=nan", "nan|k"),
    row("usage: hidden empty", "refused", (*SIMULATE.split(), "--hide", ""), "hidden|--hide"),
    row("usage: add an unknown effect", "refused", "add m.json ghost a.csv --out n.json", "ghost"),
    row("usage: add what is there", "refused", "add m.json viscous a.csv --out n.json", "viscous"),
    row("usage: add no column", "refused", "add m.json backlash a.csv --out n.json", "backlash"),
    row("usage: add without log", "refused", "add m.json offset --out n.json", "LOG"),
    row("usage: without an unknown", "refused", "diagnose m.json b.csv --without ghost", "ghost"),
    row("usage: without at no joint", "refused", "diagnose m.json b.csv --without spring@9", "9"),
    row("usage: effects of no robot", "refused", "effects --robot nowhere.toml", "nowhere.toml"),
    row("usage: paper unknown", "refused", "reproduce ghost-1999", "ghost-1999", "hanssen-2000"),
    row("usage: a dash of Word", "refused", ("derive", "wrist", "—json", "x.json"), "—json"),
    row("usage: argument of a million letters", "refused", ("derive", "x" * 100000), "long|name"),
    row("usage: NUL in a name", "refused", ("derive", "a\0b"), "derive|a"),
    row("usage: line ends in a name", "refused", ("derive", "a\nb"), "a b|a\\nb"),
    row("usage: no Unicode in a name", "refused", ("derive", "caf\udce9"), "caf"),
    row("usage: a glob that matched nothing", "refused", "fit two-link *.csv --out f.json",
        "*.csv"),
]  # fmt: skip

WINDOWS = [
    row("window: @:", "works", "compare m.json b.csv@:"),
    row("window: @", "refused", "compare m.json b.csv@", "b.csv@"),
    row("window: @900:901", "refused", "compare m.json b.csv@900:901", "no rows"),
    row("window: @nan:", "refused", "compare m.json b.csv@nan:", "nan"),
    row("window: @0:inf", "ends", "compare m.json b.csv@0:inf", "inf|error"),
    row("window: @5:2", "refused", "compare m.json b.csv@5:2", "5:2", "ends before it starts"),
    row("window: @-5:4", "works", "compare m.json b.csv@-5:4"),
    row("window: @1:2:3", "refused", "compare m.json b.csv@1:2:3", "@1:2:3", "@START:END"),
    row("window: two that share none", "works", "fit two-link a.csv@0:4 a.csv@4: --out f.json",
        check=true_values),
    row("window: the log by a link", "refused", "fit two-link a.csv l.csv --out f.json", "again",
        make=lambda w: w.path("l.csv").symlink_to(w.take("a.csv"))),
    row("window: the training log", "told", "compare m.json a.csv", "training only"),
]  # fmt: skip


# That no input is written over: tests/cli/test_places.py, of every command and option.
PLACES = [
    row("place: compare --picture is a log", "refused", "compare m.json b.csv --picture b.csv",
        "b.csv"),
    row("place: generate into the folder of the user's own Makefile", "refused",
        "generate two-link --out .", "Makefile", "--force",
        make=writes("Makefile", "all:\n\trm -rf build\n")),
    row("place: generate over its own folder", "works", "generate two-link --out c_code"),
    row("place: generate another robot over a folder", "ends", "generate wrist --out c_code",
        "wrist"),
    row("place: --json a folder", "refused", "derive two-link --json d", "d:", "folder|directory",
        make=lambda w: w.path("d").mkdir()),
    row("place: --json with a slash at its end", "ends", "derive two-link --json new/", "new"),
    row("place: an empty model", "refused", ("compare", "", "b.csv"), 'got ""'),
    row("place: --json empty", "refused", ("derive", "two-link", "--json", ""), "--json|name"),
    row("place: --json a name of 300 letters", "refused", f"derive two-link --json {'j' * 300}",
        "long"),
    row("place: --json in folders that are not there yet", "works",
        "derive two-link --json new/er/d.json"),
    row("place: --json with spaces and umlauts", "works",
        ("derive", "two-link", "--json", "über alles (1).json")),
    row("place: --out without a suffix", "ends", "fit two-link a.csv --out model", "model"),
    row("place: simulate to Excel", "refused", "simulate two-link --duration 2 --out s.xlsx",
        ".csv"),
    row("place: simulate to a folder", "refused", "simulate two-link --duration 2 --out d.csv",
        "d.csv", make=lambda w: w.path("d.csv").mkdir()),
    row("place: a refused command leaves the old file", "refused",
        "fit two-link no.csv --out old.json", "no.csv", make=writes("old.json", "{}")),
]  # fmt: skip

ROWS = [*NUMBERS, *WORDS, *WINDOWS, *PLACES]
