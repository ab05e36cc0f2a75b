"""One case: an arm with one or two hidden effects, or none, as files in a folder.

    robot.toml              table and admitted effects, without inertias
    train.parquet           20 s of moves, 20 s of a Fourier series
    holdout.parquet         15 s and 15 s, other motion
    loaded*.parquet         the same with the load, if a load is hidden: the two above lack it
    truth.json              what is hidden

The case of a seed is that seed's for its effects and its noise only: another noise, another arm.
Another kind of sensor is the same arm again.
"""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tests.hidden_effects import body_effects, drive_effects, friction_effects
from tests.hidden_effects.drives import equip, measured_noise
from tests.hidden_effects.effects import BASE, EFFECTS, LOADS, Hidden, Impossible, hide
from tests.hidden_effects.held_out_effects import HELD_OUT_EFFECTS
from tests.hidden_effects.motion import draw_bounds
from tests.hidden_effects.plant import Plant, Run
from tests.hidden_effects.robot_file import robot_text
from tests.hidden_effects.robots import draw_arm
from tests.hidden_effects.sensor_kinds import FINE, OF_LINKS, SENSORS, computed_torque
from tests.hidden_effects.sensors import log, write
from tests.hidden_effects.visibility import Trial, left_over, shown, visibility

KINDS_OF_EFFECTS = (friction_effects, body_effects, drive_effects)  # importing them fills EFFECTS
KNOWN = EFFECTS | HELD_OUT_EFFECTS

ATTEMPTS = 15
VISIBLE = 0.5  # of the medium noise: what is less to be seen is drawn again
HELD_OUT_VISIBLE = 1.0  # of a cause outside the catalogue
TRAIN, HOLDOUT = 20.0, 15.0  # s of moves, and as many of a Fourier series
LATER = 45.0  # s: the held-out log of what changes with time begins here
NONE = "none"


@dataclass(frozen=True)
class Case:
    """What is requested: no, one or two effects, noise, seed; kind of the arm, None: random.

    The sensor is a kind of `SENSORS`.

    A cause outside the catalogue is a case as any other, with a name of `HELD_OUT_EFFECTS`.

    Where the effects are withheld, the diagnosis may not name them: whatever it names is wrong.
    """

    effects: tuple[str, ...]
    noise: str
    seed: int
    kind: str | None = None
    withheld: bool = False
    sensor: str = FINE

    @property
    def folder(self) -> str:
        """Where its files are."""
        sensor = [] if self.sensor == FINE else [self.sensor]
        return "-".join(["+".join(self.effects or (NONE,)), self.noise, str(self.seed), *sensor])

    @property
    def name(self) -> str:
        """Of its result."""
        return self.folder + ("-withheld" if self.withheld else "")

    def stream(self, attempt: int, *more: int) -> np.random.Generator:
        """Random numbers of an attempt at this case."""
        text = "".join(self.effects or (NONE,)) + self.noise
        tag = sum((i + 1) * ord(letter) for i, letter in enumerate(text))
        return np.random.default_rng([self.seed, tag, attempt, *more])


def make_case(case: Case, folder: Path, visible: float | None = None) -> dict[str, Any]:
    """Write a case and give its truth; `truth.json` is written last.

    Args:
        case: what is requested.
        folder: made if need be.
        visible: least visibility of every effect; 0 takes the first draw, None what is
            usual of its kind.

    Raises:
        NoArm: none was found that can have these effects, visibly.
    """
    assert set(case.effects) <= KNOWN.keys(), case.effects
    if visible is None:
        visible = HELD_OUT_VISIBLE if set(case.effects) & HELD_OUT_EFFECTS.keys() else VISIBLE
    for attempt in range(ATTEMPTS):
        try:
            return _Attempt(case, attempt).write(folder, visible)
        except Impossible:
            continue
    raise NoArm(f"{case.name}: no arm in {ATTEMPTS} draws can have it, visibly")


class NoArm(RuntimeError):
    """No arm was found that can have these effects, visibly."""


