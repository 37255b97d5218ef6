"""The short form of the stress suite: some hundred scenes of each draw against every check, and what they may cost."""

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
SIZE = 250
WALKED = 70.0
"""Waves of a curve that is walked one by one; the checks of longer ones stand in the second half of the draws."""
DRAWS = {
    "hostile": hostile(1, 2 * SIZE, WALKED),
    "eventful": eventful(1, 2 * SIZE, WALKED),
    "hostile, any waves": hostile(1, SIZE),
    "eventful, any waves": eventful(1, SIZE),
}


@pytest.mark.parametrize("draw", DRAWS)
@pytest.mark.parametrize("check", CHECKS, ids=lambda check: str(check.__name__))
def test_it_holds(check: Callable[[Any], Any], draw: str) -> None:
    scenes = DRAWS[draw]
    excess = check(scenes)
    wrong = np.flatnonzero(~(excess <= 1.0))
    first = {name: float(values[wrong[0]]) for name, values in scenes.items()} if wrong.size else {}
    assert wrong.size == 0, f"{wrong.size} of {excess.size}, the first by {excess[wrong[0]]:.3g}: {first}"


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
