"""The loops over curves: what each compiles, what is kept on disk, and curves that no solver takes."""

import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import OUTPUTS, SOLVERS, solve
from gradhesion.core.arrays.tables import table_of
from gradhesion.core.compiler import cache
from gradhesion.core.curve.branches import ROWS
from gradhesion.core.problem.curves import Curves
from gradhesion.core.problem.names import PULL_OFF
from gradhesion.core.problem.results import Results
from gradhesion.core.problem.status import NO_VALUE
from gradhesion.core.scene import cosine as scene
from gradhesion.core.scene import solvers
from gradhesion.core.sensitivities.wanted import NoSense

SCENE = {"k": 0.2, "nu": 0.3, "modulus": 90.0, "c0_over_R": 1.1, "lambda_over_R": 0.1, "A": 0.01, "a_max_over_R": 0.7}


def run(loop: Any, rims: np.ndarray, curves: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Run a loop over the outer two of several curves, all outputs and the test of the contact asked for."""
    out, status = (
        np.full((len(OUTPUTS), curves, rims.shape[1]), -7.0),
        np.full((curves, rims.shape[1]), NO_VALUE, np.int8),
    )
    stiffness, wavelength, amplitude = np.linspace(70, 90, curves), np.full(curves, 0.1), np.full(curves, 0.01)
    index, slots = np.array([0, curves - 1]), np.array([*range(len(OUTPUTS) + 1), -1])
    tables, which = np.array([table_of(0.2)]), np.zeros(2, dtype=np.int64)
    scratch = np.empty((ROWS, 192))
    own = Curves(tables, which, index, stiffness, wavelength, amplitude, rims)
    loop(own, Results(slots, out, status), scratch, NoSense())
    return out, status


def test_a_loop_compiles_its_own_curves_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "place", lambda: cache.Place(tmp_path))
    monkeypatch.setattr(scene, "solve_curve", None)  # to compile this would be an error
    out, _ = run(solvers.loop_of(solvers.ENVELOPE), np.array([[0.3, 0.7]]))
    assert np.isfinite(out[:, [0, 2]]).all()


def test_loops_are_kept_on_disk() -> None:
    for outputs in (PULL_OFF, OUTPUTS):
        solve(SCENE, outputs)
    if not cache.CACHE_FOLDER.is_dir():
        pytest.skip("no folder for compiled code")
    code = (
        "from gradhesion.core import OUTPUTS, solve\n"
        "from gradhesion.core.scene import solvers\n"
        f"for outputs in (OUTPUTS, {PULL_OFF!r}): solve({SCENE!r}, outputs, threads=1)\n"
        "loops = (solvers.LOOPS['exact'], solvers.PULL_OFF_LOOP)\n"
        "print([sum(loop.stats.cache_misses.values()) for loop in loops])\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[0, 0]\n"


@pytest.mark.parametrize("loop", [*solvers.LOOPS.values(), solvers.PULL_OFF_LOOP], ids=[*solvers.LOOPS, "pull-off"])
def test_only_the_curves_of_the_index_are_solved(loop: Any) -> None:
    out, status = run(loop, np.array([[0.3, 0.7]]))
    assert np.all(out[:, 1] == -7.0)
    np.testing.assert_array_equal((status & NO_VALUE) != 0, [[False, False], [True, True], [False, False]])
    # rims of their own, the same for all curves
    own, _ = run(loop, np.array([[0.3, 0.7]] * 3))
    np.testing.assert_array_equal(out, own)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize(
    "change",
    [
        {"modulus": math.nan},
        {"modulus": math.inf},
        {"modulus": -90.0},
        {"modulus": 1e300, "c0_over_R": 1e-300},
        {"lambda_over_R": 0.0},
        {"lambda_over_R": math.inf},
        {"A": -1e-3},
        {"A": math.inf},
        {"A": math.nan},
    ],
)
def test_a_curve_out_of_range_has_no_value(solver: str, change: dict[str, float]) -> None:
    result = solve(SCENE | change | {"k": 0.9, "a_max_over_R": [0.3, math.inf]}, OUTPUTS, solver=solver)
    assert np.all(result["status"] == NO_VALUE)
    for name in OUTPUTS:
        assert (
            np.all(result[name] == -1) if name in ("loading_jumps", "unloading_jumps") else np.isnan(result[name]).all()
        )
