"""Arguments that several commands share; nothing that takes long to load is imported here."""

from typing import Any

from modeler.cli import places
from modeler.cli.options import Argument, flag, repeated, value

ROBOT_FILE = "a robot file, URDF or MJCF, or the name of a built-in robot"
ROBOT_OR_MODEL = f"{ROBOT_FILE}, or a model file of `modeler fit`"
WINDOW = "FILE@START:END takes the rows between these seconds"
LOGS = f"Parquet, CSV, MAT, HDF5 or MCAP logs, ROS bags; {WINDOW}"
_EFFECTS = 'effects instead of those of the file, for all joints: "viscous,coulomb"'
PARALLEL = "the one low-pass of torques and all columns"
REQUIRED: dict[str, Any] = {"required": True}

ROBOT = value("robot", "ROBOT", places.RobotFile, ROBOT_FILE)
CHANGED = value("--effects", "LIST", places.Word, f'{_EFFECTS}; "" for none')
MODEL = value("model", "MODEL", places.ModelFile, "a model file of `modeler fit`")
MAP = repeated(
    "--map", "NAME=COLUMN[:UNIT]", places.MapWord,
    "which column of the logs is ours, as 'q<j>=position_{j}:deg', or FILE.toml with such lines; "
    "auto: what `modeler log` suggests for all else; over [log] of the robot file; kept in the "
    "model",
)  # fmt: skip
DASK = value(
    "--dask", "ADDRESS", places.Word,
    "a Dask scheduler whose workers read the logs, as tcp://host:8786; local: a cluster of this "
    "machine's processors",
)  # fmt: skip
_SHARED = "with the effects that `modeler effects --export` wrote there"
EFFECTS_FROM = value("--effects-from", "FOLDER", places.Input, _SHARED)
FORCE = flag(
    "--force", "write also over files of DIR that no earlier run wrote, or that were edited since"
)
_PICTURES = "folder for every picture as PNG, SVG and CSV; or a file for all as plain data"
_OPEN = flag("--open", "show the page in the browser; without --report one in a temporary folder")
DRAWN = "draw it: .png, .svg or .pdf"


def logs(text: str, nargs: str = "+") -> Argument:
    """Declares the logs that are read, at least one by default."""
    return value("logs", "LOG", places.LogFile, text, nargs=nargs)


def page(kind: type[places.Output] = places.Output) -> tuple[Argument, Argument]:
    """Declares `--report` and `--open`."""
    text = "write one self-contained page"
    return value("--report", "PAGE.html", kind, text), _OPEN


def pictures(kind: type[places.Pictures] = places.Pictures) -> Argument:
    """Declares `--picture`."""
    return value("--picture", "DIR|FILE.json", kind, _PICTURES)
