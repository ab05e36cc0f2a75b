"""One session with the Python API, whose objects the tests look at."""

import collections
from collections.abc import Iterator
from functools import cache
from typing import Any

from modeler.api import (
    auto,
    compare,
    compile_model,
    contest,
    derive,
    diagnose,
    effects,
    estimators,
    excite,
    export,
    fit,
    fleet,
    free_run,
    generate,
    home,
    load,
    observe,
    physical,
    read_logs,
    robots,
    side_by_side,
    simulate,
)

HIDDEN = "load_friction@2"


@cache
def session() -> dict[str, Any]:
    """Every kind of object that the API gives, by the name of what it is."""
    robot = load("demo-arm")
    derivation = derive(robot)
    emitted = generate(derivation)
    compiled = compile_model(emitted)
    runs = [simulate(robot, hide=[HIDDEN], duration=6.0, seed=seed) for seed in (1, 2)]
    train, other = ([log] for log in read_logs(compiled, runs))
    short = simulate(robot, hide=[HIDDEN], duration=2.0, rate=250.0, seed=3)
    observation = observe(compiled, train)
    model = fit(derivation, emitted, observation)
    better = auto(model, train, other)
    return {
        "robot": robot,
        "derivation": derivation,
        "relations": derivation.relations,
        "closed form": derivation.closed_form(),
        "emitted": emitted,
        "compiled": compiled,
        "simulated": runs[0],
        "log": train[0],
        "observation": observation,
        "report": observation.report,
        "model": model,
        "fit": model.fit,
        "better": better,
        "addition": better.history[-1],
        "comparison": compare(model, other),
        "better comparison": compare(better, other),
        "diagnosis": diagnose(model, train, other),
        "fleet": fleet(robot, {"one": {"1": runs[0], "2": runs[1]}}),
        "free run": free_run(better, [short]),
        "contest": contest({"first": model, "better": better}, other),
        "estimators": side_by_side(compiled, train, other, ["weighted", "ridge"]),
        "modes": home(load("five-bar")),
        "motion": excite(load("two-link"), duration=4.0, harmonics=3, starts=1),
        "physical": physical(load("wrist")),
        "exported": export(better, to="urdf"),
        "list of robots": robots(),
        "list of effects": effects(),
        "list of estimators": estimators(),
    }


def reached(things: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """All objects of our classes that attributes, entries and items lead to, with the way."""
    waiting = collections.deque(things.items())
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
