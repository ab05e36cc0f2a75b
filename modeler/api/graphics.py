"""The base regressor on a graphics processor."""

from modeler.compiled.gpu import GpuModel, load_gpu
from modeler.derivation import Derivation, generate


def on_gpu(derivation: Derivation) -> GpuModel:
    """The base regressor of a robot without loops on the graphics processor of this machine.

    It needs CuPy: `pip install '.[gpu]'`.

    Raises:
        BuildError: no CuPy, no graphics processor, or the compiler refused.
        EmitError: the robot has loops.
    """
    return load_gpu(generate(derivation, cuda=True))
