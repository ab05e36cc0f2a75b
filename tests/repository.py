"""What belongs to the repository, as git sees it."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def kept_files() -> list[str]:
    """Paths of all files that are tracked or would be: not ignored, not deleted; sorted."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("NOT CHECKED: which files belong to the repository needs git and a clone")
    # In a container the clone may belong to another user, which git refuses unless configured.
    git = ["git", "-c", "safe.directory=*", "-C", str(ROOT)]
    command = [*git, "ls-files", "-z", "-co", "--exclude-standard"]
    names = subprocess.run(command, capture_output=True, text=True, check=True).stdout.split("\0")
    return sorted({name for name in names if name and (ROOT / name).is_file()})
