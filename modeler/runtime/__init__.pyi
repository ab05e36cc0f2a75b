from .build import (
    build_portable_library as build_portable_library,
    find_cache_folder as find_cache_folder,
    find_toolchain as find_toolchain,
    map_parts as map_parts,
)
from .fused import (
    NonzeroPattern as NonzeroPattern,
    Triangles as Triangles,
    average_rows as average_rows,
    make_empty_triangles as make_empty_triangles,
    reduce_rows as reduce_rows,
)
from .gpu import GpuModel as GpuModel, load_gpu as load_gpu
from .model import (
    CompiledModel as CompiledModel,
    load_cached_model as load_cached_model,
    load_folder as load_folder,
    load_module as load_module,
)
