"""One compiled model of a robot in each process, however many jobs need it."""

from modeler.compiled.model import CompiledModel, load
from modeler.core.contract import Emitted

_MODELS: dict[str, CompiledModel] = {}  # of this process, by signature


def compiled_once(emitted: Emitted) -> CompiledModel:
    """The compiled model of an emitted module; the same object every time.

    Raises:
        BuildError: see `load`.
    """
    signature = emitted.spec.signature()
    if signature not in _MODELS:
        _MODELS[signature] = load(emitted.spec, emitted.code, emitted.log)
    return _MODELS[signature]
