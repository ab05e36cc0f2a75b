"""Tiles: the same values as one sample after another, wherever a sample stands and whatever is in
the others; robots, compilers and instruction sets side by side."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

import modeler.runtime.build as threads
import modeler.runtime.fused as tiling
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.errors import LoopError, ManifestError, ShapeError
from modeler.runtime.bind import load_tile_library
from modeler.runtime.model import CompiledModel, load_folder, load_module
from tests.codegen.fitted_library import robot_module
from tests.modules import STRICT, compiled, compiler, loaded, module, states, unoptimised
from tests.rotation import ROTATING, with_cases

BOUND = 64 * np.finfo(float).eps  # of the largest entry of the sample: roundings in other places
SAMPLES = 21


@pytest.fixture
def tiled(monkeypatch):
    """Tiles for any number of samples."""
    monkeypatch.setattr(tiling, "TILED_FROM", 1)
    monkeypatch.setattr(tiling, "_SLICE", 8)


def home_of(model: CompiledModel) -> np.ndarray:
    return np.array([model.spec.closure.home[place] for place in model.spec.closure.actuated])


def assert_close(got: np.ndarray, expected: np.ndarray) -> None:
    """Equal to the bound, sample by sample."""
    assert got.shape == expected.shape
    apart = np.abs(got - expected).max(axis=1, initial=0)
    assert (apart <= BOUND * np.abs(expected).max(axis=1, initial=1)).all()


@with_cases(
    "name",
    "emps",
    *(pytest.param(n, marks=pytest.mark.digits) for n in ("wrist", "slow-arm")),
    pytest.param("scara", marks=pytest.mark.rotating),
    *(pytest.param(n, marks=ROTATING) for n in ("sr400-tree", "tx40", "dvrk-psm")),
)
def test_a_tile_has_the_values_of_the_scalar_functions(name, monkeypatch):
    """Effects that read signals have tiles, too."""
    model = loaded(robot_module(name).emitted) if name == "slow-arm" else compiled(name)
    spec, motion = model.spec, states(len(model.spec.joints), SAMPLES)
    s = np.random.default_rng(3).uniform(0.1, 0.9, (SAMPLES, len(spec.signals)))
    s = {"s": s} if spec.signals else {}
    entries, phi = model.nonzeros(*motion, **s), model.base_regressor(*motion, **s)
    monkeypatch.setattr(tiling, "TILED_FROM", 1)
    monkeypatch.setattr(tiling, "_SLICE", 8)
    assert_close(model.nonzeros(*motion, **s), entries)
    by_tiles = model.base_regressor(*motion, **s)
    assert_close(by_tiles.reshape(SAMPLES, -1), phi.reshape(SAMPLES, -1))
    W = model.observation(*motion, **s)
    np.testing.assert_array_equal(W, by_tiles.reshape(W.shape))
    rows, columns = np.array(spec.nonzeros).T
    np.testing.assert_array_equal(model.nonzeros(*motion, **s), by_tiles[:, rows, columns])


@pytest.mark.parametrize("name", ["emps", "wrist"])
@pytest.mark.parametrize("samples", [1, 7, 8, 20, 70])
def test_rows_and_columns_may_begin_anywhere_and_nothing_else_is_written(samples, name, tiled):
    model = compiled(name)
    motion = states(len(model.spec.joints), samples)
    W = model.observation(*motion)
    for begin in (0, 1, 3, 8):
        rows = np.full(W.size + 32, 7.5)
        out = rows[begin : begin + W.size].reshape(W.shape)
        assert model.observation(*motion, out=out) is out
        columns = np.full((len(W) + 9, W.shape[1]), 7.5, order="F")
        model._tiles.fill_samples([*motion], columns[begin : begin + len(W)], True)
        for whole, end in ((rows, begin + W.size), (columns, begin + len(W))):
            np.testing.assert_array_equal(whole[begin:end].reshape(W.shape), W)
            assert (whole[:begin] == 7.5).all() and (whole[end:] == 7.5).all()
    by_columns = model.observation(*motion, order="F")
    assert by_columns.flags.f_contiguous
    np.testing.assert_array_equal(by_columns, W)
    assert model.observation(*motion, out=by_columns) is by_columns


def test_results_do_not_depend_on_place_number_or_threads(tiled, monkeypatch):
    model = compiled("wrist")
    motion = states(3, 100)
    whole = model.nonzeros(*motion)
    for begin in (1, 3, 8, 50):
        part = model.nonzeros(*(array[begin:] for array in motion))
        np.testing.assert_array_equal(part, whole[begin:])
    for count in (1, 2, 5):
        monkeypatch.setattr(threads, "count_processors", lambda count=count: count)
        np.testing.assert_array_equal(model.nonzeros(*motion), whole)


@pytest.mark.digits
def test_far_angles_and_values_that_are_no_numbers_stay_in_their_lane(monkeypatch):
    """The scalar function says what they give; their neighbours must not change at all."""
    model = compiled("wrist")
    tiles, function = model._tiles, model._functions["base_regressor_nonzeros"]
    q, qd, qdd = states(3, 16)
    shape = (16, len(model.spec.nonzeros))
    clean, got, expected = np.empty(shape), np.empty(shape), np.empty(shape)
    tiles.fill_samples((q, qd, qdd), clean, dense=False)
    for k, odd in enumerate([99_999.9, 1e5, -1e5, 3e7, -1e15, 1e300, np.nan, np.inf, -np.inf]):
        for array in (q, qd, qdd):
            lane, changed = (3 * k) % 16, array.copy()
            changed[lane, k % 3] = odd
            inputs = [changed if each is array else each for each in (q, qd, qdd)]
            tiles.fill_samples(inputs, got, dense=False)
            model._library.run_batch(function, inputs, expected)
            others = np.arange(16) != lane
            np.testing.assert_array_equal(got[others], clean[others])
            size = np.nanmax(np.where(np.isfinite(expected[lane]), np.abs(expected[lane]), 1.0))
            bounds = {"rtol": 1e-12, "atol": BOUND * size}
            np.testing.assert_allclose(got[lane], expected[lane], **bounds, equal_nan=True)


def compiled_check(emitted, folder, *words, units=()):
    """Whether tiles of every instruction set have the values of the scalar function."""
    prefix = emitted.spec.prefix
    text = Path(__file__).with_name("check_tiles.c").read_text()
    write_emitted(emitted, folder)
    (folder / "check.c").write_text(text.replace("wrist", prefix).replace("WRIST", prefix.upper()))
    command = [compiler(words[0]), *STRICT, *words[1:], "-o", "check", "check.c"]
    units = (f"{prefix}_base_regressor.c", "modeler_tile.c", *units)
    built = subprocess.run([*command, *units, "-lm"], cwd=folder, capture_output=True, text=True)
    if "cannot find" in built.stderr and "san" in built.stderr:
        pytest.skip(f"NOT CHECKED: {words[0]} has no sanitizer libraries")
    assert built.returncode == 0, built.stderr
    return subprocess.run([folder / "check"]).returncode == 0


SANITIZED = ["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
FAST = ["-O2", "-ffp-contract=fast"]
FLAGS = [
    *(("gcc", ["-O0"]), ("clang", ["-DMODELER_PLAIN"])),
    *(
        pytest.param(cc, flags, marks=pytest.mark.rotating)
        for cc, flags in (
            ("clang", ["-O0"]),
            ("gcc", ["-DMODELER_PLAIN"]),
            ("gcc", FAST),
            ("clang", FAST),
        )
    ),
    *(
        pytest.param(cc, [*SANITIZED, *flags], marks=pytest.mark.slow)
        for cc in ("gcc", "clang")
        for flags in (["-O0"], ["-O2", "-march=native"])
    ),
]


@pytest.mark.parametrize(("cc", "flags"), FLAGS)
def test_every_instruction_set_of_this_processor_gives_the_same(cc, flags, tmp_path):
    assert compiled_check(module("wrist").emitted, tmp_path, cc, *flags)


def test_robots_with_loops_have_no_entries_of_their_own_and_say_so():
    model = compiled("five-bar")
    q = home_of(model)[None]
    with pytest.raises(ManifestError, match=r"five-bar has loops: every entry .* base_regressor"):
        model.nonzeros(q, 0 * q, 0 * q)


@with_cases(
    "name, plain",
    pytest.param("five-bar", False, marks=pytest.mark.digits),
    *(
        pytest.param(*case, marks=pytest.mark.rotating)
        for case in (("five-bar", True), ("3rrr", False))
    ),
)
def test_loops_closed_side_by_side_are_those_closed_one_by_one(name, plain):
    """Fast and slow, at rest, with leaps, out of reach and back, with values that are none."""
    model = compiled(name)
    with unoptimised(*["-O1", "-DMODELER_PLAIN"] * plain):
        tiles = load_tile_library(model.spec, model._tile_files, model._library)
    home = home_of(model)
    rng = np.random.default_rng()
    for far in (1e-3, 0.3, 3.0)[: 3 if name == "five-bar" else 2]:
        samples = 203
        t = np.linspace(0, 9, samples)[:, None]
        q = home + far * np.sin(t * rng.uniform(0.5, 1, len(home)))
        q[60:90] = q[60]
        q[120:] += 0.01
        qd, qdd = rng.normal(0, 2, (2, *q.shape))
        q[140, 0] = qd[150, 1] = np.nan
        shape = (samples * len(home), len(model.spec.base))
        items, value = np.zeros((2, samples), "i")
        W, order = np.empty(shape), np.empty(shape, order="F")
        model._library.fill_observation([q, qd, qdd], W, items)
        for out in (np.empty(shape), order):
            tiles.fill_samples([q, qd, qdd], out, True, value)
            np.testing.assert_array_equal(value, items)
            largest = np.abs(W).reshape(samples, -1).max(axis=1).repeat(len(home))[:, None]
            apart = np.abs(out - W) / largest
            assert not (apart > 1e-9).any() and np.nanmedian(apart.max(axis=1)) < 1e-13
            np.testing.assert_array_equal(np.isnan(out), np.isnan(W))
    assert items[140] == items[150] == 3


def test_the_observation_matrix_of_loops_uses_tiles(tiled):
    model = compiled("five-bar")
    home = home_of(model)
    q = home + 1e-3 * np.arange(40)[:, None]
    W = model.observation(q, 0 * q, 1 + 0 * q)
    expected = model.base_regressor(q, 0 * q, 1 + 0 * q)
    np.testing.assert_allclose(W, expected.reshape(W.shape), atol=1e-11)
    with pytest.raises(LoopError, match="five-bar: sample 3: the loops"):
        model.observation(q + [[9.0, -9.0]] * (np.arange(40) == 2)[:, None], 0 * q, q)


@pytest.mark.parametrize("name", [pytest.param("wrist", marks=pytest.mark.digits), "five-bar"])
def test_tiles_in_single_precision(name, tiled, monkeypatch):
    made = module(name)
    model = loaded(emit(made.model, made.base, precision="single"))
    q, qd, qdd = states(len(model.spec.joints), 37)
    if model.spec.closure is not None:
        q = home_of(model) + 1e-3 * q
    W = model.observation(q, qd, qdd)
    np.testing.assert_array_equal(model.observation(q, qd, qdd, order="F"), W)
    monkeypatch.setattr(tiling, "TILED_FROM", 2**18)
    expected = compiled(name).observation(q, qd, qdd)
    size = np.abs(expected).max()
    assert np.abs(W - expected).max() < 3e-6 * size
    assert np.abs(model.observation(q, qd, qdd) - expected).max() < 3e-6 * size


def test_a_module_without_the_unit_is_evaluated_sample_by_sample(tiled, tmp_path):
    """As those of older model files."""
    emitted = module("wrist").emitted
    files = {name: emitted.files[name] for name in emitted.spec.sources}
    with unoptimised():
        older, motion = load_module(emitted.spec, files), states(3, SAMPLES)
        write_emitted(emitted, tmp_path)
        assert load_folder(tmp_path)._tiles is not None and older._tiles is None
    assert_close(older.nonzeros(*motion), compiled("wrist").nonzeros(*motion))
    assert older.observation(*motion).shape == (SAMPLES * 3, len(emitted.spec.base))


def test_tiles_of_another_robot_are_refused(tiled):
    emitted = module("wrist").emitted
    text = emitted.files["wrist_tile.c"].replace(
        emitted.spec.compute_signature(), "0123456789abcdef"
    )
    with unoptimised():
        model = load_module(emitted.spec, {**emitted.files, "wrist_tile.c": text})
    with (
        unoptimised(),
        pytest.raises(ManifestError, match="tiles answers 0123456789abcdef, the manifest expects"),
    ):
        model.nonzeros(*states(3, 9))


def test_an_output_of_another_shape_is_refused():
    model, motion = compiled("wrist"), states(3, 4)
    entries = len(model.spec.nonzeros)
    with pytest.raises(ShapeError, match=rf"out: got \(4, 2\), expected an array \(4, {entries}\)"):
        model.nonzeros(*motion, out=np.empty((4, 2)))
    with pytest.raises(ShapeError, match="C-contiguous float64"):
        model.nonzeros(*motion, out=np.empty((entries, 4)).T)


@pytest.mark.digits
def test_triangles_of_tiles_are_those_of_samples(monkeypatch):
    model, motion = compiled("wrist"), states(3, 200)
    tau = np.random.default_rng(5).normal(size=(200, 3))
    one = model.triangles(*motion, tau).triangles
    monkeypatch.setattr(tiling, "TILED_FROM", 1)
    both = model.triangles(*motion, tau).triangles
    np.testing.assert_allclose(np.abs(both), np.abs(one), rtol=0, atol=1e-11 * np.abs(one).max())
