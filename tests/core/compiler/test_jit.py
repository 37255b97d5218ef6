"""The decorator of the kernels: where compiled code goes, and which arithmetic it keeps."""

import math
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from pathlib import Path

import numba
import pytest

from gradhesion.core.compiler import cache, jit
from gradhesion.core.compiler.probe import LAZY

CORE = Path(jit.__file__).parents[1]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place of its own for what a test compiles."""
    place = tmp_path / "kernels"
    monkeypatch.setattr(cache, "place", lambda: cache.Place(place))
    return place


def test_compiled_code_is_kept_there_and_the_setting_is_put_back(folder: Path) -> None:
    before = numba.config.CACHE_DIR

    @jit.kernel()
    def double(x: float) -> float:
        return 2.0 * x

    assert before == numba.config.CACHE_DIR
    assert double(1.7) == 3.4
    assert double.py_func(1.7) == 3.4
    assert list(folder.rglob("*.nbc"))


@pytest.mark.parametrize("folder", [None, "file/kernels"])
def test_a_kernel_needs_no_folder(folder: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr(cache, "place", lambda: cache.Place(folder and tmp_path / folder))
    monkeypatch.setattr(numba.core.caching.CacheImpl, "_locator_classes", [])  # nor may it take one of numba's own

    @jit.kernel()
    def triple(x: float) -> float:
        return 3.0 * x

    assert triple(1.7) == 3.0 * 1.7


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("contract", [False, True])
def test_arithmetic_is_that_of_ieee(contract: bool) -> None:
    @jit.kernel(contract=contract)
    def probe(x: float, y: float) -> tuple[bool, float, float, float]:
        return math.isnan(x), x - x, y / x, (1.0 + y) - 1.0

    assert probe(math.nan, 1.0)[0]
    assert math.isnan(probe(math.inf, 1.0)[1])
    assert probe(0.0, 1.0)[2] == math.inf  # numpy's error model: no exception
    assert math.copysign(1.0, probe(-math.inf, 1.0)[2]) == -1.0
    assert probe(1.0, 1e-17)[3] == 0.0  # nothing is reassociated


@pytest.mark.usefixtures("folder")
def test_contraction_only_where_asked() -> None:
    def rest(a: float, b: float) -> float:
        return a * b - 1.0

    a = 1.0 + 2.0**-30
    b = 1.0 - 2.0**-30
    assert jit.kernel()(rest)(a, b) == 0.0
    assert jit.kernel(contract=True)(rest)(a, b) in {0.0, -(2.0**-60)}


def test_nobody_else_compiles() -> None:
    for source in CORE.rglob("*.py"):
        if source not in {CORE / "compiler" / name for name in ("jit.py", "probe.py")}:
            assert not re.search(r"\b(njit|jit|vectorize|guvectorize|fastmath)\b\s*[(=]", source.read_text()), source


@pytest.mark.usefixtures("folder")
def test_a_constant_is_no_literal() -> None:
    one, two = jit.constant(1), jit.constant(2)

    @jit.kernel()
    def inner(x: float, n: int, flag: bool) -> float:
        return n * x if flag else -n * x

    @jit.kernel()
    def outer(x: float) -> float:
        return inner(x, one, jit.YES) + inner(x, two, jit.NO)

    assert outer(3.0) == 3.0 - 6.0
    assert len(inner.signatures) == 1


def test_what_is_compiled_is_heard_of(folder: Path) -> None:
    def make() -> Callable[[float], float]:
        @jit.kernel()
        def half(x: float) -> float:
            return 0.5 * x

        half.py_func.__module__ = "gradhesion.core.nowhere"
        return half

    names: list[str] = []
    first = make()  # stays, since what is read later asks for its module
    with jit.watch_compilation(names.append):
        assert first(3.0) == 1.5
        assert names == ["nowhere.half"]
        assert make()(5.0) == 2.5  # from the cache
    assert names == ["nowhere.half"]
    assert make()(7.0) == 3.5  # nobody listens any more
    assert list(folder.rglob("*.nbc"))


def test_a_process_that_compiles_clears_away_other_versions_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    cleared: list[Path] = []
    monkeypatch.setattr(cache, "remove_unused", cleared.append)
    heard = jit._Compilation()
    heard.on_start(None)
    heard.on_start(None)
    assert cleared == [folder]


@pytest.mark.skipif(not LAZY, reason="numba links in its own way: such a call ends the process")
def test_python_cannot_call_what_is_for_kernels_alone(folder: Path) -> None:
    def third(x: float) -> float:
        return x / 3.0

    third.__name__ = "_third"
    inner = jit.kernel()(third)

    @jit.kernel()
    def two_thirds(x: float) -> float:
        return 2.0 * inner(x)

    with pytest.raises(TypeError, match="third is called by kernels alone: its name begins with _"):
        inner(1.0)
    assert two_thirds(1.5) == 1.0
    assert len(list(folder.rglob("*.nbc"))) == 1


@pytest.mark.skipif(not LAZY, reason="numba links in its own way: all is made at once")
@pytest.mark.usefixtures("folder")
def test_threads_that_call_a_kernel_first_make_it_once() -> None:
    @jit.kernel()
    def fifth(x: float) -> float:
        return x / 5.0

    with ThreadPoolExecutor(8) as pool:
        assert [*pool.map(fifth, [5.0] * 64)] == [1.0] * 64
    assert sum(fifth.stats.cache_misses.values()) == 1


def test_a_kernel_can_be_copied() -> None:
    @jit.kernel()
    def sixth(x: float) -> float:
        return x / 6.0

    assert copy(sixth)(6.0) == 1.0
