"""The room of pages: what is vendored is what it says, and pages stay small."""

import hashlib

from tests.repository import ROOT

# plotly.js-basic-dist-min of the npm registry
VENDORED = {
    "plotly-basic.min.js": "99784e3abfb07b142a15e521a439e6d9addceadb3f79553fd24c72774f0649ba",
    "LICENSE": "8c45d9eaf50c2f72dd9c7ab9ef440788ba58a3538484b5c51c1f17d5128752e7",
}


def test_plotly_js_is_the_one_that_is_named() -> None:
    folder = ROOT / "templates" / "plotly"
    assert {path.name for path in folder.iterdir()} == VENDORED.keys()
    for name, checksum in VENDORED.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == checksum, name
    head = (folder / "plotly-basic.min.js").read_text(encoding="utf-8")[:200]
    assert "basic - minified) v4.1.1" in head and "MIT license" in head
