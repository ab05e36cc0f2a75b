"""The table type: what it prints, escapes, and gives to pandas."""

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


def test_a_table_is_text_html_markdown_and_latex() -> None:
    assert str(TABLE).splitlines() == [
        "masses_of <two> links",
        "name   mass [kg]  good  is",
        "a|b_1       1.25   yes  M1 + M2",
        "<b>            -    no  M2",
        "c              -   yes  x < y",
        "50 % & more",
    ]
    for text in (
        "&lt;two&gt;",
        "<td>&lt;b&gt;</td>",
        "50 % &amp; more",
        "<td>$x &lt; y$</td>",
        "<td>$M_{1} + M_{2}$</td>",
    ):
        assert text in TABLE.to_html()
    assert r"| a\|b_1 | 1.25 | yes | $M_{1} + M_{2}$ |" in TABLE.to_markdown()
    assert r"a\textbar{}b\_1 & 1.25 & yes & $M_{1} + M_{2}$ \\" in TABLE.to_latex()


def test_a_long_table_shows_its_ends() -> None:
    long = Table("long", (("n", ""),), tuple((n,) for n in range(1000)))
    text = long.to_html()
    assert text.count("<tr>") < 70 and "... 940 rows more ..." in text
    assert "<td>0</td>" in text and "<td>999</td>" in text and "<td>500</td>" not in text
    assert "500" in long.to_text().split()


def test_a_frame_has_names_numbers_and_units() -> None:
    pytest.importorskip("pandas", reason="NOT CHECKED: pandas is not installed")
    frame = TABLE.to_frame()
    assert list(frame.columns) == ["name", "mass", "good", "is"]
    assert frame.attrs["units"]["mass"] == "kg" and frame["mass"].isna().sum() == 2
    assert frame["is"][0] == "M1 + M2" and frame["mass"].dtype.kind == "f"


def test_what_is_not_there_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(DataError, match="got weight; this table has name, mass, good, is"):
        TABLE.column("weight")
    with pytest.raises(DataError, match=r'pip install "modeler-robotics\[notebook\]"'):
        TABLE.to_frame()
