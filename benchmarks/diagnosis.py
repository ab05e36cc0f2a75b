"""How long a diagnosis takes, and one effect added and fitted: a 3R arm, 40 s at 1 kHz.

Run from the top of the checkout: `python -m benchmarks.diagnosis`. All from a warm process: the
second of two calls, so imports, the compiled models and the caches of the derivation are there.
`new C` is the same with an empty cache of compiled models. The parts of `add` are timed alone.
"""

import dataclasses
import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.compiled import CompiledModel
from modeler.diagnose import diagnose
from modeler.diagnose.analyse import analysed
from modeler.diagnose.search import judged_state
from modeler.diagnose.state import Data, state_of
from modeler.fit import IdentifiedModel, identify
from modeler.improve import Logs, add_effect
from modeler.observation import Log, read_log
from modeler.robot import robot_from_text
from modeler.simulate import SimulationSettings, simulate, write_log
from modeler.simulate.hidden import hidden_effects

ROBOT, EFFECT, JOINT = "demo-arm", "load_friction", "2"
DURATION = 40.0  # s


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    start = time.perf_counter()
    result = work()
    return time.perf_counter() - start, result