class _Attempt:
    """One draw of a case; raises Impossible where it is none."""

    def __init__(self, case: Case, attempt: int):
        self.case, self.attempt = case, attempt
        self.rng = case.stream(attempt)
        self.plain, self.kind = draw_arm(self.rng, case.kind)
        n = self.plain.joints
        self.sensor = SENSORS[case.sensor]
        self.most = draw_bounds(self.rng, n)
        self.wanted = self.sensor.path(self.rng, TRAIN, self.most)
        self.wanted_later = self.sensor.path(self.rng, HOLDOUT, self.most)
        bounds = self.sensor.bounds(self.most)
        self.scales = equip(self.plain, bounds, self.wanted, case.noise, self.rng)
        self.admitted = {name: list(range(n)) for name in BASE}
        upright = abs(np.cos(self.plain.alpha[1])) < 1e-6 if n >= 3 else False
        if self.rng.uniform() < 0.4 and upright:  # the first two rotors are inertias of links
            self.admitted["rotor_inertia"] = list(range(2, n))
        self.loaded = self.plain.copy()
        self.hidden: dict[str, Hidden] = {}
        self._hide([name for name in case.effects if name not in LOADS])
        self.free = self.loaded.copy()
        self._hide([name for name in case.effects if name in LOADS])
        for name in set(case.effects) & set(BASE):
            self.admitted[name].remove(self._joint(name))
        self.temperature = self.rng.uniform(20, 24, n)
        self.seed = int(self.rng.integers(1 << 60))
        self.of_sensor = case.stream(attempt, 55)
        self.sensed = int(self.of_sensor.integers(n))  # joint of the sensor, if it is one joint's
        for arm in (self.loaded, self.free):
            self.sensor.equip(arm)

    def _hide(self, names: list[str]) -> None:
        for name in names:
            self.hidden[name] = hide(name, self.loaded, self.scales, self._own(name), KNOWN)

    def _joint(self, name: str) -> int:
        joint = self.hidden[name].joint
        assert joint is not None
        return joint

    def _own(self, name: str) -> np.random.Generator:
        return self.case.stream(self.attempt, 77 + self.case.effects.index(name))

    def write(self, folder: Path, visible: float) -> dict[str, Any]:
        """All files of the case."""
        train = ran_or_impossible(self.free, self.wanted, self.temperature, self.seed)
        thermal, drifts = "temperature_friction" in self.hidden, "drift" in self.hidden
        start = LATER if thermal or drifts else 0.0
        later = self.free.copy()
        later.contact_start = later.contact_end = -1
        later.clock = start if drifts else 0.0
        warm = train.temperature[-1] if thermal else self.temperature
        holdout = ran_or_impossible(later, self.wanted_later, warm, self.seed + 1)
        seen = [self._visibility(name, visible) for name in self.case.effects] if visible else []
        folder.mkdir(parents=True, exist_ok=True)
        if set(LOADS) & self.hidden.keys():
            self._write_loaded(folder, thermal)
        self._write_log(folder / "train.parquet", train, self.wanted, 0.0, thermal)
        self._write_log(folder / "holdout.parquet", holdout, self.wanted_later, start, thermal)
        text = robot_text(f"arm{self.case.seed}", self._known(), self.admitted)
        (folder / "robot.toml").write_text(text, encoding="utf-8")
        truth = self._truth(seen)
        (folder / "truth.json").write_text(json.dumps(truth, indent=1) + "\n", encoding="utf-8")
        return truth

    def _write_loaded(self, folder: Path, thermal: bool) -> None:
        paths = [self.sensor.path(self.rng, seconds, self.most) for seconds in (TRAIN, HOLDOUT)]
        runs = [
            ran_or_impossible(self.loaded, path, self.temperature, self.seed + 2 + k)
            for k, path in enumerate(paths)
        ]
        for name, run, path in zip(("loaded", "loaded_holdout"), runs, paths, strict=True):
            self._write_log(folder / f"{name}.parquet", run, path, 0.0, thermal, self.loaded)

    def _write_log(self, place, run, wanted, start, thermal, plant=None):
        noise = measured_noise(self.scales, self.case.noise)
        delay = sum(hidden.delay for hidden in self.hidden.values())
        columns = log(run, wanted, noise, self.rng, delay=delay, start=start, thermal=thermal)
        if self.sensor.computed:
            torque = computed_torque(plant or self.free, run.link)
            columns |= {f"tau{j + 1}": values for j, values in enumerate(torque.T)}
        write(self.sensor.logged(columns, self.sensed, self.of_sensor), place)

    def _known(self) -> Plant:
        """The arm as the robot file has it: with gravity as it was meant."""
        known = self.free.copy()
        if "base_tilt" in self.hidden:
            turned = np.array(self.hidden["base_tilt"].values["dg"])
            known.gravity = np.round(known.gravity - turned, 9) + 0.0
        return known

    def _visibility(self, name: str, least: float) -> float:
        """Of one effect, as if it were alone; others that are missing in the file stay away.

        A fine sensor must show at least so much of it; the value is that of the sensor.
        """
        alone = self.plain.copy()
        hidden = hide(name, alone, self.scales, self._own(name), KNOWN)
        admitted = dict(self.admitted)
        for other in set(BASE) & self.hidden.keys() - {name}:
            admitted[other] = sorted([*admitted[other], self._joint(other)])
        trial = Trial(self.wanted, self.temperature, self.seed + 9)
        left = left_over(alone, self.plain, name, admitted, hidden.delay, trial)
        seen = visibility(left, self.scales)
        if not seen >= least:
            raise Impossible
        if self.sensor.computed and name not in OF_LINKS:
            return 0.0
        if left is None or not self.sensor.blurs:
            return seen
        read = self.sensor.read(left.encoder, self.case.stream(self.attempt, 66))
        return shown(left, alone, read, self.case.noise, self.scales)

    def _truth(self, seen: list[float]) -> dict[str, Any]:
        hidden = []
        for name in self.case.effects:
            joint, values = self.hidden[name].joint, self.hidden[name].values
            named = None if joint is None else str(joint + 1)
            hidden.append({"effect": name, "joint": named, "values": values})
        names = ("viscous", "coulomb", "offset", "rotor_inertia", "gravity")
        return {
            "hidden": hidden,
            "visible": seen,
            "noise": self.case.noise,
            "sensor": {"kind": self.case.sensor}
            | ({"joint": str(self.sensed + 1)} if self.sensor.of_joint else {}),
            "seed": self.case.seed,
            "robot": self.kind,
            "attempt": self.attempt,
            "plant": {name: getattr(self.free, name).tolist() for name in names}
            | {"torque_rms": self.scales.motors.tolist()},
        }


def ran_or_impossible(plant: Plant, wanted: np.ndarray, temperature: np.ndarray, seed: int) -> Run:
    """A run that no arm flees from."""
    run = plant.run(wanted, temperature, seed)
    if run is None:
        raise Impossible
    return run
