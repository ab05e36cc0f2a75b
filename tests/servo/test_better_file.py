"""A file spoilt by 30 % and logs in, two commands, and MuJoCo follows them with the new file."""

import re
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.cli import main
from tests.rotation import ROTATING

from .arms import ARM7, followed, logged, mjcf, spoilt, urdf

pytest.importorskip(
    "mujoco", reason="NOT CHECKED: files in and out, for mujoco-core is not installed"
)


def written(folder: Path, seed: int):
    """A spoilt URDF and MJCF, logs of the true arm, and one to judge by."""
    wrong = spoilt(ARM7, seed)
    Path(folder, "arm.urdf").write_text(urdf("arm", wrong))
    Path(folder, "arm.xml").write_text(mjcf("arm", wrong))
    truth, believed, logs = mjcf("arm", ARM7), mjcf("arm", wrong), []
    for k, seconds in enumerate((14.0, 14.0, 6.0)):
        logs.append(logged(truth, believed, ARM7, seed + k, seconds))
        pq.write_table(pa.table(logs[-1]), folder / f"log{k}.parquet")
    return wrong, logs[-1]


def numbers_of(xml: str):
    """The text without its numbers and without the comment of the export."""
    bare = re.sub(r"<!-- modeler export.*?-->\n?", "", xml, flags=re.DOTALL)
    return re.sub(r"-?\d+(\.\d+)?(e-?\d+)?", "#", bare)


def rms(errors):
    return float(np.sqrt(np.mean(np.square(errors))))


@pytest.mark.parametrize(
    "seed",
    [pytest.param(seed, marks=ROTATING) for seed in (None, 1000, 2000)],
    ids=lambda seed: "fresh" if seed is None else str(seed),
)
def test_a_spoilt_file_comes_back_better(tmp_path, monkeypatch, capsys, seed):
    monkeypatch.chdir(tmp_path)
    seed = int(np.random.default_rng().integers(1 << 30)) if seed is None else seed
    wrong, judge = written(tmp_path, seed)
    logs = ["log0.parquet", "log1.parquet"]
    assert main(["fit", "arm.urdf", *logs, "--map", "auto", "--out", "arm.model.json"]) == 0
    out = capsys.readouterr()
    # MuJoCo's friction bends near rest: halves of the motion may differ by more than their noise.
    valid = re.search(
        r"\nValid for torque prediction(: | on similar motions only: )"
        r"cross-validated error at most ([\d.]+) % on every joint\.(.*)",
        out.out,
    )
    assert valid and float(valid[2]) < 0.5, (seed, out.out)
    assert valid[1] == ": " or "between samples of low" in valid[3], (seed, valid[3])
    assert "added to the joints: rotor_inertia, offset, of which the file says nothing" in out.err
    assert main("export arm.model.json --to mjcf --like arm.xml --out better.xml".split()) == 0
    better = Path("better.xml").read_text()
    assert numbers_of(better) == numbers_of(mjcf("arm", wrong))
    assert "<!-- a comment that stays -->" in better
    capsys.readouterr()
    before, after = (followed(xml, ARM7, judge) for xml in (mjcf("arm", wrong), better))
    floor = followed(mjcf("arm", ARM7), ARM7, judge)
    print(
        f"seed {seed}: {rms(before):.4f} rad before, {rms(after):.4f} after, of the true file "
        f"{rms(floor):.4f}; {rms(before) / rms(after):.0f} times closer"
    )
    assert rms(after) < rms(before) / 10.0, seed
    joints = np.sqrt(np.mean(before**2, axis=0) / np.mean(after**2, axis=0))
    assert joints.min() > 5.0, (seed, joints)
    assert main(["export", "arm.model.json", "--like", "arm.urdf", "--out", "better.urdf"]) == 0
    out = capsys.readouterr().out
    assert len(
        re.findall(
            r"URDF cannot hold rotor_inertia of joint \d \(Ia\d = 0\.\d+\), about "
            r"[\d.]+ % of the torque",
            out,
        )
    ) == len(ARM7)
    urdfs = Path("arm.urdf").read_text(), Path("better.urdf").read_text()
    assert numbers_of(urdfs[0]) == numbers_of(urdfs[1])
    assert urdfs[0] != urdfs[1]
