"""CUDA of the base regressor: its arithmetic on the CPU, real compilers where there are some."""

import ctypes
import shutil
import subprocess
import sys
from functools import cache
from importlib import util
from pathlib import Path

import numpy as np
import pytest

from modeler.api import derive, load, load_on_gpu
from modeler.codegen.emit import emit
from modeler.core.errors import BuildError, EmitError, ManifestError, ShapeError
from modeler.core.manifest import EmittedModule
from modeler.runtime.gpu import GpuModel, load_gpu
from tests.codegen.fitted_library import robot_module
from tests.compiled.cupy_on_cpu import cupy
from tests.modules import compiler, loaded, module, states
from tests.rotation import rotating


@cache
def emitted(name: str) -> EmittedModule:
    made = robot_module(name)
    return emit(made.model, made.base, cuda=True)


@pytest.fixture(scope="module")
def gpu(tmp_path_factory):
    """The kernels of a robot, on the CPU."""
    compiler("g++")
    table = {}

    def model(name: str) -> GpuModel:
        if name not in table:
            with pytest.MonkeyPatch.context() as patch:
                patch.setitem(sys.modules, "cupy", cupy(tmp_path_factory.mktemp("gpu")))
                table[name] = load_gpu(emitted(name))
        return table[name]

    return model


def grams(phi: np.ndarray, tau: np.ndarray, model: GpuModel) -> list[np.ndarray]:
    """By numpy, from the regressor of the scalar C."""
    values = []
    for joint, columns in enumerate(model.columns):
        rows = np.column_stack([phi[:, joint, list(columns)], tau[:, joint]])
        values.append(rows.T @ rows)
    return values


@pytest.mark.parametrize("samples", [1, 200])
@pytest.mark.parametrize("name", ["wrist", *rotating("puma560", "slow-arm")])
def test_kernels_compute_what_the_scalar_c_computes(name, samples, gpu):
    """With effects that read signals, too."""
    model, rng = gpu(name), np.random.default_rng(1)
    motion = states(len(model.spec.joints), samples)
    tau = rng.normal(size=motion[0].shape)
    s = {"s": rng.uniform(0, 1, (samples, len(model.spec.signals)))} if model.spec.signals else {}
    phi = loaded(robot_module(name).emitted).base_regressor(*motion, **s)
    expected = np.array([phi[:, joint, column] for joint, column in model.spec.nonzeros])
    atol = 1e-12 * np.abs(phi).max()
    np.testing.assert_allclose(model.nonzeros(*motion, **s), expected, rtol=1e-12, atol=atol)
    for mask in (None, rng.uniform(size=tau.shape) < 0.7):
        used = np.ones_like(tau) if mask is None else mask
        wanted = grams(phi * used[:, :, None], tau * used, model)
        for got, exact in zip(model.gram(*motion, tau, use=mask, **s), wanted, strict=True):
            size = np.sqrt(np.outer(np.diag(exact), np.diag(exact)))
            assert (np.abs(got - exact) <= 1e-12 * size + 1e-300).all()
    if s:
        with pytest.raises(ShapeError, match="its effects read signals; give s"):
            model.nonzeros(*motion)


def test_of_no_samples_nothing_and_what_is_refused(gpu):
    model = gpu("wrist")
    none = np.empty((0, 3))
    assert model.nonzeros(none, none, none).shape == (len(model.spec.nonzeros), 0)
    assert not any(square.any() for square in model.gram(none, none, none, none))
    q, qd, qdd = states(3, 5)
    assert model.nonzeros(on_device(q), qd, qdd).shape == (len(model.spec.nonzeros), 5)
    nan = on_device(np.full((5, 3), np.nan))
    for call, says in (
        (lambda: model.nonzeros(q, qd[:4], qdd), "different numbers of samples"),
        (lambda: model.gram(q, qd, qdd, q, use=np.ones((5, 2), bool)), r"use: got shape \(5, 2\)"),
        (lambda: model.nonzeros(nan, qd, qdd), "q: got values that are not finite"),
        (
            lambda: model.nonzeros(on_device(q[:, :2]), qd, qdd),
            r"q: got shape \(5, 2\), expected \(samples, 3\)",
        ),
        (
            lambda: model.nonzeros(q, qd, qdd, s=np.zeros((5, 1))),
            "got s, but its effects read no signals; leave s out",
        ),
        (lambda: model.gram(q, qd, qdd, None), "tau: got no array of real numbers"),
    ):
        with pytest.raises(ShapeError, match=says):
            call()


