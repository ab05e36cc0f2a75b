"""Arms of 2 to 4 joints with such a law, or with none: robot file, logs, fitted model, truth.

    robot.toml              table and the effects of every arm
    train.parquet           20 s of moves, 20 s of a Fourier series
    holdout.parquet         15 s and 15 s, other motion
    model.json              fit of the robot file to the training log
    truth.json              the law

The arm of a law and a seed is the same with either encoder.
"""

import json
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import numpy as np

from tests.chain import chain_of
from tests.hidden_effects.case import ran_or_impossible
from tests.hidden_effects.drives import equip, measured_noise
from tests.hidden_effects.effects import BASE, Draw, Impossible
from tests.hidden_effects.held_out_effects import STEEPEST
from tests.hidden_effects.motion import draw_bounds, motion
from tests.hidden_effects.plant import TICK, rate
from tests.hidden_effects.robot_file import robot_text
from tests.hidden_effects.robots import draw_arm
from tests.hidden_effects.sensor_kinds import FINE, SENSORS
from tests.hidden_effects.sensors import log, write
from tests.unnamed_laws.laws import LAWS, Motion, TrueForm, neighbour_of

CLEAN = "clean"
"""In place of a law: the robot file lacks nothing."""

ENCODERS = {FINE: FINE, "4096": "coarse"}
"""Encoders -> kinds of sensors."""

NOISE = "med"  # 1 % of the torque
KINDS, SHARES = ("2R", "3R", "4R"), (0.25, 0.5, 0.25)
TRAIN, HOLDOUT = 20.0, 15.0  # s of moves, and as many of a Fourier series
LEAST, MOST = 0.08, 0.20  # rms of the law over that of the torque of its joint
TURNS = 0.005  # of the largest angle: a joint that comes back by so much has turned
ATTEMPTS = 20


@dataclass(frozen=True)
class Machine:
    """A machine, as files.

    Attributes:
        name: of law, seed and encoder.
        robot: text of the robot file.
        model: path of the fitted model.
        train, holdout: paths of the logs.
        truth: the law; None of a clean machine.
    """

    name: str
    robot: str
    model: Path
    train: tuple[Path, ...]
    holdout: tuple[Path, ...]
    truth: TrueForm | None

    @property
    def joint(self) -> str | None:
        """Name of the joint that has the law."""
        return None if self.truth is None else str(self.truth.joint + 1)


def machine(law: str, seed: int, encoder: str, folder: Path) -> Machine:
    """The machine of a law of `LAWS`, or `CLEAN`; made where `folder` does not have it yet."""
    name = f"{law}-{seed}-{encoder}"
    place = folder / name
    if not (place / "truth.json").exists():
        place.mkdir(parents=True, exist_ok=True)
        truth = _made(law, seed, encoder, place)
        text = json.dumps(None if truth is None else asdict(truth), indent=1)
        chain_of(place / "robot.toml").fit([place / "train.parquet"]).save(place / "model.json")
        (place / "truth.json").write_text(text + "\n", encoding="utf-8")
    truth = json.loads((place / "truth.json").read_text(encoding="utf-8"))
    return Machine(
        name=name,
        robot=(place / "robot.toml").read_text(encoding="utf-8"),
        model=place / "model.json",
        train=(place / "train.parquet",),
        holdout=(place / "holdout.parquet",),
        truth=None if truth is None else TrueForm(**truth),
    )


def _made(law: str, seed: int, encoder: str, place: Path) -> TrueForm | None:
    """Robot file and logs of the first draw that works."""
    tag = 0 if law == CLEAN else LAWS[law].number
    for attempt in range(ATTEMPTS):
        try:
            return _drawn(law, np.random.default_rng([seed, 34, tag, attempt]), encoder, place)
        except Impossible:
            continue
    raise RuntimeError(f"{law}, seed {seed}: no arm in {ATTEMPTS} draws can have it")


def _drawn(law: str, rng: np.random.Generator, encoder: str, place: Path) -> TrueForm | None:
    plant, _ = draw_arm(rng, str(rng.choice(KINDS, p=SHARES)))
    n, bounds = plant.joints, draw_bounds(rng, plant.joints)
    paths = {"train": motion(rng, TRAIN, bounds), "holdout": motion(rng, HOLDOUT, bounds)}
    scales = equip(plant, bounds, paths["train"], NOISE, rng)
    noises = rng.spawn(2)
    seed = int(rng.integers(1 << 60))
    truth = None if law == CLEAN else with_law(law, plant, scales, paths["train"], rng)
    SENSORS[ENCODERS[encoder]].equip(plant)
    for k, (name, path) in enumerate(paths.items()):
        run = ran_or_impossible(plant, path, np.full(n, 20.0), seed + k)
        columns = log(run, path, measured_noise(scales, NOISE), noises[k])
        write(columns, place / f"{name}.parquet")
    text = robot_text("arm", plant, {name: list(range(n)) for name in BASE})
    (place / "robot.toml").write_text(text, encoding="utf-8")
    return truth


def with_law(law, plant, scales, path, rng):
    """Change the plant: a law of a share of the torque of its joint along the path."""
    kind, draw = LAWS[law], Draw(plant, scales, rng)
    other = neighbour_of(draw) if kind.neighbour else draw.joint
    shapes = kind.draw(draw, other)
    if not kind.neighbour:
        other = draw.joint
    j, width = draw.joint, plant.coulomb_width
    plant.law_turns = TURNS * scales.bounds.angle
    form = TrueForm(law, j, other, 1.0, shapes, float(width[j]), float(plant.law_turns[j]))
    v, a = rate(path), rate(rate(path))
    load = plant.inverse_dynamics(path, v, a)[0]
    column = form.column(Motion(path, v, a, load, np.arange(len(path)) * TICK))
    size = draw.between(LEAST, MOST) * scales.motors[j] / np.sqrt((column**2).mean())
    if kind.dry:  # the integration has to follow the steeper change of sign
        steepest = STEEPEST * (scales.inertia[j] + plant.rotor_inertia[j])
        width[j] = max(width[j], (plant.coulomb[j] + size * np.abs(column).max()) / steepest)
    plant.law, plant.law_joint, plant.law_with, plant.law_size = kind.number, j, other, size
    plant.law_shape[: len(shapes)] = list(shapes.values())
    return replace(form, size=float(size), width=float(width[j]))
