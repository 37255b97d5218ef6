"""Entries that are read again: without numba's library, without what only other compilations need."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core.compiler import ahead, cache, jit, keeping
from gradhesion.core.compiler.probe import LAZY

pytestmark = pytest.mark.skipif(not LAZY, reason="numba links in its own way: kernels are kept as it does")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place of its own for what a test compiles."""
    place = tmp_path / "kernels"
    monkeypatch.setattr(cache, "place", lambda: cache.Place(place))
    return place


@jit.kernel()
def root(x: float) -> float:
    return math.sqrt(x * x + 1.0)


def made() -> Any:
    """An entry with a kernel below, as a new process would make it."""

    @jit.kernel()
    def outermost(x: float) -> float:
        return root(x) - root(2.0 * x)

    return outermost


def counted(entry: Any, *arguments: Any) -> tuple[Any, int]:
    """What an entry returns, and how many times it has been compiled."""
    value = entry(*arguments)
    return value, sum(entry.stats.cache_misses.values())


def test_an_entry_is_read_again(folder: Path) -> None:
    value, times = counted(made(), 0.7)
    assert math.isclose(value, math.sqrt(1.49) - math.sqrt(2.96), rel_tol=1e-14)
    assert times == 1
    assert counted(made(), 0.7) == (value, 0)
    (kept,) = folder.rglob("*.nbc")
    assert b"root(x)" not in kept.read_bytes(), "no words"
    assert b"BC\xc0\xde" not in kept.read_bytes(), "no intermediate code"


def test_nothing_is_kept_without_a_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))
    first, second = counted(made(), 0.7), counted(made(), 0.7)
    assert first == second
    assert first[1] == 1


@pytest.mark.usefixtures("folder")
def test_a_folder_that_cannot_be_made_is_none(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setattr(cache, "place", lambda: cache.Place(tmp_path / "file" / "kernels"))
    assert [counted(made(), 0.7)[1] for _ in range(2)] == [1, 1]
    assert not list(Path(__file__).parent.rglob(f"{Path(__file__).stem}.*.nb?")), (
        "nor is anything kept beside the source"
    )


@pytest.mark.usefixtures("folder")
def test_constants_that_python_needs_are_kept() -> None:
    def make() -> Any:
        @jit.kernel()
        def second(rows: Any) -> Any:
            return rows[1]

        return second

    rows = np.array([(1.7,), (2.3,)], dtype=[("x", float)])
    for times in (1, 0):
        record, compiled = counted(make(), rows)
        assert (record["x"], record.dtype, compiled) == (2.3, rows.dtype, times)


PROCESS = """
import json, sys
from pathlib import Path
from gradhesion.core.compiler.jit import watch_compilation
from gradhesion.core.compiler import jit
from gradhesion.core.problem.material import stiffness
names = []
with watch_compilation(names.append):
    value = float(stiffness(0.3, 0.3, 500.0, 0.01))
    library = "numba.np.npyimpl" in sys.modules
    things = [thing for name in [*sys.modules] if name.startswith("gradhesion.core") for thing in vars(sys.modules[name]).values()]
    kernels = {id(thing): vars(thing) for thing in things if isinstance(thing, jit.Kernel)}.values()
    made = [sum(name in kernel for kernel in kernels) for name in ("_entry", "_inner")]
    @jit.kernel()
    def half(x):
        return x / 2.0
    half.py_func.__module__ = "gradhesion.core.nowhere"
    print(json.dumps([value, library, half(3.0), names, made]))
"""


@pytest.mark.slow
def test_what_is_read_needs_no_library_and_what_is_compiled_afterwards_has_it(tmp_path: Path) -> None:
    def run() -> list[Any]:
        environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path), "GRADHESION_KERNELS": "own"}
        done = subprocess.run(
            [sys.executable, "-c", PROCESS], env=environment, capture_output=True, text=True, check=True
        )
        found: list[Any] = json.loads(done.stdout)
        return found

    first, second = run(), run()
    assert first[:2] == [second[0], True]
    assert len(first[3]) > len(second[3])
    assert second[1:4] == [False, 1.5, ["nowhere.half"]]
    assert first[4][1] > 5
    assert second[4] == [1, 0], "the one that is called, and nothing below"


@pytest.mark.usefixtures("folder")
def test_the_code_of_an_entry_can_be_had_by_who_compiled_it_and_by_who_read_it() -> None:
    first, second = made(), made()
    first(0.7)
    second(0.7)
    name = ahead.name_of(first.py_func, first.signatures[0])
    assert name.startswith(f"{__name__}.outermost-")
    assert keeping.code_of(first._entry).keys() == {name}
    assert keeping.code_of(first._entry) == keeping.code_of(second._entry)


def test_without_a_cache_there_is_no_code_to_be_had(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(None))
    entry = made()
    entry(0.7)
    with pytest.raises(LookupError, match=r"outermost.*float64.*not in the cache"):
        keeping.code_of(entry._entry)