def on_device(array: np.ndarray) -> np.ndarray:
    """An array that says it lies on the processor."""

    class There(np.ndarray):
        __cuda_array_interface__ = None

    return array.view(There)


def test_without_cupy_or_a_processor_one_line(monkeypatch, tmp_path):
    def no_driver() -> int:
        raise RuntimeError("driver too old\nat line 3")

    broken = cupy(tmp_path)
    broken.cuda.runtime.getDeviceCount = no_driver
    for module_of_cupy, says in (
        (None, r'CuPy is not installed; pip install "modeler-robotics\[gpu\]"'),
        (cupy(tmp_path, devices=0), r"CuPy finds none; use compile_model, which needs none$"),
        (broken, r"finds none \(driver too old\); use compile_model"),
    ):
        monkeypatch.setitem(sys.modules, "cupy", module_of_cupy)
        with pytest.raises(BuildError, match=says):
            load_on_gpu(derive(load("wrist")))


@pytest.mark.rotating("laws and kernels")
def test_a_compiler_that_refuses_is_quoted(monkeypatch, tmp_path):
    compiler("g++")
    monkeypatch.setitem(sys.modules, "cupy", cupy(tmp_path))
    with pytest.raises(BuildError, match="the emitted kernels do not compile:\n"):
        GpuModel(emitted("wrist").spec, "no C")


def test_modules_without_kernels():
    with pytest.raises(ManifestError, match=r"has no wrist\.cu; generate it with cuda=True"):
        load_gpu(module("wrist").emitted)
    with pytest.raises(EmitError, match="five-bar has loops, whose closing has no CUDA form"):
        emit(module("five-bar").model, module("five-bar").base, cuda=True)
    with pytest.raises(EmitError, match="CUDA is emitted in double precision only"):
        emit(module("wrist").model, module("wrist").base, precision="single", cuda=True)


@pytest.mark.rotating("laws and kernels")
def test_nvcc_compiles_the_kernels(tmp_path):
    if shutil.which("nvcc") is None:
        pytest.skip("NOT CHECKED: nvcc is not installed")
    (tmp_path / "kernels.cu").write_text(emitted("puma560").files["puma560.cu"])
    command = ["nvcc", "-ptx", "-arch=sm_80", "-Werror", "all-warnings", "-o", "k.ptx"]
    subprocess.run([*command, "kernels.cu"], cwd=tmp_path, check=True, capture_output=True)
    assert ".entry puma560_gram_kernel" in (tmp_path / "k.ptx").read_text()


def test_nvrtc_compiles_the_kernels():
    """The compiler that CuPy calls; it needs no processor."""
    library = nvrtc()
    source = emitted("puma560").files["puma560.cu"].encode()
    program = ctypes.c_void_p()
    made = library.nvrtcCreateProgram(ctypes.byref(program), source, b"k.cu", 0, None, None)
    assert made == 0
    options = (ctypes.c_char_p * 1)(b"--gpu-architecture=compute_80")
    done = library.nvrtcCompileProgram(program, 1, options)
    size = ctypes.c_size_t()
    library.nvrtcGetProgramLogSize(program, ctypes.byref(size))
    log = ctypes.create_string_buffer(size.value)
    library.nvrtcGetProgramLog(program, log)
    assert done == 0 and not log.value.strip(), log.value.decode()


def nvrtc() -> ctypes.CDLL:
    spec = util.find_spec("nvidia.cuda_nvrtc") if util.find_spec("nvidia") else None
    places = [Path(place) / "lib" for place in spec.submodule_search_locations] if spec else []
    values = [path for place in places for path in place.glob("libnvrtc.so.*")]
    if not values:
        pytest.skip("NOT CHECKED: NVRTC is not installed (nvidia-cuda-nvrtc-cu12)")
    return ctypes.CDLL(str(values[0]))
