from .build import (
    cache_folder as cache_folder,
    find_toolchain as find_toolchain,
    portable_library as portable_library,
)
from .fused import (
    NonzeroPattern as NonzeroPattern,
    Triangles as Triangles,
    no_rows as no_rows,
    of_rows as of_rows,
)
from .gpu import GpuModel as GpuModel, load_gpu as load_gpu
from .model import (
    CompiledModel as CompiledModel,
    compiled_once as compiled_once,
    load as load,
    load_folder as load_folder,
)
from .threads import mapped as mapped
