"""Files of numpy, .npz and .npy, as columns."""

from pathlib import Path

import numpy as np

from modeler.core.files import check_unpacked
from modeler.logs.arrays import columns_of, with_fields
from modeler.logs.columns import Columns, Wanted, reading


def read_numpy(path: Path, wanted: Wanted) -> Columns:
    """The columns of the arrays of an .npz file, or of the fields of an .npy file.

    Arrays of Python objects are refused: reading them would run what the file says.
    """
    with reading(path, "numpy file"), path.open("rb") as file:
        content = np.load(file, allow_pickle=False)
        if isinstance(content, np.ndarray):
            name = "" if content.dtype.names else path.stem
            arrays = with_fields(name, content)
        else:
            with content:
                check_unpacked(path, sum(member.file_size for member in content.zip.infolist()))
                arrays = [a for name in content.files for a in with_fields(name, content[name])]
    return columns_of(path, "numpy file", arrays, wanted)
