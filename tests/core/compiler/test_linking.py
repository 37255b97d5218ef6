"""Kernels that are linked as intermediate code, beside those that numba links itself."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numba
import numpy as np
import pytest

from gradhesion.core.compiler import cache, jit, linking
from gradhesion.core.compiler.probe import LAZY

pytestmark = pytest.mark.skipif(not LAZY, reason="numba links in its own way: kernels are linked as it does")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A place of its own for what a test compiles."""
    place = tmp_path / "kernels"
    monkeypatch.setattr(cache, "place", lambda: cache.Place(place))
    return place


def three_levels() -> tuple[Any, Any, Any]:
    """An entry, a kernel that it calls, and one below it."""

    @jit.kernel(contract=True)
    def root(x: float) -> float:
        return math.sqrt(x * x + 1.0)

    @jit.kernel()
    def middle(x: float) -> float:
        return root(x) + math.sin(root(3.0 * x))

    @jit.kernel()
    def outermost(x: float) -> float:
        return middle(x) - root(2.0 * x)

    return outermost, middle, root


def expected(x: float) -> float:
    return math.sqrt(x * x + 1) + math.sin(math.sqrt(9 * x * x + 1)) - math.sqrt(4 * x * x + 1)


def is_open(dispatcher: Any) -> bool:
    (compiled,) = dispatcher.overloads.values()
    return bool(compiled.library._is_open)


def test_what_is_below_an_entry_has_no_machine_code_of_its_own(folder: Path) -> None:
    outermost, middle, root = three_levels()
    assert math.isclose(outermost(0.7), expected(0.7), rel_tol=1e-15)
    assert [is_open(middle._inner), is_open(root._inner), is_open(outermost._entry)] == [True, True, False]
    (kept,) = folder.rglob("*.nbc")
    assert "outermost" in kept.name
    assert middle._entry.signatures == []


def test_python_calls_what_is_inner_by_an_entry_of_its_own(folder: Path) -> None:
    outermost, middle, _ = three_levels()
    outermost(0.7)
    assert math.isclose(middle(0.7), math.sqrt(1.49) + math.sin(math.sqrt(9 * 0.49 + 1)), rel_tol=1e-15)
    assert len(list(folder.rglob("*.nbc"))) == 2
    assert middle.signatures == [(numba.float64,)], "one for both"


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("first", [True, False])
def test_kernels_of_others_can_call_ours(first: bool) -> None:
    outermost, middle, _ = three_levels()
    if first:
        outermost(0.7)

    @numba.njit  # type: ignore[untyped-decorator]
    def theirs(x: float) -> float:
        return middle(x) + outermost(x)

    assert theirs(0.7) == middle(0.7) + outermost(0.7)
    assert outermost(0.7) == three_levels()[0](0.7)


@pytest.mark.usefixtures("folder")
def test_a_mistake_in_a_kernel_is_an_error_and_nothing_else() -> None:
    @jit.kernel()
    def wrong(x: float) -> float:
        return x.nothing  # type: ignore[attr-defined, no-any-return]

    @jit.kernel()
    def calls(x: float) -> float:
        return wrong(x)

    with pytest.raises(numba.TypingError):
        calls(1.0)
    assert linking._compiling == []
    assert math.isclose(three_levels()[0](0.7), expected(0.7), rel_tol=1e-15)


READ = """
import sys
from gradhesion.core import solve
scene = dict(k=0.3, nu=0.3, modulus=500.0, c0_over_R=0.01, lambda_over_R=0.1, A=0.03, a_max_over_R=0.5)
assert solve(scene, ["pull_off_force"], threads=1)["pull_off_force"] > 0.0
print([name for name in ("numba.np.arraymath", "numba.np.linalg", "scipy.linalg") if name in sys.modules])
"""


def test_what_is_kept_is_read_without_what_compiles() -> None:
    subprocess.run([sys.executable, "-c", READ], check=True)  # it may compile
    done = subprocess.run([sys.executable, "-c", READ], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


SWEEP = """
import hashlib, json, sys
import numba.core.compiler
if sys.argv[1] == "another version":
    del numba.core.compiler.CompileResult._rebuild
import numpy as np
from gradhesion.core import solve
from gradhesion.core.compiler.probe import LAZY
from numba.core.registry import cpu_target
rng = np.random.default_rng(5)
scenes = dict(
    k=rng.choice([0.0, 0.3, 0.8], 2000), nu=0.3, modulus=10 ** rng.uniform(1, 4, 2000), c0_over_R=0.01,
    lambda_over_R=10 ** rng.uniform(-1.3, 0, 2000), A=10 ** rng.uniform(-3.5, -1, 2000), a_max_over_R=1.0,
)
found = {"pull_off_force": solve(scenes, ["pull_off_force"], threads=1)["pull_off_force"]}
found |= solve(scenes, ["dissipated_energy"], solver="envelope", threads=1)
force = hashlib.sha256(found["pull_off_force"].tobytes()).hexdigest()
own = cpu_target.target_context.codegen()._library_class.__module__ == "gradhesion.core.compiler.linking"
print(json.dumps([LAZY, own, force, found["dissipated_energy"].tolist()]))
"""


def swept(how: str, folder: Path | None = None) -> list[Any]:
    """Solve scenes in a process of its own, whose kernels are linked lazily or not, kept in a folder or as always."""
    environment = os.environ | ({"NUMBA_CACHE_DIR": str(folder)} if folder else {})
    command = [sys.executable, "-c", SWEEP, how]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    found: list[Any] = json.loads(done.stdout)
    return found


@pytest.mark.slow
def test_both_ways_give_the_same_values(tmp_path: Path) -> None:
    """Forces to the bit; energies, here those of the envelopes, to the roundings of a few sums: see linking.py."""
    lazy, ordinary = swept(""), swept("another version", tmp_path)
    assert lazy[:2] == [True, True]
    assert ordinary[:2] == [False, False]
    assert lazy[2] == ordinary[2]
    one, other = np.array(lazy[3]), np.array(ordinary[3])
    np.testing.assert_allclose(one, other, rtol=8 * 2.0**-52, atol=0.0)
    assert np.count_nonzero(one == other) > 0.99 * np.count_nonzero(one > 0.0) > 500
    assert len(list(tmp_path.rglob("*.nbc"))) > 30, "numba keeps every kernel"


@pytest.mark.parametrize(("how", "lazy"), [("", "True"), ("ordinary", "False")])
def test_the_environment_can_ask_for_the_ordinary_way(how: str, lazy: str) -> None:
    code = (
        "from gradhesion.core.compiler import linking, probe; from numba.core.registry import cpu_target; "
        "print(probe.LAZY, cpu_target.target_context.codegen()._library_class is linking._Library)"
    )
    environment = os.environ | {"GRADHESION_LINKING": how}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.split() == [lazy, lazy]
