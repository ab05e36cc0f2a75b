"""Whether two checkouts give the same answers: what a change for speed must leave alone.

    python -m benchmarks.equal --json after.json
    python -m benchmarks.equal --json before.json --tree ../main
    python -m benchmarks.equal --compare before.json after.json

Answers are the JSON of `modeler derive` of every built-in robot, of `modeler reproduce` of every
paper, and of `modeler fit` and `diagnose` of measured logs, where there is a folder of them. Texts
must be the same; so must numbers to 1e-9 of themselves, or of the largest number in the list or
table that they stand in (differences of large numbers, zeros up to rounding).
"""

import argparse
import fnmatch
import json
import math
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from modeler.core.choices import list_builtin_robots, list_papers

TOLERANCE = 1e-9
ROUNDING = 1e-13
"""What is smaller than this stands for zero: residues of identities."""
MOST = 30
"""Differences that are reported about each answer."""
TIMED = ("seconds", "version", "created", "path", "model", "log", "logs", "file", "folder")
"""What runs of equal programs differ in."""

FITS = {
    "emps": ("emps", "emps/train"),
    "odrive": ("odrive", "odrive_cogging/slow2__nocomp_0"),
    "tx40": ("tx40", "tx40/log_joint"),
    "panda": ("panda", "panda/excitation@:11.55"),
    "dvrk-psm": ("dvrk-psm", "dvrk_psm/one"),
    "kinova_gen3": ("kinova_gen3", *(f"kinova_gen3/traj_{k}" for k in (1, 3, 5))),
    "ur10e": ("ur10e", "ur10e/ur-20_02_05-20sec_8harm", "ur10e/ur-20_02_12-50sec_12harm"),
    "pendulum": ("dfki_pendulum/robot_a.toml", "dfki_pendulum/a_061157"),
    "dvrk_mtm": ("dvrk_mtm/robot.toml", "dvrk_mtm/one"),
}
"""Robot and measured logs."""
METHODS = {
    "emps.didim": ("emps", "--method", "didim"),
    "emps.consistent": ("emps", "--method", "consistent"),
    "ur10e.robust": ("ur10e", "--method", "robust"),
    "ur10e.energy": ("ur10e", "--model", "energy"),
}
"""A fit of above with other options."""
DIAGNOSED = {"emps": "emps/pulses", "panda": "panda/excitation@11.55:"}
"""The log that a fit of above is held against when it is diagnosed."""
HIDDEN = {
    "a": ("demo-arm", 40, 711, "stribeck@1"),
    "b": ("demo-arm", 40, 712, "motor_ripple@2"),
    "c": ("demo-arm", 40, 713, "elasticity@2"),
    "d": ("ur10e", 40, 714, "stribeck@2"),
    "e": ("ur10e", 30, 715, "spring@3", "asymmetric_viscous@5"),
    "f": ("panda", 30, 716, "payload"),
    "g": ("puma560", 40, 717, "load_friction@2"),
    "h": ("demo-arm", 30, 718),
    "i": ("scara", 40, 719, "joint_ripple@1"),
    "j": ("ur10e", 40, 720, "time_delay"),
    "k": ("demo-arm", 30, 721, "external_force"),
    "l": ("demo-arm", 30, 722, "backlash@3"),
    "m": ("demo-arm", 40, 723, "encoder_offset@2"),
    "n": ("panda", 40, 724, "drive_gain@3"),
}
"""Robot, seconds and seed of two simulated logs, and what is hidden in them."""


def main() -> int:
    """Write answers, or compare two files of them; 1 if any differs or is none."""
    asked = _parser().parse_args()
    if asked.compare:
        before, after = (json.loads(Path(f).read_text(encoding="utf-8")) for f in asked.compare)
        return told(before, after)
    table = {}
    with tempfile.TemporaryDirectory() as scratch:
        for name, words in commands(Path(scratch), Path(asked.data).resolve()):
            if any(fnmatch.fnmatch(name, f"{pattern}*") for pattern in asked.only):
                table[name] = _answer(words, Path(asked.tree).resolve(), Path(scratch))
                print(name, "" if isinstance(table[name], dict) else table[name], flush=True)
    Path(asked.json).write_text(json.dumps(table, indent=1) + "\n", encoding="utf-8")
    return 0


def commands(scratch: Path, data: Path) -> Iterator[tuple[str, list[str]]]:
    """Names and the words of command lines."""
    for robot in list_builtin_robots():
        yield f"derive.{robot}", ["derive", robot]
    yield from simulated(scratch)
    for paper in list_papers():
        yield f"reproduce.{paper}", ["reproduce", paper]
    if not data.is_dir():
        return
    model = str(scratch / "model.json")
    fits = {name: _fitted(words, data) for name, words in FITS.items()}
    fits |= {name: [*fits[of], *words] for name, (of, *words) in METHODS.items()}
    for name, words in fits.items():
        yield f"fit.{name}", ["fit", *words, "--out", model]
        if name in FITS:
            held = ["--holdout", _log(DIAGNOSED[name], data)] if name in DIAGNOSED else []
            yield f"diagnose.{name}", ["diagnose", model, *words[1:], *held]


