"""Bytes of attributes and texts of an XML file; what is refused."""

import xml.etree.ElementTree as Standard
from pathlib import Path

import numpy as np
import pytest

from modeler.core.errors import RobotError
from modeler.formats.xml_source import parse_xml, replace_spans
from tests.robot.public_robots import each_public_urdf
from tests.rotation import with_cases

ODD = (
    b'\xef\xbb\xbf<?xml version="1.0" encoding="utf-8"?>\r\n<!-- <mass value="1"/> -->\n'
    b'<robot xmlns:xacro="x"\n\t name = \'a"b\' >\r\n'
    b'<xacro:p v="&quot;1&gt;2&quot; >" w=""/> t <b>\n 3.5 </b><c><![CDATA[<mass/>]]></c>'
    b'<d><!-- c -->4</d><e  value="\xc3\xa9 1"></e >\n</robot >\n<!-- mass -->'
)


ROBOT_SPANS = {"xmlns:xacro": b"x", "name": b'a"b'}
P_SPANS = {"v": b"&quot;1&gt;2&quot; >", "w": b""}


def test_spans_are_those_of_the_bytes():
    root = parse_xml(ODD, "odd.urdf")
    elements = {}
    for one in root.iterate_elements():
        spans = {name: ODD[start:end] for name, (start, end) in one.spans.items()}
        text = one.text_span and ODD[slice(*one.text_span)]
        elements[one.tag] = (dict(one.attributes), spans, one.text, text, one.line)
    assert elements == {
        "robot": ({"xmlns:xacro": "x", "name": 'a"b'}, ROBOT_SPANS, "t", None, 3),
        "xacro:p": ({"v": '"1>2" >', "w": ""}, P_SPANS, "", None, 5),
        "b": ({}, {}, "3.5", b"3.5", 5),
        "c": ({}, {}, "<mass/>", None, 6),
        "d": ({}, {}, "4", None, 6),
        "e": ({"value": "é 1"}, {"value": b"\xc3\xa9 1"}, "", None, 6),
    }
    tags = {element.tag: element for element in root.iterate_elements()}
    assert ODD[slice(*tags["xacro:p"].opening)].endswith(b'w=""/>')
    assert tags["xacro:p"].closing == (tags["xacro:p"].opening[1],) * 2
    assert ODD[slice(*tags["e"].closing)] == b"</e >"


def test_only_what_is_changed_changes():
    root = parse_xml(ODD, "odd.urdf")
    tags = {element.tag: element for element in root.iterate_elements()}
    end = tags["b"].closing[0]
    text_span = tags["b"].text_span
    assert text_span is not None
    changes = {tags["e"].spans["value"]: "2", text_span: "7.25", (end, end): "<!-- new -->"}
    made = replace_spans(ODD, changes)
    expected = ODD.replace(b"\xc3\xa9 1", b"2").replace(b" 3.5 </b>", b" 7.25 <!-- new --></b>")
    assert made == expected
    assert replace_spans(ODD, {}) == ODD


@each_public_urdf()
def test_public_files_are_read_as_the_standard_library_reads_them(path: Path):
    """The same elements; and every value replaced by another is read back as that, nothing else."""
    data = path.read_bytes()
    ours = list(parse_xml(data, path.name).iterate_elements())
    theirs = list(Standard.fromstring(data).iter())
    assert len(ours) == len(theirs)
    for one, other in zip(ours, theirs, strict=True):
        if ":" not in one.tag:
            assert one.tag == other.tag
            assert one.attributes.items() >= {
                (key, value) for key, value in other.attrib.items() if not key.startswith("{")
            }
    rng = np.random.default_rng(len(data))
    spans = [(e, name) for e in ours for name in e.spans if not name.startswith("xmlns")]
    chosen = (
        [spans[i] for i in rng.choice(len(spans), min(40, len(spans)), replace=False)]
        if spans
        else []
    )
    made = replace_spans(data, {element.spans[name]: "0.125" for element, name in chosen})
    changed = {id(element): {} for element, _ in chosen}
    for element, name in chosen:
        changed[id(element)][name] = "0.125"
    for before, after in zip(ours, parse_xml(made, path.name).iterate_elements(), strict=True):
        assert after.attributes == {**before.attributes, **changed.get(id(before), {})}
        assert after.text == before.text


def test_what_ros_reads_is_read_with_its_lines_and_bytes():
    """`--` in comments, a declaration that is not first, encodings; every span still holds."""
    head = '<?xml version="1.0" encoding="%s"?>\n<!----- ARM -- left \xe9\n ---->\n'
    body = '<robot name="bras \xe9">\n<!--->--><a \xe9="1" v="2"/><![CDATA[<!-- -- ]]></robot>'
    for encoding in ("utf-8", "ISO-8859-1", "windows-1252", "latin1", "iso-8859-15"):
        for before in ("", "\n", " \r\n\n"):
            data = (before + head % encoding + body).encode(encoding)
            root = parse_xml(data, "arm.urdf")
            lines = before.count("\n")
            assert (root.attributes["name"], root.line) == ("bras \xe9", 4 + lines), encoding
            (a,) = root.children
            assert (a.line, a.attributes) == (5 + lines, {"\xe9": "1", "v": "2"})
            assert [data[slice(*a.spans[n])] for n in ("\xe9", "v")] == [b"1", b"2"]
            assert replace_spans(data, {a.spans["v"]: "7"}) == data.replace(b'v="2"', b'v="7"')
    comment = b"<!-- caf\xe9 --><a>\xc3\xa9</a>"  # a comment of another encoding than the rest
    assert parse_xml(comment, "arm.urdf").text == "\xe9"


@with_cases(
    "data, text",
    (b"  \n", "is empty"),
    ("<a/>".encode("utf-16"), "UTF-16"),
    (b'\n<?xml version="1.0" encoding="koi8-r"?><a/>', 'line 2: encoding="koi8-r"; save'),
    (b"<a>\n<!-- open", "line 2: .*unclosed token; <a> of line 1 is open"),
    (b"<a>\n<b c='\xff'/></a>", "line 2: byte 10 is not UTF-8"),
    (b"<a>\n<b>\n</a>", "line 3: .*mismatched tag; <b> of line 2 is open"),
    (b"<a b=1/>", "line 1: not well-formed XML, column 6: invalid token"),
    (b"<a/><b/>", "junk after document element"),
    (b"<!DOCTYPE a>\n<a/>", "line 1: <!DOCTYPE> and its entities are not read"),
    (b"<a>" * 300, "more than 200000 elements, or than 256 inside each other"),
)
def test_what_is_refused_is_told_in_one_line(data: bytes, text: str):
    with pytest.raises(RobotError, match=text) as error:
        parse_xml(data, "bad.urdf")
    assert str(error.value).startswith("bad.urdf: ")
    assert len(str(error.value).splitlines()) == 1
