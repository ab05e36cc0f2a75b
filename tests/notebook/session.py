"""One session with the Python API, whose objects the tests look at."""

import collections.abc
from collections import deque
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

from modeler import api

HIDDEN = "load_friction@2"


MOTION = {"duration": 6.0, "rate": 250.0}
MADE: dict[str, Callable[["Session"], Any]] = {
    "robot": lambda s: api.load("demo-arm"),
    "derivation": lambda s: api.derive(s["robot"]),
    "relations": lambda s: s["derivation"].relations,
    "closed form": lambda s: s["derivation"].closed_form(),
    "emitted": lambda s: api.generate(s["derivation"]),
    "compiled": lambda s: api.compile_model(s["emitted"]),
    "runs": lambda s: [api.simulate(s["robot"], hide=[HIDDEN], **MOTION, seed=n) for n in (1, 2)],
    "logs": lambda s: list(api.read_logs(s["compiled"], s["runs"])),
    "simulated": lambda s: s["runs"][0],
    "log": lambda s: s["logs"][0],
    "observation": lambda s: api.observe(s["compiled"], s["logs"][:1]),
    "report": lambda s: s["observation"].report,
    "model": lambda s: api.fit(s["derivation"], s["emitted"], s["observation"]),
    "fit": lambda s: s["model"].fit,
    "better": lambda s: api.add_all(s["model"], s["logs"][:1], s["logs"][1:]),
    "addition": lambda s: s["better"].history[-1],
    "comparison": lambda s: api.compare(s["model"], s["logs"][1:]),
    "better comparison": lambda s: api.compare(s["better"], s["logs"][1:]),
    "diagnosis": lambda s: api.diagnose(s["model"], s["logs"][:1], s["logs"][1:]),
    "fleet": lambda s: api.fleet(s["robot"], {"one": {"1": s["runs"][0], "2": s["runs"][1]}}),
    "free run": lambda s: api.free_run(
        s["better"], [api.simulate(s["robot"], hide=[HIDDEN], duration=2.0, rate=250.0, seed=3)]
    ),
    "contest": lambda s: api.compare_models(
        {"first": s["model"], "better": s["better"]}, s["logs"][1:]
    ),
    "estimators": lambda s: api.compare_methods(
        s["compiled"], s["logs"][:1], s["logs"][1:], ["weighted", "ridge"]
    ),
    "modes": lambda s: api.home(api.load("five-bar")),
    "motion": lambda s: api.excite(api.load("two-link"), duration=4.0, harmonics=3, starts=1),
    "physical": lambda s: api.physical(api.load("wrist")),
    "exported": lambda s: api.export(s["better"], to="urdf"),
    "list of robots": lambda s: api.robots(),
    "list of effects": lambda s: api.effects(),
    "list of estimators": lambda s: api.estimators(),
}


class Session(collections.abc.Mapping[str, Any]):
    """Every kind of object that the API gives, by the name of what it is; made when requested."""

    def __init__(self) -> None:
        self._made: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._made:
            self._made[name] = MADE[name](self)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(MADE.keys() - {"runs", "logs"})

    def __len__(self) -> int:
        return len(MADE) - 2


@cache
def session() -> Session:
    """That of the process."""
    return Session()


def reached(things: Session) -> Iterator[tuple[str, Any]]:
    """All objects of our classes that attributes, entries and items lead to, with the way."""
    waiting = deque(things.items())
    seen: dict[int, Any] = {}
    while waiting:
        way, thing = waiting.popleft()
        if id(thing) in seen:
            continue
        seen[id(thing)] = thing  # kept, so that no other object gets its id
        if type(thing).__module__.startswith("modeler"):
            yield way, thing
            waiting += [(f"{way}.{k}", v) for k, v in getattr(thing, "__dict__", {}).items()]
        elif isinstance(thing, tuple | list):
            waiting += [(f"{way}[{i}]", v) for i, v in enumerate(thing[:30])]
        elif isinstance(thing, collections.abc.Mapping):
            waiting += [(f"{way}[{k!r}]", v) for k, v in list(thing.items())[:30]]
