"""The table type: what it prints, escapes, and gives to pandas."""

import importlib.util
import sys

import pytest

from modeler.core.errors import DataError
from modeler.core.table import MathCell, Table

TABLE = Table(
    "masses_of <two> links",
    (("name", ""), ("mass", "kg"), ("good", ""), ("is", "")),
    (
        ("a|b_1", 1.25, True, MathCell("M1 + M2", "M_{1} + M_{2}")),
        ("<b>", None, False, MathCell("M2", "M_{2}")),
        ("c", float("nan"), True, MathCell("x < y", "x < y")),
    ),
    "50 % & more",
)


def test_text() -> None:
    assert str(TABLE).splitlines() == [
        "masses_of <two> links",
        "name   mass [kg]  good  is",
        "a|b_1       1.25   yes  M1 + M2",
        "<b>            -    no  M2",
        "c              -   yes  x < y",
        "50 % & more",
    ]


def test_html_escapes_all_that_was_written() -> None:
    text = TABLE.to_html()
    assert "&lt;two&gt;" in text and "<td>&lt;b&gt;</td>" in text and "50 % &amp; more" in text
    assert "<td>$x &lt; y$</td>" in text and "<td>$M_{1} + M_{2}$</td>" in text


def test_markdown_and_latex() -> None:
    assert r"| a\|b_1 | 1.25 | yes | $M_{1} + M_{2}$ |" in TABLE.markdown()
    assert r"a\textbar{}b\_1 & 1.25 & yes & $M_{1} + M_{2}$ \\" in TABLE.latex()


def test_a_long_table_shows_its_ends() -> None:
    long = Table("long", (("n", ""),), tuple((n,) for n in range(1000)))
    text = long.to_html()
    assert text.count("<tr>") < 70 and "... 940 rows more ..." in text
    assert "<td>0</td>" in text and "<td>999</td>" in text and "<td>500</td>" not in text
    assert "500" in long.text().split()


def test_a_column_that_is_not_there() -> None:
    with pytest.raises(DataError, match="got weight; this table has name, mass, good, is"):
        TABLE.column("weight")


def test_a_frame_has_names_numbers_and_units() -> None:
    if importlib.util.find_spec("pandas") is None:
        pytest.skip("NOT CHECKED: pandas is not installed")
    frame = TABLE.to_frame()
    assert list(frame.columns) == ["name", "mass", "good", "is"]
    assert frame.attrs["units"]["mass"] == "kg" and frame["mass"].isna().sum() == 2
    assert frame["is"][0] == "M1 + M2" and frame["mass"].dtype.kind == "f"


def test_without_pandas_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(DataError, match=r'pip install "modeler-robotics\[notebook\]"'):
        TABLE.to_frame()
