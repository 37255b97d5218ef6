"""Some hundred scenes of each draw against every check, and what they may cost.

STRESS_SCENES=100000 STRESS_SEED=7 pytest tests/stress -k long      more of them, and fresh ones
"""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gradhesion.core import REPORTS, solve
from gradhesion.core.problem.status import NO_VALUE

from .checks import CHECKS, values_or_status
from .draw import Scenes, eventful, hostile

ROOT = Path(__file__).parents[2]
SIZE, SEED = int(os.environ.get("STRESS_SCENES", "250")), int(os.environ.get("STRESS_SEED", "1"))
CHUNK = 5000
"""Scenes that are solved at once, at most."""
WALKED = 70.0
"""Waves of a curve that is walked one by one; the checks of longer ones stand in the second half of the draws."""
DRAWS: dict[str, Callable[[int, int], Scenes]] = {
    "hostile": lambda seed, size: hostile(seed, 2 * size, WALKED),
    "eventful": lambda seed, size: eventful(seed, 2 * size, WALKED),
    "hostile, long": hostile,
    "eventful, long": eventful,
}


@pytest.mark.parametrize("draw", DRAWS)
@pytest.mark.parametrize("check", CHECKS, ids=lambda check: str(check.__name__))
def test_it_holds(check: Callable[[Any], Any], draw: str) -> None:
    for drawn in range(0, SIZE, CHUNK):
        scenes = DRAWS[draw](SEED + drawn, min(CHUNK, SIZE - drawn))
        excess = check(scenes)
        for i in np.flatnonzero(~(excess <= 1.0)):
            pytest.fail(f"{excess[i]:.3g}: { {name: float(values[i]) for name, values in scenes.items()} }")


def test_cost_and_memory_are_bounded() -> None:
    """No scene hangs or asks for memory without bound: the limits are wide, and a wall that is hit is a failure."""
    script = (
        "import resource, numpy as np\n"
        "from gradhesion.core import solve, OUTPUTS\n"
        "from tests.stress.draw import hostile, eventful\n"
        "solve(hostile(3, 50), OUTPUTS, threads=1)\n"
        "before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "for draw in (hostile, eventful):\n"
        "    solve(draw(2, 600), OUTPUTS, threads=1)\n"
        "print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, timeout=300, check=True
    )
    assert float(done.stdout) < 64.0, f"{done.stdout} MiB for 1,200 scenes"


def beyond_all_bounds(seed: int, size: int) -> Scenes:
    """Any positive doubles at all."""
    rng = np.random.default_rng(seed)
    scenes = {"k": rng.choice([0.0, 1e-16, 0.3, 0.7, 1.0 - 1e-12, 1.0], size), "nu": rng.choice([-0.9, 0.3, 0.5], size)}
    for name in ("modulus", "c0_over_R", "lambda_over_R", "A", "a_max_over_R"):
        wild = 10.0 ** rng.uniform(-300, 300, size)
        scenes[name] = np.where(rng.uniform(size=size) < 0.4, wild, 10.0 ** rng.uniform(-6, 2, size))
    return scenes


def test_beyond_all_bounds_it_ends() -> None:
    """Each scene has values, or a status that says why not, and none hangs; without a value there is no report."""
    scenes = beyond_all_bounds(4, 600)
    for endless in ({}, {"a_max_over_R": np.full(600, np.inf)}):
        assert np.all(values_or_status(scenes | endless) <= 1.0)
    result = solve(scenes, REPORTS)
    failed = (result["status"] & NO_VALUE) != 0
    assert 0.1 < np.mean(failed) < 0.9
    assert np.isnan([result[name][failed] for name in REPORTS]).all()
