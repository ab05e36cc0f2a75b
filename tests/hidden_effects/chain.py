"""The chain that is tested, from the files of a case to a diagnosis: here alone it is imported."""

import os
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from modeler import api
from modeler.effects.catalogue import effect_named
from modeler.effects.effect import Effect


def diagnosed(folder: Path, withheld: Sequence[str] = ()) -> dict[str, Any]:
    """What `modeler diagnose --json` says of a case, and how long it took ("seconds").

    The model is fitted to the training log; it is asked about that log or, if there is one, the
    log with a load. Errors come from the held-out log of the same arm. The truth is not read.

    Args:
        folder: of the case.
        withheld: effects that may not be named, nor those that are the same column.
    """
    same = [other for name in withheld for other in _effect(name).same_as]
    with _own_cache():
        derivation = api.derive(api.load(folder / "robot.toml"))
        emitted = api.generate(derivation)
        compiled = api.compile_model(emitted)
        observation = api.observe(compiled, [folder / "train.parquet"])
        model = api.fit(derivation, emitted, observation)
        asked = [folder / "train.parquet", folder / "holdout.parquet"]
        if (folder / "loaded.parquet").exists():
            asked = [folder / "loaded.parquet", folder / "loaded_holdout.parquet"]
        start = time.perf_counter()
        found = api.diagnose(model, asked[:1], asked[1:], without=[*withheld, *same])
    return found.to_json() | {"seconds": time.perf_counter() - start}


def _effect(name: str) -> Effect:
    effect = effect_named(name)
    assert effect is not None, name
    return effect


@contextmanager
def _own_cache() -> Iterator[None]:
    """Compiled arms go to a folder that goes away: nobody needs a random arm again."""
    before = os.environ.get("MODELER_CACHE")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["MODELER_CACHE"] = folder
        try:
            yield
        finally:
            del os.environ["MODELER_CACHE"]
            if before is not None:
                os.environ["MODELER_CACHE"] = before
