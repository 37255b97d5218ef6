"""The decorator of the kernels: where compiled code goes, and which arithmetic it keeps."""

import math
import re
from pathlib import Path

import numba
import pytest

from gradhesion.core import _jit, compiled_before

CORE = Path(_jit.__file__).parent


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place of its own for what a test compiles."""
    place = tmp_path / "kernels"
    monkeypatch.setattr(_jit, "CACHE_FOLDER", place)
    return place


def test_the_digest_follows_every_source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "inner").mkdir()
    (tmp_path / "one.py").write_text("a = 1\n")
    (tmp_path / "inner" / "two.py").write_text("b = 2\n")
    monkeypatch.setattr(_jit, "_CORE", tmp_path)
    digests = [_jit._digest_of_sources()]
    assert _jit._digest_of_sources() == digests[0]
    (tmp_path / "inner" / "two.py").write_text("b = 3\n")
    digests.append(_jit._digest_of_sources())
    (tmp_path / "inner" / "two.py").rename(tmp_path / "inner" / "three.py")
    digests.append(_jit._digest_of_sources())
    (tmp_path / "four.py").touch()
    digests.append(_jit._digest_of_sources())
    assert len(set(digests)) == 4


def test_compiled_code_is_kept_there_and_the_setting_is_put_back(folder: Path) -> None:
    before = numba.config.CACHE_DIR

    @_jit.kernel()
    def double(x: float) -> float:
        return 2.0 * x

    assert before == numba.config.CACHE_DIR
    assert double(1.7) == 3.4
    assert double.py_func(1.7) == 3.4
    assert list(folder.rglob("*.nbc"))


def test_a_home_that_cannot_be_written_is_no_mistake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr(_jit, "CACHE_FOLDER", tmp_path / "file" / "kernels")
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / "other"))

    @_jit.kernel()
    def triple(x: float) -> float:
        return 3.0 * x

    assert triple(1.7) == 3.0 * 1.7


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("contract", [False, True])
def test_arithmetic_is_that_of_ieee(contract: bool) -> None:
    @_jit.kernel(contract=contract)
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
    assert _jit.kernel()(rest)(a, b) == 0.0
    assert _jit.kernel(contract=True)(rest)(a, b) in {0.0, -(2.0**-60)}


def test_nobody_else_compiles() -> None:
    for source in CORE.rglob("*.py"):
        if source.name != "_jit.py":
            assert not re.search(r"\b(njit|jit|vectorize|guvectorize|fastmath)\b\s*[(=]", source.read_text()), source


def test_solving_leaves_compiled_kernels() -> None:
    from gradhesion.core import solve

    names = {"k": 0.2, "nu": 0.3, "modulus": 90.0, "c0_over_R": 1.1, "lambda_over_R": 0.4, "A": 0.01}
    solve(names | {"a_max_over_R": 0.7})
    assert compiled_before() or not _jit.CACHE_FOLDER.is_dir()
