"""The one place that knows where the templates and the C runtime live."""

from pathlib import Path
from typing import Literal

_PACKAGE = Path(__file__).resolve().parents[1]


def resource_dir(kind: Literal["templates", "csrc"]) -> Path:
    """Folder of shipped data: inside the wheel (`_templates`), or at the top of a checkout."""
    for place in (_PACKAGE / f"_{kind}", _PACKAGE.parent / kind):
        if place.is_dir():
            return place
    raise FileNotFoundError(f"{kind}/ is neither inside the package ({_PACKAGE}) nor beside it")