def simulated(scratch: Path) -> Iterator[tuple[str, list[str]]]:
    """What is hidden in simulated logs, diagnosed: all that `diagnose.hidden` begins."""
    logs, model = [str(scratch / f"{k}.parquet") for k in range(2)], str(scratch / "model.json")
    for name, (robot, seconds, seed, *effects) in HIDDEN.items():
        hide = [word for effect in effects for word in ("--hide", str(effect))]
        for k, log in enumerate(logs):
            words = ["--out", log, "--duration", str(seconds), "--seed", str(seed + k), *hide]
            yield f"diagnose.hidden.{name}.log{k}", ["simulate", str(robot), *words]
        yield f"diagnose.hidden.{name}.fit", ["fit", str(robot), logs[0], "--out", model]
        yield f"diagnose.hidden.{name}", ["diagnose", model, logs[0], "--holdout", logs[1]]


def _fitted(words: tuple[str, ...], data: Path) -> list[str]:
    robot = str(data / words[0]) if words[0].endswith(".toml") else words[0]
    return [robot, *(_log(log, data) for log in words[1:])]


def _log(log: str, data: Path) -> str:
    name, at, span = log.partition("@")
    return f"{data / name}.parquet{at}{span}"


def _answer(words: list[str], tree: Path, scratch: Path) -> Any:
    out = scratch / "answer.json"
    out.unlink(missing_ok=True)
    command = [sys.executable, "-m", "modeler", *words, "--json", str(out)]
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=False)
    if not out.exists():
        return f"no answer, status {done.returncode}: {done.stderr.strip()}"
    return json.loads(out.read_text(encoding="utf-8"))


def told(before: dict[str, Any], after: dict[str, Any]) -> int:
    """Prints how far answers are apart; 1 if any is too far."""
    failed = [name for name in before if not isinstance(after.get(name), dict)]
    for name in failed:
        print(f"{name:<40}{after.get(name, 'missing')}")
    for name in after:
        if name not in before or name in failed:
            continue
        names = sorted(differences(before[name], after[name]), key=lambda d: -d[0])
        most = names[0][0] if names else 0.0
        far = [difference for difference in names if difference[0] > TOLERANCE]
        print(f"{name:<40}{'DIFFERS' if far else 'equal'} {most:.1e}")
        for _, where, text in far[:MOST]:
            print(f"    {where}: {text}")
        failed += [name] if far else []
    print(f"{len(after)} answers, {len(failed)} that differ by more than {TOLERANCE:g}")
    return bool(failed)


def differences(
    a: Any, b: Any, where: str = "", scale: float = 0.0
) -> Iterator[tuple[float, str, str]]:
    """How far, where and what of each that is not the same."""
    if isinstance(a, dict) and isinstance(b, dict):
        scale = _largest([*a.values(), *b.values()])
        for key in [*a, *(key for key in b if key not in a)]:
            if key in a and key in b:
                if not key.startswith(TIMED):
                    yield from differences(a[key], b[key], f"{where}.{key}", scale)
            else:
                yield math.inf, f"{where}.{key}", f"only {'before' if key in a else 'after'}"
    elif isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        scale = max(_largest(a), _largest(b))
        for k, (x, y) in enumerate(zip(a, b, strict=True)):
            yield from differences(x, y, f"{where}[{k}]", scale)
    elif _number(a) and _number(b) and not math.isnan(a - b):
        if a != b and abs(a - b) > ROUNDING:
            yield abs(a - b) / max(abs(a), abs(b), scale), where, f"{a!r} / {b!r}"
    elif a != b:
        yield math.inf, where, f"{str(a)[:80]} / {str(b)[:80]}"


def _largest(values: list[Any]) -> float:
    return max((abs(x) for x in values if _number(x) and math.isfinite(x)), default=0.0)


def _number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _parser() -> argparse.ArgumentParser:
    lines = (__doc__ or "").strip().splitlines()
    parser = argparse.ArgumentParser(prog="python -m benchmarks.equal", description=lines[0])
    parser.add_argument("--json", metavar="FILE", default="answers.json", help="write answers")
    parser.add_argument("--tree", metavar="DIR", default=".", help="the checkout whose they are")
    parser.add_argument("--only", metavar="NAME", nargs="+", default=["*"], help="fit.ur10e, ...")
    parser.add_argument(
        "--data", metavar="DIR", default="../shared/data", help="folder of measured logs"
    )
    parser.add_argument(
        "--compare", metavar="FILE", nargs=2, help="two files of answers, before and after"
    )
    return parser


if __name__ == "__main__":
    sys.exit(main())
